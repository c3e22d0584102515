// The fit over a population, as a report.
#include <algorithm>
#include <cmath>
#include <map>

#include "karinui/base/number.h"
#include "karinui/design/glossary.h"
#include "table.h"

namespace karinui::app {

namespace {

constexpr std::size_t kMostListed = 300;
constexpr double kGirthStep = 0.04;  // metres: sizes are this far apart

Message words(const std::string& plain) { return say("{0}", plain); }
Message tenths(double value) { return words(fixed(value, 1)); }

Message misfitSaid(const std::string& word) {
  for (const Message& known : {say("too small"), say("does not close"), say("crosses the body"), say("stretched"),
                               say("presses"), say("did not settle"), say("refused"), say("timeout"), say("crashed")})
    if (known.pattern == word) return known;
  return words(word);
}
const char* const kMisfits[] = {"too small",      "does not close", "crosses the body", "stretched", "presses",
                                "did not settle", "refused",        "timeout",          "crashed"};

// The garments of one design in one fabric, in the table's order.
struct Section {
  std::string name;
  std::vector<std::size_t> rows;
};
std::vector<Section> sectionsOf(const BatchTable& table) {
  std::vector<Section> sections;
  std::map<std::string, std::size_t> known;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::string name = table.text(r, "design");
    if (const std::string cloth = table.text(r, "fabric"); !cloth.empty()) name += ", " + cloth;
    const auto [at, fresh] = known.emplace(name, sections.size());
    if (fresh) sections.push_back({name, {}});
    sections[at->second].rows.push_back(r);
  }
  return sections;
}

bool came(const BatchTable& table, std::size_t row) { return !table.text(row, "outcome").empty(); }
bool rests(const BatchTable& table, std::size_t row) { return table.text(row, "outcome") == nameOf(Outcome::Ok); }
bool fits(const BatchTable& table, std::size_t row) { return rests(table, row) && table.text(row, "misfit").empty(); }

// The values of a column over the garments that came to rest, times a unit.
std::vector<double> valuesOf(const BatchTable& table, const Section& section, const std::string& column, double unit) {
  std::vector<double> values;
  for (const std::size_t r : section.rows)
    if (const auto value = rests(table, r) ? table.number(r, column) : std::nullopt) values.push_back(*value * unit);
  return values;
}

ReportTable outcomes(const BatchTable& table, const std::vector<Section>& sections) {
  ReportTable all{say("What came of it"), {say("design"), say("garments"), say("fit")}, {}};
  std::vector<std::string> met;  // a column for each way not to fit that occurs
  for (const char* word : kMisfits)
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      if (table.text(r, "misfit") == word) {
        met.emplace_back(word), all.columns.push_back(misfitSaid(word));
        break;
      }
  if (table.missing > 0) all.columns.push_back(say("not done yet"));
  for (const Section& section : sections) {
    const auto count = [&](const auto& holds) {
      return static_cast<std::size_t>(std::count_if(section.rows.begin(), section.rows.end(), holds));
    };
    const std::size_t good = count([&](std::size_t r) { return fits(table, r); });
    const double share = 100 * static_cast<double>(good) / static_cast<double>(section.rows.size());
    std::vector<Message> cells{words(section.name), words(written(section.rows.size())),
                               words(written(good) + " (" + fixed(share, 0) + " %)")};
    for (const std::string& word : met)
      cells.push_back(words(written(count([&](std::size_t r) { return table.text(r, "misfit") == word; }))));
    if (table.missing > 0) cells.push_back(words(written(count([&](std::size_t r) { return !came(table, r); }))));
    all.rows.push_back(std::move(cells));
  }
  return all;
}

// "under bust" of "ease_under_bust_m", for the columns of ease that a section has values in.
struct Level {
  Message name;
  std::vector<double> ease;  // cm
};
std::vector<Level> levelsOf(const BatchTable& table, const Section& section) {
  static const Message kOrder[] = {say("armpit"),     say("bust"),       say("under bust"),  say("waist"),
                                   say("hip"),        say("left thigh"), say("right thigh"), say("left knee"),
                                   say("right knee"), say("left ankle"), say("right ankle")};
  std::vector<Level> levels;
  for (const Message& name : kOrder) {
    std::string column = name.pattern;
    std::replace(column.begin(), column.end(), ' ', '_');
    if (auto ease = valuesOf(table, section, "ease_" + column + "_m", 100); !ease.empty())
      levels.push_back({name, std::move(ease)});
  }
  return levels;
}

ReportTable easeTable(const Section& section, std::vector<Level> levels) {
  ReportTable all{
      say("Ease, cm: {0}", section.name), {say("at the"), say("least"), say("1 in 10"), say("half"), say("most")}, {}};
  for (Level& level : levels) {
    std::sort(level.ease.begin(), level.ease.end());
    const auto at = [&](double share) {  // so many have no more
      return tenths(level.ease[static_cast<std::size_t>(share * static_cast<double>(level.ease.size() - 1))]);
    };
    all.rows.push_back({level.name, at(0), at(0.1), at(0.5), at(1)});
  }
  return all;
}

// The share that fits, by a girth of the people.
ReportTable byGirth(const BatchTable& table, const Section& section) {
  struct Band {
    std::size_t people = 0, fit = 0;
  };
  std::map<int, Band> bands;
  for (const std::size_t r : section.rows) {
    const auto girth = table.number(r, "body_bust_girth");
    if (!girth || !came(table, r) || table.text(r, "outcome") == nameOf(Outcome::Refused)) continue;
    Band& band = bands[static_cast<int>(std::floor(*girth / kGirthStep + 1e-9))];
    ++band.people, band.fit += fits(table, r);
  }
  ReportTable all{say("By bust girth: {0}", section.name), {words("cm"), say("people"), say("fit")}, {}};
  for (const auto& [at, band] : bands)
    all.rows.push_back({words(fixed(100 * kGirthStep * at, 0) + "–" + fixed(100 * kGirthStep * (at + 1), 0)),
                        words(written(band.people)), words(written(band.fit))});
  return all;
}

// Whom it does not fit, where and by how much: the worst of each kind first.
struct Misfit {
  std::size_t row = 0, kind = 0;
  double by = 0;
};
std::vector<Misfit> misfitsOf(const BatchTable& table) {
  std::vector<Misfit> all;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string word = table.text(r, "misfit");
    if (word.empty()) continue;
    const char* by = word == "too small"          ? "too_small_m"
                     : word == "does not close"   ? "fastenings_open"
                     : word == "crosses the body" ? "cloth_body_crossings"
                     : word == "stretched"        ? "strain_p99"
                                                  : "pressure_p99_pa";
    const auto kind = std::find(std::begin(kMisfits), std::end(kMisfits), word) - std::begin(kMisfits);
    all.push_back({r, static_cast<std::size_t>(kind), table.number(r, by).value_or(0)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Misfit& a, const Misfit& b) { return a.kind != b.kind ? a.kind < b.kind : a.by > b.by; });
  return all;
}

// By how much, and where; nothing of what has a sentence instead.
std::vector<Message> amountOf(const BatchTable& table, const Misfit& misfit) {
  const std::size_t r = misfit.row;
  const std::string word = kMisfits[misfit.kind];
  const Message& said = table.said[r];
  if (word == "too small") {
    const bool placed = said.values.size() > 1 && std::holds_alternative<Message>(said.values[1]);
    return {words(misfit.by < 0.01 ? "< 1 cm" : fixed(100 * misfit.by, 0) + " cm"),
            placed ? std::get<Message>(said.values[1]) : Message()};
  }
  if (word == "stretched") return {words(fixed(100 * misfit.by, 1) + " %"), nameSaid(table.text(r, "strain_at"))};
  if (word == "presses") {
    const auto place = parseBodyPoint(table.text(r, "pressure_at"));
    return {words(fixed(misfit.by / 1000, 1) + " kPa"), place ? placeSaid(*place) : Message()};
  }
  if (word == "crosses the body") return {say("{0} {0|place|places}", static_cast<std::size_t>(misfit.by)), Message()};
  if (word == "does not close")
    return {say("{0} {0|fastening|fastenings}", static_cast<std::size_t>(misfit.by)), Message()};
  return {};
}

ReportTable misfitTable(const BatchTable& table, const std::vector<Misfit>& misfits, bool many) {
  ReportTable all{say("Whom it does not fit, the worst first"), {say("person")}, {}};
  if (many) all.columns.push_back(say("design"));
  struct Girth {
    const char* column;
    Message name;
  };
  const Girth kGirths[] = {
      {"body_bust_girth", say("bust")}, {"body_waist_girth", say("waist")}, {"body_hip_girth", say("hip")}};
  for (const Girth& girth : kGirths) all.columns.push_back(girth.name);
  all.columns.insert(all.columns.end(), {say("does not fit"), say("by"), say("where")});
  for (std::size_t i = 0; i < std::min(misfits.size(), kMostListed); ++i) {
    const std::size_t r = misfits[i].row;
    std::vector<Message> cells{words(table.text(r, "person"))};
    if (many) {
      const std::string cloth = table.text(r, "fabric");
      cells.push_back(words(table.text(r, "design") + (cloth.empty() ? "" : ", " + cloth)));
    }
    for (const Girth& girth : kGirths) {
      const auto value = table.number(r, girth.column);
      cells.push_back(value ? tenths(*value * 100) : words(""));
    }
    const Message what = misfitSaid(kMisfits[misfits[i].kind]);
    if (std::vector<Message> amount = amountOf(table, misfits[i]); !amount.empty()) {
      cells.push_back(what);
      cells.insert(cells.end(), amount.begin(), amount.end());
    } else {
      cells.push_back(say("{0}: {1}", what, table.said[r]));
    }
    all.rows.push_back(std::move(cells));
  }
  if (misfits.size() > kMostListed)
    all.rows.push_back({say("and {0} more; see the table.", misfits.size() - kMostListed)});
  return all;
}

}  // namespace

Report fitReport(const BatchPlan& plan, const BatchTable& table, const std::string& title) {
  const FitLimits limits;
  const std::vector<Section> sections = sectionsOf(table);
  Report report;
  report.title = title;
  report.under = say("Fit over {0} {0|person|people}, {1} {1|garment|garments}", plan.bodies.size(), plan.items.size());
  report.summary.push_back(outcomes(table, sections));
  ReportPlot strain{say("Stretch: 99 % of the cloth is stretched less than"), "%", {}, 100 * limits.strain},
      pressure{say("Pressure: 99 % of the skin under it is pressed less than"), "kPa", {}, limits.pressure / 1000};
  for (const Section& section : sections) {
    strain.rows.push_back({words(section.name), valuesOf(table, section, "strain_p99", 100)});
    pressure.rows.push_back({words(section.name), valuesOf(table, section, "pressure_p99_pa", 1e-3)});
  }
  report.plots = {std::move(strain), std::move(pressure)};
  for (const Section& section : sections) {
    std::vector<Level> levels = levelsOf(table, section);
    if (!levels.empty()) {
      ReportPlot ease{say("Ease, garment less body: {0}", section.name), "cm", {}, 0, true};
      for (const Level& level : levels) ease.rows.push_back({level.name, level.ease});
      report.plots.push_back(std::move(ease));
      report.tables.push_back(easeTable(section, std::move(levels)));
    }
    if (ReportTable girths = byGirth(table, section); !girths.rows.empty()) report.tables.push_back(std::move(girths));
  }
  if (const std::vector<Misfit> misfits = misfitsOf(table); !misfits.empty())
    report.lists.push_back(misfitTable(table, misfits, sections.size() > 1));
  return report;
}

}  // namespace karinui::app
