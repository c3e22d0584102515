#pragma once
// A hand without a pointer: a fingertip that keys move over the fitting or over the cutting table, from place to place
// or in even steps. It speaks the samples a mouse speaks, so that whatever a mouse can make, keys can. The hand's
// thread.
#include <optional>
#include <vector>

#include "karinui/scene/overlay.h"
#include "karinui/scene/pointer.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

// Press takes hold and, struck again, lets go; of a tool that is worked with clicks it does both at once.
enum class KeyStroke { Left, Right, Up, Down, Next, Previous, Press, Shorter, Longer };

// Which places a gesture wants to be led to.
enum class KeyStops { Skin, Pieces, PiecesAndSliders, Edges, Corners };  // sliders: of zips

// A place worth going to, seen from where one looks.
struct KeyStop {
  Vec3 space;
  Flat table;
};
// In reading order of the thing they lie on: pieces with their edges one after the other, the skin from the crown down
// and from left to right. In space only what is in view and not hidden.
std::vector<KeyStop> keyStopsOf(const GarmentSnapshot& snapshot, const TableLayout& table, KeyStops wanted,
                                const PointerSample& with, const Viewpoint& viewpoint);

class KeyboardPointer {
 public:
  struct Around {  // what it moves in
    const GarmentSnapshot& snapshot;
    const TableLayout& table;
    Viewpoint viewpoint;
    KeyStops keyStops = KeyStops::Pieces;
    bool clicks = false;
  };
  // The samples a key comes to. `with` tells where, when, how near touching is, and the modifiers. The first key only
  // shows where the fingertip is.
  std::vector<PointerSample> strike(KeyStroke key, const PointerSample& with, const Around& around);
  void sleep() { awake_ = down_ = false; }  // a pointer is used
  void letGo() { down_ = false; }           // the gesture is over
  bool awake() const { return awake_; }
  bool down() const { return down_; }
  PointerSample::Where where() const { return last_.where; }
  PointerSample now(const Viewpoint& viewpoint) const;  // where it is
  double step() const;                                  // metres an arrow goes

 private:
  PointerSample said(PointerSample::Phase phase, const Around& around) const;
  void goToStop(int by, const Around& around);
  void arrow(double right, double up, const Viewpoint& viewpoint);

  bool awake_ = false, down_ = false;
  PointerSample last_;    // where, when, how near, with what
  double x_ = 0, y_ = 0;  // in the picture: right and up at distance 1
  Flat place_;            // on the table
  int longer_ = 1;
};

}  // namespace karinui
