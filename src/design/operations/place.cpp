// Wraps a piece round the torso or a limb: a general cylinder whose section is the hull of the body's sections over the
// height the piece covers, grown by the ease. Along the section lengths are kept, along the axis too: no distortion.
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

// A right-handed frame with y along the limb, towards the head; z out of the body at the anchor.
struct Limb {
  Vec3 origin, right, up, out;
  Flat onPlane(Vec3 p) const {
    return {dot(p - origin, right), -dot(p - origin, out)};
  }  // counter-clockwise seen from above
  Vec3 inSpace(Flat p, double height) const { return origin + right * p.u - out * p.v + up * height; }
};

Vec3 ringMiddle(const Body& body, BodyPoint at, double along) {
  constexpr int kAround = 16;
  Vec3 sum;
  int found = 0;
  at.along = along;
  for (int i = 0; i < kAround; ++i) {
    at.around = static_cast<double>(i) / kAround;
    if (const auto place = body.find(at)) sum += karinui::at(body.mesh(), *place), ++found;
  }
  return found > 0 ? sum * (1.0 / found) : sum;
}

Vec3 axisAt(const Body& body, const BodyPoint& at) {
  if (at.part == BodyPoint::Part::Torso || at.part == BodyPoint::Part::Landmark || at.part == BodyPoint::Part::Face)
    return {0, 1, 0};
  const Vec3 way =
      normalized(ringMiddle(body, at, at.along + 0.2) - ringMiddle(body, at, std::fmax(0, at.along - 0.2)));
  if (!(length(way) > 0.5)) return {0, 1, 0};
  return way.y < 0 ? -way : way;
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

  Limb limb;
  limb.origin = at((*body)->mesh(), *place);
  limb.up = axisAt(**body, op.at);
  const Vec3 normal = faceNormal((*body)->mesh(), place->face);
  limb.out = normalized(normal - limb.up * dot(normal, limb.up));
  if (!(length(limb.out) > 0.5))
    return refused(say("A piece cannot be wrapped round the body at {0}; choose a place on its side.", text(op.at)));
  limb.right = cross(limb.up, limb.out);

  // The paper about its anchor, turned.
  const double c = std::cos(op.turn), s = std::sin(op.turn);
  const auto turned = [&](Flat p) {
    const Flat d = p - *op.point;
    return Flat{c * d.u - s * d.v, s * d.u + c * d.v};
  };
  Ring paper = piece.outline.flattened(1e-3);
  for (Flat& p : paper) p = turned(p);
  const PaperBox box = boxOf(paper);

  // Everything of this limb the piece passes, seen along the axis. From level to level the loop nearest to the last
  // one's middle is the limb.
  const auto around = sections(**body, limb, kOff);
  const auto* found = nearest(around, {0, 0});
  const std::vector<Flat> first = found ? *found : std::vector<Flat>();
  if (first.size() < 3)
    return refused(say("A piece cannot be wrapped round the body at {0}; choose a place on its side.", text(op.at)));
  const PaperBox core = boxOf(first);
  const Flat middle = lerp(core.low, core.high, 0.5);
  std::vector<Flat> all = first;
  const Ring coreHull = hull(first);
  const double reach = 1.5 * length(core.high - core.low);
  for (int k = 0; k < kLevels; ++k) {
    const auto loops = sections(**body, limb, box.low.v + (box.high.v - box.low.v) * k / (kLevels - 1) + kOff);
    for (const auto& loop : loops) {
      const PaperBox its = boxOf(loop);
      // Of this limb: it lies over the core, and is not the whole figure.
      if (length(its.high - its.low) <= reach && contains(coreHull, lerp(its.low, its.high, 0.5)) &&
          distance(lerp(its.low, its.high, 0.5), middle) < 0.5 * length(core.high - core.low)) {
        all.insert(all.end(), loop.begin(), loop.end());
      }
    }
  }
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
