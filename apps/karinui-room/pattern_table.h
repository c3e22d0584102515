#pragma once
// The flat pattern on a table beside the body: where the session's table lies in the stand's space, what a ray or a
// fingertip meets of it, and how it is drawn. Pure; any thread.
#include <optional>

#include "karinui/scene/overlay.h"
#include "karinui/scene/table_scene.h"
#include "karinui/session/session.h"
#include "karinui/session/table_frame_of.h"

namespace karinui::room {

class PatternTable {
 public:
  // As large as the paper needs, never larger than arms reach: then the paper is drawn smaller. `mirrored`: on the
  // other side of the body, for a left hand.
  PatternTable() : PatternTable(Flat{0, -0.8}, Flat{1.1, 0}, false) {}
  PatternTable(Flat low, Flat high, bool mirrored);

  bool operator==(const PatternTable&) const = default;
  Vec3 at(Flat place, double above = 0) const;  // a place of the paper, and so many metres above it
  double paperScale() const { return scale_; }  // metres of the table for a metre of paper
  struct Met {
    Flat place;
    double along = 0;     // metres of the ray
    bool within = false;  // on the board itself, not only in its plane
  };
  std::optional<Met> meet(const Ray& ray) const;  // from above only
  Met below(Vec3 tip) const;                      // along: metres above the board, negative beneath
  TablePlacement placement() const;
  // The board with its legs, its edges beside the paper's.
  std::vector<SceneBody> boards() const;

 private:
  Vec3 middle_, right_, away_;  // of the board; unit vectors of the paper's u and v
  Flat paperMiddle_;
  double scale_ = 1, wide_ = 1.3, deep_ = 1;
};

// What a table has to hold: every piece of the session's table.
PatternTable patternTableFor(const Session& session, bool mirrored);

// Whether a table that was drawn is still what there is. A garment that moves as it is pulled or comes to rest leaves
// its paper as it is: that is told by the document, not by what is shown of the garment.
class DrawnTable {
 public:
  bool follow(const Session& session, const PatternTable& top);  // true: it is to be drawn anew

 private:
  SnapshotPtr of_;
  std::vector<Flat> lies_;  // of the document's pieces
  PatternTable top_;
};

// The table, the flat pattern that lies on it, and its lettering. `rooms`: kept from one call to the next.
TableScene tableSceneFor(const Session& session, const PatternTable& top, Language language, LetteringRooms& rooms);
// What the gesture shows on the paper.
std::vector<SceneLine> linesOnTable(const TableOverlay& over, const PatternTable& top);

}  // namespace karinui::room
