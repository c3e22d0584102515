#pragma once
// For other programs: a scene as it starts, and a judge of what they made of it. The judge is the one our own drapes
// are examined by.
#include <filesystem>
#include <string>
#include <vector>

#include "bench/run.h"

namespace karinui::bench {

// The finest level as JSON, metres: `points` where they stand, `faces`, `pinned`, `seams` (pairs of points to be sewn),
// `capsules` {a, b, radius} that may not be entered, `weight` in kg/m2, `friction`. The body must be analytic.
Result<std::string> startOf(const Workload& load);

struct Judged {
  Examined found;       // of the last frame
  double height = 0;    // metres, of the centre of mass there
  double drift = 0;     // metres it went from the first frame to the last
  double topSpeed = 0;  // m/s of the fastest node in any frame; 0 of a single one
};
// `frames`: OBJ files, 1/60 s apart, whose `v` lines are the points of startOf in their order. Refused: another number
// of points. The workload's finest state becomes the last frame. Points that are no numbers are found, not refused.
Result<Judged> judge(Workload& load, const std::vector<std::filesystem::path>& frames);

}  // namespace karinui::bench
