#include "karinui/exchange/measurement_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "exchange/measure_names.h"
#include "karinui/base/number.h"
#include "karinui/design/script.h"
#include "names.h"

namespace karinui {

namespace {

constexpr std::size_t kMostColumns = 500, kLongestCell = 400;
constexpr double kInch = 0.0254;  // metres

// The rows of RFC 4180, with any of three separators: the one the first line has most of.
class Rows {
 public:
  explicit Rows(std::string_view bytes) : rest_(bytes) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    const std::string_view first = rest_.substr(0, rest_.find('\n'));
    long most = -1;
    for (const char separator : {',', ';', '\t'})
      if (const long found = std::count(first.begin(), first.end(), separator); found > most)
        most = found, separator_ = separator;
  }
  bool more() const { return !rest_.empty(); }
  std::size_t number() const { return number_; }  // of the last one, from 1
  // Spreadsheets that write 88,5 separate the cells by something else.
  bool decimalCommas() const { return separator_ != ','; }

  Result<std::vector<std::string>> next() {
    ++number_;
    std::vector<std::string> cells(1);
    bool quoted = false;
    std::size_t at = 0;
    for (; at < rest_.size(); ++at) {
      const char c = rest_[at];
      if (c == '\0') return badInput(say("Row {0} of the table is not text.", number_));
      if (quoted) {
        if (c != '"')
          cells.back() += c;
        else if (at + 1 < rest_.size() && rest_[at + 1] == '"')
          cells.back() += rest_[++at];
        else
          quoted = false;
      } else if (c == '"' && trimmed(cells.back()).empty()) {
        quoted = true;
      } else if (c == separator_) {
        cells.emplace_back();
      } else if (c == '\n') {
        break;
      } else {
        cells.back() += c;
      }
      if (cells.size() > kMostColumns || cells.back().size() > kLongestCell)
        return badInput(say("Row {0} of the table is too long.", number_));
    }
    if (quoted) return badInput(say("A quotation mark in row {0} of the table is never closed.", number_));
    rest_.remove_prefix(std::min(at + 1, rest_.size()));
    for (std::string& cell : cells) cell = std::string(trimmed(cell));
    return cells;
  }

 private:
  std::string_view rest_;
  char separator_ = ',';
  std::size_t number_ = 0;
};

struct Column {
  enum class Kind { Unknown, Name, Sex, Measure } kind = Kind::Unknown;
  std::string heading, key;
  std::optional<double> unit;  // metres or radians of a bare number; nothing: the cell says
};

// "bust_girth_cm", "Bust (mm)": the name and its unit.
std::pair<std::string, std::optional<double>> unitOf(std::string heading) {
  const std::pair<std::string_view, double> units[] = {{"mm", 0.001}, {"cm", 0.01}, {"inches", kInch}, {"inch", kInch},
                                                       {"in", kInch}, {"m", 1},     {"deg", kDegree},  {"rad", 1}};
  while (!heading.empty() && (heading.back() == ')' || heading.back() == ']')) heading.pop_back();
  for (const auto& [unit, metres] : units) {
    if (!heading.ends_with(unit) || heading.size() <= unit.size()) continue;
    const std::size_t end = heading.size() - unit.size();
    if (std::string_view("_ ([").find(heading[end - 1]) == std::string_view::npos) continue;
    const std::size_t last = heading.find_last_not_of("_ ([", end - 1);
    if (last == std::string::npos) continue;
    return {heading.substr(0, last + 1), metres};
  }
  return {heading, std::nullopt};
}

Column columnOf(const std::string& heading) {
  Column column;
  column.heading = heading;
  std::string lower = heading;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c; });
  if (lower == "name" || lower == "id" || lower == "person") return column.kind = Column::Kind::Name, column;
  if (lower == "sex" || lower == "gender") return column.kind = Column::Kind::Sex, column;
  auto [name, unit] = unitOf(heading);
  for (const std::string& one : {name, std::string(trimmed(std::string_view(lower).substr(0, name.size())))}) {
    std::string word = one;
    std::replace(word.begin(), word.end(), ' ', '_');
    if (const auto key = measurementKey(word)) {
      column.kind = Column::Kind::Measure, column.key = *key, column.unit = unit;
      break;
    }
  }
  return column;
}

std::optional<Sex> sexOf(std::string_view cell) {
  for (const std::string_view word : {"female", "f", "F", "Female", "woman", "w"})
    if (cell == word) return Sex::Female;
  for (const std::string_view word : {"male", "m", "M", "Male", "man"})
    if (cell == word) return Sex::Male;
  for (const std::string_view word : {"child", "c", "C", "Child", "girl", "boy"})
    if (cell == word) return Sex::Child;
  return std::nullopt;
}

// "88,5" and "88,5cm" with a point, nothing of what has no such comma. With points or more commas it is no number in
// any country.
std::optional<std::string> withPoint(std::string cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string::npos || cell.find_first_of(".,", comma + 1) != std::string::npos) return std::nullopt;
  const auto digit = [&](std::size_t at) { return at < cell.size() && cell[at] >= '0' && cell[at] <= '9'; };
  if (comma == 0 || !digit(comma - 1) || !digit(comma + 1) || cell.find('.') < comma) return std::nullopt;
  cell[comma] = '.';
  return cell;
}

Result<double> measureOf(const Column& column, const std::string& cell, bool decimalCommas) {
  const std::string close = withUnitClose(cell);
  const auto pointed = withPoint(close);
  if (pointed && !decimalCommas)
    return badInput(
        say("“{0}” has a decimal comma, and commas separate the cells here; write {1}, or separate the "
            "cells with semicolons.",
            cleanText(cell), cleanText(*pointed)));
  const std::string& text = pointed ? *pointed : close;
  if (column.unit)
    if (const auto number = parseNumber(text)) return *number * *column.unit;
  if (column.unit == kInch)
    if (const auto length = parseLength(text + "in")) return *length;  // 27 1/2
  const bool angle = isAngle(column.key);
  if (const Done meant = angle ? Done() : unitMeant(text); !meant)
    return badInput(say("{0} Or the column's name says it: {1}_cm.", meant.error().what, column.key));
  if (const auto value = angle ? parseAngle(text) : parseLength(text)) return *value;
  return badInput(say("“{0}” is no measure; write a number, or one with its unit, like 88.5cm.", cleanText(cell)));
}

}  // namespace

Result<MeasurementTable> readMeasurementTable(std::string_view bytes) {
  Rows rows(bytes);
  MeasurementTable table;
  std::vector<Column> columns;
  std::set<std::string> keys;
  DistinctNames names;
  while (rows.more()) {
    const auto cells = rows.next();
    if (!cells) return cells.error();
    if (std::all_of(cells->begin(), cells->end(), [](const auto& cell) { return cell.empty(); })) continue;
    if (columns.empty()) {
      for (const std::string& heading : *cells) {
        Column& column = columns.emplace_back(columnOf(heading));
        if (column.kind == Column::Kind::Unknown) table.unknown.push_back(cleanText(heading));
        if (column.kind == Column::Kind::Measure && !keys.insert(column.key).second)
          return badInput(say("Two columns of the table are the measure {0}.", column.key));
      }
      if (keys.empty())
        return badInput(say("The first row of the table names no measure, as in: name,height_cm,bust_girth_cm."));
      continue;
    }
    if (cells->size() > columns.size())
      return badInput(rows.decimalCommas()
                          ? say("Row {0} of the table has more cells than there are columns.", rows.number())
                          : say("Row {0} of the table has more cells than there are columns; numbers with decimal "
                                "commas need semicolons between the cells.",
                                rows.number()));
    if (table.people.size() == kMostPeople) return badInput(say("The table has more than {0} people.", kMostPeople));
    MeasuredPerson person;
    for (std::size_t i = 0; i < cells->size(); ++i) {
      const std::string& cell = (*cells)[i];
      if (cell.empty()) continue;
      const auto wrong = [&](const Message& what) {
        return badInput(
            say("Row {0} of the table, column “{1}”: {2}", rows.number(), cleanText(columns[i].heading), what));
      };
      switch (columns[i].kind) {
        case Column::Kind::Name:
          person.name = cleanText(cell);
          break;
        case Column::Kind::Sex:
          if (const auto sex = sexOf(cell))
            person.measures.sex = *sex;
          else
            return wrong(say("“{0}” is no figure; write female, male or child.", cleanText(cell)));
          break;
        case Column::Kind::Measure:
          if (const auto value = measureOf(columns[i], cell, rows.decimalCommas()))
            person.measures.value[columns[i].key] = *value;
          else
            return wrong(value.error().what);
          break;
        case Column::Kind::Unknown:
          break;
      }
    }
    if (person.name.empty()) person.name = "row " + std::to_string(rows.number());
    person.name = names.give(std::move(person.name));
    table.people.push_back(std::move(person));
  }
  if (table.people.empty()) return badInput(say("The table has no row with measures."));
  return table;
}

}  // namespace karinui
