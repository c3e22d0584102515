#include "delaunay.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "karinui/base/result.h"
#include "karinui/geometry/polygon.h"

namespace karinui {
namespace {

// Places lie within 2^27, the three corners beyond them all within 2^30: products of two differences stay below 2^61,
// those of four need more than 64 bits.
__extension__ typedef __int128 Wide;

int indexOf(const Delaunay::Face& face, std::uint32_t corner) {
  for (int k = 0; k < 3; ++k)
    if (face.corner[k] == corner) return k;
  return -1;
}

}  // namespace

Delaunay::Delaunay(std::span<const Flat> places) {
  const auto [low, high] = boxOf(places);
  const double extent = places.empty() ? 1 : std::max({high.u - low.u, high.v - low.v, 1e-9});
  // A power of two, so that equal steps of the lattice stay (nearly) equal steps of the grid.
  const double unit = std::exp2(std::ceil(std::log2(extent)) - 27);
  constexpr std::int64_t kFar = std::int64_t{1} << 28;
  at_ = {{-kFar, -kFar}, {3 * kFar, -kFar}, {-kFar, 3 * kFar}};  // clear of all places
  faces_ = {{{0, 1, 2}, {kNone, kNone, kNone}}};
  someFace_ = {0, 0, 0};
  std::map<Whole, std::uint32_t> known;
  cornerOf_.reserve(places.size());
  for (Flat p : places) {
    const Whole whole{std::llround((p.u - low.u) / unit), std::llround((p.v - low.v) / unit)};
    const auto [found, fresh] = known.emplace(whole, static_cast<std::uint32_t>(at_.size()));
    cornerOf_.push_back(found->second);
    if (!fresh) continue;
    at_.push_back(whole);
    someFace_.push_back(kNone);
    insert(found->second);
  }
}

bool Delaunay::real(const Face& face) const { return face.corner[0] > 2 && face.corner[1] > 2 && face.corner[2] > 2; }

int Delaunay::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const std::int64_t bu = at_[b].u - at_[a].u, bv = at_[b].v - at_[a].v;
  const std::int64_t cu = at_[c].u - at_[a].u, cv = at_[c].v - at_[a].v;
  const std::int64_t area = bu * cv - bv * cu;
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool Delaunay::insideCircle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
  std::array<std::int64_t, 3> u, v, square;
  const std::array<std::uint32_t, 3> three{a, b, c};
  for (int k = 0; k < 3; ++k) {
    u[k] = at_[three[k]].u - at_[d].u;
    v[k] = at_[three[k]].v - at_[d].v;
    square[k] = u[k] * u[k] + v[k] * v[k];
  }
  Wide sum = 0;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    sum += static_cast<Wide>(square[k]) * (u[l] * v[m] - v[l] * u[m]);
  }
  return sum > 0;
}

std::uint32_t Delaunay::locate(std::uint32_t corner) const {
  // Walk towards it. In a Delaunay triangulation such a walk cannot run in a circle (de Floriani et al. 1991).
  std::uint32_t face = last_;
  for (;;) {
    const Face& here = faces_[face];
    bool moved = false;
    for (int k = 0; k < 3 && !moved; ++k)
      if (turn(here.corner[(k + 1) % 3], here.corner[(k + 2) % 3], corner) < 0) {
        face = here.beyond[k];
        moved = true;
        KARINUI_ASSERT(face != kNone);
      }
    if (!moved) return face;
  }
}

void Delaunay::replaceBeyond(std::uint32_t face, std::uint32_t before, std::uint32_t now) {
  if (face == kNone) return;
  for (auto& b : faces_[face].beyond)
    if (b == before) {
      b = now;
      return;
    }
}

void Delaunay::insert(std::uint32_t p) {
  const std::uint32_t found = locate(p);
  const Face old = faces_[found];
  int onSide = -1;
  for (int k = 0; k < 3; ++k)
    if (turn(old.corner[(k + 1) % 3], old.corner[(k + 2) % 3], p) == 0) onSide = k;
  std::vector<std::uint32_t> open;
  const auto fresh = static_cast<std::uint32_t>(faces_.size());
  if (onSide < 0) {  // one face becomes three
    const auto [a, b, c] = old.corner;
    faces_[found] = {{a, b, p}, {fresh, fresh + 1, old.beyond[2]}};
    faces_.push_back({{b, c, p}, {fresh + 1, found, old.beyond[0]}});
    faces_.push_back({{c, a, p}, {found, fresh, old.beyond[1]}});
    replaceBeyond(old.beyond[0], found, fresh);
    replaceBeyond(old.beyond[1], found, fresh + 1);
    someFace_[a] = found;
    someFace_[b] = someFace_[p] = fresh;
    someFace_[c] = fresh + 1;
    open = {found, fresh, fresh + 1};
  } else {  // on an edge: two faces become four
    const std::uint32_t other = old.beyond[onSide];
    KARINUI_ASSERT(other != kNone);
    const std::uint32_t a = old.corner[onSide], b = old.corner[(onSide + 1) % 3], c = old.corner[(onSide + 2) % 3];
    const Face across = faces_[other];
    int k = 0;
    while (across.beyond[k] != found) ++k;
    const std::uint32_t d = across.corner[k];  // across: d, c, b
    const std::uint32_t ab = old.beyond[(onSide + 2) % 3], ca = old.beyond[(onSide + 1) % 3];
    const std::uint32_t dc = across.beyond[(k + 2) % 3], bd = across.beyond[(k + 1) % 3];
    faces_[found] = {{a, b, p}, {other, fresh, ab}};
    faces_.push_back({{c, a, p}, {found, fresh + 1, ca}});
    faces_[other] = {{b, d, p}, {fresh + 1, found, bd}};
    faces_.push_back({{d, c, p}, {fresh, other, dc}});
    replaceBeyond(ca, found, fresh);
    replaceBeyond(dc, other, fresh + 1);
    someFace_[a] = someFace_[p] = found;
    someFace_[b] = other;
    someFace_[c] = fresh;
    someFace_[d] = fresh + 1;
    open = {found, fresh, other, fresh + 1};
  }
  settle(open, p);
  last_ = someFace_[p];
}

void Delaunay::settle(std::vector<std::uint32_t>& open, std::uint32_t apex) {
  while (!open.empty()) {
    const std::uint32_t face = open.back();
    open.pop_back();
    const int k = indexOf(faces_[face], apex);
    const std::uint32_t other = k < 0 ? kNone : faces_[face].beyond[k];
    if (other == kNone || !wantsFlip(face, k)) continue;
    flip(face, k);
    open.push_back(face);
    open.push_back(other);
  }
}

bool Delaunay::wantsFlip(std::uint32_t face, int side) const {
  const Face& here = faces_[face];
  const std::uint32_t other = here.beyond[side];
  if (other == kNone) return false;
  const Face& across = faces_[other];
  int k = 0;
  while (across.beyond[k] != face) ++k;
  return insideCircle(here.corner[0], here.corner[1], here.corner[2], across.corner[k]);
}

// The two faces at an edge take the other diagonal of their (strictly convex) quadrilateral.
void Delaunay::flip(std::uint32_t face, int side) {
  const Face here = faces_[face];
  const std::uint32_t other = here.beyond[side];
  const Face across = faces_[other];
  int k = 0;
  while (across.beyond[k] != face) ++k;
  const std::uint32_t a = here.corner[side], b = here.corner[(side + 1) % 3], c = here.corner[(side + 2) % 3];
  const std::uint32_t d = across.corner[k];
  const std::uint32_t ab = here.beyond[(side + 2) % 3], ca = here.beyond[(side + 1) % 3];
  const std::uint32_t bd = across.beyond[(k + 1) % 3], dc = across.beyond[(k + 2) % 3];
  faces_[face] = {{a, b, d}, {bd, other, ab}};
  faces_[other] = {{a, d, c}, {dc, ca, face}};
  replaceBeyond(bd, other, face);
  replaceBeyond(ca, face, other);
  someFace_[a] = someFace_[b] = face;
  someFace_[c] = someFace_[d] = other;
}

std::uint32_t Delaunay::leftOf(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t first = someFace_[a];
  // Round the corner counter-clockwise, then (at the rim of everything) clockwise.
  for (const int step : {1, 2}) {
    std::uint32_t face = first;
    do {
      const int k = indexOf(faces_[face], a);
      if (faces_[face].corner[(k + 1) % 3] == b) return face;
      face = faces_[face].beyond[(k + step) % 3];
    } while (face != kNone && face != first);
    if (face == first) break;
  }
  return kNone;
}

Delaunay::Forced Delaunay::force(std::uint32_t a, std::uint32_t b, std::array<std::uint32_t, 2>& met) {
  const std::array<std::uint32_t, 2> key{std::min(a, b), std::max(a, b)};
  if (leftOf(a, b) != kNone) {
    forced_.insert(key);
    return Forced::Made;
  }
  // Find the face at a through which the way to b leaves, then all edges crossed on the way.
  std::deque<std::array<std::uint32_t, 2>> crossed;  // right, left of the way
  std::uint32_t face = someFace_[a];
  const std::uint32_t first = face;
  for (;;) {
    const int k = indexOf(faces_[face], a);
    const std::uint32_t right = faces_[face].corner[(k + 1) % 3], left = faces_[face].corner[(k + 2) % 3];
    const int toRight = turn(a, b, right), toLeft = turn(a, b, left);
    const auto ahead = [&](std::uint32_t c) {
      return (at_[c].u - at_[a].u) * (at_[b].u - at_[a].u) + (at_[c].v - at_[a].v) * (at_[b].v - at_[a].v) > 0;
    };
    if (toRight == 0 && ahead(right)) return met = {right, right}, Forced::Touched;
    if (toLeft == 0 && ahead(left)) return met = {left, left}, Forced::Touched;
    if (toRight < 0 && toLeft > 0) {
      crossed.push_back({right, left});
      break;
    }
    face = faces_[face].beyond[(k + 1) % 3];
    KARINUI_ASSERT(face != kNone && face != first);
  }
  for (;;) {
    const auto [right, left] = crossed.back();
    if (forced(right, left)) return met = {right, left}, Forced::Crossed;
    const std::uint32_t next = leftOf(left, right);
    KARINUI_ASSERT(next != kNone);
    const Face& across = faces_[next];
    std::uint32_t tip = across.corner[0];
    for (std::uint32_t c : across.corner)
      if (c != right && c != left) tip = c;
    if (tip == b) break;
    const int side = turn(a, b, tip);
    if (side == 0) return met = {tip, tip}, Forced::Touched;
    crossed.push_back(side > 0 ? std::array{right, tip} : std::array{tip, left});
  }
  // Flip the crossed edges away; one whose quadrilateral is not convex waits for its turn.
  while (!crossed.empty()) {
    const std::uint32_t right = crossed.front()[0], left = crossed.front()[1];
    crossed.pop_front();
    const std::uint32_t here = leftOf(right, left), there = leftOf(left, right);
    const auto tipOf = [&](std::uint32_t f) {
      for (std::uint32_t c : faces_[f].corner)
        if (c != right && c != left) return c;
      return kNone;
    };
    const std::uint32_t p = tipOf(here), q = tipOf(there);
    if (turn(q, left, p) <= 0 || turn(p, right, q) <= 0) {
      crossed.push_back({right, left});
      continue;
    }
    flip(here, indexOf(faces_[here], p));
    if (p == a || p == b || q == a || q == b) continue;  // it starts at an end, so it crosses the way no more
    const int sideP = turn(a, b, p), sideQ = turn(a, b, q);
    if (sideP * sideQ < 0) crossed.push_back(sideP < 0 ? std::array{p, q} : std::array{q, p});
  }
  forced_.insert(key);
  return Forced::Made;
}

void Delaunay::improve() {
  // Lawson: every flip lowers a bounded potential, so the rounds end.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t face = 0; face < faces_.size(); ++face)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t b = faces_[face].corner[(k + 1) % 3], c = faces_[face].corner[(k + 2) % 3];
        if (faces_[face].beyond[k] == kNone || !wantsFlip(face, k) || forced(b, c)) continue;
        flip(face, k);
        changed = true;
      }
  }
}

}  // namespace karinui
