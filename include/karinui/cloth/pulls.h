#pragma once
// What elastics and closed fastenings pull with, by the solver's own springs. Pure; any thread.
#include <string>
#include <vector>

#include "karinui/cloth/cloth.h"

namespace karinui {

// An elastic as it lies in the cloth.
struct ElasticPull {
  PieceId piece;
  std::string edge;
  double cut = 0, now = 0;  // metres: its own length, and drawn out
  double pull = 0;          // N, on average along it
};

// A closed fastening as it holds.
struct FasteningPull {
  std::string name;
  FasteningKind kind = FasteningKind::Button;
  std::size_t number = 0;  // of its places, from 1; of a zip 0
  double gap = 0;          // metres between the two places, or the widest between a zip's sides
  double force = 0;        // N that draw it open; of a zip along all of its closed part
  double length = 0;       // metres of a zip's closed part
  bool holds() const;      // false: it does not reach, or its thread would tear
};

// `state` has one place per node of `cloth`.
std::vector<ElasticPull> elasticPulls(const Cloth& cloth, const ClothState& state);
std::vector<FasteningPull> fasteningPulls(const Cloth& cloth, const ClothState& state);

}  // namespace karinui
