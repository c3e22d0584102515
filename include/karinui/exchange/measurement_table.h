#pragma once
// Measures of many people, one a row: a table of comma, semicolon or tab separated values. The first row names the
// columns: "name", "sex" (female, male; f, m) and measures by any name measurementKey() knows, whose unit may follow,
// "bust_girth_cm" or "Bust (mm)"; "_m", "_deg" and "_rad" likewise. Without one, numbers are metres, radians, or bring
// their own unit: "88cm"; what would be metres and is hardly meant so is refused (unitMeant). Where semicolons or tabs
// separate the cells a number may have a decimal comma. A stranger's file: counts are bounded. Pure; any thread.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/body/measurements.h"

namespace karinui {

struct MeasuredPerson {
  std::string name;  // as in the table, or "row 3"; no two the same
  Measurements measures;
};
struct MeasurementTable {
  std::vector<MeasuredPerson> people;
  std::vector<std::string> unknown;  // columns that mean nothing here; left out
};

inline constexpr std::size_t kMostPeople = 100'000;
// Refuses a table without a measure or a row; a cell that is no number is refused with its row and column. An empty
// cell is not stated.
Result<MeasurementTable> readMeasurementTable(std::string_view bytes);

}  // namespace karinui
