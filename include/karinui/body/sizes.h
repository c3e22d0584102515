#pragma once
// Sizes of ready-to-wear as measurements to start from: bust, waist, hip and body height of each, series by series. In
// metres. Pure functions, any thread. docs/user/body.md has the table.
// Sources: JIS L 4005 (women, figure A, height R; waists of the twenties), JIS L 4004 (men, figure A), the German rows
// of women's (DOB) and men's (HAKA) sizes, the charts on American pattern envelopes (misses); children by their height.
#include <span>
#include <string_view>
#include <vector>

#include "karinui/body/measurements.h"

namespace karinui {

struct BuiltInSize {
  std::string_view name;   // "eu44w", as it is written in a script
  std::string_view label;  // "44", as it stands in a garment's collar
  double bust, waist, hip, height;
};

enum class SizeSystem { JisWomen, EuWomen, EuMen, JisMen, Misses, Children };

struct SizeSeries {
  SizeSystem system;
  Sex sex;
  std::string_view usual;              // the name of the size in its middle, by which patterns are drafted
  std::span<const BuiltInSize> sizes;  // from the smallest on
};
std::span<const SizeSeries> sizeSeries();

inline constexpr std::string_view kUsualSize = "jis9ar";  // where none was chosen
std::span<const std::string_view> builtInSizes();         // the names, series after series
// As a script writes it: "eu44w" of "EU 44 W". What is no size stays as it is.
std::string plainSize(std::string_view name);
// However it is written; an unknown name is refused with a list.
Result<Measurements> builtInSize(std::string_view name);

}  // namespace karinui
