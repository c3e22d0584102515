#pragma once
// Takes a figure in or lets it out where the tape on the finished mesh differs from what is asked for.
#include "body/figure.h"
#include "body/reading.h"

namespace karinui {

struct Miss {
  std::string key;
  double wanted = 0, got = 0;
  double share = 0;  // |got - wanted| as a share of what is allowed (girths 3 mm, heights and lengths 5 mm)
};
std::vector<Miss> misses(const std::map<std::string, double>& wanted, const Reading& reading);

// One round of corrections; `damped` for the later rounds, when girths near the armpit answer twice as strongly.
void refit(Figure& figure, const std::map<std::string, double>& wanted, const Reading& reading, double damping);

}  // namespace karinui
