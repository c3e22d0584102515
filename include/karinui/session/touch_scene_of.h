#pragma once
// What the hand feels near its tip, out of the garment as it stands: made anew on the session's side some tens of times
// a second, and handed to a servo by whoever owns both. Takes a fraction of a millisecond; any thread.
#include <memory>
#include <optional>
#include <set>

#include "karinui/session/garment_snapshot.h"
#include "karinui/touch/touch_scene.h"

namespace karinui {

// What the hand is about, as far as it is felt. Reshaping the pattern is not.
struct Handling {
  std::set<PieceId> carried;  // moved as rigid things: they weigh, and are not touched
  struct Pull {
    PieceId piece;
    Flat at;                    // the place on paper that is held
    Vec3 from;                  // where the hand was when it took hold: nothing pulls there
    Vec3 place;                 // where the solver last had the held place,
    std::optional<Vec3> force;  // and what the cloth then did to the hand
  };
  std::optional<Pull> pull;
  PieceId cut;         // being cut: resists
  bool still = false;  // nothing at all is felt: the pattern is being reshaped
  // What is held has snapped to this: any number but 0 that tells it from others. A click, once; 0: nothing.
  std::size_t snap = 0;
  bool changing = false;     // pieces are being cut, sewn or replaced
  std::uint32_t clicks = 0;  // pairs of edges that have snapped together
};

inline constexpr double kPatchRadius = 0.06;  // metres: more than a hand goes between two scenes

// `proxy`: where the tip is stopped while it touches something; the skin there is in the scene, too, however deep the
// tip is, and the cloth on it. Cloth that hangs free is held around the tip alone: a hand that is led away from it is
// not held back.
TouchScene touchSceneOf(const GarmentSnapshot& snapshot, Vec3 tip, const Handling& handling = {},
                        std::optional<Vec3> proxy = {}, double radius = kPatchRadius);

// What could be felt at one moment of a session, wherever the tip is then. Immutable: any thread makes scenes of it.
struct TouchSource {
  SnapshotPtr garment;
  Handling handling;
  TouchScene sceneAt(Vec3 tip, std::optional<Vec3> proxy = {}) const {
    return touchSceneOf(*garment, tip, handling, proxy);
  }
};

// The distance between threads of a plain weave, metres, as far as weight and thickness tell it: threads as thick as
// half the cloth, of 0.909 g/cm3 (Peirce 1937, "The geometry of cloth structure"), as many each way. Between 0.2 and
// 3 mm.
double threadSpacing(const Fabric& fabric);

// A strip of a fabric, half along its warp and half along its weft: metres.
TensionCurve tensionCurveOf(const Fabric& fabric, double width, double length);

}  // namespace karinui
