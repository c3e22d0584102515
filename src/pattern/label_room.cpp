// Finding room: places of a grid over the piece are tried with ever smaller lettering.
#include "karinui/pattern/label_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace karinui {
namespace {

constexpr int kGrid = 21;

double distanceBetween(Flat p, Flat a, Flat b) {  // point and segment
  const Flat along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return distance(p, a + along * t);
}

bool cross(Flat a, Flat b, Flat c, Flat d) {
  const auto side = [](Flat p, Flat q, Flat r) { return karinui::cross(q - p, r - p) > 0; };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

struct Box {  // metres on paper
  Flat centre, half;
};

double distanceTo(const Box& box, Flat p) {
  return length(Flat{std::max(0.0, std::abs(p.u - box.centre.u) - box.half.u),
                     std::max(0.0, std::abs(p.v - box.centre.v) - box.half.v)});
}

class Room {
 public:
  explicit Room(const Piece& piece) {
    rings_.push_back(piece.outline.flattened(2e-4));
    for (const Outline& hole : piece.holes) rings_.push_back(hole.flattened(2e-4));
    for (const Ring& ring : rings_)
      for (std::size_t i = 0; i < ring.size(); ++i) segments_.push_back({ring[i], ring[(i + 1) % ring.size()]});
    for (const InternalLine& line : piece.lines)
      for (const Curve& curve : line.curves) {
        const std::vector<Flat> points = curve.flattened(5e-4);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) segments_.push_back({points[i], points[i + 1]});
      }
    const FlatBox box = boxOf(rings_[0]);
    low_ = box.low, high_ = box.high;
    for (int j = 1; j < kGrid; ++j)
      for (int i = 1; i < kGrid; ++i) {
        const Flat p{low_.u + (high_.u - low_.u) * i / kGrid, low_.v + (high_.v - low_.v) * j / kGrid};
        if (inside(p)) places_.push_back(p);
      }
  }

  const std::vector<Flat>& places() const { return places_; }
  Flat middle() const { return (low_ + high_) * 0.5; }
  bool inside(Flat p) const {
    if (!contains(rings_[0], p)) return false;
    return std::none_of(rings_.begin() + 1, rings_.end(), [&](const Ring& hole) { return contains(hole, p); });
  }
  bool clear(const Box& box, double margin) const {
    const Box wide{box.centre, box.half + Flat{margin, margin}};
    const Flat c = wide.centre, h = wide.half;
    const std::array<Flat, 4> corner{c + Flat{-h.u, -h.v}, c + Flat{h.u, -h.v}, c + h, c + Flat{-h.u, h.v}};
    for (const auto& [a, b] : segments_) {
      if (distanceTo(wide, a) == 0 || distanceTo(wide, b) == 0) return false;
      for (std::size_t k = 0; k < 4; ++k)
        if (cross(a, b, corner[k], corner[(k + 1) % 4])) return false;
    }
    return inside(c);
  }
  double clearance(Flat from, Flat to) const {  // of a stroke from all lines; 0 where it leaves the piece
    if (!inside(from) || !inside(to)) return 0;
    double out = 1e9;
    for (const auto& [a, b] : segments_) {
      if (cross(from, to, a, b)) return 0;
      out = std::min({out, distanceBetween(a, from, to), distanceBetween(b, from, to), distanceBetween(from, a, b),
                      distanceBetween(to, a, b)});
    }
    return out;
  }

 private:
  std::vector<Ring> rings_;
  std::vector<std::pair<Flat, Flat>> segments_;
  Flat low_, high_;
  std::vector<Flat> places_;
};

struct Lettering {
  Box box;
  double size = 0.002;
  bool upright = true;
};

constexpr double kSmaller = 0.62;     // a later line's size to the first's
constexpr double kLineHeight = 1.35;  // of the font's size

Lettering letteringFor(const Room& room, const std::vector<std::string>& lines) {
  const auto boxOf = [&](Flat centre, double size, bool upright) {
    double width = 0, height = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double own = i == 0 ? size : size * kSmaller;
      width = std::max(width, wordsWidth(lines[i], own));
      height += own * kLineHeight;
    }
    const Flat half = Flat{width, height} * 0.5;
    return Box{centre, upright ? half : Flat{half.v, half.u}};
  };
  for (const double margin : {0.009, 0.003, 0.001})
    for (const double size : {0.011, 0.009, 0.0075, 0.006, 0.005, 0.004, 0.0032, 0.0026})
      for (const bool upright : {true, false}) {
        std::optional<Box> best;
        for (const Flat place : room.places()) {
          const Box box = boxOf(place, size, upright);
          if ((!best || distance(place, room.middle()) < distance(best->centre, room.middle())) &&
              room.clear(box, margin))
            best = box;
        }
        if (best && (size >= 0.0032 || margin < 0.003)) return {*best, size, upright};
      }
  // No room at all: small, at the place farthest from the lines.
  Flat widest = room.middle();
  double most = -1;
  for (const Flat place : room.places())
    if (const double here = room.clearance(place, place); here > most) most = here, widest = place;
  return {boxOf(widest, 0.002, true), 0.002, true};
}

std::optional<std::pair<Flat, Flat>> grainFor(const Room& room, Flat grain, const Box& lettering) {
  for (const double margin : {0.008, 0.003})
    for (const double long_ : {0.30, 0.24, 0.18, 0.13, 0.09, 0.06, 0.04, 0.025, 0.015}) {
      std::optional<std::pair<Flat, Flat>> best;
      double nearest = 1e9;
      for (const Flat place : room.places()) {
        const Flat from = place - grain * (long_ / 2), to = place + grain * (long_ / 2);
        double apart = 1e9;
        for (int i = 0; i <= 20; ++i) apart = std::min(apart, distanceTo(lettering, lerp(from, to, i / 20.0)));
        const double far = distance(place, room.middle());
        if (apart > 0.004 && far < nearest && room.clearance(from, to) > margin) best = {from, to}, nearest = far;
      }
      if (best) return best;
    }
  return std::nullopt;
}

Box boxOf(const std::string& words, const LetteredPiece::Line& at) {
  constexpr double kWider = 1.08;  // a font may be wider than estimated
  const Flat half = Flat{kWider * wordsWidth(words, at.size), at.size * kLineHeight} * 0.5;
  return {at.place, at.upright ? half : Flat{half.v, half.u}};
}

bool overlap(const Box& a, const Box& b) {
  return std::abs(a.centre.u - b.centre.u) < a.half.u + b.half.u &&
         std::abs(a.centre.v - b.centre.v) < a.half.v + b.half.v;
}

// Steps from a place, the shortest first.
const std::vector<Flat>& stepsAround() {
  static const std::vector<Flat> all = [] {
    constexpr int kFar = 11;
    constexpr double kApart = 0.005;  // metres
    std::vector<Flat> steps;
    for (int j = -kFar; j <= kFar; ++j)
      for (int i = -kFar; i <= kFar; ++i) steps.push_back({i * kApart, j * kApart});
    std::stable_sort(steps.begin(), steps.end(), [](Flat a, Flat b) { return length(a) < length(b); });
    return steps;
  }();
  return all;
}

}  // namespace

std::vector<LetteredPiece::Line> roomForNotes(const Piece& piece, const std::vector<WishedNote>& notes,
                                              const std::vector<std::string>& lines, const LetteredPiece& lettered,
                                              const std::vector<Flat>& tags) {
  if (notes.empty()) return {};
  constexpr double kTag = 0.002, kMargin = 0.0004;  // metres: half a seam's number; what is kept clear of lines
  const Room room(piece);
  std::vector<Box> taken;
  for (std::size_t i = 0; i < lines.size() && i < lettered.lines.size(); ++i)
    taken.push_back(boxOf(lines[i], lettered.lines[i]));
  for (const Flat tag : tags) taken.push_back({tag, {kTag, kTag}});
  if (lettered.grain)
    for (int k = 0; k <= 40; ++k)
      taken.push_back({lerp(lettered.grain->from, lettered.grain->to, k / 40.0), {kMargin, kMargin}});
  const auto free = [&](const Box& box) {
    return std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return overlap(box, other); });
  };
  std::vector<LetteredPiece::Line> out;
  for (const WishedNote& note : notes) {
    LetteredPiece::Line at = note.at;
    const auto search = [&](bool alone) -> std::optional<LetteredPiece::Line> {
      for (const double share : {1.0, 0.85, 0.7, 0.6, 0.5})
        for (const bool turned : {false, true})
          for (const Flat step : stepsAround()) {
            const LetteredPiece::Line tried{note.at.place + step, std::max(kLeastNote, share * note.at.size),
                                            note.at.upright != turned};
            const Box box = boxOf(note.words, tried);
            if ((!alone || free(box)) && room.clear(box, kMargin)) return tried;
          }
      return std::nullopt;
    };
    if (const auto found = search(true))
      at = *found;
    else if (const auto over = search(false))
      at = *over;
    taken.push_back(boxOf(note.words, at));
    out.push_back(at);
  }
  return out;
}

double wordsWidth(std::string_view words, double size) {
  double width = 0;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    width += byte < 0x80 ? 0.6 : byte >= 0xC0 ? 1.0 : 0.0;
  }
  return width * size;
}

LetteredPiece roomFor(const Piece& piece, const std::vector<std::string>& lines) {
  const Room room(piece);
  const Lettering lettering = letteringFor(room, lines);
  const Box& box = lettering.box;
  LetteredPiece out;
  // The lines are stacked within the box, downwards or, turned, to the right.
  double below = -(lettering.upright ? box.half.v : box.half.u);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double size = i == 0 ? lettering.size : lettering.size * kSmaller, middle = below + size * kLineHeight / 2;
    out.lines.push_back(
        {box.centre + (lettering.upright ? Flat{0, -middle} : Flat{middle, 0}), size, lettering.upright});
    below += size * kLineHeight;
  }
  if (const auto grain = grainFor(room, piece.grain, box)) out.grain = {grain->first, grain->second};
  return out;
}

}  // namespace karinui
