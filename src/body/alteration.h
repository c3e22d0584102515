#pragma once
// Takes a drawn figure in and lets it out, as a tailor alters a block: one amount for each measurement, zero leaves the
// figure as drawn. A girth's amount is the logarithm of its scale; that of a height or a length is in metres.
#include <map>
#include <string>
#include <vector>

#include "body/figure.h"

namespace karinui {

// What can be altered: most under the name of the measurement that it moves about one to one.
inline constexpr const char* kThighDepth = "thigh_depth";  // the tops of the legs deeper, as the girth is

using Alteration = std::map<std::string, double>;
std::string parameterOf(std::string_view measurement);  // what alters it; empty: nothing of its own

// What has no amount of its own follows its neighbours: the thigh follows the hip.
Figure altered(const Figure& drawn, const Alteration& by);

}  // namespace karinui
