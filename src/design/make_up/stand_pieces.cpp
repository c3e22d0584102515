// Where the pieces of a garment stand before it is draped: fronts and backs wrapped round the trunk, sleeves round the
// arms, legs flat before and behind, bands round what they are sewn to.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "design/operations/limb.h"
#include "karinui/design/make_up.h"
#include "karinui/design/sewing.h"

namespace karinui {

namespace {

using Side = PieceReading::Side;
constexpr double kOff = 0.02;      // metres from the trunk
constexpr double kGap = 0.008;     // between pieces that stand beside each other on one cylinder
constexpr double kLap = 0.03;      // by which two fronts that are buttoned lie over each other,
constexpr double kLapOver = 0.02;  // and how far apart
constexpr double kAhead = 0.05;    // flat pieces from the body
constexpr double kCentre = 0.015;  // of a trouser leg's fork from the body's middle
constexpr double kAside = 0.9;     // to the side, for what nothing holds
constexpr int kWaist = 3;          // levels of the trunk (chartLevels)
constexpr double kNeck = 9.5;
constexpr double kNeckBase = 8.3;
constexpr double kTouches = 0.001;  // metres from the body: nearer is no place to begin

struct Box {
  Flat low{1e9, 1e9}, high{-1e9, -1e9};
  double width() const { return high.u - low.u; }
};

class StandingPieces {
 public:
  StandingPieces(const Document& document, const PieceReadings& readings, const Body& body, Context& context)
      : document_(document), readings_(readings), body_(body), context_(context) {}

  Result<std::vector<Operation>> all() {
    waist_ = heightOf({BodyPoint::Part::Torso, kWaist, 0, {}, {}}, 1.05);
    const auto neck = body_.landmarks().find("neck_left");
    neck_ = neck != body_.landmarks().end() ? neck->second.y : waist_ + 0.42;
    crotch_ = body_.landmarks().contains("crotch") ? body_.landmarks().at("crotch").y
                                                   : heightOf({BodyPoint::Part::Torso, 0, 0, {}, {}}, 0.78);
    for (const Vec3 p : body_.mesh().points) {
      if (p.y > waist_ + 0.1 || std::abs(p.x) > 0.3) continue;
      front_ = std::max(front_, p.z), back_ = std::min(back_, p.z);
    }
    trunk(), legs(), skirts(), sleeves(), bands(), rest();
    if (trouble_) return *trouble_;
    return std::move(out_);
  }

 private:
  const PieceReading& reading(PieceId id) const { return readings_.at(id); }
  const Piece& piece(PieceId id) const { return *document_.find(id); }
  std::vector<PieceId> of(std::initializer_list<PieceRole> roles) const {
    std::vector<PieceId> ids;
    for (const auto& [id, read] : readings_)
      if (std::find(roles.begin(), roles.end(), read.role) != roles.end() && document_.find(id) && held(id))
        ids.push_back(id);
    return ids;
  }
  bool held(PieceId id) const {
    for (const auto& [seam, one] : document_.pattern.seams)
      for (const auto* side : {&one.a, &one.b})
        for (const EdgeSpan& span : *side)
          if (span.piece == id && (one.a.front().piece != id || one.b.front().piece != id)) return true;
    return false;
  }
  double heightOf(const BodyPoint& at, double otherwise) const {
    const auto place = body_.find(at);
    return place ? karinui::at(body_.mesh(), *place).y : otherwise;
  }
  Box boxOf(PieceId id) const {
    Box box;
    for (Flat p : piece(id).outline.flattened(1e-3)) {
      p = reading(id).upright(p);
      box.low = {std::min(box.low.u, p.u), std::min(box.low.v, p.v)};
      box.high = {std::max(box.high.u, p.u), std::max(box.high.v, p.v)};
    }
    return box;
  }
  // Of a part of a piece, upright.
  Box boxOf(PieceId id, PiecePart part) const {
    Box box;
    const auto found = reading(id).parts.find(part);
    if (found == reading(id).parts.end()) return box;
    for (const std::string& edge : found->second.edges)
      for (Flat p : findEdge(piece(id), edge)->curve.flattened(1e-4)) {
        p = reading(id).upright(p);
        box.low = {std::min(box.low.u, p.u), std::min(box.low.v, p.v)};
        box.high = {std::max(box.high.u, p.u), std::max(box.high.v, p.v)};
      }
    return box;
  }
  bool has(PieceId id, PiecePart part) const { return reading(id).parts.contains(part); }
  Flat onPaper(PieceId id, Flat upright) const {
    const double c = std::cos(reading(id).turn), s = std::sin(reading(id).turn);
    return {c * upright.u + s * upright.v, -s * upright.u + c * upright.v};
  }

  // Takes an operation if it can be done, and knows the garment after it.
  bool perform(Operation operation, PieceId id) {
    auto next = apply(document_, operation, context_);
    if (!next) {
      if (next.error().kind == Error::Kind::Cancelled && !trouble_) trouble_ = next.error();
      return false;
    }
    document_ = *std::move(next);
    out_.push_back(std::move(operation));
    if (id) done_.insert(id);
    return true;
  }

  // A place to try for a piece: wrapped there, an upright place of its paper at a place of the body.
  struct Try {
    BodyPoint at;
    Flat upright;
    double ease = 0, turn = 0;
    bool taper = false;
  };
  PlacePiece wrapped(PieceId id, const Try& one) const {
    PlacePiece place;
    place.piece = PieceRef(id);
    place.at = one.at;
    place.point = onPaper(id, one.upright);
    place.ease = Length{one.ease};
    place.turn = Angle{reading(id).turn + one.turn};
    place.cone = Choice::No;
    place.taper = one.taper;
    if (!isLimb(one.at.part)) place.bothLegs = Choice::Yes;
    return place;
  }
  void wrap(PieceId id, BodyPoint at, Flat upright, double ease, double turn = 0) {
    perform(wrapped(id, {std::move(at), upright, ease, turn}), id);
  }
  // The first of several places where the piece stands clear of the body and of what stands already; else the one where
  // it meets least. Gives how much it meets there.
  std::size_t wrap(PieceId id, const std::vector<Try>& tries) {
    const Try* best = nullptr;
    std::size_t least = 0;
    for (const Try& one : tries) {
      const auto tried = apply(document_, wrapped(id, one), context_);
      if (!tried) continue;
      const std::size_t met = meetings(*tried, id);
      if (!best || met < least) best = &one, least = met;
      if (least == 0) break;
    }
    if (best) perform(wrapped(id, *best), id);
    return least;
  }
  // Places of a piece within the body, and crossings of its cloth with what stands.
  std::size_t meetings(const Document& document, PieceId id) const {
    const auto meshOf = [&](PieceId of) {
      TriangleMesh mesh;
      const Piece& one = *document.find(of);
      if (!one.form) return mesh;
      for (const Vec3 p : one.form->space) mesh.points.push_back(one.pose(p));
      mesh.faces = one.form->faces;
      return mesh;
    };
    const TriangleMesh own = meshOf(id);
    std::size_t met = 0;
    for (const Vec3 p : own.points) met += body_.bvh().signedDistance(p) < kTouches;
    for (const PieceId other : done_) {
      if (other == id) continue;
      TriangleMesh both = meshOf(other);
      const auto first = static_cast<std::uint32_t>(both.points.size());
      both.points.insert(both.points.end(), own.points.begin(), own.points.end());
      for (Triangle face : own.faces) {
        for (std::uint32_t& corner : face) corner += first;
        both.faces.push_back(face);
      }
      met += selfCrossings(both).size();
    }
    return met;
  }

  // The girth of the trunk that pieces between two heights must go round, as placing wraps them about a place there.
  double girth(double low, double high, const BodyPoint& about) const {
    LimbFrame limb;
    limb.origin = {0, waist_, front_};
    limb.up = {0, 1, 0}, limb.out = {0, 0, 1}, limb.right = cross(limb.up, limb.out);
    if (const auto place = body_.find(about)) limb.origin = karinui::at(body_.mesh(), *place);
    std::vector<Flat> all;
    for (const SkinPlace& p :
         levelsAround(body_, limb, {{-0.3, low - limb.origin.y}, {0.3, high - limb.origin.y}}, true))
      all.push_back(p.place);
    return all.size() < 3 ? 0.9 : perimeter(hull(std::move(all)));
  }
  // Pieces of that width in all stand with gaps between them.
  double easeFor(double girth, double width, std::size_t pieces, double least = kOff) const {
    return std::max(least, (width + kGap * static_cast<double>(pieces) * 2 - girth) / (2 * std::numbers::pi));
  }

  static BodyPoint onTrunk(bool back, double along = kWaist) {
    BodyPoint at;
    at.along = along, at.around = back ? 0.5 : 0;
    return at;
  }
  // Half of a front that is not sewn to the other half, but lies over or under it to be buttoned.
  bool lapped(PieceId id) const {
    if (reading(id).role != PieceRole::Front || reading(id).side == Side::Both) return false;
    const auto ids = of({PieceRole::Front});
    const auto other = std::find_if(ids.begin(), ids.end(), [&](PieceId one) {
      return reading(one).side != Side::Both && reading(one).side != reading(id).side && has(one, PiecePart::Centre);
    });
    if (other == ids.end()) return false;
    const auto isCentre = [&](const EdgeSpan& span) {
      const auto& edges = reading(id).parts.at(PiecePart::Centre).edges;
      return span.piece == id && std::find(edges.begin(), edges.end(), span.edge) != edges.end();
    };
    return std::none_of(document_.pattern.seams.begin(), document_.pattern.seams.end(), [&](const auto& seam) {
      const auto sewn = [&](const auto& side) { return std::any_of(side.begin(), side.end(), isCentre); };
      return sewn(seam.second.a) || sewn(seam.second.b);
    });
  }
  // A woman's right front lies over the left one, a man's left one over the right.
  bool lapsOver(PieceId id) const {
    return lapped(id) && reading(id).side == (body_.measured().sex == Sex::Female ? Side::Right : Side::Left);
  }
  // u that comes to the body's middle: of a half its centre edge, a hair beside the middle.
  double middleOf(PieceId id) const {
    const Box box = boxOf(id);
    if (has(id, PiecePart::Centre)) {
      const Box centre = boxOf(id, PiecePart::Centre);
      const bool atPlus = centre.low.u + centre.high.u > box.low.u + box.high.u;
      const double beside = lapped(id) ? -kLap / 2 : kGap / 2;
      return atPlus ? centre.high.u + beside : centre.low.u - beside;
    }
    if (has(id, PiecePart::Neck) && reading(id).side == Side::Both) {
      const Box neck = boxOf(id, PiecePart::Neck);
      return 0.5 * (neck.low.u + neck.high.u);
    }
    return 0.5 * (box.low.u + box.high.u);
  }

  void trunk() {
    const auto ids = of({PieceRole::Front, PieceRole::Back, PieceRole::Yoke});
    if (ids.empty()) return;
    double yokeDepth = 0, fronts = 0, backs = 0, lowest = neck_;
    for (const PieceId id : ids)
      if (reading(id).role == PieceRole::Yoke)
        yokeDepth = boxOf(id, PiecePart::Neck).high.v - boxOf(id, PiecePart::Hem).low.v;
    // The paper's height that comes to the side of the neck.
    const auto neckOf = [&](PieceId id) {
      if (has(id, PiecePart::Neck)) return boxOf(id, PiecePart::Neck).high.v;
      return boxOf(id).high.v + yokeDepth + (yokeDepth > 0 ? kGap : 0);
    };
    std::size_t count = 0;
    for (const PieceId id : ids) {
      const Box box = boxOf(id);
      if (reading(id).role == PieceRole::Front) fronts += box.width(), ++count;
      if (reading(id).role == PieceRole::Back) backs += box.width(), ++count;
      lowest = std::min(lowest, neck_ - (neckOf(id) - box.low.v));
    }
    const double ease = easeFor(girth(lowest, neck_, onTrunk(false)), 2 * std::max(fronts, backs), count + 2);
    for (const PieceId id : ids) {
      const double v = neckOf(id) - (neck_ - waist_);
      if (lapsOver(id)) perform(SetLayer{{PieceRef(id)}, 1}, {});
      wrap(id, onTrunk(reading(id).role != PieceRole::Front), {middleOf(id), v}, ease + (lapsOver(id) ? kLapOver : 0));
    }
  }

  void skirts() {
    const auto ids = of({PieceRole::SkirtFront, PieceRole::SkirtBack});
    double width = 0, most = 0, lowest = waist_;
    std::map<PieceRole, double> wide;
    for (const PieceId id : ids) {
      const Box box = boxOf(id);
      wide[reading(id).role] += box.width();
      most = std::max(most, box.high.v - box.low.v);
      lowest = std::min(lowest, waist_ - (box.high.v - box.low.v));
    }
    for (const auto& [role, w] : wide) width = std::max(width, w);
    const double ease =
        easeFor(girth(std::max(lowest, crotch_ - 0.05), waist_, onTrunk(false)), 2 * width, ids.size() + 1);
    for (const PieceId id : ids)
      wrap(id, onTrunk(reading(id).role == PieceRole::SkirtBack), {middleOf(id), boxOf(id).high.v}, ease);
  }

  // A flat piece upright before the body or, turned round, behind it: its upright place `from` comes to `to`.
  void stand(PieceId id, Flat from, Vec3 to, bool behind) {
    const Rigid turn = turnAbout({0, 0, 1}, reading(id).turn);
    const Rigid pose = behind ? after(turnAbout({0, 1, 0}, std::numbers::pi), turn) : turn;
    move(id, onPaper(id, from), to, pose);
  }
  void move(PieceId id, Flat paper, Vec3 to, const Rigid& pose) {
    MovePiece move;
    move.pieces = {PieceRef(id)};
    const Rigid now = piece(id).pose;
    move.by = to - now({paper.u, paper.v, 0});
    move.about = paper;
    // One turn from how it stands now to how it shall stand.
    const Rigid turn = after(pose, Rigid{now.w, -now.x, -now.y, -now.z, {}});
    const Vec3 axis{turn.x, turn.y, turn.z};
    const double angle = 2 * std::atan2(karinui::length(axis), turn.w);
    if (karinui::length(axis) > 1e-9) move.turn = Turn{normalized(axis), Angle{angle}};
    perform(std::move(move), id);
  }

  void legs() {
    for (const PieceId id : of({PieceRole::LegFront, PieceRole::LegBack})) {
      const bool back = reading(id).role == PieceRole::LegBack, left = reading(id).side == Side::Left;
      const bool inPlus = has(id, PiecePart::CrotchPlus);
      const Box crotch = boxOf(id, inPlus ? PiecePart::CrotchPlus : PiecePart::CrotchMinus);
      const Flat fork{inPlus ? crotch.high.u : crotch.low.u, crotch.low.v};
      stand(id, fork, {left ? kCentre : -kCentre, crotch_ - 0.01, back ? back_ - kAhead : front_ + kAhead}, back);
    }
    const auto whole = of({PieceRole::Leg});
    if (whole.empty()) return;
    double width = 0, lowest = waist_;
    for (const PieceId id : whole) {
      const Box box = boxOf(id);
      width += box.width();
      lowest = std::min(lowest, crotch_ - (boxOf(id, PiecePart::CrotchPlus).low.v - box.low.v));
    }
    const double ease = easeFor(girth(std::max(lowest, 0.15), waist_, onTrunk(false)), width, 2 * whole.size());
    for (const PieceId id : whole) {
      const Box box = boxOf(id);
      BodyPoint at = onTrunk(false);
      at.around = reading(id).side == Side::Left ? 0.25 : 0.75;
      const double fork = boxOf(id, PiecePart::CrotchPlus).low.v;
      wrap(id, at, {0.5 * (box.low.u + box.high.u), fork + waist_ - crotch_}, ease);
    }
  }

  // Round an arm, at every height as narrow as the sleeve is there, so that its two sides meet under the arm all along.
  std::vector<Try> roundArm(PieceId id, double v, double from, double to) const {
    const Box box = boxOf(id);
    const bool left = reading(id).side == Side::Left;
    std::vector<Try> tries;
    for (double along = from; along <= to + 1e-9; along += 0.1) {
      BodyPoint at;
      at.part = left ? BodyPoint::Part::LeftArm : BodyPoint::Part::RightArm;
      at.along = along, at.around = left ? 0.25 : 0.75;
      tries.push_back({at, {0.5 * (box.low.u + box.high.u), v}, 0.012, 0, true});
    }
    return tries;
  }

  // Round the upper arms. Where they would meet fronts and backs, these stand off further, before and behind: sleeves
  // that stood far down an arm would close round the hand.
  void sleeves() {
    const auto arms = of({PieceRole::Sleeve});
    const auto before = std::tuple(document_, out_.size(), done_);
    for (const double off : {0.0, 0.05, 0.1, 0.15}) {
      if (off > 0) {
        std::tie(document_, std::ignore, done_) = before;
        out_.erase(out_.begin() + static_cast<std::ptrdiff_t>(std::get<1>(before)), out_.end());
        for (const bool back : {false, true}) {
          MovePiece move;
          for (const PieceId id : of({PieceRole::Front, PieceRole::Back, PieceRole::Yoke}))
            if ((reading(id).role != PieceRole::Front) == back) move.pieces.push_back(PieceRef(id));
          move.by = {0, 0, back ? -off : off};
          if (!move.pieces.empty()) perform(move, move.pieces.front().id);
        }
      }
      std::size_t met = 0;
      for (const PieceId id : arms) {
        met += wrap(id, roundArm(id, boxOf(id, PiecePart::Top).low.v, 0.8, 1.1));
      }
      if (met == 0) break;
    }
    for (const PieceId id : of({PieceRole::Cuff})) wrap(id, roundArm(id, boxOf(id).high.v, 2.7, 3.5));
  }

  // Which long edge of a band is sewn to something that is no band; Hem where none is.
  PiecePart sewn(PieceId band) const {
    const auto& top = reading(band).parts.at(PiecePart::Top).edges;
    for (const auto& [id, seam] : document_.pattern.seams)
      for (const auto& [own, other] : {std::pair{&seam.a, &seam.b}, {&seam.b, &seam.a}})
        for (const EdgeSpan& span : *own)
          if (span.piece == band && std::find(top.begin(), top.end(), span.edge) != top.end() &&
              (reading(band).role != PieceRole::CollarStand || reading(other->front().piece).role != PieceRole::Collar))
            return PiecePart::Top;
    return PiecePart::Hem;
  }

  void bands() {
    const bool trousers = !of({PieceRole::LegFront, PieceRole::Leg}).empty();
    for (const PieceId id : of({PieceRole::Waistband, PieceRole::CollarStand, PieceRole::Collar})) {
      const PieceRole role = reading(id).role;
      const PiecePart edge = sewn(id);
      const double turn = edge == PiecePart::Top ? std::numbers::pi : 0;
      const Box box = boxOf(id), low = boxOf(id, edge);
      const double v = edge == PiecePart::Top ? low.high.v : low.low.v;
      if (role == PieceRole::Waistband) {
        BodyPoint at = onTrunk(trousers);
        const double ease = easeFor(girth(waist_, waist_ + 0.05, onTrunk(false)), box.width(), 2, 0.012);
        const double off = edge == PiecePart::Top ? 1 : -1;
        std::vector<Try> tries;
        for (const double up : {1.0, 2.0, 4.0, 7.0})
          tries.push_back({at, {0.5 * (box.low.u + box.high.u), v + off * kGap * up}, ease, turn});
        wrap(id, tries);
        continue;
      }
      double lift = 0;
      if (role == PieceRole::Collar)
        for (const PieceId stand : of({PieceRole::CollarStand})) {
          const Box its = boxOf(stand);
          lift = its.high.v - its.low.v + kGap;
        }
      // Above the slope of the shoulders, so that it goes round the neck: round these too it would stand nearly flat
      // behind the head and close through itself. Where a figure's head is in the way, lower.
      const double off = edge == PiecePart::Top ? 1 : -1, middle = 0.5 * (box.low.u + box.high.u);
      const BodyPoint nape = onTrunk(true, kNeck);
      const double neck = heightOf(nape, neck_ + 0.08);
      const double least = easeFor(girth(neck, neck + box.high.v - box.low.v, nape), box.width(), 1, 0.008);
      std::vector<Try> tries;
      for (const double more : {0.0, 0.01, 0.02})
        for (const double up : {0.0, 0.01, 0.02})
          tries.push_back({nape, {middle, v + off * (lift + up)}, least + more, turn});
      for (const double ease : {0.012, 0.02, 0.03, 0.045})
        for (const double up : {0.0, 0.01, 0.02, 0.03})
          tries.push_back({onTrunk(true, kNeckBase), {middle, v + off * (lift + up)}, ease, turn});
      wrap(id, tries);
    }
  }

  void rest() {
    FreezePieces freeze;
    double x = kAside;
    std::vector<PieceId> all;  // the document is another one after each step
    for (const auto& [id, one] : document_.pattern.pieces) all.push_back(id);
    for (const PieceId id : all) {
      if (done_.contains(id) || !readings_.contains(id)) continue;
      const Box box = boxOf(id);
      stand(id, {box.low.u, box.low.v}, {x, 1.0, 0}, false);
      x += box.width() + 0.05;
      freeze.pieces.push_back(PieceRef(id));
    }
    if (!freeze.pieces.empty()) perform(std::move(freeze), {});
  }

  Document document_;
  const PieceReadings& readings_;
  const Body& body_;
  Context& context_;
  std::optional<Error> trouble_;
  double waist_ = 1.05, neck_ = 1.45, crotch_ = 0.78, front_ = 0.1, back_ = -0.1;
  std::set<PieceId> done_;
  std::vector<Operation> out_;
};

}  // namespace

Result<std::vector<Operation>> standPieces(const Document& document, const PieceReadings& readings, Context& context) {
  if (!document.body.chosen()) return std::vector<Operation>{};
  const auto body = bodyOf(document, context);
  if (!body) return body.error();
  return StandingPieces(document, readings, **body, context).all();
}

}  // namespace karinui
