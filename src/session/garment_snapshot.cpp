#include "karinui/session/garment_snapshot.h"

#include <algorithm>
#include <cmath>

#include "karinui/pattern/allowance.h"
#include "karinui/pattern/cut_line.h"
#include "karinui/pattern/facing.h"
#include "karinui/pattern/grading.h"
#include "karinui/pattern/lattice.h"
#include "karinui/session/look_of.h"
#include "karinui/session/scene_of.h"

namespace karinui {

namespace {

// Every piece for itself, for patterns whose seams cannot be laid together: what is there is shown all the same.
SceneFrame scenePieceByPiece(const Document& document, const Body* body, const Prints& prints) {
  SceneFrame frame;
  if (body) frame.bodies.push_back({body->mesh(), SceneBody{}.colour});
  const std::set<PieceId> insideOut = wornInsideOut(document.pattern);  // by its seams
  for (const auto& [id, piece] : document.pattern.pieces) {
    Document alone = document;
    alone.pattern.seams.clear(), alone.allowances.fastenings.clear();
    std::erase_if(alone.pattern.pieces, [own = id](const auto& other) { return other.first != own; });
    Result<SceneFrame> one = sceneOf(alone, nullptr, prints);
    if (one && !one->cloths.empty()) {
      SceneCloth& cloth = one->cloths.front();
      if (insideOut.contains(id)) turnInsideOut(cloth.colour, cloth.look);
      frame.cloths.push_back(std::move(cloth));
    } else {
      frame.cloths.push_back({.name = piece->name, .mesh = {}, .flat = {}, .strain = {}, .outlines = {}, .seams = {}});
    }
  }
  return frame;
}

struct Closest {
  double away = 1e9;  // radians between the ray and the way to the place, or metres from the tip
  double along = 0;   // metres along the ray
  double share = 0;   // of the segment
};

// How near a ray passes to a segment in space, as an angle seen from where it starts. The nearest approach of the two
// lines, kept within the segment.
Closest closest(const Ray& ray, Vec3 a, Vec3 b) {
  const Vec3 side = b - a, from = a - ray.origin;
  const double sd = dot(side, ray.direction), ss = squaredLength(side);
  const double fd = dot(from, ray.direction), fs = dot(from, side);
  const double bottom = ss - sd * sd;
  const double t = bottom > 1e-18 ? std::clamp((sd * fd - fs) / bottom, 0.0, 1.0) : 0.0;
  const Vec3 p = from + side * t;
  const double along = dot(p, ray.direction);
  if (along <= 0) return {};
  return {std::atan2(length(p - ray.direction * along), along), along, t};
}

bool anyEdge(const EdgeNear&) { return true; }

// The wanted edge of a piece nearest to a paper place: its name and the fraction of its length.
std::optional<EdgeNear> edgeOnPaper(const Piece& piece, Flat place, const WantedEdge& wanted) {
  std::optional<EdgeNear> best;
  for (const Edge& edge : piece.outline.edges) {
    const std::vector<Flat> points = edge.curve.flattened(1e-4);
    double done = 0, bestHere = 1e9, at = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Flat side = points[i + 1] - points[i];
      const double whole = length(side);
      const double t = whole > 0 ? std::clamp(dot(place - points[i], side) / (whole * whole), 0.0, 1.0) : 0;
      const double away = distance(place, points[i] + side * t);
      if (away < bestHere) bestHere = away, at = done + t * whole;
      done += whole;
    }
    if (best && bestHere >= best->away) continue;
    const EdgeNear here{piece.id, edge.name, done > 0 ? std::clamp(at / done, 0.0, 1.0) : 0.0, bestHere};
    if (wanted(here)) best = here;
  }
  return best;
}

Hit pickTable(const GarmentSnapshot& snapshot, const TableLayout& table, const PointerSample& sample,
              const WantedEdge& wanted) {
  Hit hit;
  for (auto w = snapshot.worn.rbegin(); w != snapshot.worn.rend(); ++w) {
    const Piece* piece = snapshot.document.find(w->id);
    if (!piece) continue;
    const Flat paper = sample.place - table.at(w->id);
    auto edge = edgeOnPaper(*piece, paper, wanted);
    const bool inside = contains(w->ring, paper);
    if (edge && edge->away <= sample.reach && (!hit.edge || edge->away < hit.edge->away)) {
      hit.edge = edge;
      if (!inside && hit.on == Hit::On::Nothing) {
        hit.piece = w->id;
        hit.paper = paper;
      }
    }
    if (inside && hit.on == Hit::On::Nothing) {
      hit.on = Hit::On::Cloth;
      hit.piece = w->id;
      hit.paper = paper;
    }
  }
  if (hit.on == Hit::On::Cloth)
    if (const auto at = spaceOf(snapshot, hit.piece, hit.paper)) hit.point = *at;
  return hit;
}

// How near a tip is to a segment, in metres.
Closest closest(Vec3 tip, Vec3 a, Vec3 b) {
  const Vec3 side = b - a;
  const double ss = squaredLength(side);
  const double t = ss > 0 ? std::clamp(dot(tip - a, side) / ss, 0.0, 1.0) : 0.0;
  return {distance(tip, a + side * t), 0, t};
}

void pickEdge(const GarmentSnapshot& snapshot, const PointerSample& sample, const WantedEdge& wanted, Hit& hit) {
  constexpr double kBehind = 0.03;  // metres: an edge just behind the first thing met still counts
  double nearest = sample.reach;
  for (std::size_t k = 0; k < snapshot.worn.size(); ++k) {
    const SceneCloth& cloth = snapshot.frame.cloths[k];
    const Piece* piece = snapshot.document.find(snapshot.worn[k].id);
    if (!piece || cloth.outlines.empty()) continue;
    const auto& border = cloth.outlines.front();
    for (std::size_t i = 0; i + 1 < border.size(); ++i) {
      const Vec3 from = cloth.mesh.points[border[i]], to = cloth.mesh.points[border[i + 1]];
      const Closest near = sample.tip ? closest(sample.tip->carry, from, to) : closest(sample.ray, from, to);
      // An edge that lies on another piece's is no nearer than it: a whisker decides for the first.
      if (near.away >= nearest * 0.999 || (hit.on != Hit::On::Nothing && near.along > hit.along + kBehind)) continue;
      if (snapshot.visible && !snapshot.visible->shows(lerp(from, to, near.share))) continue;
      const Flat paper = lerp(cloth.flat[border[i]], cloth.flat[border[i + 1]], near.share);
      auto edge = edgeOnPaper(*piece, paper, anyEdge);
      if (!edge || !wanted(*edge)) continue;
      nearest = near.away;
      edge->away = near.away;
      hit.edge = edge;
      if (hit.on != Hit::On::Cloth) {
        hit.piece = piece->id;
        hit.paper = paper;
      }
    }
  }
}

}  // namespace

const Bvh& PickingTree::operator*() const {
  std::call_once(asked_, [&] { tree_.emplace(mesh_); });
  return *tree_;
}

SnapshotPtr snapshotOf(Document document, BodyPtr body, const Prints& prints) {
  auto snapshot = std::make_shared<GarmentSnapshot>();
  snapshot->body = std::move(body);
  Result<LaidScene> scene = laidSceneOf(document, snapshot->body.get(), prints);
  if (scene) {
    snapshot->frame = std::move(scene->frame);
  } else {
    snapshot->trouble = scene.error().what;
    snapshot->frame = scenePieceByPiece(document, snapshot->body.get(), prints);
  }
  auto cloth = snapshot->frame.cloths.begin();
  for (const auto& [id, piece] : document.pattern.pieces) {
    KARINUI_ASSERT(cloth != snapshot->frame.cloths.end() && cloth->name == piece->name);
    snapshot->worn.push_back({id, std::make_shared<const PickingTree>(cloth->mesh), piece->outline.flattened(2e-4)});
    if (scene) snapshot->worn.back().lattice = scene->lattices[snapshot->worn.size() - 1];
    ++cloth;
  }
  if (prints)
    for (const auto& [name, underlay] : document.underlays)
      if (auto image = prints(underlay.photo)) snapshot->scans.emplace(name, std::move(image));
  snapshot->document = std::move(document);
  return snapshot;
}

SnapshotPtr snapshotStanding(const GarmentSnapshot& before, const Forms& forms) {
  auto snapshot = std::make_shared<GarmentSnapshot>(before);
  bool laid = true;  // what the forms are of; coarser ones are laid over the garment's own lattice
  for (std::size_t k = 0; k < snapshot->worn.size(); ++k) {
    GarmentSnapshot::Worn& worn = snapshot->worn[k];
    const auto at = forms.find(worn.id);
    if (at == forms.end()) continue;
    Piece piece = *before.document.find(worn.id);
    piece.form = at->second;
    piece.pose = Rigid();
    snapshot->document.pattern.pieces[worn.id] = std::make_shared<const Piece>(std::move(piece));
    laid = laid && worn.lattice && at->second->flat == worn.lattice->nodes;
    if (!laid) continue;
    SceneCloth& cloth = snapshot->frame.cloths[k];
    cloth.mesh.points = at->second->space;
    cloth.strain = strainOf(*worn.lattice, cloth.mesh.points);
    worn.tree = std::make_shared<const PickingTree>(cloth.mesh);
  }
  if (!laid) return snapshotOf(std::move(snapshot->document), before.body);
  if (!snapshot->document.allowances.fastenings.empty())
    snapshot->frame.lines = fasteningLines(snapshot->document, snapshot->frame.cloths);
  return snapshot;
}

SnapshotPtr snapshotUnderWay(const GarmentSnapshot& before, const PoseUnderWay& way) {
  auto snapshot = std::make_shared<GarmentSnapshot>(*snapshotStanding(before, way.forms()));
  snapshot->document.body.pose = way.pose;
  for (SceneBody& body : snapshot->frame.bodies)
    if (body.mesh.points.size() == way.skin.size()) body.mesh.points = way.skin;
  snapshot->underWay = true;
  return snapshot;
}

Prints printsOf(const GarmentSnapshot& snapshot) {
  std::map<std::string, std::shared_ptr<const PrintImage>> images;
  for (std::size_t k = 0; k < snapshot.worn.size() && k < snapshot.frame.cloths.size(); ++k)
    if (const auto& photo = snapshot.frame.cloths[k].look.photo)
      if (const Piece* piece = snapshot.document.find(snapshot.worn[k].id))
        images[lookOf(snapshot.document, *piece).photo] = photo;
  return [images](const std::string& photo) {
    const auto at = images.find(photo);
    return at == images.end() ? nullptr : at->second;
  };
}

PhotoTall photosOf(const GarmentSnapshot& snapshot) {
  return [prints = printsOf(snapshot)](const std::string& photo) {
    const auto image = prints(photo);
    return image ? static_cast<double>(image->height) / image->width : 1.0;
  };
}

bool asFine(const GarmentSnapshot& snapshot, const Forms& forms) {
  return std::all_of(snapshot.worn.begin(), snapshot.worn.end(), [&](const GarmentSnapshot::Worn& worn) {
    const auto at = forms.find(worn.id);
    return at == forms.end() || (worn.lattice && at->second->flat == worn.lattice->nodes);
  });
}

namespace {

constexpr double kTableGap = 0.04, kTableWide = 1.1;  // metres

// The room a piece needs on the table, about its paper's origin: its seam line and, where these reach into the gap to
// its neighbours, its cut line and its other sizes.
Box roomOnTable(const GarmentSnapshot::Worn& worn, const Document& document, const AllowancePlan& plan) {
  Box seam, all;
  const auto hold = [](Box& box, const Ring& ring) {
    for (const Flat p : ring) box.include({p.u, p.v, 0});
  };
  hold(seam, worn.ring), hold(all, worn.ring);
  const Piece* piece = document.find(worn.id);
  if (!piece) return seam;
  if (const auto cut = cutLines(*piece, plan, 1e-3)) hold(all, cut->outer);
  const Grading& grading = document.grading;
  if (grading.pieces.contains(worn.id))
    for (std::size_t size = 0; size < grading.sizes.size(); ++size)
      if (const auto other = inSize(*piece, grading, size)) hold(all, other->outline.flattened(1e-3));
  constexpr double kHalf = 0.475 * kTableGap;  // so that 2 mm are left between the lines of two neighbours
  seam.include({std::min(seam.low.x, all.low.x + kHalf), std::min(seam.low.y, all.low.y + kHalf), 0});
  seam.include({std::max(seam.high.x, all.high.x - kHalf), std::max(seam.high.y, all.high.y - kHalf), 0});
  return seam;
}

Flat paperMiddle(const Box& box) { return {(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2}; }

}  // namespace

Box TableLayout::lies(PieceId id) const {
  const auto known = room_.find(id);
  if (known == room_.end()) return {};
  Box box = known->second;
  const Flat by = at(id);
  box.low += Vec3{by.u, by.v, 0}, box.high += Vec3{by.u, by.v, 0};
  return box;
}

bool TableLayout::meet(PieceId one, PieceId other) const {
  const Box a = lies(one), b = lies(other);
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

void TableLayout::arrange(const GarmentSnapshot& snapshot) {
  const Document& document = snapshot.document;
  std::erase_if(place_, [&](const auto& known) {
    if (document.find(known.first)) return false;
    left_.insert_or_assign(known.first, known.second);
    return true;
  });
  std::set<PieceId> graded;
  std::map<PieceId, Box> seam;
  for (const auto& worn : snapshot.worn) {
    if (document.grading.pieces.contains(worn.id)) graded.insert(worn.id);
    for (const Flat p : worn.ring) seam[worn.id].include({p.u, p.v, 0});
  }
  const bool sized = !std::includes(graded_.begin(), graded_.end(), graded.begin(), graded.end());
  graded_ = std::move(graded);
  const bool same = std::equal(seam.begin(), seam.end(), seam_.begin(), seam_.end(), [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.low == b.second.low && a.second.high == b.second.high;
  });
  const auto laid = [&](const auto& worn) { return place_.contains(worn.id); };
  if (!sized && same && std::all_of(snapshot.worn.begin(), snapshot.worn.end(), laid)) return;
  seam_ = std::move(seam);
  makeRoom(snapshot, sized);
  bringBack(snapshot);
  layNew(snapshot);
}

template <class Each>
void TableLayout::eachThatMeet(const Each& each) const {
  for (auto one = place_.begin(); one != place_.end(); ++one)
    for (auto other = std::next(one); other != place_.end(); ++other)
      if (meet(one->first, other->first)) each(one->first, other->first);
}

bool TableLayout::isFree(PieceId id) const {
  return std::none_of(place_.begin(), place_.end(),
                      [&](const auto& other) { return other.first != id && meet(id, other.first); });
}

// Pieces that need more room than they did, so that they lie on each other now, are laid anew.
void TableLayout::makeRoom(const GarmentSnapshot& snapshot, bool sized) {
  const Document& document = snapshot.document;
  std::set<std::pair<PieceId, PieceId>> met;  // as the hand had laid them
  eachThatMeet([&](PieceId one, PieceId other) { met.insert({one, other}); });
  const AllowancePlan plan(document.pattern, document.allowances);
  room_.clear();
  for (const auto& worn : snapshot.worn) room_[worn.id] = roomOnTable(worn, document, plan);
  // What was traced stays on its scan.
  const auto onScan = [&](PieceId id) {
    return at(id) == Flat{} && underlayAt(document.underlays, paperMiddle(room_.at(id)));
  };
  bool anew = false;
  eachThatMeet([&](PieceId one, PieceId other) {
    if ((!sized && met.contains({one, other})) || (onScan(one) && onScan(other))) return;
    carried_.erase(one), carried_.erase(other);
    anew = true;
  });
  if (!anew) return;
  std::erase_if(place_, [&](const auto& known) { return !carried_.contains(known.first) && !onScan(known.first); });
  left_.clear();
}

// What an undo brings back lies where it lay, unless something else does now.
void TableLayout::bringBack(const GarmentSnapshot& snapshot) {
  for (const auto& worn : snapshot.worn) {
    const auto left = left_.find(worn.id);
    if (left == left_.end() || place_.contains(worn.id)) continue;
    place_[worn.id] = left->second;
    left_.erase(left);
    if (!isFree(worn.id)) place_.erase(worn.id);
  }
}

// Rows from the top downwards; a new piece goes to the end of the last row.
void TableLayout::layNew(const GarmentSnapshot& snapshot) {
  double right = 0, top = 0, low = 0;
  bool any = false;
  const auto goOnBeside = [&](const Box& b) {
    low = any ? std::min(low, b.low.y) : b.low.y;
    top = any ? std::max(top, b.high.y) : b.high.y;
    right = std::max(right, b.high.x + kTableGap);
    any = true;
  };
  for (const auto& [id, place] : place_) goOnBeside(lies(id));
  for (const auto& worn : snapshot.worn) {
    if (place_.contains(worn.id)) continue;
    const Box& b = room_.at(worn.id);
    // What was traced lies on its scan again, when the document is opened anew.
    if (underlayAt(snapshot.document.underlays, paperMiddle(b)) && isFree(worn.id)) {
      place_[worn.id] = {};
      goOnBeside(b);
      continue;
    }
    if (any && right + b.size().x > kTableWide) {
      top = low - kTableGap;
      right = 0;
    }
    place_[worn.id] = Flat{right - b.low.x, top - b.high.y};
    right += b.size().x + kTableGap;
    low = any ? std::min(low, top - b.size().y) : top - b.size().y;
    any = true;
  }
}

Flat TableLayout::at(PieceId id) const {
  const auto at = place_.find(id);
  return at == place_.end() ? Flat{} : at->second;
}

void TableLayout::carry(PieceId id, Flat by) {
  const auto at = place_.find(id);
  if (at == place_.end()) return;
  at->second += by;
  carried_.insert(id);
}

namespace {

// What a sample meets of a surface: the first place along its ray, or the nearest within reach of its tip.
struct Met {
  SurfacePoint place;
  Vec3 point;
  double along = 0;  // the ray, or away from the tip
};
// What is not drawn does not count; where a cut end comes first there is nothing but it.
using Seen = std::function<bool(const SurfacePoint&, Vec3)>;
std::optional<Met> meet(const Bvh& tree, const PointerSample& sample, const Seen& seen, bool closed) {
  if (sample.tip) {
    const auto near = tree.nearest(sample.tip->carry, sample.reach);
    if (!near || (seen && !seen(near->place, near->point))) return std::nullopt;
    return Met{near->place, near->point, near->distance};
  }
  if (seen) {
    for (const Bvh::Hit& hit : tree.all(sample.ray.origin, sample.ray.direction))
      if (seen(hit.place, hit.point))
        return closed && !hit.outside ? std::nullopt : std::optional<Met>({hit.place, hit.point, hit.along});
    return std::nullopt;
  }
  const auto first = tree.first(sample.ray.origin, sample.ray.direction);
  return first ? std::optional<Met>({first->place, first->point, first->along}) : std::nullopt;
}

}  // namespace

Hit pickBody(const GarmentSnapshot& snapshot, const PointerSample& sample) {
  Hit hit;
  if (!snapshot.body || sample.where != PointerSample::Where::Space) return hit;
  const Seen seen = !snapshot.visible ? Seen() : [&](const SurfacePoint& place, Vec3 point) {
    return snapshot.visible->showsSkin(place, point);
  };
  if (const auto met = meet(snapshot.body->bvh(), sample, seen, true)) {
    hit.on = Hit::On::Body;
    hit.along = met->along;
    hit.point = met->point;
    hit.skin = met->place;
  }
  return hit;
}

namespace {

Hit pickWanted(const GarmentSnapshot& snapshot, const TableLayout& table, const PointerSample& sample,
               const WantedEdge& wanted) {
  if (sample.where == PointerSample::Where::Table) return pickTable(snapshot, table, sample, wanted);
  Hit hit = pickBody(snapshot, sample);
  const Seen seen =
      !snapshot.visible ? Seen() : [&](const SurfacePoint&, Vec3 point) { return snapshot.visible->shows(point); };
  for (std::size_t k = 0; k < snapshot.worn.size(); ++k) {
    const SceneCloth& cloth = snapshot.frame.cloths[k];
    if (cloth.mesh.faces.empty()) continue;
    const auto met = meet(**snapshot.worn[k].tree, sample, seen, false);
    // Cloth that lies on the skin, or a hair within it, is what is seen.
    constexpr double kSkin = 0.004;
    if (!met || (hit.on != Hit::On::Nothing && met->along > hit.along + (hit.on == Hit::On::Body ? kSkin : 0.0)))
      continue;
    hit.on = Hit::On::Cloth;
    hit.along = met->along;
    hit.point = met->point;
    hit.piece = snapshot.worn[k].id;
    hit.paper = {};
    const Triangle& face = cloth.mesh.faces[met->place.face];
    for (std::size_t i = 0; i < 3; ++i) hit.paper += cloth.flat[face[i]] * met->place.weight[i];
  }
  pickEdge(snapshot, sample, wanted, hit);
  return hit;
}

}  // namespace

Hit pick(const GarmentSnapshot& snapshot, const TableLayout& table, const PointerSample& sample) {
  return pickWanted(snapshot, table, sample, anyEdge);
}
std::optional<EdgeNear> pickEdge(const GarmentSnapshot& snapshot, const TableLayout& table, const PointerSample& sample,
                                 const WantedEdge& wanted) {
  return pickWanted(snapshot, table, sample, wanted).edge;
}

std::optional<Vec3> spaceOf(const GarmentSnapshot& snapshot, PieceId id, Flat paper) {
  const Piece* piece = snapshot.document.find(id);
  if (!piece) return std::nullopt;
  return Stand(*piece)(paper);
}

SeamId seamAt(const Document& document, const EdgeNear& near) {
  SeamId found;
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto* side : takenSides(seam))
      for (const EdgeSpan& span : *side)
        if (span.piece == near.piece && span.edge == near.edge && span.from <= near.fraction + 1e-9 &&
            near.fraction <= span.to + 1e-9)
          found = id;
  return found;
}

std::vector<Vec3> edgeInSpace(const GarmentSnapshot& snapshot, const EdgeRef& part) {
  std::vector<Vec3> line;
  const Piece* piece = snapshot.document.find(part.piece.id);
  const Curve* curve = piece ? findCurve(*piece, part.edge) : nullptr;
  if (!curve) return line;
  const Stand stand(*piece);
  const int steps = std::clamp(static_cast<int>(curve->length() * (part.to - part.from) / 0.008), 4, 200);
  for (const Flat p : curve->evenly(part.from, part.to, steps)) line.push_back(stand(p));
  return line;
}

}  // namespace karinui
