#pragma once
// What came of a batch, as one table: a row an item, in the manifest's order, whoever did it and whenever.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "karinui/exchange/report.h"
#include "karinui/session/fit_over_bodies.h"
#include "plan.h"

namespace karinui::app {

struct BatchTable {
  using Cell = std::variant<std::monostate, std::string, double>;  // monostate: nothing is known
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
  std::vector<Message> said;  // of each row, as its column "said" but in any language
  std::size_t missing = 0;    // items that have no outcome yet

  // Of a row and a column by name; nothing where there is none.
  std::optional<double> number(std::size_t row, const std::string& column) const;
  std::string text(std::size_t row, const std::string& column) const;
};
BatchTable tableOf(const BatchPlan& plan, const std::filesystem::path& folder);

std::string asCsv(const BatchTable& table);  // RFC 4180; numbers exact
// A new SQLite database with the one table "item". The same table gives the same bytes.
Done writeDatabase(const BatchTable& table, const std::filesystem::path& file);

// Why a garment does not fit, or an empty text: it did not come to rest, or is stretched or presses more than one
// wears.
std::string misfitOf(const Json& outcome, const FitLimits& limits = {});

// The fit over all people as a pattern-maker reads it: what came of each design, the distributions of stretch, pressure
// and ease, the share that fits by bust girth, and whom it does not fit, where and by how much; the worst first.
Report fitReport(const BatchPlan& plan, const BatchTable& table, const std::string& title);

}  // namespace karinui::app
