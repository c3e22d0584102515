#pragma once
// Snapping for lines drawn on the skin: corners and outlines of the pieces that are there already, the figure's
// landmarks, its lines, where they cross, and its middle. All of it is judged as it is seen, along the ray, so that
// cloth off the skin and lines at the silhouette are met from every view. Made once for each state of the garment; the
// session's thread.
#include <optional>
#include <vector>

#include "karinui/body/lines.h"
#include "session/stroke.h"

namespace karinui {

class DrawSnaps {
 public:
  struct Snap {
    SurfacePoint skin;
    Vec3 point;  // on the skin
    Vec3 seen;   // where the eye sees it: on the cloth, or the skin
    Message what;
    std::optional<BodyPoint> named;  // on one of the body's lines
    bool corner = false;             // a place, not a line to run along
  };
  void of(SnapshotPtr snapshot);
  // What the pointer snaps to: places before lines, outlines before lines of the body.
  // The body's lines count where they are shown, and where the depth is not certain.
  std::optional<Snap> near(const StrokeSample& sample, bool linesShown) const;

  // Which outline or line of the body each sample of a run follows, at least a hand's breadth of it, and where on it;
  // empty entries where none. A sample follows at most one.
  struct Followed {
    std::size_t curve = 0;
    double share = 0;  // of the curve's length
    Vec3 point;        // on the skin
  };
  std::vector<std::optional<Followed>> followed(std::span<const StrokeSample> run) const;
  Snap on(std::size_t curve, double share) const;
  Vec3 at(std::size_t curve, double share) const { return curves_[curve].line.at(share); }
  bool closed(std::size_t curve) const { return curves_[curve].line.closed; }
  double length(std::size_t curve) const { return curves_[curve].line.length; }
  double nearest(std::size_t curve, Vec3 place) const {
    double away = 0;
    return curves_[curve].line.nearest(place, away);
  }
  // Where the curve passes a place of the skin; nothing: beside it.
  std::optional<double> shareOf(std::size_t curve, Vec3 point) const;
  std::optional<std::size_t> lineThrough(Vec3 from, Vec3 to) const;  // a line of the body on which both lie
  const std::string& bodyLineOf(std::size_t curve) const { return curves_[curve].line.name; }  // empty: an outline

 private:
  struct Curve {
    BodyLine line;           // as it is seen; `name` is empty for an outline
    std::vector<Vec3> skin;  // beside each point of it; empty: the points themselves
    Message what;
    std::vector<bool> hidden;  // points in what is not drawn; may be empty
  };
  struct Place {
    Snap snap;
    bool cloth = false;
    bool crossing = false;  // of the body's lines: counts as they do
  };
  std::optional<Followed> onCurve(std::size_t curve, const StrokeSample& sample, double share, double& away) const;
  SnapshotPtr fitting_;
  BodyPtr crossedOf_;
  std::vector<LineCrossing> crossings_;
  std::vector<Place> places_;
  std::vector<Curve> curves_;
};

}  // namespace karinui
