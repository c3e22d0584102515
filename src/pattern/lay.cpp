#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "border_plan.h"
#include "karinui/base/hash.h"
#include "karinui/pattern/lattice.h"
#include "karinui/pattern/pleats.h"
#include "kept_lattices.h"
#include "piece_lattice.h"
#include "words.h"

namespace karinui {
namespace {

// The nodes of one track in order, and which of them stands at each station.
struct TrackNodes {
  std::vector<Flat> place;
  std::vector<double> at;            // length along the track
  std::vector<std::size_t> station;  // node index of each station
  std::vector<std::size_t> stretch;  // of the segment that starts at each node
};

TrackNodes divide(const BorderPlan& plan, std::size_t t) {
  const Track& track = plan.tracks()[t];
  TrackNodes nodes;
  std::size_t edge = 0;
  for (std::size_t k = 0; k < track.station.size(); ++k) {
    const double from = track.station[k], to = k + 1 < track.station.size() ? track.station[k + 1] : track.whole();
    nodes.station.push_back(nodes.place.size());
    const std::size_t count = track.open() && k + 1 == track.station.size() ? 1 : plan.count(t, k);
    for (std::size_t n = 0; n < count; ++n) {
      const double at = from + (to - from) * static_cast<double>(n) / static_cast<double>(count);
      while (edge + 1 < track.outline->edges.size() && track.edgeStart[edge + 1] <= at + 5e-8) ++edge;
      const double own = at - track.edgeStart[edge];
      const Curve& curve = track.outline->edges[edge].curve;
      nodes.place.push_back(own < 1e-7 ? curve.start : curve.at(curve.parameterAt(own)));
      nodes.at.push_back(at);
      nodes.stretch.push_back(k);
    }
  }
  return nodes;
}

// The node indices of a track along one step of a walk, both ends included.
std::vector<std::size_t> along(const BorderPlan& plan, const std::vector<TrackNodes>& nodes, const Walk::Step& step) {
  const TrackNodes& track = nodes[step.track];
  const std::size_t count = plan.count(step.track, step.stretch), first = track.station[step.stretch];
  std::vector<std::size_t> run(count + 1);
  for (std::size_t n = 0; n <= count; ++n) run[n] = (first + n) % track.place.size();
  if (step.backwards) std::reverse(run.begin(), run.end());
  return run;
}

// The two banks of a slit stand on the very same places, to the last bit.
void alignBanks(const BorderPlan& plan, std::vector<TrackNodes>& nodes) {
  for (const auto& joined : plan.joined()) {
    if (joined.seam) continue;
    const Walk a = plan.walk(joined.a, false), b = plan.walk(joined.b, joined.reversed);
    for (std::size_t k = 0; k < a.steps.size(); ++k) {
      const auto runA = along(plan, nodes, a.steps[k]), runB = along(plan, nodes, b.steps[k]);
      for (std::size_t n = 0; n < runA.size(); ++n)
        nodes[b.steps[k].track].place[runB[n]] = nodes[a.steps[k].track].place[runA[n]];
    }
  }
}

class TieMaker {
 public:
  TieMaker(const BorderPlan& plan, const std::vector<TrackNodes>& nodes,
           const std::vector<std::vector<std::uint32_t>>& numbers)
      : plan_(plan), nodes_(nodes), numbers_(numbers) {}

  void sew(const BorderPlan::Joined& joined) {
    const Walk a = plan_.walk(joined.a, false), b = plan_.walk(joined.b, joined.reversed);
    seam_ = joined.seam;
    done_.clear();
    const std::size_t first = ties.size();
    for (std::size_t k = 0; k < a.stops.size(); ++k) {
      meet(a.stops[k], b.stops[k]);
      if (k + 1 == a.stops.size()) break;
      const auto runA = along(plan_, nodes_, a.steps[k]), runB = along(plan_, nodes_, b.steps[k]);
      const std::size_t trackA = a.steps[k].track, trackB = b.steps[k].track;
      if (joined.doubled == 0)
        for (std::size_t n = 1; n + 1 < runA.size(); ++n) tie(trackA, runA[n], trackB, runB[n]);
      else if (joined.doubled < 0)
        gather(trackA, runA, trackB, runB);
      else
        gather(trackB, runB, trackA, runA);
    }
    const Track &own = plan_.tracks()[joined.a.front().track], &other = plan_.tracks()[joined.b.front().track];
    if (ties.size() < first + 2 || !own.open() || !other.open() || own.piece != other.piece) return;
    besideEnds_.push_back({first, first + 1}), besideEnds_.push_back({ties.size() - 1, ties.size() - 2});
  }

  // Where a pleat is sewn down from the edge it is sewn into, the lines of both seams meet in a corner. Were the first
  // cell of the corner held by both, its triangle would be one in all three layers, and the middle layer, divided
  // otherwise, could not lie between the outer two. So the seam that holds the fold begins one node farther on.
  void freeCornersOfPleats(const Pattern& pattern) {
    std::set<std::pair<PieceId, std::uint32_t>> pleated;
    for (const SeamTie& tie : ties)
      if (pattern.seams.at(tie.seam).tie == Seam::Tie::Pleat)
        pleated.insert({tie.pieceA, tie.a}), pleated.insert({tie.pieceB, tie.b});
    std::set<std::size_t> freed;
    for (const auto& [end, beside] : besideEnds_)
      if (pleated.contains({ties[end].pieceA, ties[end].a})) freed.insert(beside);
    for (auto at = freed.rbegin(); at != freed.rend(); ++at)
      ties.erase(ties.begin() + static_cast<std::ptrdiff_t>(*at));
  }

  // Where what is turned back is faced, facing and piece go round the fold together, the one outside the other. Held
  // where the fold runs out at their seam, the outer of two layers as long as each other could not pass round the
  // inner.
  void freeEndsOfFolds(const Pattern& pattern, const LaidPattern& laid) {
    constexpr double kTurnedBack = 2.6;  // radians: 150 degrees
    constexpr double kFree = 1.2;        // spacings
    constexpr double kSameEnd = 1e-3;    // metres
    std::map<PieceId, std::vector<Flat>> ends;
    for (const auto& [id, piece] : pattern.pieces)
      for (const InternalLine& line : piece->lines)
        if (line.crease && std::abs(line.crease->angle) > kTurnedBack && !line.curves.empty())
          ends[id].insert(ends[id].end(), {line.curves.front().start, line.curves.back().end});
    for (const PaperPleat& pleat : pleatsOf(pattern))  // these are held in their own layers
      for (const Flat own : {pleat.fold, pleat.inner, pleat.place})
        std::erase_if(ends[pleat.piece], [&](Flat end) { return distance(end, own) < kSameEnd; });
    const auto atFold = [&](PieceId id, std::uint32_t node) {
      const auto own = ends.find(id);
      return own != ends.end() && std::any_of(own->second.begin(), own->second.end(), [&](Flat end) {
               return distance(laid.lattices.at(id)->nodes[node], end) < kFree * laid.spacing;
             });
    };
    std::erase_if(ties, [&](const SeamTie& tie) {
      return tie.pieceA != tie.pieceB && pattern.seams.at(tie.seam).tie == Seam::Tie::Pleat &&
             (atFold(tie.pieceA, tie.a) || atFold(tie.pieceB, tie.b));
    });
  }

  std::vector<SeamTie> ties;

 private:
  std::uint32_t node(std::size_t track, std::size_t k) const { return numbers_[track][k]; }

  void tie(std::size_t trackA, std::size_t a, std::size_t trackB, std::size_t b, std::size_t c = kNoNode) {
    SeamTie made{seam_,
                 plan_.tracks()[trackA].piece,
                 plan_.tracks()[trackB].piece,
                 node(trackA, a),
                 node(trackB, b),
                 c == kNoNode ? kNoNode : node(trackB, c)};
    if (made.pieceA == made.pieceB && made.a == made.b) return;  // the tip of a dart
    if (!done_.insert({made.pieceA, made.a, made.pieceB, made.b}).second) return;
    if (done_.contains({made.pieceB, made.b, made.pieceA, made.a})) return;
    ties.push_back(made);
  }

  // Stops stand at one station, or at two where the run goes over from piece to piece.
  void meet(const Walk::Stop& a, const Walk::Stop& b) {
    const std::size_t most = std::max(a.stations.size(), b.stations.size());
    for (std::size_t k = 0; k < most; ++k) {
      const auto& [trackA, stationA] = a.stations[std::min(k, a.stations.size() - 1)];
      const auto& [trackB, stationB] = b.stations[std::min(k, b.stations.size() - 1)];
      tie(trackA, nodes_[trackA].station[stationA], trackB, nodes_[trackB].station[stationB]);
    }
  }

  // Two to one within a stretch: every inner node of the shorter side takes a folded pair of the longer; the pairs are
  // disjoint and lie symmetrically about the stretch's middle.
  void gather(std::size_t trackS, const std::vector<std::size_t>& shorter, std::size_t trackL,
              const std::vector<std::size_t>& longer) {
    const std::size_t n = shorter.size() - 1;
    for (std::size_t k = 1; k < n; ++k) {
      const std::size_t b = 2 * k < n ? 2 * k - 1 : 2 * k > n ? 2 * k : 2 * k - 1;
      const std::size_t c = 2 * k < n ? 2 * k : 2 * k + 1;
      tie(trackS, shorter[k], trackL, longer[b], longer[c]);
    }
  }

  const BorderPlan& plan_;
  const std::vector<TrackNodes>& nodes_;
  const std::vector<std::vector<std::uint32_t>>& numbers_;  // in the lattice, of each track's nodes
  SeamId seam_;
  std::vector<std::array<std::size_t, 2>>
      besideEnds_;  // of lines sewn to lines of their piece: the tie at an end, that beside it
  std::set<std::tuple<PieceId, std::uint32_t, PieceId, std::uint32_t>> done_;
};

void fillEdges(Lattice& lattice, const Track& track, const TrackNodes& nodes, std::uint32_t first) {
  const std::size_t count = nodes.place.size();
  for (std::size_t k = 0; k < track.outline->edges.size(); ++k) {
    const double from = track.corner[k], to = track.corner[k + 1];
    Lattice::EdgeNodes edge;
    edge.hole = track.hole;
    if (from == to) {  // too short for the lattice: both its ends are one node
      const auto at = std::lower_bound(nodes.at.begin(), nodes.at.end(), from - 5e-8) - nodes.at.begin();
      edge.first = static_cast<std::size_t>(at) % count;
      edge.nodes.assign(2, first + static_cast<std::uint32_t>(edge.first));
      edge.fraction = {0, 1};
      edge.count = 1;
      lattice.edges[track.outline->edges[k].name] = std::move(edge);
      continue;
    }
    edge.first =
        static_cast<std::size_t>(std::lower_bound(nodes.at.begin(), nodes.at.end(), from - 5e-8) - nodes.at.begin());
    for (std::size_t n = edge.first;; ++n) {
      const double at = n < count ? nodes.at[n] : track.whole();
      if (at > to + 5e-8) break;
      edge.nodes.push_back(first + static_cast<std::uint32_t>(n % count));
      edge.fraction.push_back(std::clamp((at - from) / (to - from), 0.0, 1.0));
      if (n >= count) break;
    }
    edge.fraction.front() = 0;
    edge.fraction.back() = 1;
    edge.count = edge.nodes.size() - 1;
    lattice.edges[track.outline->edges[k].name] = std::move(edge);
  }
}

void fillLine(Lattice& lattice, const Track& track, const TrackNodes& nodes,
              const std::vector<std::uint32_t>& numbers) {
  Lattice::EdgeNodes line;
  line.hole = track.hole, line.nodes = numbers, line.count = numbers.size() - 1;
  for (const double at : nodes.at) line.fraction.push_back(std::min(1.0, at / track.whole()));
  lattice.edges[track.outline->edges.front().name] = std::move(line);
}

// The nodes of a line: those at its ends may be another's.
void addLine(BorderNodes& border, const TrackNodes& nodes) {
  constexpr double kOne = 1.5e-4;  // metres
  std::vector<Flat> places = border.outline;
  for (const auto& hole : border.holes) places.insert(places.end(), hole.begin(), hole.end());
  places.insert(places.end(), border.inner.begin(), border.inner.end());
  auto& line = border.lines.emplace_back();
  for (std::size_t n = 0; n < nodes.place.size(); ++n) {
    const bool end = n == 0 || n + 1 == nodes.place.size();
    const auto same =
        std::find_if(places.begin(), places.end(), [&](Flat p) { return end && distance(p, nodes.place[n]) < kOne; });
    line.push_back(static_cast<std::uint32_t>(same - places.begin()));
    if (same != places.end()) continue;
    border.inner.push_back(nodes.place[n]);
    places.push_back(nodes.place[n]);
  }
}

// All that a piece's lattice is made from.
std::string contentOf(std::span<const Track> tracks, std::span<const TrackNodes> nodes, Flat centre, Flat grain,
                      double spacing) {
  Hasher content;
  content.add(spacing).bytes(&grain, sizeof grain).bytes(&centre, sizeof centre);
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    content.add(std::span<const Flat>(nodes[k].place)).add(std::span<const double>(nodes[k].at));
    content.add(std::span<const double>(tracks[k].edgeStart)).add(std::uint64_t{tracks[k].hole});
    for (const Edge& edge : tracks[k].outline->edges) content.add(edge.name);
    if (tracks[k].open()) content.add(std::string_view("line"));
  }
  return content.hex();
}

// Whether a lattice's last nodes are these of the outline and the holes: names may be alike by malice.
bool endsOn(const Lattice& lattice, const BorderNodes& border) {
  std::vector<Flat> wanted = border.outline;
  for (const auto& hole : border.holes) wanted.insert(wanted.end(), hole.begin(), hole.end());
  wanted.insert(wanted.end(), border.inner.begin(), border.inner.end());
  return wanted.size() <= lattice.nodes.size() && std::equal(wanted.rbegin(), wanted.rend(), lattice.nodes.rbegin());
}

// Makes all lattices, or says which stretches must be divided more finely first.
Result<LaidPattern> tryLay(const Pattern& pattern, const BorderPlan& plan, double spacing,
                           std::set<std::array<std::size_t, 2>>& tooCoarse) {
  const auto& tracks = plan.tracks();
  std::vector<TrackNodes> nodes;
  for (std::size_t t = 0; t < tracks.size(); ++t) nodes.push_back(divide(plan, t));
  alignBanks(plan, nodes);
  LaidPattern laid{spacing, {}, {}};
  std::vector<std::vector<std::uint32_t>> numbers(tracks.size());
  std::optional<Error> trouble;
  for (std::size_t t = 0; t < tracks.size();) {
    const Piece& piece = *pattern.pieces.at(tracks[t].piece);
    std::size_t end = t;
    BorderNodes border;
    std::vector<std::array<std::size_t, 2>> stretchOf;  // of every segment, as a clash counts them
    for (; end < tracks.size() && tracks[end].piece == tracks[t].piece; ++end) {
      if (tracks[end].open()) {
        addLine(border, nodes[end]);
        for (std::size_t k = 0; k + 1 < nodes[end].place.size(); ++k)
          stretchOf.insert(stretchOf.end(), 2, {end, nodes[end].stretch[k]});
        continue;
      }
      (end == t ? border.outline : border.holes.emplace_back()) = nodes[end].place;
      for (std::size_t k : nodes[end].stretch) stretchOf.push_back({end, k});
    }
    const Flat grain = normalized(piece.grain), centre = centreOf(piece.outline.flattened(1e-4), grain);
    const std::span own(tracks.data() + t, end - t);
    const std::string name = contentOf(own, std::span(nodes.data() + t, own.size()), centre, grain, spacing);
    const auto numberAsNodes = [&](std::size_t nodesInAll) {
      std::size_t onBorder = border.inner.size();
      for (std::size_t k = t; k < end; ++k) onBorder += tracks[k].open() ? 0 : nodes[k].place.size();
      const auto base = static_cast<std::uint32_t>(nodesInAll - onBorder);
      std::uint32_t first = base;
      for (std::size_t k = t, line = 0; k < end; ++k) {
        numbers[k].resize(nodes[k].place.size());
        if (tracks[k].open()) {
          for (std::size_t n = 0; n < numbers[k].size(); ++n) numbers[k][n] = base + border.lines[line][n];
          ++line;
          continue;
        }
        std::iota(numbers[k].begin(), numbers[k].end(), first);
        first += static_cast<std::uint32_t>(numbers[k].size());
      }
    };
    if (auto before = keptLattices().find(name); before && endsOn(*before, border)) {
      numberAsNodes(before->nodes.size());
      laid.lattices[piece.id] = std::move(before);
      t = end;
      continue;
    }
    std::optional<std::array<std::size_t, 2>> clash;
    auto lattice = latticeOf(border, centre, grain, spacing, &clash);
    if (!lattice) {
      if (!trouble)
        trouble = badInput(
            say("Piece {0} cannot be laid as cloth: its outline comes too near itself; keep its edges apart. ({1})",
                piece.name, lattice.error().what));
      if (clash) {
        for (std::size_t k : *clash)
          if (k < stretchOf.size()) tooCoarse.insert(stretchOf[k]);
      } else {  // so coarse that it has turned inside out
        tooCoarse.insert(stretchOf.begin(), stretchOf.end());
      }
    } else {
      numberAsNodes(lattice->nodes.size());
      for (std::size_t k = t; k < end; ++k) {
        if (tracks[k].open()) {
          fillLine(*lattice, tracks[k], nodes[k], numbers[k]);
          continue;
        }
        const std::uint32_t first = numbers[k].front();
        fillEdges(*lattice, tracks[k], nodes[k], first);
        if (k == t) continue;
        auto& hole = lattice->holes.emplace_back();
        for (std::size_t n = nodes[k].place.size(); n-- > 0;) hole.push_back(first + static_cast<std::uint32_t>(n));
      }
      auto made = std::make_shared<const Lattice>(std::move(*lattice));
      keptLattices().keep(name, made);
      laid.lattices[piece.id] = std::move(made);
    }
    t = end;
  }
  if (trouble) return *trouble;
  TieMaker maker(plan, nodes, numbers);
  for (const auto& joined : plan.joined())
    if (joined.seam) maker.sew(joined);
  maker.freeCornersOfPleats(pattern);
  maker.freeEndsOfFolds(pattern, laid);
  laid.ties = std::move(maker.ties);
  return laid;
}

// How many places the grid under a piece has, the empty ones between its arms too.
double gridPlaces(const Piece& piece, double spacing) {
  const Flat warp = normalized(piece.grain);
  double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
  for (const Flat p : piece.outline.flattened(0.01))
    for (int axis = 0; axis < 2; ++axis) {
      const double along = axis == 0 ? dot(p, warp) : cross(p, warp);
      low[axis] = std::min(low[axis], along), high[axis] = std::max(high[axis], along);
    }
  return (high[0] - low[0]) * (high[1] - low[1]) / (spacing * spacing);
}

}  // namespace

Result<LaidPattern> lay(const Pattern& pattern, double spacing) {
  if (!(spacing >= 5e-4 && spacing <= 1))
    return badInput(say("A spacing of {0} mm is not usable; choose one between 0.5 mm and 1 m.", inMm(spacing)));
  constexpr double kMost = 4e6;         // nodes: a gigabyte or two of memory
  constexpr double kLargestGrid = 4e7;  // places of the grids under the pieces
  double together = 0, grids = 0;
  for (const auto& [id, piece] : pattern.pieces) {
    const double area = piece->outline.area();
    if (!(length(piece->grain) > 1e-9) || !finite(piece->grain))
      return badInput(say("The grain of piece {0} has no direction.", piece->name));
    together += area / (spacing * spacing);
    if (area / (spacing * spacing) > kMost)
      return refused(say("Piece {0} would need more than four million nodes at {1} mm; choose a wider spacing.",
                         piece->name, inMm(spacing)));
    grids += gridPlaces(*piece, spacing);
    if (grids > kLargestGrid)
      return refused(
          say("Piece {0} spreads too far for a spacing of {1} mm; choose a wider spacing, or turn the piece so that "
              "it lies along its grain.",
              piece->name, inMm(spacing)));
  }
  if (together > kMost)
    return refused(say("All pieces together would need more than four million nodes at {0} mm; choose a wider spacing.",
                       inMm(spacing)));
  auto plan = BorderPlan::plan(pattern, spacing);
  if (!plan) return plan.error();
  for (;;) {
    std::set<std::array<std::size_t, 2>> tooCoarse;
    auto laid = tryLay(pattern, *plan, spacing, tooCoarse);
    if (laid) return laid;
    bool finer = false;
    for (const auto& [track, stretch] : tooCoarse) finer |= plan->refine(track, stretch);
    if (!finer) return laid.error();
  }
}

}  // namespace karinui
