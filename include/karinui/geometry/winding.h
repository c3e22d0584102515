#pragma once
// What a closed line goes round where it crosses itself, as lines drawn beside an outline do. Metres. Pure; any thread.
#include <span>

#include "karinui/geometry/polygon.h"

namespace karinui {

// How often the ring goes round a place, counter-clockwise counted up.
int turnsRound(std::span<const Flat> ring, Flat place);

// The outer line, counter-clockwise, of what the ring goes round counter-clockwise (`clockwise`: the other way) at
// least once; of several parts the largest, of none an empty one.
Ring outlineOfTurns(std::span<const Flat> ring, bool clockwise = false);

}  // namespace karinui
