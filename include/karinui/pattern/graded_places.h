#pragma once
// Where the graded places of an outline are once it is in another size. Metres on paper. Pure; any thread.
#include "karinui/pattern/grading.h"

namespace karinui {

// `points` lie on the outline, in size `from`; those given back on graded(outline, grading, points, from, to).
GradePoints placesInSize(const Outline& outline, const GradePoints& points, std::size_t from, std::size_t to);

}  // namespace karinui
