// A cut across darts: where the line leaves the cloth through one leg it goes on from the place of the other leg that
// is sewn to it, as if the dart were closed.
#include <algorithm>
#include <cmath>

#include "cut_along.h"
#include "karinui/pattern/seam_walk.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kSamePlace = 1e-6;  // metres

// The place of the dart's other side that is sewn to this one; nothing: the edge is not the dart's.
std::optional<Meeting> sewnTo(const Pattern& pattern, const Outline& hole, const Seam& seam, const Meeting& from) {
  const SeamSides sides(pattern, seam);
  const Edge& edge = hole.edges[from.on.edge];
  const double fraction = edge.curve.lengthTo(from.on.t) / edge.curve.length();
  for (const auto& [own, other] : {std::pair(&sides.a, &sides.b), std::pair(&sides.b, &sides.a)})
    for (std::size_t k = 0; k < own->spans().size(); ++k) {
      if (own->spans()[k].edge != edge.name) continue;
      const SeamPlace there = other->at(own->fractionOf(k, fraction));
      const auto index = hole.find(there.edge);
      if (!index) return std::nullopt;
      Meeting meeting = from;
      const Curve& curve = hole.edges[*index].curve;
      meeting.on = {*index, curve.parameterAt(there.fraction * curve.length())};
      meeting.place = curve.at(meeting.on.t);
      return meeting;
    }
  return std::nullopt;
}

struct Crossed {
  std::vector<HoleCrossing> holes;
  std::vector<SeamId> seams;
};

// The darts with two points that the stretch goes across, in its order.
Result<Crossed> doubleDartsAcross(const Pattern& pattern, const Piece& whole, const Piece& part,
                                  const Stretch& stretch) {
  std::vector<std::pair<HoleCrossing, SeamId>> found;
  for (const DoubleDart& dart : doubleDartsOf(pattern)) {
    if (dart.piece != whole.id) continue;
    const std::string& edge = whole.holes[dart.hole].edges.front().name;
    const auto hole = std::find_if(part.holes.begin(), part.holes.end(),
                                   [&](const Outline& own) { return own.find(edge).has_value(); });
    if (hole == part.holes.end()) continue;
    std::vector<Meeting> met;
    meetings(stretch.line, *hole, met);
    if (met.empty()) continue;
    std::stable_sort(met.begin(), met.end(), [](const Meeting& a, const Meeting& b) { return a.at < b.at; });
    met.erase(std::unique(met.begin(), met.end(),  // at a corner both edges are met
                          [](const Meeting& a, const Meeting& b) { return distance(a.place, b.place) < kSamePlace; }),
              met.end());
    const auto out = sewnTo(pattern, *hole, pattern.seams.at(dart.seam), met.front());
    const bool back = met.size() == 2 && out && stretch.start && stretch.end;
    const auto sideOf = [&](const Meeting& meeting) {
      const auto& a = pattern.seams.at(dart.seam).a;
      return std::any_of(a.begin(), a.end(),
                         [&](const EdgeSpan& span) { return span.edge == hole->edges[meeting.on.edge].name; });
    };
    if (!back || sideOf(met.front()) == sideOf(met.back()))
      return refused(say("The line goes into a dart at {0} mm and does not leave it by its other side; lead it across.",
                         inMm(met.front().place)));
    found.push_back(
        {{static_cast<std::size_t>(hole - part.holes.begin()), met.front().at, met.back().at, met.front(), *out},
         dart.seam});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first.enters < b.first.enters; });
  Crossed crossed;
  for (auto& [crossing, seam] : found) crossed.holes.push_back(crossing), crossed.seams.push_back(seam);
  return crossed;
}

// The piece cut along each of the stretches.
Result<CutAcross> cutStretches(const Pattern& pattern, const Piece& piece, const std::vector<Stretch>& stretches,
                               const std::vector<PaperDart>& darts, const std::function<NewPart(std::size_t)>& newPart,
                               const std::set<std::string>& sewnLines, const std::vector<bool>& keepLeft) {
  CutAcross all{{{piece}, {}}, {}, {}};
  std::size_t made = 0;
  for (std::size_t s = 0; s < stretches.size(); ++s) {
    const auto& places = stretches[s].line;
    // The part that it runs over: where its longest bit has its middle.
    std::size_t longest = 0;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      if (distance(places[k], places[k + 1]) > distance(places[longest], places[longest + 1])) longest = k;
    const Flat middle = lerp(places[longest], places[longest + 1], 0.5);
    const auto part = std::find_if(all.cut.pieces.begin(), all.cut.pieces.end(),
                                   [&](const Piece& own) { return contains(own.outline.flattened(1e-6), middle); });
    if (part == all.cut.pieces.end())
      return refused(say("The line does not run over piece {0}; draw it across the cloth.", piece.name));
    // On a part its ends are found anew; on the whole piece that would move them by some bits.
    auto stretch = s == 0 ? Result<std::vector<Stretch>>({stretches[0]}) : stretchesOver(*part, places, {});
    if (!stretch) return stretch.error();
    auto crossed = doubleDartsAcross(pattern, piece, *part, stretch->front());
    if (!crossed) return crossed.error();
    const NewPart fresh = newPart(made);
    std::optional<bool> keep;
    if (const std::size_t k = all.keptLeft.size(); k < keepLeft.size()) keep = keepLeft[k];
    auto cut =
        cutAlong(*part, std::move(stretch->front()), std::move(crossed->holes), fresh.id, fresh.name, sewnLines, keep);
    if (!cut) return cut.error();
    all.cut.edges = composed(all.cut.edges, cut->edges);
    *part = cut->pieces.front();
    if (cut->pieces.size() > 1) {
      all.keptLeft.push_back(cut->keptLeft);
      all.cut.pieces.push_back(std::move(cut->pieces.back()));
      ++made;
    }
    for (const SeamId seam : crossed->seams) all.darts.push_back({seam, true});
    if (s == 0) continue;
    // The dart between this stretch and the one before.
    const auto ends = [&](const PaperDart& dart) {
      const auto on = [&](const EdgePlace& place) { return place.edge == dart.to || place.edge == dart.back; };
      return on(*stretches[s - 1].end) && on(*stretches[s].start);
    };
    if (const auto dart = std::find_if(darts.begin(), darts.end(), ends); dart != darts.end())
      all.darts.push_back({dart->seam, false});
  }
  return all;
}

}  // namespace

Result<CutAcross> cutAcrossDarts(const Pattern& pattern, const Piece& piece, std::vector<Flat> line,
                                 const std::function<NewPart(std::size_t)>& newPart,
                                 const std::set<std::string>& sewnLines, const std::vector<bool>& keepLeft,
                                 bool toCorners) {
  std::vector<PaperDart> darts;
  for (const PaperDart& dart : dartsOf(pattern))
    if (dart.piece == piece.id) darts.push_back(dart);
  const auto stretches = stretchesOver(piece, std::move(line), darts);
  if (!stretches) return stretches.error();
  if (toCorners)
    if (auto led = *stretches; leadToCorners(piece.outline, led))
      if (auto cut = cutStretches(pattern, piece, led, darts, newPart, sewnLines, keepLeft)) return cut;
  return cutStretches(pattern, piece, *stretches, darts, newPart, sewnLines, keepLeft);
}

std::vector<Seam> dividedDart(Seam seam, bool turned) {
  // Of each side, as it is walked, the edges on one piece after the other.
  const auto groups = [](std::vector<EdgeSpan> side, bool against) {
    if (against) std::reverse(side.begin(), side.end());
    std::vector<std::vector<EdgeSpan>> all;
    for (EdgeSpan& span : side) {
      if (all.empty() || all.back().front().piece != span.piece) all.emplace_back();
      all.back().push_back(std::move(span));
    }
    if (against)
      for (auto& group : all) std::reverse(group.begin(), group.end());
    return all;
  };
  auto a = groups(seam.a, false), b = groups(seam.b, seam.reversed);
  if (a.size() != b.size()) return {std::move(seam)};
  std::vector<Seam> parts;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (turned) std::reverse(a[k].begin(), a[k].end()), std::reverse(b[k].begin(), b[k].end());
    parts.push_back(seam);
    parts.back().a = std::move(a[k]), parts.back().b = std::move(b[k]);
  }
  // What is still a dart keeps the seam's name.
  std::stable_sort(parts.begin(), parts.end(), [](const Seam& x, const Seam& y) {
    const auto isDart = [](const Seam& part) { return part.a.front().piece == part.b.front().piece; };
    return isDart(x) > isDart(y);
  });
  return parts;
}

}  // namespace karinui
