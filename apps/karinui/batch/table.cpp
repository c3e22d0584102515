#include "table.h"

#include <sqlite3.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "karinui/base/number.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

// Numbers that every outcome may have, in this order; what else an outcome has follows by name.
constexpr const char* kNumbers[] = {"operations",
                                    "vertices",
                                    "strain_mean",
                                    "strain_p99",
                                    "strain_max",
                                    "seam_gap_mm",
                                    "penetration_mm",
                                    "cloth_body_crossings",
                                    "cloth_cloth_crossings",
                                    "fold_crossings",
                                    "fastenings_open",
                                    "too_small_m",
                                    "too_small_at",
                                    "strain_at",
                                    "pressure_mean_pa",
                                    "pressure_p99_pa",
                                    "pressure_at"};

BatchTable::Cell cellOf(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  return {};
}

std::size_t columnOf(const BatchTable& table, const std::string& name) {
  return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) - table.columns.begin());
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string all = "\"";
  for (const char c : text) all += c == '"' ? std::string("\"\"") : std::string(1, c);
  return all + "\"";
}

}  // namespace

std::optional<double> BatchTable::number(std::size_t row, const std::string& column) const {
  const std::size_t at = columnOf(*this, column);
  const auto* number = at < rows[row].size() ? std::get_if<double>(&rows[row][at]) : nullptr;
  return number ? std::optional(*number) : std::nullopt;
}
std::string BatchTable::text(std::size_t row, const std::string& column) const {
  const std::size_t at = columnOf(*this, column);
  const auto* words = at < rows[row].size() ? std::get_if<std::string>(&rows[row][at]) : nullptr;
  return words ? *words : std::string();
}

std::string misfitOf(const Json& outcome, const FitLimits& limits) {
  const Json& numbers = outcome.at("numbers");
  const auto above = [&](const char* name, double limit) {
    return numbers.contains(name) && numbers.at(name).is_number() && numbers.at(name).get<double>() > limit;
  };
  if (numbers.contains("too_small_m")) return "too small";
  if (outcome.at("outcome") != nameOf(Outcome::Ok)) return outcome.at("outcome").get<std::string>();
  if (above("fastenings_open", 0)) return "does not close";
  if (above("cloth_body_crossings", 0)) return "crosses the body";
  if (above("strain_p99", limits.strain)) return "stretched";
  if (above("pressure_p99_pa", limits.pressure)) return "presses";
  return {};
}

BatchTable tableOf(const BatchPlan& plan, const fs::path& folder) {
  BatchTable table;
  std::vector<Json> outcomes;
  std::set<std::string> measures, more;
  for (const BatchBody& body : plan.bodies)
    for (const auto& [key, value] : body.measures.value) measures.insert(key);
  for (const BatchItem& item : plan.items) {
    outcomes.push_back(itemOutcome(folder, item));
    table.said.push_back(outcomes.back().is_object() ? saidOf(outcomes.back()) : Message());
    if (!outcomes.back().is_object()) {
      ++table.missing;
      continue;
    }
    for (const auto& [name, value] : outcomes.back().at("numbers").items()) more.insert(name);
  }
  std::vector<std::string> numbers(std::begin(kNumbers), std::end(kNumbers));
  for (const std::string& name : numbers) more.erase(name);
  numbers.insert(numbers.end(), more.begin(), more.end());
  table.columns = {"key", "design", "person", "sex", "fabric", "outcome", "said", "misfit"};
  table.columns.insert(table.columns.end(), numbers.begin(), numbers.end());
  for (const std::string& key : measures) table.columns.push_back("body_" + key);
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    const BatchItem& item = plan.items[i];
    const BatchBody& body = plan.bodies[item.body];
    const bool known = outcomes[i].is_object();
    std::vector<BatchTable::Cell> row = {item.key, plan.designs[item.design].name, body.name,
                                         std::string(sexName(body.measures.sex)), item.fabric};
    const auto add = [&](BatchTable::Cell cell) { row.push_back(std::move(cell)); };
    add(known ? cellOf(outcomes[i].at("outcome")) : BatchTable::Cell());
    add(known ? cellOf(outcomes[i].at("said")) : BatchTable::Cell());
    add(known ? BatchTable::Cell(misfitOf(outcomes[i])) : BatchTable::Cell());
    for (const std::string& name : numbers)
      add(known && outcomes[i].at("numbers").contains(name) ? cellOf(outcomes[i].at("numbers").at(name))
                                                            : BatchTable::Cell());
    for (const std::string& key : measures) {
      const auto at = body.measures.value.find(key);
      add(at == body.measures.value.end() ? BatchTable::Cell() : BatchTable::Cell(at->second));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string asCsv(const BatchTable& table) {
  std::string all;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) all += (i ? "," : "") + cells[i];
    all += "\r\n";
  };
  line(table.columns);
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (const BatchTable::Cell& cell : row) {
      if (const auto* text = std::get_if<std::string>(&cell))
        cells.push_back(quoted(*text));
      else if (const auto* number = std::get_if<double>(&cell))
        cells.push_back(shortest(*number));
      else
        cells.emplace_back();
    }
    line(cells);
  }
  return all;
}

Done writeDatabase(const BatchTable& table, const fs::path& file) {
  const fs::path part = file.string() + ".part";
  std::error_code trouble;
  fs::remove(part, trouble);
  sqlite3* db = nullptr;
  bool good = sqlite3_open(part.c_str(), &db) == SQLITE_OK;
  const auto run = [&](const std::string& sql) {
    good = good && sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
  };
  run("PRAGMA page_size=4096; PRAGMA journal_mode=MEMORY; BEGIN");
  std::string columns, places;
  for (const std::string& column : table.columns) {
    std::string name;  // ours, and those of measures; a quotation mark would end it
    for (const char c : column) name += c == '"' ? '_' : c;
    columns += (columns.empty() ? "\"" : ", \"") + name + "\"";
    places += places.empty() ? "?" : ", ?";
  }
  run("CREATE TABLE item(" + columns + ")");
  sqlite3_stmt* insert = nullptr;
  good = good &&
         sqlite3_prepare_v2(db, ("INSERT INTO item VALUES(" + places + ")").c_str(), -1, &insert, nullptr) == SQLITE_OK;
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; good && i < row.size(); ++i) {
      const int at = static_cast<int>(i) + 1;
      if (const auto* text = std::get_if<std::string>(&row[i]))
        good = sqlite3_bind_text64(insert, at, text->data(), text->size(), SQLITE_TRANSIENT, SQLITE_UTF8) == SQLITE_OK;
      else if (const auto* number = std::get_if<double>(&row[i]))
        good = sqlite3_bind_double(insert, at, *number) == SQLITE_OK;
      else
        good = sqlite3_bind_null(insert, at) == SQLITE_OK;
    }
    good = good && sqlite3_step(insert) == SQLITE_DONE && sqlite3_reset(insert) == SQLITE_OK;
  }
  sqlite3_finalize(insert);
  run("COMMIT");
  const std::string why = good ? "" : sqlite3_errmsg(db);
  good = sqlite3_close(db) == SQLITE_OK && good;
  if (good) fs::permissions(part, fs::perms::owner_read | fs::perms::owner_write, trouble);
  if (good && !trouble) fs::rename(part, file, trouble);
  if (good && !trouble) return {};
  const std::string said = good ? trouble.message() : why;
  fs::remove(part, trouble);
  return storageError(say("“{0}” could not be written: {1}", file.string(), said));
}

}  // namespace karinui::app
