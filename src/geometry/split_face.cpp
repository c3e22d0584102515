#include "geometry/split_face.h"

#include <algorithm>

namespace karinui {
namespace {

using Cycle = std::vector<std::uint32_t>;
using Place = std::function<Flat(std::uint32_t)>;

double turn(Flat a, Flat b, Flat c) { return cross(b - a, c - a); }

bool properlyCross(Flat a, Flat b, Flat c, Flat d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

bool holds(const Cycle& cycle, Flat p, const Place& place) {
  bool in = false;
  for (std::size_t i = 0, j = cycle.size() - 1; i < cycle.size(); j = i++) {
    const Flat a = place(cycle[i]), b = place(cycle[j]);
    if ((a.v > p.v) != (b.v > p.v) && p.u < (b.u - a.u) * (p.v - a.v) / (b.v - a.v) + a.u) in = !in;
  }
  return in;
}

// Cuts off the best shaped ear again and again. Points in a row on one side of the face are no hindrance: an ear must
// have some area, and no other point may lie in or on it.
void clipEars(Cycle cycle, const Place& place, std::vector<Triangle>& out) {
  while (cycle.size() > 3) {
    const std::size_t n = cycle.size();
    std::size_t best = n, widest = 0;
    double bestShape = 0, widestShape = -1;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t ia = cycle[(i + n - 1) % n], ib = cycle[i], ic = cycle[(i + 1) % n];
      const Flat a = place(ia), b = place(ib), c = place(ic);
      const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
      const double shape = longest > 0 ? turn(a, b, c) / (longest * longest) : 0;
      if (shape > widestShape) {
        widestShape = shape;
        widest = i;
      }
      if (shape <= bestShape) continue;
      const bool free = std::none_of(cycle.begin(), cycle.end(), [&](std::uint32_t other) {
        if (other == ia || other == ib || other == ic) return false;
        const Flat p = place(other);
        return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
      });
      if (!free) continue;
      bestShape = shape;
      best = i;
    }
    if (best == n) best = widest;  // only rounding is left
    out.push_back({cycle[(best + n - 1) % n], cycle[best], cycle[(best + 1) % n]});
    cycle.erase(cycle.begin() + static_cast<std::ptrdiff_t>(best));
  }
  out.push_back({cycle[0], cycle[1], cycle[2]});
}

}  // namespace

SplitFace splitFace(std::span<const std::uint32_t> cycle, std::span<const Chord> chords, const Place& place) {
  SplitFace out;
  for (std::size_t i = 0; i < chords.size(); ++i)
    for (std::size_t j = i + 1; j < chords.size(); ++j) {
      const Chord &c = chords[i], &d = chords[j];
      if (c.a == d.a || c.a == d.b || c.b == d.a || c.b == d.b) continue;
      if (!properlyCross(place(c.a), place(c.b), place(d.a), place(d.b))) continue;
      out.trouble = SplitFace::Trouble::Crossing;
      out.firstChord = i;
      out.secondChord = j;
      return out;
    }

  std::vector<Cycle> parts{Cycle(cycle.begin(), cycle.end())};
  std::vector<std::uint32_t> placed(cycle.begin(), cycle.end());
  const auto isPlaced = [&](std::uint32_t v) { return std::find(placed.begin(), placed.end(), v) != placed.end(); };
  std::vector<Chord> open(chords.begin(), chords.end());
  while (!open.empty()) {
    // A run of chords from a node that is on a part's border, through nodes inside, to another on the border.
    Cycle run;
    const auto take = [&](std::size_t i, std::uint32_t from) {
      run.push_back(open[i].a == from ? open[i].b : open[i].a);
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
    };
    for (std::size_t i = 0; i < open.size() && run.empty(); ++i)
      for (std::uint32_t end : {open[i].a, open[i].b})
        if (run.empty() && isPlaced(end)) {
          run.push_back(end);
          take(i, end);
          break;
        }
    if (run.empty()) {
      out.trouble = SplitFace::Trouble::Island;
      return out;
    }
    while (!isPlaced(run.back())) {
      const std::uint32_t here = run.back();
      const auto next =
          std::find_if(open.begin(), open.end(), [&](const Chord& c) { return c.a == here || c.b == here; });
      if (next == open.end()) {
        out.trouble = SplitFace::Trouble::DeadEnd;
        return out;
      }
      take(static_cast<std::size_t>(next - open.begin()), here);
    }
    if (run.front() == run.back()) {
      out.trouble = SplitFace::Trouble::Island;
      return out;
    }
    const Flat middle = lerp(place(run[0]), place(run[1]), 0.5);
    std::size_t host = parts.size();
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const auto has = [&](std::uint32_t v) {
        return std::find(parts[p].begin(), parts[p].end(), v) != parts[p].end();
      };
      if (!has(run.front()) || !has(run.back())) continue;
      if (host == parts.size() || holds(parts[p], middle, place)) host = p;
    }
    if (host == parts.size()) {  // its ends lie in different parts: it would have to cross a chord
      out.trouble = SplitFace::Trouble::Crossing;
      return out;
    }
    const Cycle whole = parts[host];
    const std::size_t n = whole.size();
    const auto index = [&](std::uint32_t v) {
      return static_cast<std::size_t>(std::find(whole.begin(), whole.end(), v) - whole.begin());
    };
    const std::size_t i = index(run.front()), j = index(run.back());
    Cycle one, two;
    for (std::size_t k = i; k != j; k = (k + 1) % n) one.push_back(whole[k]);
    for (std::size_t k = run.size(); k-- > 1;) one.push_back(run[k]);
    for (std::size_t k = j; k != i; k = (k + 1) % n) two.push_back(whole[k]);
    for (std::size_t k = 0; k + 1 < run.size(); ++k) two.push_back(run[k]);
    placed.insert(placed.end(), run.begin() + 1, run.end() - 1);
    parts[host] = std::move(one);
    parts.push_back(std::move(two));
  }
  for (Cycle& part : parts)
    if (part.size() >= 3) clipEars(std::move(part), place, out.triangles);
  return out;
}

}  // namespace karinui
