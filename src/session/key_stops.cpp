// Places that keys go to.
#include <algorithm>
#include <cmath>

#include "karinui/body/lines.h"
#include "karinui/session/keyboard_pointer.h"
#include "session/zip_slider.h"

namespace karinui {

namespace {

using Where = PointerSample::Where;

class Finder {
 public:
  Finder(const GarmentSnapshot& snapshot, const TableLayout& table, PointerSample with, const Viewpoint& viewpoint)
      : fitting_(snapshot), table_(table), with_(with), sight_(viewpoint) {}

  std::vector<KeyStop> pieces(bool sliders) {
    if (sliders)
      for (const ZipWay& zip : zipsOf(fitting_.document)) {
        const ZipPlace::Side slider = zip.at(zip.closed()).over;
        if (const Piece* piece = fitting_.document.find(slider.piece))
          add(*piece, slider.paper, [&](const Hit& hit) { return !hidden(hit, *piece, slider.paper); });
      }
    for (const auto& worn : fitting_.worn) {
      const Piece& piece = *fitting_.document.find(worn.id);
      inside(piece, worn.ring);
      for (const Edge& edge : piece.outline.edges) besideEdge(piece, edge);
    }
    return std::move(found_);
  }
  std::vector<KeyStop> edges(bool corners) {
    for (const auto& worn : fitting_.worn) {
      const Piece& piece = *fitting_.document.find(worn.id);
      for (const Edge& edge : piece.outline.edges) {
        if (corners)
          add(piece, edge.curve.start, [&](const Hit& hit) { return !hidden(hit, piece, edge.curve.start); });
        onEdge(piece, edge);
      }
    }
    return std::move(found_);
  }
  // The named places of the figure.
  std::vector<KeyStop> skin() {
    if (!fitting_.body || with_.where != Where::Space) return {};
    const Body& body = *fitting_.body;
    std::vector<Vec3> places;
    for (const auto& [name, place] : body.landmarks()) places.push_back(place);
    for (const auto part : {BodyPoint::Part::Torso, BodyPoint::Part::LeftArm, BodyPoint::Part::RightArm,
                            BodyPoint::Part::LeftLeg, BodyPoint::Part::RightLeg}) {
      const auto levels = chartLevels(part);
      for (std::size_t level = 0; level + 1 < levels.size(); ++level)
        for (int k = 0; k < 8; k += part == BodyPoint::Part::Torso ? 1 : 2) {
          BodyPoint point;
          point.part = part, point.along = static_cast<double>(level), point.around = k / 8.0;
          if (const auto there = body.find(point)) places.push_back(at(body.mesh(), *there));
        }
    }
    constexpr double kRow = 0.02, kSame = 0.012;  // metres
    // Corners of what is drawn by the body's lines: also those that lie at the silhouette.
    std::vector<Vec3> crossed;
    for (const LineCrossing& crossing : lineCrossings(body)) crossed.push_back(crossing.place);
    for (const Vec3 place : crossed) {
      const auto seen = pickBody(fitting_, towards(place));
      const bool known = std::any_of(found_.begin(), found_.end(),
                                     [&](const KeyStop& s) { return distance(s.space, place) < kSame / 2; });
      if (!known && inView(place) && (seen.on != Hit::On::Body || seen.along > distance(place, sight_.eye) - kSame))
        found_.push_back({place, {}});
    }
    for (const Vec3 place : places) {
      const auto seen = pickBody(fitting_, towards(place));
      const bool known =
          std::any_of(found_.begin(), found_.end(), [&](const KeyStop& s) { return distance(s.space, place) < kSame; });
      if (!known && inView(place) && seen.on == Hit::On::Body && distance(seen.point, place) < 0.005)
        found_.push_back({place, {}});
    }
    std::sort(found_.begin(), found_.end(), [&](const KeyStop& a, const KeyStop& b) {
      const double p = std::round(a.space.y / kRow), q = std::round(b.space.y / kRow);
      return p != q ? p > q : dot(a.space, sight_.right) < dot(b.space, sight_.right);
    });
    return std::move(found_);
  }

 private:
  bool inView(Vec3 place) const {
    const Vec3 way = place - sight_.eye;
    const double deep = -dot(way, sight_.back);
    return deep > 0 && std::fabs(dot(way, sight_.up)) < deep * sight_.tanHalf &&
           std::fabs(dot(way, sight_.right)) < deep * sight_.tanHalf * sight_.aspect;
  }
  PointerSample towards(Vec3 place) const {
    PointerSample sample = with_;
    sample.ray = {sight_.eye, normalized(place - sight_.eye)};
    return sample;
  }
  // Whether something lies between the eye and a place of a piece.
  bool hidden(const Hit& hit, const Piece& piece, Flat paper) const {
    constexpr double kNear = 0.012;  // metres
    if (hit.on == Hit::On::Nothing) return false;
    return hit.along < distance(*spaceOf(fitting_, piece.id, paper), sight_.eye) - kNear;
  }
  template <class Seen>
  bool add(const Piece& piece, Flat paper, Seen&& seen) {
    const Vec3 space = *spaceOf(fitting_, piece.id, paper);
    if (with_.where == Where::Space && (!inView(space) || !seen(pick(fitting_, table_, towards(space))))) return false;
    found_.push_back({space, paper + table_.at(piece.id)});
    return true;
  }
  // A place well inside, the middle if it is.
  void inside(const Piece& piece, const Ring& ring) {
    const FlatBox box = boxOf(ring);
    const Flat size = box.size();
    for (const double up : {0.5, 0.35, 0.65, 0.2, 0.8})
      for (const double across : {0.5, 0.35, 0.65, 0.2, 0.8}) {
        const Flat p = box.low + Flat{across * size.u, up * size.v};
        if (!contains(ring, p) || distanceToRing(ring, p) < 0.01) continue;
        if (add(piece, p, [&](const Hit& hit) { return hit.on == Hit::On::Cloth && hit.piece == piece.id; })) return;
      }
  }
  // Where one takes hold of the cloth at an edge.
  void besideEdge(const Piece& piece, const Edge& edge) {
    constexpr double kHem = 0.006;  // metres
    const double t = edge.curve.parameterAt(edge.curve.length() / 2);
    add(piece, edge.curve.at(t) + leftOf(normalized(edge.curve.tangent(t))) * kHem,
        [&](const Hit& hit) { return hit.on == Hit::On::Cloth && hit.piece == piece.id; });
  }
  // The middle of an edge, or what is seen of it.
  void onEdge(const Piece& piece, const Edge& edge) {
    for (const double share : {0.5, 0.3, 0.7, 0.1, 0.9})
      if (add(piece, edge.curve.atFraction(share),
              [&](const Hit& hit) { return hit.edge && hit.edge->piece == piece.id && hit.edge->edge == edge.name; }))
        return;
  }

  const GarmentSnapshot& fitting_;
  const TableLayout& table_;
  PointerSample with_;
  const Viewpoint& sight_;
  std::vector<KeyStop> found_;
};

}  // namespace

std::vector<KeyStop> keyStopsOf(const GarmentSnapshot& snapshot, const TableLayout& table, KeyStops wanted,
                                const PointerSample& with, const Viewpoint& viewpoint) {
  Finder finder(snapshot, table, with, viewpoint);
  switch (wanted) {
    case KeyStops::Skin:
      return finder.skin();
    case KeyStops::Pieces:
    case KeyStops::PiecesAndSliders:
      return finder.pieces(wanted == KeyStops::PiecesAndSliders);
    default:
      return finder.edges(wanted == KeyStops::Corners);
  }
}

}  // namespace karinui
