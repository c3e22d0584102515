// The fit over a population, drawn.
#include <algorithm>
#include <cmath>
#include <map>

#include "karinui/base/number.h"
#include "table.h"

namespace karinui::app {

namespace {

constexpr double kWide = 960, kMargin = 40, kPlotHigh = 170, kPlotWide = 410, kLine = 18;
constexpr std::size_t kMostNamed = 60;

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) switch (c) {
      case '&':
        all += "&amp;";
        break;
      case '<':
        all += "&lt;";
        break;
      case '>':
        all += "&gt;";
        break;
      default:
        all += c;
    }
  return all;
}
// At most so many letters as there is room for.
std::string shortened(const std::string& text) {
  std::size_t end = std::min<std::size_t>(text.size(), 150);
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return end < text.size() ? text.substr(0, end) + "…" : text;
}
std::string n(double value) { return fixed(value, 1); }

class Sheet {
 public:
  explicit Sheet(Language language) : language_(language) {}
  std::string said(const Message& message) const { return text(message, language_); }
  void words(double x, double y, const std::string& what, const char* kind = "plain", const char* anchor = "start") {
    body_ += "<text class=\"" + std::string(kind) + "\" x=\"" + n(x) + "\" y=\"" + n(y) + "\" text-anchor=\"" + anchor +
             "\">" + escaped(what) + "</text>\n";
  }
  void box(double x, double y, double wide, double high, const char* kind) {
    body_ += "<rect class=\"" + std::string(kind) + "\" x=\"" + n(x) + "\" y=\"" + n(y) + "\" width=\"" + n(wide) +
             "\" height=\"" + n(high) + "\"/>\n";
  }
  void line(double x1, double y1, double x2, double y2, const char* kind) {
    body_ += "<line class=\"" + std::string(kind) + "\" x1=\"" + n(x1) + "\" y1=\"" + n(y1) + "\" x2=\"" + n(x2) +
             "\" y2=\"" + n(y2) + "\"/>\n";
  }
  void dot(double x, double y) { body_ += "<circle class=\"dot\" cx=\"" + n(x) + "\" cy=\"" + n(y) + "\" r=\"3\"/>\n"; }
  std::string done(double high) const {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + n(kWide) + " " + n(high) + "\" width=\"" +
           n(kWide) + "\" height=\"" + n(high) +
           "\">\n<style>text{font-family:sans-serif;font-size:12px;fill:#222}.title{font-size:20px}.heading{font-size:"
           "14px;"
           "font-weight:bold}.bar{fill:#4477aa}.over{fill:#cc4433}.axis{stroke:#888}.limit{stroke:#cc4433;stroke-"
           "dasharray:"
           "4 3}.dot{fill:#4477aa;fill-opacity:0.6}.paper{fill:#fff}</style>\n<rect class=\"paper\" x=\"0\" y=\"0\" "
           "width=\"" +
           n(kWide) + "\" height=\"" + n(high) + "\"/>\n" + body_ + "</svg>\n";
  }

 private:
  Language language_;
  std::string body_;
};

std::size_t columnOf(const BatchTable& table, const std::string& name) {
  return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) - table.columns.begin());
}
std::optional<double> numberIn(const std::vector<BatchTable::Cell>& row, std::size_t column) {
  const auto* number = column < row.size() ? std::get_if<double>(&row[column]) : nullptr;
  return number ? std::optional(*number) : std::nullopt;
}
std::string textIn(const std::vector<BatchTable::Cell>& row, std::size_t column) {
  const auto* text = column < row.size() ? std::get_if<std::string>(&row[column]) : nullptr;
  return text ? *text : std::string();
}

// A round number not below `value`: 1, 2 or 5 times a power of ten.
double roundUp(double value) {
  const double ten = std::pow(10, std::floor(std::log10(std::fmax(value, 1e-9))));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * ten >= value * (1 - 1e-9)) return step * ten;
  return 10 * ten;
}

// How many people have which value; beyond `limit` in another colour.
void histogram(Sheet& sheet, double x, double y, const Message& heading, const std::vector<double>& values,
               double limit, const std::string& unit) {
  sheet.words(x, y, sheet.said(heading), "heading");
  y += 12;
  if (values.empty()) return sheet.words(x, y + kLine, sheet.said(say("Nothing is known.")));
  const double top = roundUp(std::fmax(limit * 1.2, *std::max_element(values.begin(), values.end())));
  constexpr std::size_t kBars = 20;
  std::vector<std::size_t> counts(kBars);
  for (const double v : values) ++counts[std::min(kBars - 1, static_cast<std::size_t>(std::fmax(0, v) / top * kBars))];
  const double most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  const double base = y + kPlotHigh - 30, wide = kPlotWide / kBars;
  for (std::size_t i = 0; i < kBars; ++i) {
    const double high = (kPlotHigh - 60) * static_cast<double>(counts[i]) / most;
    const bool over = top * static_cast<double>(i) / kBars >= limit;
    if (counts[i] > 0) sheet.box(x + static_cast<double>(i) * wide, base - high, wide - 1, high, over ? "over" : "bar");
  }
  sheet.line(x, base, x + kPlotWide, base, "axis");
  const double at = x + kPlotWide * limit / top;
  sheet.line(at, y + 14, at, base, "limit");
  sheet.words(at, y + 10, fixed(limit, 1) + " " + unit, "plain", "middle");
  for (int i = 0; i <= 4; ++i)
    sheet.words(x + kPlotWide * i / 4, base + 16, shortest(top * i / 4) + (i == 4 ? " " + unit : ""), "plain",
                i == 0   ? "start"
                : i == 4 ? "end"
                         : "middle");
  sheet.words(x, y + 10, sheet.said(say("highest bar: {0}", static_cast<std::size_t>(most))));
}

// The ease at each level, a dot a person.
double easePlot(Sheet& sheet, double y, const BatchTable& table, const std::vector<std::size_t>& rows) {
  sheet.words(kMargin, y, sheet.said(say("Ease: garment less body, cm; a dot is a person")), "heading");
  y += 24;
  std::vector<std::pair<std::string, std::vector<double>>> levels;
  double low = 0, high = 0;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    if (!name.starts_with("ease_") || !name.ends_with("_m")) continue;
    std::string words = name.substr(5, name.size() - 7);
    std::replace(words.begin(), words.end(), '_', ' ');
    std::vector<double> values;
    for (const std::size_t r : rows)
      if (const auto value = numberIn(table.rows[r], c)) values.push_back(*value * 100);
    if (values.empty()) continue;
    for (const double v : values) low = std::fmin(low, v), high = std::fmax(high, v);
    levels.emplace_back(sheet.said(Message{words, {}}), std::move(values));
  }
  if (levels.empty()) return sheet.words(kMargin, y, sheet.said(say("Nothing is known."))), y + kLine;
  const double top = high > 0 ? roundUp(high) : 0, bottom = low < 0 ? -roundUp(-low) : 0;
  const double left = kMargin + 110, wide = kWide - 2 * kMargin - 110;
  const auto at = [&](double v) { return left + wide * (v - bottom) / std::fmax(1e-9, top - bottom); };
  const double begin = y - 14;
  for (const auto& [name, values] : levels) {
    sheet.words(kMargin, y + 4, name);
    for (const double v : values) sheet.dot(at(v), y);
    y += 22;
  }
  sheet.line(at(0), begin, at(0), y - 8, "axis");
  sheet.words(at(0), y + 8, "0", "plain", "middle");
  for (const double v : {bottom, top})
    if (std::abs(at(v) - at(0)) > 40) sheet.words(at(v), y + 8, shortest(v), "plain", "middle");
  return y + 30;
}

}  // namespace

std::string fitSummary(const BatchPlan& plan, const BatchTable& table, Language language) {
  Sheet sheet(language);
  const FitLimits limits;
  const std::size_t design = columnOf(table, "design"), outcome = columnOf(table, "outcome"),
                    misfit = columnOf(table, "misfit"), person = columnOf(table, "person"),
                    fabric = columnOf(table, "fabric"), strain = columnOf(table, "strain_p99"),
                    pressure = columnOf(table, "pressure_p99_pa"), saidAt = columnOf(table, "said");
  double y = kMargin;
  sheet.words(kMargin, y, sheet.said(say("Fit over {0} people", plan.bodies.size())), "title");
  y += 20;
  // A section for each design in each fabric, in the table's order.
  std::vector<std::pair<std::string, std::vector<std::size_t>>> sections;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::string name = textIn(table.rows[r], design);
    if (const std::string cloth = textIn(table.rows[r], fabric); !cloth.empty()) name += ", " + cloth;
    const auto known =
        std::find_if(sections.begin(), sections.end(), [&](const auto& section) { return section.first == name; });
    (known == sections.end() ? sections.emplace_back(name, std::vector<std::size_t>()) : *known).second.push_back(r);
  }
  for (const auto& [name, rows] : sections) {
    y += 20;
    sheet.words(kMargin, y, name, "title");
    std::map<std::string, std::size_t> counts;
    std::size_t fits = 0;
    std::vector<double> strains, pressures;
    std::vector<std::string> misfits;
    for (const std::size_t r : rows) {
      const auto& row = table.rows[r];
      const std::string became = textIn(row, outcome), why = textIn(row, misfit);
      ++counts[became.empty() ? "not done yet" : became];
      if (became == nameOf(Outcome::Ok) && why.empty()) ++fits;
      if (!why.empty())
        misfits.push_back(textIn(row, person) + ": " + sheet.said(wordSaid(why)) +
                          (became == nameOf(Outcome::Ok) ? "" : " – " + textIn(row, saidAt)));
      if (became != nameOf(Outcome::Ok)) continue;
      if (const auto v = numberIn(row, strain)) strains.push_back(*v * 100);
      if (const auto v = numberIn(row, pressure)) pressures.push_back(*v / 1000);
    }
    y += 22;
    std::string line = sheet.said(say("It fits {0} of {1}.", fits, rows.size()));
    for (const auto& [became, count] : counts)
      line += "   " + sheet.said(wordSaid(became)) + ": " + std::to_string(count);
    sheet.words(kMargin, y, line);
    y += 28;
    histogram(sheet, kMargin, y, say("Stretch: 99 % of the cloth is stretched less than"), strains, limits.strain * 100,
              "%");
    histogram(sheet, kMargin + kPlotWide + 60, y, say("Pressure: 99 % of the skin under it is pressed less than"),
              pressures, limits.pressure / 1000, "kPa");
    y = easePlot(sheet, y + kPlotHigh + 20, table, rows);
    if (!misfits.empty()) {
      sheet.words(kMargin, y, sheet.said(say("Whom it does not fit")), "heading");
      for (std::size_t i = 0; i < std::min(misfits.size(), kMostNamed); ++i)
        sheet.words(kMargin, y += kLine, shortened(misfits[i]));
      if (misfits.size() > kMostNamed)
        sheet.words(kMargin, y += kLine, sheet.said(say("and {0} more; see the table.", misfits.size() - kMostNamed)));
      y += kLine;
    }
  }
  return sheet.done(y + kMargin);
}

}  // namespace karinui::app
