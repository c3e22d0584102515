#pragma once
// What a person reads of the scenes of `bench`. Each ends with a line break.
#include <vector>

#include "bench/edits.h"
#include "bench/foreign.h"
#include "bench/run.h"
#include "console.h"

namespace karinui::app {

// `hash`: of where it rests.
std::string findingWords(const bench::Workload& load, const bench::Finding& found, int threads, const std::string& hash,
                         const Console& console);
std::string judgedWords(const bench::Workload& load, const bench::Judged& judged, const Console& console);
std::string editWords(const bench::EditFinding& found, int threads, int runs, const Console& console);

// A fabric on the drape tester, laid on several times.
struct TestedFabric {
  Fabric fabric;
  double mean = 0, lowest = 0, highest = 0;  // percent of the free ring
  int folds = 0;                             // in the middle one
  double seconds = 0;                        // of processor time
};
std::string testerWords(const std::vector<TestedFabric>& fabrics, bool settled, int runs, const Console& console);

}  // namespace karinui::app
