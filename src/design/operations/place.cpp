// Wraps a piece round the torso or a limb: a general cylinder whose section is the hull of the limb's own sections over
// the length the piece covers, grown by the ease. Along the section lengths are kept, along the axis too: no
// distortion. A sector of a ring stands as a cone (place_cone.cpp), a long sleeve as a tube that narrows with the arm
// (tapered_tube.cpp).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "design/operations/lifted_form.h"
#include "design/operations/limb.h"
#include "design/operations/new_piece.h"
#include "design/operations/place_cone.h"
#include "design/operations/spiral.h"
#include "design/operations/tapered_tube.h"
#include "design/operations/waves.h"
#include "karinui/base/number.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

namespace {

constexpr double kMostEase = 0.5;
constexpr double kBesideTrunk = 0.06;  // metres a pleated sheet may be wider than the trunk on either side
constexpr double kPleat = 0.24;        // metres of cloth in one pleat
constexpr double kTouches = 0.001;     // metres from the body: nearer is no place to begin
constexpr Joint kShoulders[] = {Joint::LeftShoulder, Joint::RightShoulder};

Error unwrappable(const BodyPoint& at) {
  return refused(say("A piece cannot be wrapped round the body at {0}; choose a place on its side.", text(at)));
}

// A sheet in upright pleats: a sine-generated curve (Langbein and Leopold, River Meanders, 1966), whose direction
// swings so far that the whole is `share` of its length wide. Lengths along it are kept.
class Pleats {
 public:
  Pleats(double half, double share) {
    double low = 0, high = 2.1;  // beyond that neighbouring pleats touch
    for (int i = 0; i < 40 && share < 1; ++i) {
      const double swing = 0.5 * (low + high);
      (std::cyl_bessel_j(0, swing) > share ? low : high) = swing;
    }
    Flat place;
    double deepest = 0;
    const int steps = static_cast<int>(std::ceil(half / kStep)) + 1;
    for (int i = 0; i <= steps; ++i) {
      places_.push_back(place);
      deepest = std::fmin(deepest, place.v);
      const double way = low * std::sin(2 * std::numbers::pi * (i + 0.5) * kStep / kPleat);
      place += Flat{std::cos(way), std::sin(way)} * kStep;
    }
    for (Flat& p : places_) p.v -= deepest;
  }
  Flat at(double u) const {
    const double s = std::fabs(u) / kStep;
    const auto i = std::min(static_cast<std::size_t>(s), places_.size() - 2);
    const Flat p = lerp(places_[i], places_[i + 1], s - static_cast<double>(i));
    return {std::copysign(p.u, u), p.v};
  }

 private:
  static constexpr double kStep = 0.002;
  std::vector<Flat> places_;
};

// How far the body stands out, before the limb's origin, where a flat sheet of that size would stand.
double furthest(const Body& body, const LimbFrame& limb, const FlatBox& box) {
  double most = 0;
  for (const Vec3 p : body.mesh().points) {
    const Vec3 d = p - limb.origin;
    const double u = dot(d, limb.right), v = dot(d, limb.up);
    if (u >= box.low.u && u <= box.high.u && v >= box.low.v && v <= box.high.v)
      most = std::fmax(most, dot(d, limb.out));
  }
  return most;
}

// Whether cloth that hangs from there goes over the arms.
bool aboveArms(const Body& body, Vec3 place) {
  const auto armpit = body.find(*parseBodyPoint("torso:armpit@0.25"));
  return armpit && place.y > at(body.mesh(), *armpit).y;
}

// All skin that cloth can meet which hangs down so far from the limb's origin.
std::vector<SkinPlace> skinBelow(const Body& body, const LimbFrame& limb, double reach) {
  std::vector<SkinPlace> all;
  for (const Vec3 p : body.mesh().points) {
    const double height = dot(p - limb.origin, limb.up);
    if (height <= 0 && distance(p, limb.origin) < reach) all.push_back({limb.onPlane(p), height});
  }
  return all;
}

// Within the rectangle round the piece: what is cut out of a ring or below a crescent may lie at the body, too.
Done onItsPaper(const Piece& piece, const FlatBox& box, Flat place) {
  constexpr double kBeside = 1e-3;  // metres
  if (place.u >= box.low.u - kBeside && place.u <= box.high.u + kBeside && place.v >= box.low.v - kBeside &&
      place.v <= box.high.v + kBeside)
    return {};
  const auto said = [](Flat at) { return fixed(at.u * 1e3, 1) + ", " + fixed(at.v * 1e3, 1); };
  return refused(say("The place {0} mm lies beside the paper of “{1}”, which reaches from {2} to {3} mm.", said(place),
                     piece.name, said(box.low), said(box.high)));
}

// The edge that lies on top is at one of the two ends of what is wound.
Done atAnEnd(const Document& before, const Piece& piece, const PlacePiece& op) {
  EdgeRef top{op.piece, op.wrap};
  if (Done done = resolve(before, top); !done) return done;
  constexpr double kEnd = 0.25;  // of the width, from either side
  Ring paper = piece.outline.flattened(1e-3);
  for (Flat& p : paper) p = turned(p, op.turn);
  const FlatBox box = boxOf(paper);
  const Flat middle = findEdge(piece, op.wrap)->curve.atFraction(0.5);
  const double at = turned(middle, op.turn).u, share = (at - box.low.u) / (box.high.u - box.low.u);
  if (share < kEnd || share > 1 - kEnd) return {};
  if (const auto sector = sectorOf(piece); sector && std::fabs(shareOf(*sector, middle)) > 0.5 - kEnd) return {};
  return refused(say("{0}.{1} is at neither end of what goes round; name the edge of the end that lies on top.",
                     piece.name, op.wrap));
}

bool armsRaised(const BodyPose& pose) {
  constexpr double kRaised = 60 * kDegree;  // from hanging; level are 90
  return std::all_of(std::begin(kShoulders), std::end(kShoulders), [&](Joint shoulder) {
    const auto at = pose.find(shoulder);
    return at != pose.end() && at->second.abduct >= kRaised;
  });
}

// A wide piece that is bent round the trunk may stand through the arms.
void tellThroughBody(const Piece& piece, const Body& body, const BodyPose& pose, const Context& context) {
  constexpr double kDeep = 0.01, kShare = 0.003;  // metres; of the places of its form
  if (!context.advise || !piece.form) return;
  std::size_t deep = 0;
  Vec3 where;
  for (const Vec3 place : piece.form->space)
    if (const Vec3 stands = piece.pose(place); body.field().distance(stands) < -kDeep) where = stands, ++deep;
  if (!(static_cast<double>(deep) > kShare * static_cast<double>(piece.form->space.size()))) return;
  if (armsRaised(pose))
    context.advise(
        {say("“{0}” stands through the body, about {1} cm above the floor. The arms are raised already, and what goes "
             "round the trunk meets them: place it lower, or stand it flat before or behind the body: flat=yes.",
             piece.name, std::round(where.y * 100))});
  else
    context.advise(
        {say("“{0}” stands through the body, about {1} cm above the floor. Place it elsewhere, stand it flat "
             "before or behind the body, flat=yes, or raise the arms first: pose name=T.",
             piece.name, std::round(where.y * 100))});
}

// Two wide pieces that each go all the way round stand in each other, where a front and a back were meant.
void tellRingInRing(const Document& before, const Piece& piece, const PlacePiece& op, const Context& context) {
  constexpr double kBesideIt = 0.01, kMuch = 0.05;  // metres; of the places of its form
  constexpr double kCloses = 0.03, kSide = 1e-3;    // metres between its two sides; of a side's places
  if (!context.advise || op.arc > 0 || !op.wrap.empty()) return;
  double low = 1e9, high = -1e9;
  for (const Flat p : piece.form->flat) {
    const double u = turned(p, op.turn).u;
    low = std::fmin(low, u), high = std::fmax(high, u);
  }
  const auto sideAt = [&](double u) {  // the mean of its places
    Vec3 sum;
    double count = 0;
    for (std::size_t k = 0; k < piece.form->flat.size(); ++k)
      if (std::fabs(turned(piece.form->flat[k], op.turn).u - u) < kSide) sum += piece.form->space[k], ++count;
    return sum * (1 / count);
  };
  if (distance(sideAt(low), sideAt(high)) > kCloses) return;
  for (const auto& [id, other] : before.pattern.pieces) {
    if (id == piece.id || !other->form) continue;
    TriangleMesh cloth;
    for (const Vec3 p : other->form->space) cloth.points.push_back(other->pose(p));
    cloth.faces = other->form->faces;
    const Bvh near(cloth);
    const auto within = std::count_if(piece.form->space.begin(), piece.form->space.end(),
                                      [&](Vec3 p) { return near.nearest(piece.pose(p), kBesideIt).has_value(); });
    if (static_cast<double>(within) < kMuch * static_cast<double>(piece.form->space.size())) continue;
    PlacePiece half = op;
    half.arc = 0.5;
    context.advise(
        {say("“{0}” stands in “{1}”: each is wider than its part of the way round. Place both for their part, "
             "in waves: place piece={1} … arc=0.5.",
             piece.name, other->name),
         piece.id,
         {},
         {},
         half});
    return;
  }
}

}  // namespace

Result<std::shared_ptr<const Lattice>> layAlone(const Piece& piece, double spacing) {
  Pattern alone;
  Piece bare = piece;
  bare.form = nullptr;
  alone.pieces[piece.id] = std::make_shared<const Piece>(std::move(bare));
  const auto laid = lay(alone, spacing);
  if (!laid) return laid.error();
  return laid->lattices.at(piece.id);
}

Done resolve(const Document& before, PlacePiece& op, Context& context) {
  const bool recordOfBefore = op.piece.id && op.ease && op.point;
  if (op.cone == Choice::Auto && recordOfBefore) op.cone = Choice::No;
  if (Done done = resolve(before, op.piece); !done) return done;
  if (!op.ease) op.ease = Length{before.settings.ease};
  if (!(*op.ease >= 0 && *op.ease <= kMostEase))
    return refused(say("The ease lies between 0 and 50 cm; 8 mm is usual."));
  if (!(std::abs(op.turn) <= 1000)) return refused(say("That turn is too large."));
  const Piece& piece = *before.find(op.piece.id);
  const FlatBox box = boxOf(piece.outline.flattened(1e-4));
  if (!op.point) op.point = lerp(box.low, box.high, 0.5);
  if (!(length(*op.point) <= 100)) return refused(say("That place is not on the paper."));
  if (!context.recorded && !recordOfBefore)
    if (Done done = onItsPaper(piece, box, *op.point); !done) return done;
  if (!op.wrap.empty())
    if (Done done = atAnEnd(before, piece, op); !done) return done;
  const bool ring = sectorOf(piece).has_value();
  if (op.cone == Choice::Yes && !ring)
    return refused(say("“{0}” is no sector of a ring; only such a piece stands as a cone.", piece.name));
  if (!(op.arc >= 0 && op.arc <= 1)) return refused(say("A piece takes between none and all (1) of the way round."));
  if (op.folded == Choice::Yes && !foldingOf(before.pattern, op.piece.id))
    return refused(
        say("“{0}” has no pleats that run alongside each other, equally deep; leave folded= away.", piece.name));
  if (op.folded == Choice::Auto && !context.recorded && !recordOfBefore && foldingOf(before.pattern, op.piece.id))
    op.folded = Choice::Yes;
  if (op.arc > 0 && !op.wrap.empty())
    return refused(say("What goes round more than once takes all of the way round; leave arc= away."));
  if (op.flat && (op.taper || !op.wrap.empty() || op.arc > 0 || op.cone == Choice::Yes))
    return refused(say("What stands flat goes round nothing; leave cone=, taper=, wrap= and arc= away."));
  if (op.flat) op.cone = Choice::No;
  const bool plain = !op.taper && op.wrap.empty() && op.arc == 0;
  const bool wound = !op.wrap.empty() && !op.taper && !context.recorded;  // recorded, it stands as it did
  if (op.cone == Choice::Auto) op.cone = ring && (plain || wound) ? Choice::Yes : Choice::No;
  const bool roundTrunk = !isLimb(op.at.part) && !op.flat;
  if (op.bothLegs == Choice::Yes && !roundTrunk)
    return refused(say("Only what goes round the trunk goes round both legs; leave both_legs= away."));
  if (op.bothLegs == Choice::Auto && !context.recorded && !recordOfBefore && roundTrunk) op.bothLegs = Choice::Yes;
  if (op.cone == Choice::Yes && op.taper)
    return refused(say("A piece stands as a cone or as a tube that narrows with the limb; say only one of them."));
  if (op.arc > 0 && (op.cone == Choice::Yes || op.taper))
    return refused(
        say("A piece that takes a share of the way round stands neither as a cone nor as a tube that narrows "
            "with the limb; leave cone= and taper= away."));
  if (!op.wrap.empty() && op.taper)
    return refused(
        say("A piece that goes round more than once does not stand as a tube that narrows with the limb; leave taper= "
            "away."));
  return {};
}

namespace {

// A piece that is to stand before its place on the body.
struct WishedPlace {
  const Piece& piece;
  const PlacePiece& op;
  const Body& body;
  LimbFrame limb = {};
  Ring paper = {};  // about the anchor, turned
  FlatBox box = {};
  std::vector<SkinPlace> skin = {};  // what it goes round

  Flat lies(Flat p) const { return turned(p - *op.point, op.turn); }
  bool isClear(const Form& form) const {
    return std::all_of(form.space.begin(), form.space.end(),
                       [&](Vec3 p) { return body.bvh().signedDistance(p) > kTouches; });
  }
};

// A wide cone meets the arms: upright before the place, in pleats no wider than the trunk.
void standInPleats(const WishedPlace& wish, Form& form) {
  FlatBox core{{0, 0}, {0, 0}};
  double off = 0;
  for (const SkinPlace& p : wish.skin) {
    core.low.u = std::fmin(core.low.u, p.place.u), core.high.u = std::fmax(core.high.u, p.place.u);
    off = std::fmax(off, -p.place.v);
  }
  const double half = std::fmax(wish.box.high.u, -wish.box.low.u), room = (core.high.u - core.low.u) / 2 + kBesideTrunk;
  const Pleats pleats(half, room / half);
  const auto stand = [&](double away) {
    form.space.clear();
    for (const Flat p : form.flat) {
      const Flat d = wish.lies(p), plan = pleats.at(d.u);
      form.space.push_back(wish.limb.inSpace({plan.u, -(*wish.op.ease + away + plan.v)}, d.v));
    }
  };
  stand(off);
  if (!wish.isClear(form)) stand(furthest(wish.body, wish.limb, wish.box));
}

Done standAsWoundCone(const WishedPlace& wish, const RingSector& sector, const Edge& top, Form& form) {
  const bool endOnTop = shareOf(sector, top.curve.atFraction(0.5)) > 0;
  const auto cone = coneWound(sector, wish.limb, wish.skin, *wish.op.ease, endOnTop);
  if (!cone) return cone.error();
  for (const Flat p : form.flat) form.space.push_back(cone->place(p));
  return {};
}

Done standAsCone(const WishedPlace& wish, const RingSector& sector, Form& form) {
  if (const Edge* top = findEdge(wish.piece, wish.op.wrap)) return standAsWoundCone(wish, sector, *top, form);
  const auto standRound = [&](const std::vector<SkinPlace>& within) -> Done {
    const auto cone = coneRound(sector, wish.limb, within, *wish.op.ease);
    if (!cone) return cone.error();
    form.space.clear();
    for (const Flat p : form.flat) form.space.push_back(cone->place(p));
    return {};
  };
  if (Done done = standRound(wish.skin); !done) return done;
  if (!wish.isClear(form) && aboveArms(wish.body, wish.limb.origin)) {  // a cape goes over the arms
    std::vector<SkinPlace> all = wish.skin;
    const auto arms = skinBelow(wish.body, wish.limb, sector.inner + sector.depth);
    all.insert(all.end(), arms.begin(), arms.end());
    (void)standRound(all);  // too wide for that: as below
  }
  if (!wish.isClear(form)) standInPleats(wish, form);
  return {};
}

// A tube must close: a piece wider than the girth stands further off, its two sides a hair apart; or it goes round more
// than once, or stands in waves.
void standAsTube(const WishedPlace& wish, Form& form) {
  std::vector<Flat> all;
  for (const SkinPlace& p : wish.skin) all.push_back(p.place);
  const Ring tape = hull(std::move(all));
  const double width = wish.box.high.u - wish.box.low.u;
  const Girth near(grown(tape, std::fmax(*wish.op.ease, 1e-4)));
  const auto stand = [&](const auto& section) {
    for (const Flat p : form.flat) {
      const Flat d = wish.lies(p);
      form.space.push_back(wish.limb.inSpace(section.at(d.u), d.v));
    }
  };
  if (wish.op.arc > 0 && width > wish.op.arc * near.length())
    return stand(
        Waves(near, near.nearest({0, -*wish.op.ease}), wish.box.low.u, wish.box.high.u, wish.op.arc * near.length()));
  if (const Edge* top = findEdge(wish.piece, wish.op.wrap)) {
    const bool lowOnTop = wish.lies(top->curve.atFraction(0.5)).u < lerp(wish.box.low, wish.box.high, 0.5).u;
    return stand(Spiral(near, near.nearest({0, -*wish.op.ease}), wish.box.low.u, wish.box.high.u, lowOnTop));
  }
  const double ease = std::fmax(*wish.op.ease, (width + 0.002 - perimeter(tape)) / (2 * std::numbers::pi));
  const Girth girth(grown(tape, std::fmax(ease, 1e-4)));
  const double anchor = girth.nearest({0, -ease});
  for (const Flat p : form.flat) {
    const Flat d = wish.lies(p);
    form.space.push_back(wish.limb.inSpace(girth.at(anchor + d.u), d.v));
  }
}

// Upright before the place, or as steep as the limb, and clear of what stands out there.
void standFlat(const WishedPlace& wish, Form& form) {
  constexpr double kBesideIt = 0.02;  // metres from its outline
  double off = 0;
  for (const Vec3 p : wish.body.mesh().points) {
    const Vec3 d = p - wish.limb.origin;
    const Flat at{dot(d, wish.limb.right), dot(d, wish.limb.up)};
    if (dot(d, wish.limb.out) > off && (contains(wish.paper, at) || distanceToRing(wish.paper, at) < kBesideIt))
      off = dot(d, wish.limb.out);
  }
  off += *wish.op.ease;
  for (const Flat p : form.flat) {
    const Flat d = wish.lies(p);
    form.space.push_back(wish.limb.inSpace({d.u, -off}, d.v));
  }
}

// Pleated paper stands as it lies folded, its layers over each other.
Done standFolded(const PaperFolding& folding, const std::set<std::pair<double, double>>& sewn,
                 const std::function<Done(Form&)>& stand, Form& form) {
  constexpr double kAside = 1e-3;  // metres on the folded paper, by which its directions are found
  Form here, right, above;
  std::vector<double> lifted;
  for (const Flat place : form.flat) {
    FoldedPlace in = folding.folded(place);
    if (sewn.contains({place.u, place.v})) in = {in.place, 1};
    const Flat lies = in.place + in.clear;
    here.flat.push_back(lies), right.flat.push_back(lies + Flat{kAside, 0}),
        above.flat.push_back(lies + Flat{0, kAside});
    lifted.push_back(in.lifted * kLayersApart);
  }
  for (Form* one : {&here, &right, &above})
    if (Done done = stand(*one); !done) return done;
  for (std::size_t k = 0; k < form.flat.size(); ++k) {
    const Vec3 out = cross(right.space[k] - here.space[k], above.space[k] - here.space[k]);
    form.space.push_back(here.space[k] + (length(out) > 0 ? normalized(out) * lifted[k] : Vec3{}));
  }
  return {};
}

}  // namespace

Result<Piece> placed(const Document& document, Piece piece, const PlacePiece& op, const Body& body) {
  const auto place = body.find(op.at);
  if (!place) return place.error();
  const auto folding = op.folded == Choice::Yes ? foldingOf(document.pattern, piece.id) : std::nullopt;
  PlacePiece own = op;
  if (folding && own.point) own.point = folding->folded(*own.point).place;
  WishedPlace wish{piece, own, body};
  wish.paper = piece.outline.flattened(1e-3);
  for (Flat& p : wish.paper) p = wish.lies(folding ? folding->folded(p).place : p);
  const FlatBox& box = wish.box = boxOf(wish.paper);

  LimbFrame& limb = wish.limb;
  limb.origin = at(body.mesh(), *place);
  const BodyPoint::Part part = isLimb(op.at.part) ? op.at.part : body.describe(*place).part;
  const std::vector<LimbRing> rings = isLimb(part) ? ringsOf(body, part) : std::vector<LimbRing>();
  limb.up = rings.empty() ? Vec3{0, 1, 0} : axisOver(rings, limb.origin, box.low.v, box.high.v);
  // What is flat looks straight ahead, or as far round as its place is; what is bent lies along the skin.
  const double round = 2 * std::numbers::pi * op.at.around;
  const Vec3 normal = op.flat && part == BodyPoint::Part::Torso ? Vec3{std::sin(round), 0, std::cos(round)}
                                                                : faceNormal(body.mesh(), place->face);
  limb.out = normalized(normal - limb.up * dot(normal, limb.up));
  if (!(length(limb.out) > 0.5)) return unwrappable(op.at);
  limb.right = cross(limb.up, limb.out);

  wish.skin = rings.empty() ? levelsAround(body, limb, box, op.bothLegs == Choice::Yes) : ringsAround(rings, limb, box);
  if (wish.skin.size() < 3) return unwrappable(op.at);
  if (op.over) {
    const auto cloth = clothAround(document, piece.id, limb, box, wish.skin);
    wish.skin.insert(wish.skin.end(), cloth.begin(), cloth.end());
  }
  const auto lattice = layAlone(piece, document.settings.spacing);
  if (!lattice) return lattice.error();
  auto form = std::make_shared<Form>();
  form->flat = (*lattice)->nodes;
  form->faces = (*lattice)->faces;
  const auto stand = [&](Form& one) -> Done {
    if (op.cone == Choice::Yes) return standAsCone(wish, *sectorOf(piece), one);
    if (op.flat) {
      standFlat(wish, one);
      return {};
    }
    if (op.taper) {
      const TaperedTube tube(wish.paper, wish.skin, *op.ease);
      for (const Flat p : one.flat) one.space.push_back(tube.place(wish.lies(p), limb));
    } else {
      standAsTube(wish, one);
    }
    return {};
  };
  if (folding) {
    std::vector<const Seam*> seams;
    for (const auto& [id, seam] : document.pattern.seams) seams.push_back(&seam);
    Result<std::set<std::pair<double, double>>> sewn = std::set<std::pair<double, double>>{};
    if (folding->together) sewn = nodesOfSewnLayers(piece, document.settings.spacing, seams);
    if (!sewn) return sewn.error();
    if (Done done = standFolded(*folding, *sewn, stand, *form); !done) return done.error();
  } else if (Done done = stand(*form); !done) {
    return done.error();
  }
  piece.pose = Rigid();
  piece.form = std::move(form);
  return piece;
}

Result<Document> perform(const Document& before, const PlacePiece& op, Context& context) {
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  auto piece = placed(before, *before.find(op.piece.id), op, **body);
  if (!piece) return piece.error();
  tellThroughBody(*piece, **body, before.body.pose, context);
  tellRingInRing(before, *piece, op, context);
  const std::vector<PaperPleat> pleats = pleatsOf(before.pattern);
  if (context.advise && op.folded != Choice::Yes &&
      std::any_of(pleats.begin(), pleats.end(), [&](const PaperPleat& pleat) { return pleat.piece == op.piece.id; }))
    context.advise(
        {say("The pleats of “{0}” are spread flat now; place a piece first, and pleat it then.", piece->name)});
  return withPiece(before, *std::move(piece));
}

}  // namespace karinui
