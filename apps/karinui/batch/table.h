#pragma once
// What came of a batch, as one table: a row an item, in the manifest's order, whoever did it and whenever.
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "plan.h"

namespace karinui::app {

struct BatchTable {
  using Cell = std::variant<std::monostate, std::string, double>;  // monostate: nothing is known
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
  std::size_t missing = 0;  // items that have no outcome yet
};
BatchTable tableOf(const BatchPlan& plan, const std::filesystem::path& folder);

std::string asCsv(const BatchTable& table);  // RFC 4180; numbers exact
// A new SQLite database with the one table "item". The same table gives the same bytes.
Done writeDatabase(const BatchTable& table, const std::filesystem::path& file);

// Why a garment that came to rest does not fit, or an empty text: it is stretched or presses more than one wears.
struct FitLimits {
  double strain = 0.08;    // 99 of 100 parts of the cloth are stretched less
  double pressure = 4000;  // Pa, at 99 of 100 places: clothes are comfortable up to 2 to 4 kPa (Denton 1972)
};
std::string misfitOf(const Json& outcome, const FitLimits& limits = {});

// A word of the columns "outcome" and "misfit", for people.
Message wordSaid(const std::string& word);

// The fit over all people: outcomes, stretch, pressure and ease as plots, and whom it does not fit. SVG.
std::string fitSummary(const BatchPlan& plan, const BatchTable& table, Language language);

}  // namespace karinui::app
