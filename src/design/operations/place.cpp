// Wraps a piece round the torso or a limb: a general cylinder whose section is the hull of the limb's own sections over
// the length the piece covers, grown by the ease. Along the section lengths are kept, along the axis too: no
// distortion.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "design/operations/operations.h"
#include "karinui/pattern/lattice.h"

namespace karinui {

namespace {

constexpr double kMostEase = 0.5;
constexpr double kOff = 1e-7;  // a plane just beside a mesh's own points cuts its faces cleanly
constexpr int kLevels = 9;     // sections taken over the piece's height
constexpr int kAround = 48;    // places looked for round a limb, and kRings such rings from one named level to the next
constexpr int kRings = 12;

// A right-handed frame with y along the limb, towards the head; z out of the body at the anchor.
struct Limb {
  Vec3 origin, right, up, out;
  Flat onPlane(Vec3 p) const {
    return {dot(p - origin, right), -dot(p - origin, out)};
  }  // counter-clockwise seen from above
  Vec3 inSpace(Flat p, double height) const { return origin + right * p.u - out * p.v + up * height; }
};

// The limb's own skin: places all round it, ring by ring along the chart. A direction that runs into the trunk has
// none, so a ring near the shoulder or the crotch is open on its inner side.
struct LimbRing {
  double along = 0;
  Vec3 middle;
  std::vector<Vec3> skin;
};

std::vector<LimbRing> ringsOf(const Body& body, BodyPoint::Part part) {
  std::vector<LimbRing> rings;
  const int levels = static_cast<int>(chartLevels(part).size());
  for (int i = 0; i <= (levels - 1) * kRings; ++i) {
    LimbRing ring{static_cast<double>(i) / kRings, {}, {}};
    for (int k = 0; k < kAround; ++k) {
      BodyPoint at;
      at.part = part, at.along = ring.along, at.around = static_cast<double>(k) / kAround;
      if (const auto place = body.find(at)) ring.skin.push_back(karinui::at(body.mesh(), *place));
    }
    for (const Vec3 p : ring.skin) ring.middle += p * (1.0 / static_cast<double>(ring.skin.size()));
    if (ring.skin.size() >= kAround / 4) rings.push_back(std::move(ring));
  }
  return rings;
}

bool isLimb(BodyPoint::Part part) {
  return part == BodyPoint::Part::LeftArm || part == BodyPoint::Part::RightArm || part == BodyPoint::Part::LeftLeg ||
         part == BodyPoint::Part::RightLeg;
}

// Towards the head along the stretch of the limb from `low` to `high` (metres towards the head from the anchor).
Vec3 axisOver(const std::vector<LimbRing>& rings, Vec3 anchor, double low, double high) {
  Vec3 up{0, 1, 0};
  for (int round = 0; round < 3; ++round) {
    const LimbRing *bottom = nullptr, *top = nullptr;
    const auto height = [&](const LimbRing& ring) { return dot(ring.middle - anchor, up); };
    for (const LimbRing& ring : rings) {
      // Open rings have no middle; they lie beyond the first closed one.
      if (ring.skin.size() < kAround) continue;
      if (!bottom || std::abs(height(ring) - low) < std::abs(height(*bottom) - low)) bottom = &ring;
      if (!top || std::abs(height(ring) - high) < std::abs(height(*top) - high)) top = &ring;
    }
    if (!bottom || !top || distance(bottom->middle, top->middle) < 0.02) return up;
    up = normalized(top->middle - bottom->middle);
    if (up.y < 0) up = -up;
  }
  return up;
}

// Where the mesh meets the plane `height` above the limb's origin: loose segments on the plane, grouped by being
// joined.
std::vector<std::vector<Flat>> sections(const Body& body, const Limb& limb, double height) {
  const TriangleMesh& mesh = body.mesh();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> node;  // a crossed edge of the mesh is a node
  std::vector<Flat> place;
  std::vector<std::uint32_t> parent;
  const auto root = [&](std::uint32_t n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  const auto above = [&](std::uint32_t p) { return dot(mesh.points[p] - limb.origin, limb.up) - height; };
  for (const Triangle& face : mesh.faces) {
    std::array<std::uint32_t, 3> ends{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t a = face[i], b = face[(i + 1) % 3];
      if (a > b) std::swap(a, b);
      const double ha = above(a), hb = above(b);
      if ((ha < 0) == (hb < 0)) continue;
      const auto [at, fresh] = node.try_emplace({a, b}, static_cast<std::uint32_t>(place.size()));
      if (fresh) {
        place.push_back(limb.onPlane(lerp(mesh.points[a], mesh.points[b], ha / (ha - hb))));
        parent.push_back(at->second);
      }
      ends[count++] = at->second;
    }
    if (count == 2) parent[std::max(root(ends[0]), root(ends[1]))] = std::min(root(ends[0]), root(ends[1]));
  }
  std::map<std::uint32_t, std::vector<Flat>> loops;
  for (std::uint32_t n = 0; n < place.size(); ++n) loops[root(n)].push_back(place[n]);
  std::vector<std::vector<Flat>> all;
  for (auto& [first, loop] : loops) all.push_back(std::move(loop));
  return all;
}

// Andrew's monotone chain, counter-clockwise.
Ring hull(std::vector<Flat> points) {
  std::sort(points.begin(), points.end(), [](Flat a, Flat b) { return a.u < b.u || (a.u == b.u && a.v < b.v); });
  Ring ring;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = ring.size();
    for (const Flat p : points) {
      while (ring.size() >= base + 2 && cross(ring.back() - ring[ring.size() - 2], p - ring.back()) <= 1e-12)
        ring.pop_back();
      ring.push_back(p);
    }
    ring.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return ring;
}

const std::vector<Flat>* nearest(const std::vector<std::vector<Flat>>& loops, Flat place) {
  const std::vector<Flat>* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops) {
    for (const Flat p : loop) {
      if (const double d = distance(p, place); d < least) least = d, best = &loop;
    }
  }
  return best;
}

// A convex ring grown outwards by `ease`, corners rounded.
Ring grown(const Ring& ring, double ease) {
  Ring out;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Flat in = normalized(ring[i] - ring[(i + n - 1) % n]), on = normalized(ring[(i + 1) % n] - ring[i]);
    const double turn = std::atan2(cross(in, on), dot(in, on));
    const int steps = std::max(1, static_cast<int>(std::ceil(turn / 0.1)));
    const Flat side = -leftOf(in);
    for (int k = 0; k <= steps; ++k) {
      const double a = turn * k / steps;
      out.push_back(ring[i] +
                    Flat{side.u * std::cos(a) - side.v * std::sin(a), side.u * std::sin(a) + side.v * std::cos(a)} *
                        ease);
    }
  }
  return out;
}

struct PaperBox {
  Flat low, high;
};
PaperBox boxOf(const Ring& ring) {
  PaperBox box{ring.front(), ring.front()};
  for (const Flat p : ring) {
    box.low = {std::fmin(box.low.u, p.u), std::fmin(box.low.v, p.v)};
    box.high = {std::fmax(box.high.u, p.u), std::fmax(box.high.v, p.v)};
  }
  return box;
}

Error unwrappable(const BodyPoint& at) {
  return refused(say("A piece cannot be wrapped round the body at {0}; choose a place on its side.", text(at)));
}

// The limb's skin that the piece passes, seen along the axis.
std::vector<Flat> ringsAround(const std::vector<LimbRing>& rings, const Limb& limb, const PaperBox& box) {
  constexpr double kBeside = 0.005;  // a piece narrower than the way from ring to ring
  std::vector<Flat> all;
  for (const LimbRing& ring : rings)
    for (const Vec3 p : ring.skin) {
      const double height = dot(p - limb.origin, limb.up);
      if (height >= box.low.v - kBeside && height <= box.high.v + kBeside) all.push_back(limb.onPlane(p));
    }
  return all;
}

// The same round the trunk: loops of level sections that lie over the anchor's own one (not arms, not the whole
// figure).
std::vector<Flat> levelsAround(const Body& body, const Limb& limb, const PaperBox& box) {
  const auto around = sections(body, limb, kOff);
  const auto* found = nearest(around, {0, 0});
  if (!found || found->size() < 3) return {};
  std::vector<Flat> all = *found;
  const PaperBox core = boxOf(all);
  const Flat middle = lerp(core.low, core.high, 0.5);
  const Ring coreHull = hull(all);
  const double reach = 1.5 * length(core.high - core.low);
  for (int k = 0; k < kLevels; ++k) {
    const auto loops = sections(body, limb, box.low.v + (box.high.v - box.low.v) * k / (kLevels - 1) + kOff);
    for (const auto& loop : loops) {
      const PaperBox its = boxOf(loop);
      const Flat centre = lerp(its.low, its.high, 0.5);
      if (length(its.high - its.low) <= reach && contains(coreHull, centre) &&
          distance(centre, middle) < 0.5 * length(core.high - core.low))
        all.insert(all.end(), loop.begin(), loop.end());
    }
  }
  return all;
}

// A closed line by arc length.
class Girth {
 public:
  explicit Girth(Ring ring) : ring_(std::move(ring)) {
    double done = 0;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      start_.push_back(done);
      done += distance(ring_[i], ring_[(i + 1) % ring_.size()]);
    }
    length_ = done;
  }
  double length() const { return length_; }
  Flat at(double s) const {
    s -= std::floor(s / length_) * length_;
    const auto next = std::upper_bound(start_.begin(), start_.end(), s);
    const auto i = static_cast<std::size_t>(next - start_.begin()) - 1;
    const Flat a = ring_[i], b = ring_[(i + 1) % ring_.size()];
    const double part = distance(a, b);
    return part > 0 ? lerp(a, b, std::fmin(1, (s - start_[i]) / part)) : a;
  }
  double nearest(Flat place) const {
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Flat a = ring_[i], way = ring_[(i + 1) % ring_.size()] - a;
      const double whole = dot(way, way);
      const double t = whole > 0 ? std::clamp(dot(place - a, way) / whole, 0.0, 1.0) : 0;
      if (const double d = distance(place, a + way * t); d < least) least = d, best = start_[i] + t * std::sqrt(whole);
    }
    return best;
  }

 private:
  Ring ring_;
  std::vector<double> start_;
  double length_ = 0;
};

}  // namespace

Done resolve(const Document& before, PlacePiece& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (!op.ease) op.ease = Length{before.settings.ease};
  if (!(*op.ease >= 0 && *op.ease <= kMostEase))
    return refused(say("The ease lies between 0 and 50 cm; 8 mm is usual."));
  if (!(std::abs(op.turn) <= 1000)) return refused(say("That turn is too large."));
  if (!op.point) {
    const PaperBox box = boxOf(before.find(op.piece.id)->outline.flattened(1e-4));
    op.point = lerp(box.low, box.high, 0.5);
  }
  if (!(length(*op.point) <= 100)) return refused(say("That place is not on the paper."));
  return {};
}

Result<Document> perform(const Document& before, const PlacePiece& op, Context& context) {
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  const auto place = (*body)->find(op.at);
  if (!place) return place.error();
  Piece piece = *before.find(op.piece.id);

  // The paper about its anchor, turned.
  const double c = std::cos(op.turn), s = std::sin(op.turn);
  const auto turned = [&](Flat p) {
    const Flat d = p - *op.point;
    return Flat{c * d.u - s * d.v, s * d.u + c * d.v};
  };
  Ring paper = piece.outline.flattened(1e-3);
  for (Flat& p : paper) p = turned(p);
  const PaperBox box = boxOf(paper);

  Limb limb;
  limb.origin = at((*body)->mesh(), *place);
  const BodyPoint::Part part = isLimb(op.at.part) ? op.at.part : (*body)->describe(*place).part;
  const std::vector<LimbRing> rings = isLimb(part) ? ringsOf(**body, part) : std::vector<LimbRing>();
  limb.up = rings.empty() ? Vec3{0, 1, 0} : axisOver(rings, limb.origin, box.low.v, box.high.v);
  const Vec3 normal = faceNormal((*body)->mesh(), place->face);
  limb.out = normalized(normal - limb.up * dot(normal, limb.up));
  if (!(length(limb.out) > 0.5)) return unwrappable(op.at);
  limb.right = cross(limb.up, limb.out);

  std::vector<Flat> all = rings.empty() ? levelsAround(**body, limb, box) : ringsAround(rings, limb, box);
  if (all.size() < 3) return unwrappable(op.at);
  const Ring tape = hull(std::move(all));
  const double width = box.high.u - box.low.u;
  // A tube must close: a piece wider than the girth stands further off, its two sides a hair apart.
  const double ease = std::fmax(*op.ease, (width + 0.002 - perimeter(tape)) / (2 * std::numbers::pi));
  const Girth girth(grown(tape, std::fmax(ease, 1e-4)));
  const double anchor = girth.nearest({0, -ease});

  Pattern alone;
  Piece bare = piece;
  bare.form = nullptr;
  alone.pieces[piece.id] = std::make_shared<const Piece>(std::move(bare));
  const auto laid = lay(alone, before.settings.spacing);
  if (!laid) return laid.error();
  const Lattice& lattice = *laid->lattices.at(piece.id);
  auto form = std::make_shared<Form>();
  form->flat = lattice.nodes;
  form->faces = lattice.faces;
  for (const Flat p : lattice.nodes) {
    const Flat d = turned(p);
    form->space.push_back(limb.inSpace(girth.at(anchor + d.u), d.v));
  }
  piece.form = std::move(form);
  piece.pose = Rigid();
  return withPiece(before, std::move(piece));
}

}  // namespace karinui
