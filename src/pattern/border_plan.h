#pragma once
// Where the nodes of all outlines go. Along each outline stand stations (corners, ends of seams, notches) that must be
// nodes; seams carry stations from side to side until both have the same ones; then stretches between stations that are
// sewn together share one count of segments (or have twice the other's).
#include <map>
#include <memory>
#include <vector>

#include "karinui/pattern/lattice.h"
#include "retrace.h"

namespace karinui {

// One closed curve of a piece: its outline (hole = 0) or its hole number hole - 1; behind these, open, the internal
// lines that something is sewn to, each a single edge with a station at its end.
struct Track {
  PieceId piece;
  std::size_t hole = 0;
  const Outline* outline = nullptr;
  std::vector<double> edgeStart;  // length from the first edge's start; edges + 1 of them
  // The station at which each edge starts, and the last one ends; edges + 1 of them. Not edgeStart where edges are too
  // short for a stretch of their own: a run of such edges has one station.
  std::vector<double> corner;
  std::vector<double> station;               // ascending, in [0, whole); stretch k runs from station k to the next
  std::shared_ptr<const Outline> line = {};  // of an open track: what `outline` points to
  bool open() const { return line != nullptr; }
  double whole() const { return edgeStart.back(); }
};

struct Leg {  // a part of a track, 0 <= from < to <= whole
  std::size_t track = 0;
  double from = 0, to = 0;
};

// A side of a seam, walked: stops at stations, and the stretch between each stop and the next. At a join of two pieces
// a stop stands at two stations.
struct Walk {
  struct Stop {
    double at = 0;                                     // metres walked
    std::vector<std::array<std::size_t, 2>> stations;  // track, station
  };
  struct Step {
    std::size_t track = 0, stretch = 0;
    bool backwards = false;
  };
  std::vector<Stop> stops;
  std::vector<Step> steps;  // one fewer
  double length() const { return stops.back().at; }
};

class BorderPlan {
 public:
  struct Joined {  // two runs divided alike
    SeamId seam;   // none: the banks of a slit
    std::vector<Leg> a, b;
    bool reversed = true;
    int doubled = 0;  // log2 of segments on a per segment on b: -1, 0, 1
    double snap = 0;  // stations of the two sides that are nearer than this count as the same
  };
  static Result<BorderPlan> plan(const Pattern& pattern, double spacing);

  const std::vector<Track>& tracks() const { return tracks_; }
  const std::vector<Joined>& joined() const { return joined_; }
  std::size_t count(std::size_t track, std::size_t stretch) const { return count_[offset_[track] + stretch]; }
  Walk walk(const std::vector<Leg>& side, bool backwards) const;
  // Divides a stretch, and all that is sewn to it, more finely. False: it is as fine as it gets.
  bool refine(std::size_t track, std::size_t stretch);

 private:
  Done gatherTracks(const Pattern& pattern);
  void gatherLines(const Pattern& pattern, const Piece& piece);
  void standOnTracks(std::size_t line);
  Done gatherSeams(const Pattern& pattern);
  Result<std::vector<Leg>> legs(const Pattern& pattern, const Seam& seam, const std::vector<EdgeSpan>& side) const;
  void addNotches(const Pattern& pattern);
  bool addStation(std::size_t track, double at, double apart);
  bool carryAcross(const Joined& joined);
  Done carryAll();
  Done count();

  double spacing_ = 0;
  std::vector<Track> tracks_;
  std::map<std::pair<PieceId, std::size_t>, std::size_t> trackOf_;
  std::vector<Joined> joined_;
  std::vector<std::size_t> offset_, root_, count_;  // per stretch: its class and its number of segments
  std::vector<int> finer_;                          // per class: times it was refined
  std::map<SeamId, std::string> seamName_;
  std::vector<std::pair<std::size_t, double>> lineEnds_;  // on which track, and where along it
};

}  // namespace karinui
