#include "sheet_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace karinui {

namespace {

constexpr double kSame = 0.2;  // mm: lines that are no farther from each other are one

double away(Mm a, Mm b) { return std::hypot(a.x - b.x, a.y - b.y); }

double awayFrom(const std::vector<Mm>& line, bool closed, Mm p) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
    const Mm a = line[i], along = line[(i + 1) % line.size()] - a, off = p - a;
    const double squared = along.x * along.x + along.y * along.y;
    const double t = squared > 0 ? std::clamp((along.x * off.x + along.y * off.y) / squared, 0.0, 1.0) : 0;
    least = std::min(least, away(a + along * t, p));
  }
  return least;
}

using Lines = std::vector<std::vector<Mm>>;

bool liesOn(const Lines& one, const Lines& other, bool closed) {
  return std::all_of(one.begin(), one.end(), [&](const std::vector<Mm>& line) {
    return std::any_of(other.begin(), other.end(), [&](const std::vector<Mm>& on) {
      return std::all_of(line.begin(), line.end(), [&](Mm p) { return awayFrom(on, closed, p) < kSame; });
    });
  });
}
bool same(const Lines& one, const Lines& other, bool closed) {
  return one.size() == other.size() && liesOn(one, other, closed) && liesOn(other, one, closed);
}

// All that is drawn, by layer and whether it is closed. Where pieces meet in a seam either of them may have the notch
// at the corner.
using Drawn = std::map<std::pair<SheetLayer, bool>, Lines>;
Drawn drawnOf(const SheetPiece& piece) {
  Drawn drawn;
  eachLine(piece, [&](SheetLayer layer, const std::vector<Mm>& points, bool closed) {
    if (layer != SheetLayer::Notch) drawn[{layer, closed}].push_back(points);
  });
  for (const SheetNotch& notch : piece.notches)
    if (!notch.corner) drawn[{SheetLayer::Notch, false}].push_back({notch.stroke.from, notch.stroke.to});
  for (const SheetSize& size : piece.nest) drawn[{SheetLayer::Boundary, true}].push_back(size.line);
  return drawn;
}

bool cutAlike(const SheetPiece& one, const SheetPiece& other, const SheetSettings& settings) {
  const auto cutting = [&](const SheetPiece& piece) {
    const auto told = settings.cutting.find(piece.piece->id);
    return told == settings.cutting.end() ? Cutting() : told->second;
  };
  const auto matched = [&](const SheetPiece& piece) {
    return std::any_of(settings.matches.begin(), settings.matches.end(),
                       [&](const MatchMark& mark) { return mark.piece == piece.piece->id; });
  };
  const Flat grain = one.piece->grain;
  return distance({-grain.u, grain.v}, other.piece->grain) < 1e-3 && one.piece->fabric == other.piece->fabric &&
         one.piece->interfacing == other.piece->interfacing && cutting(one) == cutting(other) && !matched(one) &&
         !matched(other);
}

bool isTurnedOver(const SheetPiece& second, const SheetPiece& first) {
  const Drawn one = drawnOf(first);
  Drawn other = drawnOf(second);
  for (auto& [layer, lines] : other)
    for (std::vector<Mm>& line : lines)
      for (Mm& p : line) p = turnedOver(second, first, p);
  return one.size() == other.size() && std::all_of(one.begin(), one.end(), [&](const auto& lines) {
           const auto also = other.find(lines.first);
           return also != other.end() && same(lines.second, also->second, lines.first.second);
         });
}

}  // namespace

Mm turnedOver(const SheetPiece& second, const SheetPiece& first, Mm place) {
  return {first.low.x + second.high.x - place.x, first.low.y + place.y - second.low.y};
}

std::map<PieceId, PieceId> secondsOfPairs(const std::vector<SheetPiece>& pieces, const SheetSettings& settings) {
  std::map<PieceId, PieceId> seconds;
  std::set<PieceId> paired;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      const SheetPiece &first = pieces[i], &second = pieces[j];
      const PieceId one = first.piece->id, other = second.piece->id;
      if (first.strip || second.strip || paired.contains(one) || paired.contains(other)) continue;
      if (first.piece->mirrorOf != other && second.piece->mirrorOf != one) continue;
      if (!cutAlike(first, second, settings) || !isTurnedOver(second, first)) continue;
      seconds[other] = one;
      paired.insert({one, other});
    }
  return seconds;
}

}  // namespace karinui
