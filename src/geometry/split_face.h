#pragma once
// One flat face cut by chords into triangles.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "karinui/geometry/mesh.h"

namespace karinui {

struct Chord {
  std::uint32_t a = 0, b = 0;
  std::uint32_t side = 0;
};

struct SplitFace {
  enum class Trouble { None, Crossing, DeadEnd, Island } trouble = Trouble::None;
  std::size_t firstChord = 0, secondChord = 0;  // of a crossing
  std::vector<Triangle> triangles;
};

// `cycle`: the nodes round the face, counter-clockwise; chords join nodes of it, or nodes inside the face. `place`
// tells where a node lies in the face's plane. Nodes inside are reached by chords only.
SplitFace splitFace(std::span<const std::uint32_t> cycle, std::span<const Chord> chords,
                    const std::function<Flat(std::uint32_t)>& place);

}  // namespace karinui
