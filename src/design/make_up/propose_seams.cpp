// The seams of a garment whose pieces are known. Each kind of seam is looked for where clothes have it, and judged by
// how well the two sides' lengths agree.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "karinui/base/number.h"
#include "karinui/design/sewing.h"
#include "karinui/geometry/polygon.h"
#include "piece_shape.h"

namespace karinui {

namespace {

using Side = PieceReading::Side;
constexpr double kClose = 1e-3;        // metres: what is shorter of a part of an edge is left out
constexpr double kNotchMiss = 0.003;   // metres between notches that meet, beside the seam's ease
constexpr double kNotchTells = 0.5;    // of the doubt that is left many meeting notches take away at most this share
constexpr double kWidestStand = 0.12;  // metres from a front's edge to its centre line
constexpr double kAlongCentre = 0.7;   // of the centre's length: a line along it that long tells a button stand
constexpr double kStandMiss = 0.005;   // metres that what is left of the neck beside a stand may miss its length by

class Proposing {
 public:
  Proposing(const Document& document, const PieceReadings& readings) : document_(document), readings_(readings) {
    for (const auto& [id, seam] : document.pattern.seams)
      for (const auto* side : {&seam.a, &seam.b})
        for (const EdgeSpan& span : *side) used_.insert({span.piece, span.edge});
  }

  std::vector<SeamProposal> all() {
    darts();
    for (const Side side : {Side::Left, Side::Right}) {
      const std::string name = side == Side::Left ? "_left" : "_right";
      const PieceId front = piece(PieceRole::Front, side), back = piece(PieceRole::Back, side),
                    yoke = piece(PieceRole::Yoke, Side::Both);
      propose("shoulder" + name, at(front, PiecePart::ShoulderPlus, side),
              at(yoke ? yoke : back, PiecePart::ShoulderPlus, side), 0.12, say("shoulder"));
      propose("side" + name, at(front, PiecePart::SidePlus, side), at(back, PiecePart::SidePlus, side), 0.12,
              say("side seam"));
    }
    if (const PieceId yoke = piece(PieceRole::Yoke, Side::Both), back = piece(PieceRole::Back, Side::Both);
        yoke && back)
      propose("yoke", run(back, PiecePart::Top), run(yoke, PiecePart::Hem), 0.3, say("back and yoke"));
    centre("centre_front", PieceRole::Front), centre("centre_back", PieceRole::Back);
    for (const Side side : {Side::Left, Side::Right}) sleeve(side);
    for (const Side side : {Side::Left, Side::Right}) leg(side);
    crotches();
    for (const Side side : {Side::Left, Side::Right}) {
      const PieceId front = piece(PieceRole::SkirtFront, side), back = piece(PieceRole::SkirtBack, side);
      propose(std::string("skirt_side") + (side == Side::Left ? "_left" : "_right"),
              at(front, PiecePart::SidePlus, side), at(back, PiecePart::SidePlus, side), 0.12, say("side seam"));
    }
    centre("skirt_centre_front", PieceRole::SkirtFront), centre("skirt_centre_back", PieceRole::SkirtBack);
    waist(), neck();
    alike();
    return std::move(out_);
  }

 private:
  using Run = std::vector<EdgeRef>;

  const PieceReading* reading(PieceId id) const {
    const auto found = readings_.find(id);
    return found == readings_.end() ? nullptr : &found->second;
  }
  // The one piece of a role that has that side; none where there are several.
  PieceId piece(PieceRole role, Side side) const {
    PieceId one;
    std::size_t count = 0;
    for (const auto& [id, read] : readings_)
      if (read.role == role && (read.side == side || read.side == Side::Both || (side == Side::Both)))
        one = id, ++count;
    return count == 1 ? one : PieceId{};
  }
  Run run(PieceId id, PiecePart part) const {
    Run out;
    const PieceReading* read = reading(id);
    if (!read) return out;
    const auto found = read->parts.find(part);
    if (found == read->parts.end()) return out;
    for (const std::string& edge : found->second.edges) out.push_back({PieceRef(id), edge});
    return out;
  }
  // The part that lies on a side of the body: of fronts the wearer's left is at plus, of backs at minus.
  static PiecePart sided(PiecePart plus, bool isPlus) {
    if (isPlus) return plus;
    switch (plus) {
      case PiecePart::SidePlus:
        return PiecePart::SideMinus;
      case PiecePart::ArmholePlus:
        return PiecePart::ArmholeMinus;
      case PiecePart::ShoulderPlus:
        return PiecePart::ShoulderMinus;
      default:
        return PiecePart::CrotchMinus;
    }
  }
  Run at(PieceId id, PiecePart plus, Side side) const {
    const PieceReading* read = reading(id);
    if (!read) return {};
    const bool back =
        read->role == PieceRole::Back || read->role == PieceRole::Yoke || read->role == PieceRole::SkirtBack;
    return run(id, sided(plus, (side == Side::Left) != back));
  }
  double lengthOf(const Run& side) const { return side.empty() ? 0 : karinui::lengthOf(document_, side); }
  bool free(const Run& side) const {
    return !side.empty() && std::none_of(side.begin(), side.end(), [&](const EdgeRef& edge) {
      return used_.contains({edge.piece.id, edge.edge}) && edge.from == 0 && edge.to == 1;
    });
  }
  static Run joined(std::initializer_list<Run> runs) {
    Run all;
    for (const Run& one : runs) {
      if (one.empty()) return {};
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  }

  // Distances of a run's notches from where it begins.
  std::vector<double> notchesOn(const Run& side, bool ends = false) const {
    std::vector<double> all;
    double before = 0;
    for (const EdgeRef& edge : side) {
      const Piece* piece = document_.find(edge.piece.id);
      const double own = karinui::lengthOf(document_, {edge}), whole = own / (edge.to - edge.from);
      if (piece)
        for (const double at : notchesAlong(*piece, {edge.edge}, true))
          if (at >= edge.from * whole && at <= edge.to * whole) all.push_back(before + at - edge.from * whole);
      before += own;
    }
    if (!ends) std::erase_if(all, [&](double at) { return at < kAtEnd || at > before - kAtEnd; });
    std::sort(all.begin(), all.end());
    return all;
  }
  // How many of two sides' notches sit at the same distances, walked as they are sewn; none where one does not.
  std::size_t notchesThatMeet(const Run& a, const Run& b) const {
    std::vector<double> few = notchesOn(a), many = notchesOn(b);
    const double lb = lengthOf(b), ease = std::abs(lengthOf(a) - lb);
    for (double& at : many) at = lb - at;
    if (many.size() < few.size()) std::swap(few, many);
    const bool all = std::all_of(few.begin(), few.end(), [&](double at) {
      return std::any_of(many.begin(), many.end(),
                         [&](double theirs) { return std::abs(theirs - at) < kNotchMiss + ease; });
    });
    return all ? few.size() : 0;
  }

  // `slack`: by which share of the longer side the sides may differ and still be sure.
  void propose(const std::string& name, const Run& a, const Run& b, double slack, const Message& what,
               double atMost = 0.97) {
    if (!free(a) || !free(b)) return;
    const double la = lengthOf(a), lb = lengthOf(b), longer = std::max(la, lb);
    const double off = std::abs(la - lb) / longer;
    SeamProposal one;
    one.sew.a = a, one.sew.b = b;
    one.sew.name = freeName(name);
    one.sew.reversed = Choice::Yes;
    one.sew.tie = off > 0.33 ? SewEdges::Tie::TwoToOne : SewEdges::Tie::OneToOne;
    double known = 1;
    for (const Run* side : {&a, &b})
      for (const EdgeRef& edge : *side)
        if (const PieceReading* read = reading(edge.piece.id)) known = std::min(known, read->sure);
    one.sure = atMost * std::max(0.0, 1 - 0.27 * off / slack) * std::min(1.0, 0.7 + 0.5 * known);
    one.reason = say("{0}: {1} mm and {2} mm", what, fixed(la * 1000, 0), fixed(lb * 1000, 0));
    if (const std::size_t met = notchesThatMeet(a, b); met > 0) {
      one.sure += kNotchTells * (atMost - one.sure) * (1 - 1 / static_cast<double>(1 + met));
      one.reason = say("{0}; {1} {1|notch meets|notches meet}", one.reason, met);
    }
    if (one.sure >= kSureSeam)
      for (const Run* side : {&a, &b})
        for (const EdgeRef& edge : *side) used_.insert({edge.piece.id, edge.edge});
    out_.push_back(std::move(one));
  }
  std::string freeName(const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; names_.contains(name) || std::any_of(document_.pattern.seams.begin(), document_.pattern.seams.end(),
                                                         [&](const auto& one) { return one.second.name == name; });
         ++n)
      name = wanted + "_" + std::to_string(n);
    names_.insert(name);
    return name;
  }

  void darts() {
    for (const auto& [id, read] : readings_)
      for (const auto& legs : read.darts)
        propose("dart", {{PieceRef(id), legs[0]}}, {{PieceRef(id), legs[1]}}, 0.1, say("dart"));
  }

  void centre(const std::string& name, PieceRole role) {
    const PieceId left = piece(role, Side::Left), right = piece(role, Side::Right);
    if (!left || !right || left == right) return;
    if (role == PieceRole::Front && frontOpens())
      return propose(name, run(left, PiecePart::Centre), run(right, PiecePart::Centre), 0.06,
                     say("centre front, which has a button stand and stays open"), 0.3);
    propose(name, run(left, PiecePart::Centre), run(right, PiecePart::Centre), 0.06,
            role == PieceRole::Front ? say("centre front, closed edge to edge") : say("centre seam"), 0.9);
  }

  // Whether two fronts are buttoned over each other: a line inside along the centre's edge, where the front is folded
  // or buttoned, or a row of holes.
  bool hasButtonStand(PieceId id) const {
    const Piece* piece = document_.find(id);
    const PieceReading* read = reading(id);
    const auto centre = read ? read->parts.find(PiecePart::Centre) : std::map<PiecePart, EdgeRun>::const_iterator();
    if (!piece || !read || centre == read->parts.end()) return false;
    Ring line;
    for (const std::string& edge : centre->second.edges)
      for (const Flat p : findEdge(*piece, edge)->curve.flattened(1e-4)) line.push_back(p);
    const auto off = [&](Flat p) {
      double nearest = 1e9;
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        nearest = std::min(nearest, distanceToSegment(line[i], line[i + 1], p));
      return nearest;
    };
    const auto along = [&](double first, double second) {
      return first > 0.005 && first < kWidestStand && std::abs(first - second) < 0.005;
    };
    for (const InternalLine& inner : piece->lines) {
      const Flat from = inner.curves.front().start, to = inner.curves.back().end;
      if (distance(from, to) > kAlongCentre * centre->second.length && along(off(from), off(to))) return true;
    }
    std::size_t holes = 0;
    double first = 0;
    for (const Mark& mark : piece->marks)
      if (mark.edge.empty()) {
        if (holes == 0) first = off(mark.place);
        holes += along(first, off(mark.place));
      }
    return holes >= 3;
  }
  bool frontOpens() const {
    const PieceId left = piece(PieceRole::Front, Side::Left), right = piece(PieceRole::Front, Side::Right);
    return left && right && left != right &&
           (piece(PieceRole::CollarStand, Side::Both) || hasButtonStand(left) || hasButtonStand(right));
  }

  void sleeve(Side side) {
    const std::string name = side == Side::Left ? "_left" : "_right";
    const PieceId one = piece(PieceRole::Sleeve, side);
    if (!one) return;
    const Run front = at(piece(PieceRole::Front, side), PiecePart::ArmholePlus, side),
              back = at(piece(PieceRole::Back, side), PiecePart::ArmholePlus, side);
    const PieceId yoke = piece(PieceRole::Yoke, Side::Both);
    Run hole;
    if (yoke) {
      const Run above = at(yoke, PiecePart::ArmholePlus, side);
      hole = side == Side::Left ? joined({front, above, back}) : joined({back, above, front});
    } else {
      hole = side == Side::Left ? joined({front, back}) : joined({back, front});
    }
    propose("armhole" + name, run(one, PiecePart::Top), hole, 0.15, say("sleeve cap and armhole"));
    propose("underarm" + name, run(one, PiecePart::SidePlus), run(one, PiecePart::SideMinus), 0.06,
            say("sides of a sleeve"));
    const PieceId cuff = piece(PieceRole::Cuff, side);
    if (!cuff) return;
    propose("cuff" + name, run(cuff, PiecePart::Top), run(one, PiecePart::Hem), 0.4, say("cuff and sleeve"), 0.85);
    propose("cuff_ends" + name, run(cuff, PiecePart::SidePlus), run(cuff, PiecePart::SideMinus), 0.06,
            say("ends of a cuff"), 0.8);
  }

  // Where the crotch of a leg's front or back lies, and with it the inseam.
  bool inAtPlus(PieceId id) const { return reading(id)->parts.contains(PiecePart::CrotchPlus); }

  void leg(Side side) {
    const std::string name = side == Side::Left ? "_left" : "_right";
    const PieceId front = piece(PieceRole::LegFront, side), back = piece(PieceRole::LegBack, side);
    if (front && back) {
      const auto outer = [&](PieceId id) { return run(id, inAtPlus(id) ? PiecePart::SideMinus : PiecePart::SidePlus); };
      const auto inner = [&](PieceId id) { return run(id, inAtPlus(id) ? PiecePart::SidePlus : PiecePart::SideMinus); };
      propose("outseam" + name, outer(front), outer(back), 0.06, say("outseam"));
      propose("inseam" + name, inner(front), inner(back), 0.06, say("inseam"));
    }
    if (const PieceId whole = piece(PieceRole::Leg, side))
      propose("inseam" + name, run(whole, PiecePart::SidePlus), run(whole, PiecePart::SideMinus), 0.06, say("inseam"));
  }

  void crotches() {
    for (const auto& [role, name] :
         {std::pair{PieceRole::LegFront, "crotch_front"}, {PieceRole::LegBack, "crotch_back"}}) {
      const PieceId left = piece(role, Side::Left), right = piece(role, Side::Right);
      if (!left || !right || left == right) continue;
      const auto crotch = [&](PieceId id) {
        return run(id, inAtPlus(id) ? PiecePart::CrotchPlus : PiecePart::CrotchMinus);
      };
      propose(name, crotch(left), crotch(right), 0.06, say("left and right leg"));
    }
    const PieceId left = piece(PieceRole::Leg, Side::Left), right = piece(PieceRole::Leg, Side::Right);
    if (!left || !right || left == right) return;
    propose("crotch_front", run(left, PiecePart::CrotchMinus), run(right, PiecePart::CrotchPlus), 0.06,
            say("left and right leg"));
    propose("crotch_back", run(left, PiecePart::CrotchPlus), run(right, PiecePart::CrotchMinus), 0.06,
            say("left and right leg"));
  }

  Run tops(std::initializer_list<std::pair<PieceRole, Side>> order) const {
    Run all;
    std::set<PieceId> seen;
    for (const auto& [role, side] : order) {
      const PieceId id = piece(role, side);
      if (!id) return {};
      if (!seen.insert(id).second) continue;
      const Run one = run(id, PiecePart::Top);
      if (one.empty()) return {};
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  }

  // A band's edge that is sewn: the one whose length agrees better, or the lower one.
  PiecePart sewnEdge(PieceId band, double length) const {
    const double low = lengthOf(run(band, PiecePart::Hem)), top = lengthOf(run(band, PiecePart::Top));
    return std::abs(top - length) + 0.002 < std::abs(low - length) ? PiecePart::Top : PiecePart::Hem;
  }

  void waist() {
    const PieceId band = piece(PieceRole::Waistband, Side::Both);
    if (!band) return;
    Run around = tops({{PieceRole::LegFront, Side::Right},
                       {PieceRole::LegBack, Side::Right},
                       {PieceRole::LegBack, Side::Left},
                       {PieceRole::LegFront, Side::Left}});
    if (around.empty()) around = tops({{PieceRole::Leg, Side::Right}, {PieceRole::Leg, Side::Left}});
    if (around.empty())
      around = tops({{PieceRole::SkirtBack, Side::Left},
                     {PieceRole::SkirtFront, Side::Left},
                     {PieceRole::SkirtFront, Side::Right},
                     {PieceRole::SkirtBack, Side::Right}});
    if (around.empty()) return;
    const PiecePart edge = sewnEdge(band, lengthOf(around));
    propose("waistband", run(band, edge), around, 0.25, say("waistband and waist"));
    propose("waistband_ends", run(band, PiecePart::SidePlus), run(band, PiecePart::SideMinus), 0.06,
            say("ends of a waistband"), 0.85);
  }

  // Two parts of a run at a share of its length.
  std::pair<Run, Run> parted(const Run& whole, double share) const {
    std::pair<Run, Run> out;
    double left = lengthOf(whole) * share;
    for (const EdgeRef& edge : whole) {
      const double own = karinui::lengthOf(document_, {edge});
      if (left >= own - kClose) {
        out.first.push_back(edge);
      } else if (left <= kClose) {
        out.second.push_back(edge);
      } else {
        EdgeRef first = edge, second = edge;
        first.to = second.from = edge.from + (edge.to - edge.from) * left / own;
        out.first.push_back(first), out.second.push_back(second);
      }
      left -= own;
    }
    return out;
  }

  void neck() {
    const PieceId yoke = piece(PieceRole::Yoke, Side::Both);
    const auto part = [&](PieceRole role, Side side) { return run(piece(role, side), PiecePart::Neck); };
    const auto backNeck = [&]() -> Run {
      if (yoke) return run(yoke, PiecePart::Neck);
      if (const PieceId left = piece(PieceRole::Back, Side::Left); left && left == piece(PieceRole::Back, Side::Right))
        return run(left, PiecePart::Neck);
      return joined({part(PieceRole::Back, Side::Right), part(PieceRole::Back, Side::Left)});
    }();
    const PieceId left = piece(PieceRole::Front, Side::Left), right = piece(PieceRole::Front, Side::Right);
    if (!left || !right || backNeck.empty()) return;
    const bool whole = left == right;
    Run around;
    if (whole) {  // opened in the middle of the front
      const auto [first, second] = parted(run(left, PiecePart::Neck), 0.5);
      around = joined({second, backNeck, first});
    } else {
      around = joined({run(right, PiecePart::Neck), backNeck, run(left, PiecePart::Neck)});
    }
    if (around.empty()) return;
    const PieceId stand = piece(PieceRole::CollarStand, Side::Both), collar = piece(PieceRole::Collar, Side::Both);
    const PieceId first = stand ? stand : collar;
    if (!first) return;
    const PiecePart edge = run(first, PiecePart::SidePlus).empty() ? PiecePart::Hem : sewnEdge(first, lengthOf(around));
    if (!whole && frontOpens()) around = withoutFacings(around, run(left, PiecePart::Neck), run(first, edge));
    propose("neck", run(first, edge), around, 0.3, say("collar and neck"));
    if (whole && !stand && lengthOf(run(first, PiecePart::SidePlus)) < 0.045)  // a ribbed band closes to a ring
      propose("neck_ends", run(first, PiecePart::SidePlus), run(first, PiecePart::SideMinus), 0.06,
              say("ends of a band"), 0.8);
    if (!stand || !collar) return;
    const Run top = run(stand, edge == PiecePart::Hem ? PiecePart::Top : PiecePart::Hem);
    const double low = lengthOf(run(collar, PiecePart::Hem)), high = lengthOf(run(collar, PiecePart::Top));
    const Run between = underCollar(top, {low, high});
    propose("collar", run(collar, sewnEdge(collar, lengthOf(between))), between, 0.3, say("collar and its stand"));
  }

  // Of a run the part between two distances from its beginning.
  Run part(const Run& whole, double from, double to) const {
    const double length = lengthOf(whole);
    const Run first = to < length - kClose ? parted(whole, to / length).first : whole;
    return from > kClose ? parted(first, from / std::min(to, length)).second : first;
  }

  // The neck as far as a collar reaches where fronts are folded back or lie over each other at its ends: notches of the
  // fronts that meet those of the collar's ends, or else as much on either side. `around` begins at the right front's
  // edge and ends at the left one's, with the run `last`.
  Run withoutFacings(const Run& around, const Run& last, const Run& collar) const {
    const double neck = lengthOf(around), own = lengthOf(collar), excess = neck - own;
    if (excess < kStandMiss) return around;
    const auto near = [](const std::vector<double>& places, double length, bool back) {
      std::vector<double> all;
      for (const double at : places)
        if (const double from = back ? length - at : at; from < kWidestStand && from > kClose) all.push_back(from);
      return all;
    };
    const auto right = near(notchesOn(around, true), neck, false),
               left = near(notchesOn(last, true), lengthOf(last), true);
    auto start = near(notchesOn(collar, true), own, false), end = near(notchesOn(collar, true), own, true);
    start.push_back(0), end.push_back(0);
    double miss = kStandMiss, fromRight = excess / 2;
    for (const double r : right)
      for (const double l : left)
        for (const double s : start)
          for (const double e : end)
            if (const double off = std::abs(r - e + l - s - excess); off < miss && r >= e && l >= s)
              miss = off, fromRight = r - e + (excess - (r - e + l - s)) / 2;
    return part(around, fromRight, fromRight + own);
  }

  // The part of a stand's upper edge that a collar of one of these lengths is sewn to: between notches, or else in the
  // middle; all of it where it is no longer than the collar.
  Run underCollar(const Run& top, std::initializer_list<double> lengths) const {
    const double whole = lengthOf(top);
    const std::vector<double> notches = notchesOn(top, true);
    double least = kStandMiss;
    std::optional<std::pair<double, double>> best;
    for (const double from : notches)
      for (const double to : notches)
        for (const double length : lengths)
          if (const double off = std::abs(to - from - length); off < least) least = off, best = std::pair(from, to);
    const double longest = std::max(lengths);
    if (!best && longest < whole - kStandMiss) best = std::pair((whole - longest) / 2, (whole + longest) / 2);
    return best ? part(top, best->first, best->second) : top;
  }

  // Hems, necklines and waists, which are not sewn to each other; the edges of a front that is buttoned.
  bool hangsFree(const Run& edges) const {
    const PieceId piece = edges.front().piece.id;
    for (const PiecePart part : {PiecePart::Hem, PiecePart::Neck, PiecePart::Top, PiecePart::Centre})
      for (const EdgeRef& edge : run(piece, part))
        if (edge.edge == edges.front().edge) return true;
    return false;
  }
  // What is left: edges of one length that no third has. Never sure.
  void alike() {
    struct Left {
      Run run;
      double length;
      PieceId piece;
    };
    std::vector<Left> left;
    for (const auto& [id, piece] : document_.pattern.pieces) {
      const PieceReading* read = reading(id);
      if (read && read->role == PieceRole::Aside) continue;
      const Shape shape = shapeOf(*piece);
      for (const Shape::Run& one : shape.runs) {
        Run edges;
        for (const std::size_t k : one.edges) edges.push_back({PieceRef(id), piece->outline.edges[k].name});
        if (free(edges) && one.length > 0.03) left.push_back({edges, one.length, id});
      }
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
      std::vector<std::size_t> like, notched;
      for (std::size_t j = 0; j < left.size(); ++j) {
        if (j == i || std::abs(left[j].length - left[i].length) >= 0.004 * left[i].length) continue;
        like.push_back(j);
        if (notchesThatMeet(left[i].run, left[j].run) > 0) notched.push_back(j);
      }
      const bool told = notched.size() == 1;
      if (!told && like.size() != 1) continue;
      const Left& other = left[told ? notched[0] : like[0]];
      if (&other < &left[i] || other.piece == left[i].piece) continue;
      if (hangsFree(left[i].run) && hangsFree(other.run)) continue;
      propose("seam", left[i].run, other.run, 0.06,
              told ? say("edges of one length whose notches meet") : say("edges of one length that no other has"),
              told ? 0.6 : 0.5);
    }
  }

  const Document& document_;
  const PieceReadings& readings_;
  std::set<std::pair<PieceId, std::string>> used_;
  std::set<std::string> names_;
  std::vector<SeamProposal> out_;
};

}  // namespace

std::vector<SeamProposal> proposeSeams(const Document& document, const PieceReadings& readings) {
  return Proposing(document, readings).all();
}

}  // namespace karinui
