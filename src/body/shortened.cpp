#include "body/shortened.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {

namespace {

constexpr double kSnap = 0.0022;  // metres: a point nearer to the cut lies on it

}  // namespace

Line oneLine(const std::map<std::uint32_t, std::uint32_t>& next) {
  Line line;
  if (next.empty()) return line;
  const std::uint32_t first = next.begin()->first;
  std::uint32_t here = first;
  do {
    line.push_back(here);
    const auto at = next.find(here);
    if (at == next.end() || line.size() > next.size()) return {};
    here = at->second;
  } while (here != first);
  return line.size() == next.size() ? line : Line();
}

Shortened::Shortened(const TriangleMesh& mesh) : mesh_(mesh), gone_(mesh.faces.size(), false) {
  first_.assign(mesh.points.size() + 1, 0);
  for (const Triangle& f : mesh.faces)
    for (const std::uint32_t p : f) ++first_[p + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  faceOf_.resize(first_.back());
  std::vector<std::uint32_t> filled(first_.begin(), first_.end() - 1);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t p : mesh.faces[f]) faceOf_[filled[p]++] = f;
}

Line Shortened::takeOff(const Plane& cut, Vec3 tip) {
  const auto height = [&](std::uint32_t p) { return this->height(cut, p); };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> onEdge;
  const auto crossing = [&](std::uint32_t below, std::uint32_t above) {
    const double h = height(below);
    if (h == 0) return below;
    const auto [at, fresh] =
        onEdge.emplace(std::pair(below, above), static_cast<std::uint32_t>(mesh_.points.size() + points_.size()));
    if (fresh) points_.push_back(lerp(mesh_.points[below], mesh_.points[above], h / (h - height(above))));
    return at->second;
  };
  std::map<std::uint32_t, std::uint32_t> next;
  bool simple = true;
  for (const std::uint32_t f : facesBeyond(cut, tip)) {
    gone_[f] = true;
    const Triangle& face = mesh_.faces[f];
    std::size_t up = 3;  // the face's corner after which the cut is passed upwards
    for (std::size_t i = 0; i < 3; ++i)
      if (height(face[i]) <= 0 && height(face[(i + 1) % 3]) > 0) up = i;
    if (up == 3) continue;  // all of it goes
    const std::uint32_t a = face[up], b = face[(up + 1) % 3], c = face[(up + 2) % 3];
    const std::uint32_t in = crossing(a, b), out = height(c) > 0 ? crossing(a, c) : crossing(c, b);
    if (in == out) continue;  // it touches the cut with a corner
    simple = next.emplace(in, out).second && simple;
    // What is left of it: out … in, closed along the cut.
    const auto keep = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
      if (p != q && q != r && r != p) faces_.push_back({p, q, r});
    };
    if (height(c) > 0)
      keep(out, a, in);
    else if (squaredLength(point(out) - point(a)) < squaredLength(point(c) - point(in)))
      keep(out, c, a), keep(out, a, in);
    else
      keep(out, c, in), keep(c, a, in);
  }
  return simple ? oneLine(next) : Line();
}

TriangleMesh Shortened::taken() const {
  TriangleMesh out;
  out.points = mesh_.points;
  out.points.insert(out.points.end(), points_.begin(), points_.end());
  for (std::size_t f = 0; f < gone_.size(); ++f)
    if (!gone_[f]) out.faces.push_back(mesh_.faces[f]);
  out.faces.insert(out.faces.end(), faces_.begin(), faces_.end());
  return out;
}

Vec3 Shortened::point(std::uint32_t i) const {
  return i < mesh_.points.size() ? mesh_.points[i] : points_[i - mesh_.points.size()];
}

double Shortened::height(const Plane& cut, std::uint32_t point) const {
  const double far = along(cut, mesh_.points[point]);
  return std::abs(far) < kSnap ? 0 : far;
}

std::vector<std::uint32_t> Shortened::facesBeyond(const Plane& cut, Vec3 tip) const {
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 1; i < mesh_.points.size(); ++i)
    if (squaredLength(mesh_.points[i] - tip) < squaredLength(mesh_.points[nearest] - tip)) nearest = i;
  std::vector<std::uint32_t> faces, open;
  std::vector<bool> seen(mesh_.points.size(), false), taken(mesh_.faces.size(), false);
  const auto reach = [&](std::uint32_t p) {
    if (!seen[p] && height(cut, p) > 0) open.push_back(p);
    seen[p] = true;
  };
  reach(nearest);
  while (!open.empty()) {
    const std::uint32_t p = open.back();
    open.pop_back();
    for (std::uint32_t i = first_[p]; i < first_[p + 1]; ++i)
      if (const std::uint32_t f = faceOf_[i]; !taken[f]) {
        taken[f] = true;
        faces.push_back(f);
        for (const std::uint32_t q : mesh_.faces[f]) reach(q);
      }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

bool joinLines(TriangleMesh& mesh, const Line& a, Line b, Vec3 normal) {
  if (a.size() < 3 || b.size() < 3) return false;
  std::reverse(b.begin(), b.end());
  Vec3 middle;
  for (const std::uint32_t i : b) middle += mesh.points[i] * (1.0 / static_cast<double>(b.size()));
  const Vec3 side = normalized(cross(normal, std::abs(normal.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 0, 1})),
             front = cross(side, normal);
  const auto angle = [&](std::uint32_t i) {
    const Vec3 p = mesh.points[i] - middle;
    return std::atan2(dot(p, side), dot(p, front));
  };
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto turned = [&](std::uint32_t from, std::uint32_t to) {
    return std::remainder(angle(to) - angle(from), kTurn);
  };
  const auto nearest = std::min_element(b.begin(), b.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::abs(turned(a[0], i)) < std::abs(turned(a[0], j));
  });
  std::rotate(b.begin(), nearest, b.end());
  double way = 0;
  for (std::size_t i = 0; i < a.size(); ++i) way += turned(a[i], a[(i + 1) % a.size()]);
  const double sign = way < 0 ? -1 : 1;
  if (std::abs(std::abs(way) - kTurn) > 0.1) return false;  // no ring about the axis
  double onA = 0, onB = sign * turned(a[0], b[0]);
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const std::uint32_t a0 = a[i % a.size()], a1 = a[(i + 1) % a.size()], b0 = b[j % b.size()],
                        b1 = b[(j + 1) % b.size()];
    const double nextA = onA + sign * turned(a0, a1), nextB = onB + sign * turned(b0, b1);
    if (j == b.size() || (i < a.size() && nextA + onA <= nextB + onB)) {
      mesh.faces.push_back({a1, a0, b0});
      onA = nextA, ++i;
    } else {
      mesh.faces.push_back({a0, b0, b1});
      onB = nextB, ++j;
    }
  }
  return true;
}

TriangleMesh compact(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> now(mesh.points.size(), ~0u);
  for (const Triangle& f : mesh.faces)
    for (const std::uint32_t i : f) now[i] = 0;
  TriangleMesh out;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != ~0u) now[i] = static_cast<std::uint32_t>(out.points.size()), out.points.push_back(mesh.points[i]);
  for (const Triangle& f : mesh.faces) out.faces.push_back({now[f[0]], now[f[1]], now[f[2]]});
  return out;
}

}  // namespace karinui
