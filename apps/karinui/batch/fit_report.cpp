// The fit over a population, as a report.
#include <algorithm>
#include <cmath>
#include <map>

#include "karinui/base/number.h"
#include "misfit.h"

namespace karinui::app {

namespace {

constexpr std::size_t kMostListed = 300;
constexpr double kGirthStep = 0.04;  // metres: sizes are this far apart

Message words(const std::string& plain) { return say("{0}", plain); }
Message tenths(double value) { return words(fixed(value, 1)); }

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
  for (const Message& misfit : misfits())
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      if (table.text(r, "misfit") == misfit.pattern) {
        met.push_back(misfit.pattern), all.columns.push_back(misfit);
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
  static const Message kOrder[] = {say("armpit"),    say("bust"),       say("under bust"), say("waist"),
                                   say("high hip"),  say("hip"),        say("left thigh"), say("right thigh"),
                                   say("left knee"), say("right knee"), say("left ankle"), say("right ankle")};
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
    if (!girth || !(*girth >= 0 && *girth < 10) || !came(table, r) ||
        table.text(r, "outcome") == nameOf(Outcome::Refused))
      continue;
    Band& band = bands[static_cast<int>(std::floor(*girth / kGirthStep + 1e-9))];
    ++band.people, band.fit += fits(table, r);
  }
  ReportTable all{say("By bust girth: {0}", section.name), {words("cm"), say("people"), say("fit")}, {}};
  for (const auto& [at, band] : bands)
    all.rows.push_back({words(fixed(100 * kGirthStep * at, 0) + "–" + fixed(100 * kGirthStep * (at + 1), 0)),
                        words(written(band.people)), words(written(band.fit))});
  return all;
}

ReportTable misfitTable(const BatchTable& table, const std::vector<Misfit>& people, bool many) {
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
  for (std::size_t i = 0; i < std::min(people.size(), kMostListed); ++i) {
    const std::size_t r = people[i].row;
    std::vector<Message> cells{words(table.text(r, "person"))};
    if (many) {
      const std::string cloth = table.text(r, "fabric");
      cells.push_back(words(table.text(r, "design") + (cloth.empty() ? "" : ", " + cloth)));
    }
    for (const Girth& girth : kGirths) {
      const auto value = table.number(r, girth.column);
      cells.push_back(value ? tenths(*value * 100) : words(""));
    }
    const Message& what = misfits()[people[i].kind];
    if (std::vector<Message> amount = amountOf(table, people[i]); !amount.empty()) {
      cells.push_back(what);
      cells.insert(cells.end(), amount.begin(), amount.end());
    } else {
      cells.push_back(say("{0}: {1}", what, table.said[r]));
    }
    all.rows.push_back(std::move(cells));
  }
  if (people.size() > kMostListed)
    all.rows.push_back({say("and {0} more; see the table.", people.size() - kMostListed)});
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
  if (const std::vector<Misfit> people = misfitsOf(table); !people.empty())
    report.lists.push_back(misfitTable(table, people, sections.size() > 1));
  return report;
}

}  // namespace karinui::app
