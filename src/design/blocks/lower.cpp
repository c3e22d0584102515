// Skirt, trousers and leggings.
#include <algorithm>
#include <cmath>

#include "design/blocks/draft.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

// The waist and the hip of one quarter, and what the dart takes of the difference.
struct Quarter {
  double waist = 0, hip = 0, dart = 0;  // waist: as drawn, the dart's width included
};
constexpr double kLeastDart = 0.006;
constexpr double kTrousersEase = 0.06;  // metres, where none is said
std::string centimetresOf(double metres) { return fixed(metres * 100, 1); }
Quarter quarterOf(double waist, double hip, double atSide, bool exact) {
  const double less = std::fmax(0, hip - waist);
  double side = std::fmin(atSide, 0.5 * less);
  if (exact && less - side < kLeastDart) side = less;  // what is too little for a dart goes at the side, too
  return {hip - side, hip, less - side};
}

// Where the upper edge lies. What is worn holds by what is wider below it.
struct Top {
  double girth = 0, height = 0;  // metres; height above the floor
  double along = 3;              // that height, by the levels of the torso's chart
  double ease = 0.02;
  bool exact = false;  // no wider than that for want of a dart
  double raised = 0;   // metres that the middle of the back is raised by besides
  double belly = 0;    // metres that the front is wider than the back, for a belly that is wider than the hip
  bool atWaist() const { return along == 3; }
};
Top topOf(const Measured& of, const BlockWish& wish) {
  using Worn = DraftBlock::Worn;
  constexpr double kBetter = 0.01;  // metres of girth that a place holds better by than the waist
  constexpr double kWell = 0.06;    // metres of girth that any edge holds by
  constexpr double kFirm = 0.04;    // metres that the edge is narrower by than what lies below, where that can be
  const double hip = of("hip_girth"), waistHigh = of("waist_height");
  Top top{of("waist_girth"), waistHigh};
  if (wish.meets) {
    if (wish.belly && top.girth <= hip) top.belly = std::fmax(0, of.belly().girth - hip);
    return top;
  }
  const auto low = [&](double girth, double height) {
    const double highHip = of("high_hip_height");
    const double above = (height - highHip) / std::fmax(waistHigh - highHip, 0.01),
                 below = (height - highHip) / std::fmax(highHip - of("hip_height"), 0.01);
    return Top{
        std::fmin(girth, hip), height, 2 + std::clamp(height > highHip ? above : below, -0.9, 0.9), 0.005, true, 0.015};
  };
  if (wish.worn == Worn::HighHip) return low(of("high_hip_girth"), of("high_hip_height"));
  // Where the waist is wider than the hip nothing but a belly below it holds up what has room for one.
  if (wish.belly && top.girth <= hip) top.belly = std::fmax(0, of.belly().girth - hip);
  if (wish.worn != Worn::Holds) return top;
  const Measured::Trunk trunk = of.underWaist();
  const double holds = trunk.widest - top.girth;
  if (wish.belly && top.girth > hip - kFirm) top.belly = std::fmax(top.belly, trunk.widest - hip);
  top.exact = true;
  top.ease = std::clamp(holds - kFirm, -0.01, top.ease);
  if (holds >= kWell || hip - trunk.narrowest < holds + kBetter) return top;
  return low(trunk.narrowest, trunk.narrowHeight);
}

void sewLegs(Draft& draft) {
  draft.seams.push_back(
      {"crotch_front", {draftedEdge("leg_front_left", "crotch")}, {draftedEdge("leg_front_right", "crotch")}});
  draft.seams.push_back(
      {"crotch_back", {draftedEdge("leg_back_left", "crotch")}, {draftedEdge("leg_back_right", "crotch")}});
  for (const std::string s : {"left", "right"}) {
    draft.seams.push_back(
        {"outseam_" + s, {draftedEdge("leg_front_" + s, "outseam")}, {draftedEdge("leg_back_" + s, "outseam")}});
    draft.seams.push_back(
        {"inseam_" + s, {draftedEdge("leg_front_" + s, "inseam")}, {draftedEdge("leg_back_" + s, "inseam")}});
  }
}

// Drawn with the leg at positive u: the figure's left leg in front, its right one behind. And its symmetric copy.
std::string addLeg(Draft& draft, bool front, Outline outline, double x, double lean = 0) {
  DraftPiece piece;
  piece.name = front ? "leg_front_left" : "leg_back_right";
  piece.outline = std::move(outline);
  piece.stands.x = front ? x : -x;
  piece.stands.lean = lean;
  piece.stands.z = front ? 0.20 : -0.22;
  piece.stands.point = {0, 0};
  draft.pieces.push_back(piece);
  draft.pieces.push_back({front ? "leg_front_right" : "leg_back_left", {}, {}, {}, {}, piece.name});
  return piece.name;
}

// A fair line through all of them, each passed along the chord of its neighbours; the first begins, and the last ends,
// straight.
Curve through(const std::vector<Flat>& points) {
  constexpr double kHandle = 1.0 / 3;
  const std::size_t last = points.size() - 1;
  std::vector<Curve> parts;
  const auto way = [&](std::size_t k) { return normalized(points[std::min(last, k + 1)] - points[k > 0 ? k - 1 : 0]); };
  for (std::size_t k = 0; k < last; ++k) {
    const double reach = kHandle * length(points[k + 1] - points[k]);
    parts.push_back(
        Curve::cubic(points[k], points[k] + way(k) * reach, points[k + 1] - way(k + 1) * reach, points[k + 1]));
  }
  return Curve::joined(parts);
}

}  // namespace

namespace {

// The dart of a quarter whose waist is drawn that long: how wide it is, and how far from the centre its middle lies, as
// a share of that.
struct WaistDart {
  double width = 0, place = 0.5;
};
WaistDart waistDart(double drawn, double width, const BlockWish::Waist* meets) {
  if (!meets) return {width, 0.5};
  const double left = drawn - meets->whole();
  return {left, meets->side ? (meets->centre + left / 2) / drawn : 0.5};
}
const BlockWish::Waist* waistOf(const BlockWish& wish, bool front) {
  return !wish.meets ? nullptr : front ? &wish.meets->front : &wish.meets->back;
}

}  // namespace

double skirtWaist(const Measured& of) { return of("waist_girth") + 0.02; }

Result<Draft> skirtDraft(const Measured& of, const BlockWish& wish) {
  const double ease = wish.ease.value_or(0.05);
  const Top worn = topOf(of, wish);
  const double waist = (worn.girth + worn.ease) / 4, hip = (of("hip_girth") + ease) / 4;
  // The hip line of a skirt lies where the seat is fullest, no deeper than 22 cm.
  const double deep = worn.atWaist() ? std::fmin(of("waist_to_hip_length"), 0.22)
                                     : std::clamp(worn.height - of("hip_height"), 0.06, 0.22);
  const double whole = wish.length.value_or(worn.height - of("knee_height"));
  if (Done done = of.enough(); !done) return done.error();
  if (!(whole > deep + 0.03))
    return refused(
        say("A skirt that long ends above the hip; it has to be longer than {0} cm.", std::round((deep + 0.03) * 100)));
  const double flare = 0.10 * (whole - deep);
  const double rise = 0.010;          // the side is cut higher than the centre, for it runs over the hip
  constexpr double kFrontDart = 0.8;  // of their mean width: the seat is rounder than the belly, which pouches less so
  Draft draft;
  for (const bool front : {true, false}) {
    const double wide = hip + (front ? worn.belly / 2 : 0);
    const BlockWish::Waist* meets = waistOf(wish, front);
    const Quarter q = quarterOf(meets ? meets->whole() : waist, wide, 0.03, worn.exact || meets);
    const double middle = front ? 0 : worn.raised;
    const Flat foot{wide + flare, -whole}, seat{wide, -deep}, top{q.waist, rise + worn.raised / 2};
    const Flat up = top - seat;
    const std::vector<Curve> side{
        Curve::line(foot, seat),
        Curve::cubic(seat, seat + normalized(seat - foot) * (0.35 * length(up)), top - Flat{-0.006, 0.3 * up.v}, top)};
    const std::vector<Edge> half{
        {"hem", Curve::line({0, -whole}, foot)},
        {"side", Curve::joined(side)},
        {"waist", Curve::cubic(top, top - Flat{0.3 * q.waist, 0.003}, {0.4 * q.waist, middle}, {0, middle})}};
    const std::string name = front ? "skirt_front" : "skirt_back";
    const std::string plus = front ? "_left" : "_right", minus = front ? "_right" : "_left";
    DraftPiece piece{name, wholeOf(half, plus, minus), {}, {}, {}, {}};
    BodyPoint at;
    at.along = worn.along, at.around = front ? 0 : 0.5;
    piece.stands.at = at, piece.stands.ease = 0.012;
    draft.pieces.push_back(std::move(piece));
    if (q.dart < kLeastDart) continue;
    const auto [width, place] =
        waistDart(half.back().curve.length(), q.dart * (front ? kFrontDart : 2 - kFrontDart), meets);
    // The waist runs from the side to the centre on the half at positive u.
    for (const bool left : {true, false})
      draft.darts.push_back({name,
                             "waist" + (left ? plus : minus),
                             left ? 1 - place : place,
                             width,
                             {(left ? 1 : -1) * place * q.waist, -deep * (front ? 0.5 : 0.65)},
                             "dart"});
  }
  for (const std::string s : {"left", "right"})
    draft.seams.push_back(
        {"skirt_side_" + s, {draftedEdge("skirt_front", "side_" + s)}, {draftedEdge("skirt_back", "side_" + s)}});
  return draft;
}

Result<Draft> trousersDraft(const Measured& of, const BlockWish& wish) {
  const double ease = wish.ease.value_or(kTrousersEase);
  const Top worn = topOf(of, wish);
  const double hip = (of("hip_girth") + ease) / 4, waist = (worn.girth + worn.ease) / 4;
  const double seat = worn.height - of("crotch_height") + 0.015;  // the rise, with room to sit
  const double inside = wish.length.value_or(worn.height - of("ankle_height"));
  const double knee = worn.height - of("knee_height");
  if (!(inside > seat + 0.05))
    return refused(say("Trousers that long end above the crotch; they have to be longer than {0} cm.",
                       std::round((seat + 0.05) * 100)));
  // What is given up or added at the hip goes on down the legs, as far as knee and heel let it.
  const double share = wish.legs ? (of("hip_girth") + ease) / (of("hip_girth") + kTrousersEase) : 1;
  const auto round = [&](double usual, double least) { return std::fmax(usual * share, std::fmin(usual, least)); };
  const double kneeRound = wish.knee.value_or(round(std::fmax(of("knee_girth") + 0.08, 0.36), of("knee_girth") + 0.02));
  const double hemRound = wish.hem.value_or(round(of("ankle_girth") + 0.14, of("ankle_girth") + 0.10));
  if (Done done = of.enough(); !done) return done.error();
  const bool toKnee = inside > knee + 0.05;
  if (kneeRound < of("knee_girth"))
    return refused(say("The knee is {0} cm round; trousers are no narrower there.", centimetresOf(of("knee_girth"))));
  if (toKnee && hemRound < of("ankle_girth"))
    return refused(say("The ankle is {0} cm round; trousers are no narrower there.", centimetresOf(of("ankle_girth"))));
  const double kneeHalf = kneeRound / 4, hemHalf = hemRound / 4;
  Draft draft;
  draft.height = worn.height;
  for (const bool front : {true, false}) {
    const double fork = of("hip_girth") * (front ? 0.045 : 0.10), more = front ? -0.008 : 0.008;
    const double room = front ? worn.belly / 2 : 0;  // half of it at the side, half at the centre
    // u = 0: the centre seam; the leg hangs at u > 0
    const double width = hip + more + room / 2, crease = (hip + more - fork) / 2;
    const BlockWish::Waist* meets = waistOf(wish, front);
    const Quarter q = quarterOf(meets ? meets->whole() : waist + more, hip + more + room, 0.02, worn.exact || meets);
    const double high = 0.62 * seat;  // of the hip line, below the waist
    // The back is longer and leans.
    const double rise = front ? 0 : 0.025 + worn.raised, lean = (front ? 0.006 : 0.028) - room / 2;
    const double legMore = front ? -0.008 : 0.008;  // the back of the leg is wider
    const Flat centre{lean, rise}, side{lean + q.waist, 0.008 + worn.raised / 2}, hipSide{width, -high};
    const double hem = -inside;
    const double kneeW = kneeHalf + legMore / 2, hemW = hemHalf + legMore / 2;
    const Flat kneeOut{crease + kneeW, -knee}, kneeIn{crease - kneeW, -knee};
    const Flat hemOut{crease + hemW, hem}, hemIn{crease - hemW, hem};
    const Flat tip{-fork, -seat}, seatCentre{0 - room / 4, -high};
    const Flat outEnd = toKnee ? hemOut : lerp(hipSide, kneeOut, (inside - high) / (knee - high));
    const Flat inEnd = toKnee ? hemIn : lerp(tip, kneeIn, (inside - seat) / (knee - seat));
    Flat footOut{outEnd.u, hem}, footIn{inEnd.u, hem};
    if (!toKnee && wish.hem) {  // about the middle of the leg
      const double middle = (footOut.u + footIn.u) / 2;
      footOut.u = middle + hemW, footIn.u = middle - hemW;
    }
    const Flat lowOut = toKnee ? kneeOut : footOut, lowIn = toKnee ? kneeIn : footIn;
    std::vector<Curve> outseam, inseam;
    if (toKnee) outseam.push_back(Curve::line(footOut, kneeOut));
    outseam.push_back(Curve::cubic(lowOut, lerp(lowOut, {lowOut.u, hipSide.v}, 0.35),
                                   hipSide - Flat{0, 0.45 * (hipSide.v - lowOut.v)}, hipSide));
    outseam.push_back(Curve::cubic(hipSide, hipSide + Flat{0, 0.35 * high}, lerp(side, hipSide, 0.25), side));
    inseam.push_back(Curve::cubic(tip, lerp(tip, lowIn, 0.3) + Flat{front ? 0.008 : 0.018, 0},
                                  lerp({lowIn.u, tip.v}, lowIn, 0.6), lowIn));
    if (toKnee) inseam.push_back(Curve::line(kneeIn, footIn));
    const Flat down = normalized(seatCentre - centre);
    const std::vector<Curve> crotch{
        Curve::line(centre, seatCentre),
        Curve::cubic(seatCentre, seatCentre + down * (0.75 * (seat - high)), tip + Flat{0.62 * fork, 0}, tip)};
    Outline outline{{{"hem", Curve::line(footIn, footOut)},
                     {"outseam", Curve::joined(outseam)},
                     {"waist", Curve::line(side, centre)},
                     {"crotch", Curve::joined(crotch)},
                     {"inseam", Curve::joined(inseam)}}};
    // Wide legs stand farther apart, or they would stand through each other.
    const double besideMiddle = std::fmax(fork, -std::fmin(footIn.u, lowIn.u)) + 0.015;
    const std::string name = addLeg(draft, front, std::move(outline), besideMiddle);
    if (q.dart < kLeastDart) continue;
    const auto dart = waistDart(distance(side, centre), q.dart, meets);
    draft.darts.push_back({name,
                           "waist",
                           1 - dart.place,
                           dart.width,
                           {lean + dart.place * q.waist, -(front ? 0.4 : 0.5) * high},
                           "dart"});
  }
  sewLegs(draft);
  return draft;
}

// Trousers of cloth that stretches: no dart, all girths narrower than the figure by one share.
Result<Draft> leggingsDraft(const Measured& of, const BlockWish& wish) {
  constexpr double kAboveAnkle = 0.03;  // the instep would catch what is longer while it is put on
  constexpr double kMostLean = 0.2;     // radians
  const Top worn = topOf(of, wish);
  const double girth = of("hip_girth");
  const double share = girth > 0 ? 1 + wish.ease.value_or(-0.1 * girth) / girth : 1;
  const double hip = share * girth / 4, waist = share * worn.girth / 4;
  const double thigh = share * of("thigh_girth"), knee = share * of("knee_girth"), calf = share * of("calf_girth"),
               ankle = share * of("ankle_girth");
  const double seat = worn.height - of("crotch_height") + 0.015,
               inside = wish.length.value_or(worn.height - of("ankle_height") - kAboveAnkle);
  const double kneeDown = worn.height - of("knee_height"), ankleDown = worn.height - of("ankle_height");
  if (Done done = of.enough(); !done) return done.error();
  if (!(inside > seat + 0.05))
    return refused(say("Leggings that long end above the crotch; they have to be longer than {0} cm.",
                       std::round((seat + 0.05) * 100)));
  // Between both forks and the thigh; under a slim thigh the seat still needs them.
  const double forks = std::fmax(thigh + 0.01 - 2 * hip, 0.13 * share * girth);
  const double high = 0.62 * seat, calfDown = std::lerp(kneeDown, ankleDown, 0.3);
  Draft draft;
  draft.height = worn.height;
  for (const bool front : {true, false}) {
    const double to = front ? -1 : 1;                        // the back is the wider one
    const double room = front ? share * worn.belly / 2 : 0;  // half of it at the side, half at the centre
    const double fork = (front ? 0.3 : 0.7) * forks, even = hip + to * 0.006, width = even + room / 2,
                 crease = (even - fork) / 2;
    const double rise = front ? 0 : 0.025 + worn.raised, lean = (front ? 0.004 : 0.02) - room / 2;
    const auto half = [&](double round) { return round / 4 + to * 0.004; };
    const double sideHigh = 0.006 + worn.raised / 2, whole = waistOf(wish, front) ? waistOf(wish, front)->whole() : 0;
    const double wide =
        whole > 0 ? std::sqrt(whole * whole - (rise - sideHigh) * (rise - sideHigh)) : waist + to * 0.004;
    const Flat centre{lean, rise}, side{lean + wide, sideHigh}, hipSide{width, -high}, tip{-fork, -seat};
    // How far from the crease the leg ends, at `down` below the waist: straight from girth to girth.
    const std::vector<Flat> girths{
        {(even + fork) / 2, seat}, {half(knee), kneeDown}, {half(calf), calfDown}, {half(ankle), ankleDown}};
    const auto legAt = [&](double down) {
      for (std::size_t k = 1; k < girths.size(); ++k)
        if (down <= girths[k].v)
          return std::lerp(girths[k - 1].u, girths[k].u, (down - girths[k - 1].v) / (girths[k].v - girths[k - 1].v));
      return girths.back().u;
    };
    std::vector<Flat> outside{{crease + legAt(inside), -inside}}, within{tip};
    for (auto at = girths.rbegin(); at != girths.rend(); ++at)
      if (at->v > seat && at->v < inside - 0.03) outside.push_back({crease + at->u, -at->v});
    for (auto at = outside.rbegin(); at != outside.rend(); ++at) within.push_back({2 * crease - at->u, at->v});
    outside.push_back(hipSide);
    outside.push_back(side);
    const Flat seatCentre{0 - room / 4, -high}, down = normalized(seatCentre - centre);
    const std::vector<Curve> crotch{
        Curve::line(centre, seatCentre),
        Curve::cubic(seatCentre, seatCentre + down * (0.75 * (seat - high)), tip + Flat{0.62 * fork, 0}, tip)};
    // Narrow legs stand along the figure's, or their sides would close beside them.
    const double besideMiddle = fork + 0.015, crotchTo = besideMiddle + crease;
    const double legLean =
        std::clamp(std::atan2(of.aside("ankle_left").value_or(crotchTo) - crotchTo, ankleDown), -kMostLean, kMostLean);
    addLeg(draft, front,
           Outline{{{"hem", Curve::line(within.back(), outside.front())},
                    {"outseam", through(outside)},
                    {"waist", Curve::line(side, centre)},
                    {"crotch", Curve::joined(crotch)},
                    {"inseam", through(within)}}},
           besideMiddle, legLean);
  }
  sewLegs(draft);
  return draft;
}

}  // namespace karinui
