#include "karinui/pattern/fastening.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "karinui/pattern/markings.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

constexpr double kLeastZipped = 0.001;  // metres: a zip that is closed for less is open
constexpr double kBeside = 0.002;       // metres: so near to the end of a seam a zip ends just there

// The part of a run between two shares of its length, in the outlines' order.
std::vector<EdgeSpan> partOf(const Pattern& pattern, const std::vector<EdgeSpan>& run, double from, double to) {
  const double whole = length(pattern, run);
  std::vector<EdgeSpan> part;
  double before = 0;
  for (const EdgeSpan& span : run) {
    const double own = length(pattern, {span}), first = std::max(0.0, from * whole - before),
                 last = std::min(own, to * whole - before);
    before += own;
    if (!(last - first > 1e-4)) continue;
    const auto share = [&](double at) { return std::lerp(span.from, span.to, at / own); };
    part.push_back({span.piece, span.edge, first > 0 ? share(first) : span.from, last < own ? share(last) : span.to});
  }
  return part;
}

bool isThere(const Pattern& pattern, const std::vector<EdgeSpan>& side) {
  return !side.empty() && std::all_of(side.begin(), side.end(), [&](const EdgeSpan& span) {
    return curveOf(pattern, span.piece, span.edge) && span.to > span.from;
  });
}

double millimetres(double metres) { return std::round(metres * 1e4) / 10; }

Message said(const Fastening& own, std::size_t count, double zip, bool over) {
  switch (own.kind) {
    case FasteningKind::Button:
      return over ? say("{0} {0|buttonhole|buttonholes} {1} mm", count, millimetres(own.size + kHoleLonger))
                  : say("{0} {0|button|buttons} {1} mm", count, millimetres(own.size));
    case FasteningKind::Snap:
      return say("{0} {0|snap|snaps} {1} mm", count, millimetres(own.size));
    case FasteningKind::Hook:
      return say("{0} {0|hook and eye|hooks and eyes}", count);
    case FasteningKind::Tie:
      return say("{0} {0|pair|pairs} of ties", count);
    case FasteningKind::Zip:
      break;
  }
  return say("zip {0} cm", std::round(zip * 1000) / 10);
}

}  // namespace

const FasteningTraits& traitsOf(FasteningKind kind) {
  using Kind = FasteningKind;
  static constexpr FasteningTraits kAll[] = {{Kind::Button, "buttons", true, true, true, false},
                                             {Kind::Snap, "snaps", true, true, false, false},
                                             {Kind::Hook, "hooks", true, false, false, false},
                                             {Kind::Tie, "ties", true, false, false, true},
                                             {Kind::Zip, "zip", false, false, false, false}};
  return *std::find_if(std::begin(kAll), std::end(kAll), [&](const FasteningTraits& one) { return one.kind == kind; });
}

bool sound(const Fastening& own) {
  const bool zip = own.kind == FasteningKind::Zip;
  const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
  return own.kind >= FasteningKind::Button && own.kind <= FasteningKind::Zip && !own.a.empty() && !own.b.empty() &&
         (zip ? own.at.size() == 2 && own.at[0] < own.at[1]
              : within(static_cast<double>(own.at.size()), 1, kMostFastened)) &&
         std::is_sorted(own.at.begin(), own.at.end()) &&
         std::all_of(own.at.begin(), own.at.end(), [&](double at) { return within(at, 0, 1); }) && own.closed >= 0 &&
         own.closed <= static_cast<int>(own.at.size()) && within(own.zipped, 0, 1) && within(own.inset, 0, 0.5) &&
         within(own.size, 0.001, 0.1) && within(own.gap, 0, 1);
}

std::vector<FastenedPlaces> placesOf(const Pattern& pattern, const Fastening& own) {
  const SeamSide a(pattern, own.a, false), b(pattern, own.b, own.reversed);
  std::vector<FastenedPlaces> all;
  const auto on = [&](const SeamSide& side, double share) -> std::optional<FasteningPlace> {
    const SeamPlace at = side.at(share);
    const auto place = sewnPlace(pattern, at);
    if (!place) return std::nullopt;
    return FasteningPlace{at.piece, place->place - place->outward * own.inset, place->outward};
  };
  const std::size_t n = own.at.size(),
                    closed = own.kind == FasteningKind::Zip ? 0 : static_cast<std::size_t>(own.closed);
  for (std::size_t k = 0; k < n; ++k) {
    const auto over = on(a, own.at[k]), under = on(b, own.at[k]);
    if (!over || !under) return {};
    all.push_back({*over, *under, (own.fromStart ? k : n - 1 - k) < closed});
  }
  return all;
}

double lengthOf(const Pattern& pattern, const Fastening& own) {
  return (own.at.back() - own.at.front()) * length(pattern, own.a);
}

std::optional<Seam> zipSeam(const Pattern& pattern, const Fastening& own) {
  if (own.kind != FasteningKind::Zip || own.zipped * lengthOf(pattern, own) < kLeastZipped) return std::nullopt;
  const double part = own.zipped * (own.at[1] - own.at[0]);
  const double from = own.fromStart ? own.at[1] - part : own.at[0], to = own.fromStart ? own.at[1] : own.at[0] + part;
  Seam seam;
  seam.reversed = own.reversed;
  seam.a = partOf(pattern, own.a, from, to);
  seam.b = own.reversed ? partOf(pattern, own.b, 1 - to, 1 - from) : partOf(pattern, own.b, from, to);
  if (seam.a.empty() || seam.b.empty()) return std::nullopt;
  return seam;
}

namespace {

// A seam keeps to its cloth when its edge is redrawn, a zip to its shares of the run: where both ended at one place,
// they may lie a hair apart afterwards. Cloth that is laid with a corner at either place has a sliver there, which
// tears.
void endBesideSeams(Seam& zip, const Pattern& pattern) {
  for (auto* side : {&zip.a, &zip.b})
    for (EdgeSpan& own : *side) {
      const double whole = length(pattern, {{own.piece, own.edge, 0, 1}});
      const auto meet = [&](double& end, double other) {
        if (std::fabs(end - other) * whole < kBeside) end = other;
      };
      for (const auto& [id, seam] : pattern.seams)
        for (const auto* sewn : {&seam.a, &seam.b})
          for (const EdgeSpan& beside : *sewn) {
            if (beside.piece != own.piece || beside.edge != own.edge) continue;
            meet(own.from, beside.to), meet(own.to, beside.from);
          }
    }
}

}  // namespace

SeamId zipId(std::size_t number) { return {~std::uint64_t{0} - number}; }

Pattern withZips(Pattern pattern, const Fastenings& fastenings) {
  std::size_t number = 0;
  for (const auto& [name, own] : fastenings) {
    const SeamId id = zipId(number++);
    auto seam = zipSeam(pattern, own);
    if (!seam) continue;
    seam->id = id, seam->name = name;
    endBesideSeams(*seam, pattern);
    pattern.seams[id] = *std::move(seam);
  }
  return pattern;
}

void updateFastenings(Fastenings& fastenings, const EdgeMap& map, const Pattern& now) {
  for (auto& [name, own] : fastenings) own.a = ledOver(own.a, map), own.b = ledOver(own.b, map);
  std::erase_if(fastenings,
                [&](const auto& own) { return !isThere(now, own.second.a) || !isThere(now, own.second.b); });
}

Message fastenedSaid(const Pattern& pattern, const Fastening& own, bool over) {
  return said(own, own.at.size(), lengthOf(pattern, own), over);
}

std::vector<Message> notionsSaid(const Pattern& pattern, const Fastenings& fastenings) {
  std::map<std::tuple<FasteningKind, double, double>, std::pair<Fastening, std::size_t>> alike;
  for (const auto& [name, own] : fastenings) {
    const bool zip = own.kind == FasteningKind::Zip;
    auto& found = alike[{own.kind, zip ? 0 : own.size, zip ? lengthOf(pattern, own) : 0}];
    found.first = own, found.second += own.at.size();
  }
  std::vector<Message> words;
  for (const auto& [what, found] : alike)
    for (std::size_t k = 0; k < (std::get<0>(what) == FasteningKind::Zip ? found.second / 2 : 1); ++k)
      words.push_back(said(found.first, found.second, std::get<2>(what), false));
  return words;
}

}  // namespace karinui
