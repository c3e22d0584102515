#pragma once
// One state of the garment, ready to be drawn and picked. Immutable, shared between threads; made off the hand's
// thread.
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include "karinui/design/apply.h"
#include "karinui/design/document.h"
#include "karinui/design/print_match.h"
#include "karinui/design/values.h"
#include "karinui/geometry/bvh.h"
#include "karinui/scene/pointer.h"
#include "karinui/scene/scene_frame.h"
#include "karinui/session/look_of.h"
#include "karinui/session/view_cut.h"

namespace karinui {

// A tree over a piece of cloth that is built when the pointer first asks for it: most pictures of cloth on its way are
// never pointed at. Any thread.
class PickingTree {
 public:
  explicit PickingTree(TriangleMesh mesh) : mesh_(std::move(mesh)) {}
  const Bvh& operator*() const;
  const Bvh* operator->() const { return &**this; }

 private:
  const TriangleMesh mesh_;
  mutable std::once_flag asked_;
  mutable std::optional<Bvh> tree_;
};

struct GarmentSnapshot {
  Document document;
  BodyPtr body;      // null: none chosen, or not to be had
  SceneFrame frame;  // cloths in the order of the document's pieces
  struct Worn {      // cloth k of the frame
    PieceId id;
    std::shared_ptr<const PickingTree> tree;
    Ring ring;                                           // the outline on paper, for the table
    std::shared_ptr<const struct Lattice> lattice = {};  // it was laid as; null where there is trouble
  };
  std::vector<Worn> worn;
  std::shared_ptr<const VisibleParts> visible;                     // null: all of it
  std::map<std::string, std::shared_ptr<const PrintImage>> scans;  // of the document's underlays, by name
  // The figure is between two poses: it stands so in the frame and in the document; `body` stands as it did before.
  bool underWay = false;
  std::optional<Message> trouble;  // why pieces could not be laid together (then each stands alone, without seams)
};
using SnapshotPtr = std::shared_ptr<const GarmentSnapshot>;
Prints printsOf(const GarmentSnapshot& snapshot);     // the photographs it shows
PhotoTall photosOf(const GarmentSnapshot& snapshot);  // how tall they are
SnapshotPtr snapshotOf(Document document, BodyPtr body, const Prints& prints = {});
// The same garment where these pieces have come to stand, as drapes and pulls leave them (in space: the poses become
// the identity). Forms asFine() as the garment need not be laid anew: quick.
using Forms = std::map<PieceId, std::shared_ptr<const Form>>;
SnapshotPtr snapshotStanding(const GarmentSnapshot& before, const Forms& forms);
// The same garment and its figure on the way to another pose.
SnapshotPtr snapshotUnderWay(const GarmentSnapshot& before, const PoseUnderWay& way);
// Whether forms are as fine as the garment is shown; on their way drapes stand on coarser lattices first.
bool asFine(const GarmentSnapshot& snapshot, const Forms& forms);

// Where each piece lies on the cutting table: the pattern's own paper, moved so that no two lie on each other, nor do
// their cut lines and their other sizes. A piece keeps its place while it is edited, and comes back to it; where pieces
// come to reach into each other, as they grow or are given sizes, all are laid anew but those the hand laid. Part of
// the view, not of the document.
class TableLayout {
 public:
  void arrange(const GarmentSnapshot& snapshot);  // gives new pieces a place, and old ones theirs
  Flat at(PieceId id) const;                      // what to add to a paper place; (0, 0) for a piece it does not know
  void carry(PieceId id, Flat by);                // by the hand

 private:
  Box lies(PieceId id) const;
  bool meet(PieceId one, PieceId other) const;
  template <class Each>
  void eachThatMeet(const Each& each) const;
  bool isFree(PieceId id) const;  // whether it meets no piece that is laid
  void makeRoom(const GarmentSnapshot& snapshot, bool sized);
  void bringBack(const GarmentSnapshot& snapshot);
  void layNew(const GarmentSnapshot& snapshot);
  std::map<PieceId, Flat> place_, left_;  // of the pieces that are there; of those that are gone
  std::set<PieceId> graded_;              // those that had sizes when they were laid
  std::set<PieceId> carried_;
  std::map<PieceId, Box> seam_, room_;  // about the paper's origin: the seam line; with all that needs room
};

struct EdgeNear {
  PieceId piece;
  std::string edge;
  double fraction = 0;  // by length
  double away = 0;      // in the sample's own measure: radians or metres
  bool operator==(const EdgeNear&) const = default;
};

struct Hit {
  enum class On { Nothing, Body, Cloth } on = On::Nothing;
  double along = 0;  // metres along the ray, or from the tip
  Vec3 point;        // in space: where the cloth or the skin is
  SurfacePoint skin;
  PieceId piece;
  Flat paper;
  std::optional<EdgeNear> edge;  // within reach, hidden ones left out
};

// What is under the pointer: what its ray meets first or, where it has a tip, what is within reach of that. Cheap; any
// thread.
Hit pick(const GarmentSnapshot& snapshot, const TableLayout& table, const PointerSample& sample);
Hit pickBody(const GarmentSnapshot& snapshot, const PointerSample& sample);  // through the cloth
// The nearest edge within reach among those that are wanted.
using WantedEdge = std::function<bool(const EdgeNear&)>;
std::optional<EdgeNear> pickEdge(const GarmentSnapshot& snapshot, const TableLayout& table, const PointerSample& sample,
                                 const WantedEdge& wanted);

// Where a paper place of a piece is in space now; nothing for a piece that is not there.
std::optional<Vec3> spaceOf(const GarmentSnapshot& snapshot, PieceId piece, Flat paper);
// The seam that runs over a place of an edge; none: an invalid id.
SeamId seamAt(const Document& document, const EdgeNear& near);
// A part of an edge as a line in space and on the table; nothing when it is not there.
std::vector<Vec3> edgeInSpace(const GarmentSnapshot& snapshot, const EdgeRef& part);
// Threads between edges that are to be sewn but hang apart, from place to place as they will be sewn.
std::vector<SceneLine> threadsOf(const GarmentSnapshot& snapshot);

// Open seams whose threads cross: sewn as they are the cloth would twist; a click on the mark turns one round.
struct CrossedSeam {
  SeamId seam;
  Vec3 place;                                   // where the threads cross
  std::vector<std::pair<PieceId, Flat>> paper;  // the middle of either side
};
std::vector<CrossedSeam> crossedSeams(const GarmentSnapshot& snapshot);  // takes milliseconds of a fine garment
std::optional<SeamId> crossedAt(const std::vector<CrossedSeam>& crossed, const TableLayout& table,
                                const PointerSample& sample);

}  // namespace karinui
