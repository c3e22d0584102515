#pragma once
// What a person waits for after an edit: the tunic (W3) at rest on its capsules as a document in a session, edited
// again and again. Times by the clock, as the hand feels them.
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/check/check.h"

namespace karinui::bench {

struct EditTimes {
  std::string name;                            // seam, sew, cut, move, pull
  std::vector<double> first, within2mm, rest;  // seconds, one per run: the first changed picture; the first that stays
                                               // within 2 mm of the cloth at rest; at rest
  std::size_t unsettled = 0;                   // runs that did not come to rest
  std::size_t undraped = 0;                    // runs after which the session left the garment to be draped by hand
  SettleReport last;                           // of the last run's drape,
  std::size_t crossings = 0;                   // and where its cloth passes through cloth
};
struct EditFinding {
  std::size_t vertices = 0;
  std::vector<EditTimes> edits;
  std::vector<double> pullStep;  // seconds of each step of a live pull of one point, 30 a run
};
// About so many vertices (0: 12,096), each edit so many times.
Result<EditFinding> edits(std::size_t vertices, int runs, int threads, const Token& token);

double percentile(std::vector<double> values, double part);  // nearest rank; 0 of nothing

}  // namespace karinui::bench
