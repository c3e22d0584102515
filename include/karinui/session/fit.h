#pragma once
// How a garment fits, in numbers: what it presses with, how far round it is and how far round the body is under it.
// Pure; long for large garments; any thread.
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/workers.h"
#include "karinui/cloth/pulls.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

// Per point of the body's mesh, pascals, the mean over a patch as large as a fingertip; negative: no cloth there.
// Nothing without a body or a garment that can be laid.
std::vector<float> pressureOnBody(const GarmentSnapshot& snapshot, Workers& workers);

// Where cloth lies, in pascals; nothing where none does. `values`: of pressureOnBody().
struct PressureReport {
  double mean = 0, p99 = 0;
};
std::optional<PressureReport> pressureReport(const std::vector<float>& values);

std::optional<BodyPoint> mostPressed(const std::vector<float>& values, const Body& body);  // where the skin is so

// The cloth of which one point in a hundred is stretched more than that of any other; empty: none is.
std::string mostStretched(const SceneFrame& frame);

// The bared body coloured by it, and the garment as lines: to be drawn as a strain map is, up to a round number of
// pascals. `values`: of pressureOnBody(); empty: not known yet. Needs the snapshot's body.
SceneFrame pressureFrame(const GarmentSnapshot& snapshot, const std::vector<float>& values);
inline constexpr double kPressureLeast = 100;  // pascals, at the least, at the top of the scale

// The same with its scale. Refuses a garment that has no figure or does not press.
struct PressedFrame {
  SceneFrame frame;
  double top = 0;  // pascals
};
Result<PressedFrame> pressedFrame(const GarmentSnapshot& snapshot, Workers& workers);

// How the garment's elastics lie and pull as it is shown; quick. Nothing where it cannot be laid.
std::vector<ElasticPull> elasticsOf(const GarmentSnapshot& snapshot);

// How its closed buttons, snaps, hooks, ties and zips hold. As long as a garment is laid.
std::vector<FasteningPull> fasteningsOf(const GarmentSnapshot& snapshot);

// "front 3", and "drawn open with 12.0 N; does not close, 1.4 mm are missing".
Message fastenerSaid(const FasteningPull& pull);
Message pulledSaid(const FasteningPull& pull);
Message pulledSaid(const FasteningPull& pull, std::string (*length)(double metres));  // in the reader's own units

// The level tape: round the trunk, or both legs together, arms and sleeves left out; or round one leg.
struct Girths {
  enum class Round { Trunk, LeftLeg, RightLeg };
  Round what = Round::Trunk;
  double height = 0;               // metres above the floor
  Message name;                    // of a level of the body, else empty
  double off = 0;                  // metres above that level, below it less than 0: there the garment ends
  double body = 0, garment = 0;    // metres round; 0: nothing there
  std::vector<Vec3> round, under;  // the tape round the garment and round the body, closed; may be empty
};
// One; or two where the garment goes round a leg by itself, the left one first.
std::vector<Girths> girthsAt(const GarmentSnapshot& snapshot, double height);
// At the levels a tailor asks for that this garment covers, from the top downwards. A garment that ends at the waist or
// the high hip seldom reaches the very level: it is measured beside it, at its edge.
std::vector<Girths> girthsOf(const GarmentSnapshot& snapshot);

// A round number (1, 2 or 5 times a power of ten) that holds 99 of 100 of the values above zero; 0: there are none.
double roundTop(std::vector<float> values, double least);

}  // namespace karinui
