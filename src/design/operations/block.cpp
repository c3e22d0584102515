// Ready pieces drafted from the figure's measures. The drafts are in design/blocks; here they become pieces, darts,
// seams and bands, and stand on the body.
#include <algorithm>
#include <cmath>

#include "design/blocks/draft.h"
#include "design/operations/new_piece.h"
#include "karinui/design/block_numbers.h"
#include "karinui/design/sewing.h"

namespace karinui {

namespace {

constexpr double kMostEase = 1.0;      // metres
constexpr double kLeastEase = 0.0005;  // metres
constexpr double kOffCloth = 0.015;    // metres a block stands off the cloth that is there
using Kind = DraftBlock::Kind;

// What a draft becomes, with ids counted within the step.
class Made {
 public:
  Made(const Document& before, const DraftBlock& op, const Body& body, const Context& context)
      : document_(before), op_(op), body_(body), context_(context) {
    if (op.over)
      for (const auto& [id, piece] : before.pattern.pieces) {
        const std::vector<Vec3> stands = inSpace(*piece);
        there_.insert(there_.end(), stands.begin(), stands.end());
      }
    context_.advise = nullptr;  // what is out of true on the way is nobody's concern
  }

  Done take(const Draft& draft) {
    high_ = draft.height.value_or(body_.measured().value.at("waist_height"));
    for (const DraftPiece& piece : draft.pieces)
      if (Done done = add(piece); !done) return done;
    for (const DraftDart& dart : draft.darts)
      if (Done done = add(dart); !done) return done;
    for (const DraftPiece& piece : draft.pieces)
      if (!piece.mirrorOf.empty()) copy(piece);
    for (const DraftSeam& seam : draft.seams) sew(named(seam.name), spansOf(seam.a), spansOf(seam.b));
    if (Done done = trueUp(); !done) return done;
    for (const DraftPiece& piece : draft.pieces)  // cut as it is now, so that nothing of it is stretched
      if (Done done = stand(piece); !done) return done;
    for (const DraftBand& band : draft.bands)
      if (Done done = add(band); !done) return done;
    return {};
  }
  Document document() const { return document_; }

 private:
  std::string named(const std::string& name) const { return op_.prefix.empty() ? name : op_.prefix + "_" + name; }
  PieceId newId() { return mint<PieceId>(document_, pieces_++); }

  Done add(const DraftPiece& draft) {
    if (Done done = checkNewName(document_, named(draft.name)); !done) return done;
    if (!draft.mirrorOf.empty()) return {};  // when the other has its darts and stands
    Piece piece;
    piece.id = newId();
    piece.name = named(draft.name);
    auto outline = checked(draft.outline);
    if (!outline) return outline.error();
    piece.outline = *std::move(outline);
    piece.lines = draft.lines;
    piece.marks = draft.marks;
    if (!op_.fabric.empty()) piece.fabric = op_.fabric;
    piece.layer = op_.layer;
    document_ = withPiece(std::move(document_), std::move(piece));
    return {};
  }

  Done add(const DraftDart& dart) {
    const Piece& piece = *document_.pieceNamed(named(dart.piece));
    const auto made = addDart(piece, dart.edge, dart.at, dart.width, dart.tip, dart.name);
    if (!made) return made.error();
    const PieceId id = piece.id;
    document_ = withEdit(std::move(document_), made->edited);
    sew("", {{id, made->to, 0, 1}}, {{id, made->back, 0, 1}});
    return {};
  }

  void copy(const DraftPiece& draft) {
    const Piece& other = *document_.pieceNamed(named(draft.mirrorOf));
    Piece copy = mirrored(other);
    copy.id = newId();
    copy.name = named(draft.name);
    copy.mirrorOf = other.id;
    const PieceId from = other.id, to = copy.id;
    const std::size_t n = copy.outline.edges.size();
    std::vector<std::pair<EdgeSpan, EdgeSpan>> darts;
    for (const auto& [id, seam] : document_.pattern.seams)
      if (seam.a.size() == 1 && seam.a[0].piece == from && seam.b[0].piece == from) {
        const auto image = [&](const EdgeSpan& span) {
          return EdgeSpan{to, copy.outline.edges[n - 1 - *other.outline.find(span.edge)].name, 0, 1};
        };
        darts.emplace_back(image(seam.b[0]), image(seam.a[0]));
      }
    document_ = withPiece(std::move(document_), std::move(copy));
    for (auto& [a, b] : darts) sew("", {a}, {b});
  }

  Done stand(const DraftPiece& draft) {
    if (!draft.mirrorOf.empty()) {
      const Piece image = mirrored(*document_.pieceNamed(named(draft.mirrorOf)));
      Piece copy = *document_.pieceNamed(named(draft.name));
      copy.form = image.form, copy.pose = image.pose;
      document_ = withPiece(std::move(document_), std::move(copy));
      return {};
    }
    Piece piece = *document_.pieceNamed(named(draft.name));
    if (draft.stands.at) {
      PlacePiece place;
      place.piece = PieceRef(piece.id);
      place.at = *draft.stands.at;
      place.point = draft.stands.point;
      place.ease = Length{draft.stands.ease};
      place.taper = draft.stands.taper && op_.taper == Choice::Yes;
      place.cone = Choice::No;
      place.bothLegs = op_.bothLegs;
      place.over = op_.over;
      auto stood = placed(document_, std::move(piece), place, body_);
      if (!stood) return stood.error();
      piece = *std::move(stood);
    } else {
      const bool behind = draft.stands.z < 0;  // half a turn about the upright
      piece.pose = behind ? Rigid{0, 0, 1, 0, {}} : Rigid();
      if (draft.stands.lean != 0)
        piece.pose =
            after(turnAbout({0, 0, 1}, draft.stands.x < 0 ? -draft.stands.lean : draft.stands.lean), piece.pose);
      piece.pose.carry = {draft.stands.x, high_, draft.stands.z};
      piece.pose.carry.z += (behind ? -1 : 1) * nearerThan(piece, behind);
    }
    document_ = withPiece(std::move(document_), std::move(piece));
    return {};
  }

  static std::vector<Vec3> inSpace(const Piece& piece) {
    std::vector<Vec3> all;
    if (piece.form)
      for (const Vec3 p : piece.form->space) all.push_back(piece.pose(p));
    else
      for (const Flat p : piece.outline.flattened(1e-3)) all.push_back(Stand(piece)(p));
    return all;
  }

  // How much nearer a flat piece stands than the cloth that it is to lie over lets it.
  double nearerThan(const Piece& piece, bool behind) const {
    const std::vector<Vec3> own = inSpace(piece);
    Vec3 low = own.front(), high = own.front();
    for (const Vec3 p : own)
      low = {std::min(low.x, p.x), std::min(low.y, p.y), 0}, high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    const auto out = [&](Vec3 p) { return behind ? -p.z : p.z; };
    double nearer = 0;
    for (const Vec3 p : there_)
      if (p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y)
        nearer = std::max(nearer, out(p) + kOffCloth - out(own.front()));
    return nearer;
  }

  std::vector<EdgeSpan> spansOf(const std::vector<EdgeRef>& refs) const {
    std::vector<EdgeSpan> spans;
    for (const EdgeRef& ref : refs)
      spans.push_back(
          {ref.piece.id ? ref.piece.id : document_.pieceNamed(named(ref.piece.name))->id, ref.edge, ref.from, ref.to});
    return spans;
  }

  void sew(const std::string& name, std::vector<EdgeSpan> a, std::vector<EdgeSpan> b) {
    Seam seam;
    seam.id = mint<SeamId>(document_, seams_++);
    const auto taken = [&](const auto& one) { return one.second.name == name; };
    if (std::none_of(document_.pattern.seams.begin(), document_.pattern.seams.end(), taken)) seam.name = name;
    seam.a = std::move(a);
    seam.b = std::move(b);
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) document_.drape.dirty.insert(span.piece);
    document_.pattern.seams[seam.id] = std::move(seam);
  }

  // A draft is straight lines and arcs: a cutter trues it across darts and seams before it is cut.
  Done trueUp() {
    if (op_.trued != Choice::Yes) return {};
    TrueUp all;
    for (std::uint32_t k = 0; k < seams_; ++k) all.seams.push_back(SeamRef(mint<SeamId>(document_, k)));
    if (all.seams.empty()) return {};
    auto trued = perform(document_, all, context_);
    if (!trued) return trued.error();
    document_ = *std::move(trued);
    for (const SeamRef& ref : all.seams) {
      const Seam& seam = *document_.find(ref.id);
      const double ease = std::fabs(lengthMismatch(document_.pattern, seam));
      if (ease > kLeastEase) document_.eases[ref.id] = ease;
    }
    return {};
  }

  Done add(const DraftBand& band) {
    if (Done done = checkNewName(document_, named(band.name)); !done) return done;
    std::vector<EdgeRef> run = band.of;
    for (EdgeRef& edge : run)
      if (!edge.piece.id) edge.piece = PieceRef(document_.pieceNamed(named(edge.piece.name))->id);
    if (Done done = orderRun(document_, run); !done) return done;
    const SpaceRun along = runOf(document_, run);
    Piece piece;
    piece.id = newId();
    piece.name = named(band.name);
    piece.outline = rectangleOf(along.length * band.ratio, band.depth, {"low", "end_left", "top", "end_right"});
    if (!op_.fabric.empty()) piece.fabric = op_.fabric;
    piece.layer = op_.layer;
    const PieceId id = piece.id;
    if (band.at && !along.together()) {
      PlacePiece place;
      place.at = *band.at;
      place.point = Flat{0, 0};
      place.ease = Length{0.012};
      place.cone = Choice::No;
      auto round = placed(document_, std::move(piece), place, body_);
      if (!round) return round.error();
      document_ = withPiece(std::move(document_), *std::move(round));
    } else {
      auto stood = attached(document_, std::move(piece), "low", along, {band.turn, false, false}, &body_);
      if (!stood) return stood.error();
      document_ = withPiece(std::move(document_), *std::move(stood));
    }
    std::vector<EdgeSpan> spans;
    for (const EdgeRef& edge : run) spans.push_back({edge.piece.id, edge.edge, edge.from, edge.to});
    sew(named(band.name), {{id, "low", 0, 1}}, std::move(spans));
    if (along.closed) sew("", {{id, "end_left", 0, 1}}, {{id, "end_right", 0, 1}});
    return {};
  }

  Document document_;
  const DraftBlock& op_;
  const Body& body_;
  Context context_;
  std::vector<Vec3> there_;  // the cloth it is to lie over
  double high_ = 0;          // metres above the floor: where v = 0 of a flat piece stands
  std::uint32_t pieces_ = 0, seams_ = 0;
};

// An unsewn edge of the garment that is there, by its name, on the piece that stands on that side.
std::optional<EdgeRef> edgeThere(const Document& document, const std::string& part, const std::string& edge,
                                 const std::string& side) {
  for (const auto& [id, piece] : document.pattern.pieces) {
    const bool mine = piece->name.ends_with(part) || piece->name.ends_with(part + "_" + side);
    if (!mine) continue;
    for (const std::string& name : {edge + "_" + side, edge}) {
      const EdgeRef ref{PieceRef(id), name};
      if (piece->outline.find(name) && seamsOn(document, {ref}).empty()) return ref;
    }
  }
  return std::nullopt;
}

// Sleeves for the open armholes of the garment; without any, for those of a bodice.
Result<Draft> sleevesFor(const Document& before, const Measured& of, const BlockWish& wish) {
  const auto front = edgeThere(before, "front", "armhole", "left"), back = edgeThere(before, "back", "armhole", "left");
  if (!front || !back) {
    const auto armhole = bodiceArmhole(of, wish);
    return sleeveDraft(of, wish, armhole);
  }
  auto draft = sleeveDraft(of, wish, {lengthOf(before, {*front}), lengthOf(before, {*back})});
  if (!draft) return draft;
  for (const std::string side : {"left", "right"}) {
    const auto f = edgeThere(before, "front", "armhole", side), b = edgeThere(before, "back", "armhole", side);
    if (!f || !b) continue;
    const PieceRef sleeve("sleeve_" + side);
    std::vector<EdgeRef> cap{{sleeve, "cap_back"}, {sleeve, "cap_front"}}, armhole{*f, *b};
    if (side == "right") std::reverse(cap.begin(), cap.end()), std::reverse(armhole.begin(), armhole.end());
    draft->seams.push_back({"armhole_" + side, cap, armhole});
  }
  return draft;
}

// The open waist of what is there above it, on one side of front or back: unsewn edges called hem or waist, with cloth
// above them, that stand at the waist. Nothing where there is none.
std::optional<BlockWish::Waist> openWaist(const Document& document, const Body& body, const std::string& part) {
  constexpr double kAtWaist = 0.05, kOffCentre = 1e-4, kDartOpens = 1e-4;  // metres
  const auto waist = body.measured().value.find("waist_height");
  if (waist == body.measured().value.end()) return std::nullopt;
  for (const auto& [id, piece] : document.pattern.pieces) {
    const bool half = piece->name.ends_with(part + "_left");
    if (!half && !piece->name.ends_with(part)) continue;
    std::vector<Curve> run;  // from the centre on
    for (const Edge& edge : piece->outline.edges) {
      if (!edge.name.starts_with("hem") && !edge.name.starts_with("waist")) continue;
      Curve curve = edge.curve;
      if (!(curve.end.u > curve.start.u)) continue;  // outlines run counter-clockwise: there is cloth below it
      if (std::fabs(Stand(*piece)(curve.atFraction(0.5)).y - waist->second) > kAtWaist) continue;
      if (!seamsOn(document, {{PieceRef(id), edge.name}}).empty()) return std::nullopt;
      const bool across = curve.start.u < -kOffCentre && curve.end.u > kOffCentre;
      if (across) curve = curve.part(curve.parameterAt(curve.length() / 2), 1);
      if (!half && curve.end.u <= kOffCentre) continue;
      run.push_back(curve);
    }
    if (run.empty()) continue;
    const bool towards = half && std::fabs(run.back().end.u) < std::fabs(run.front().start.u);  // the centre
    if (towards) {
      std::reverse(run.begin(), run.end());
      for (Curve& curve : run) curve = curve.reversed();
    }
    BlockWish::Waist found{run.front().length(), std::nullopt};
    for (std::size_t k = 1; k < run.size(); ++k) {
      if (!found.side && distance(run[k - 1].end, run[k].start) > kDartOpens) found.side = 0;
      (found.side ? *found.side : found.centre) += run[k].length();
    }
    return found;
  }
  return std::nullopt;
}
std::optional<BlockWish::Waists> openWaists(const Document& document, const Body& body) {
  const auto front = openWaist(document, body, "front"), back = openWaist(document, body, "back");
  return front && back ? std::optional(BlockWish::Waists{*front, *back}) : std::nullopt;
}

// What the waist of a skirt can be: not so loose that it would hold nowhere by itself.
bool isNearWaist(const BlockWish::Waists& waists, const Measured& of) {
  constexpr double kLooser = 0.08;  // metres
  return std::fabs(2 * (waists.front.whole() + waists.back.whole()) - skirtWaist(of)) < kLooser;
}

// A stand round the neckline that is there.
Result<Draft> collarFor(const Document& before, const BlockWish& wish) {
  std::vector<EdgeRef> run;
  for (const auto& [part, side] :
       {std::pair{"front", "right"}, {"back", "right"}, {"back", "left"}, {"front", "left"}}) {
    const auto edge = edgeThere(before, part, "neck", side);
    if (edge && std::find(run.begin(), run.end(), *edge) == run.end()) run.push_back(*edge);
  }
  if (run.size() < 2)
    return refused(say("There is no open neckline; a collar is drafted for edges called neck of a front and a back."));
  Draft draft;
  draft.bands = {collarBand(std::move(run), wish.length.value_or(0.035))};
  return draft;
}

}  // namespace

Done checkNumbers(const DraftBlock& block) {
  if (block.ease && !(*block.ease >= -0.3 && *block.ease <= kMostEase))
    return refused(say("The ease of a block lies between -30 cm, for cloth that stretches, and 100 cm."));
  if (block.length && !(*block.length >= 0 && *block.length <= 3))
    return refused(say("The length of a block lies between 0 and 3 m."));
  return {};
}

Done resolve(const Document& before, DraftBlock& op, Context& context) {
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  if (Done done = checkNumbers(op); !done) return done;
  if (!op.prefix.empty())
    if (Done done = checkName(op.prefix); !done) return done;
  if (op.layer < 0 || op.layer > 20) return refused(say("A layer is a number from 0, next to the skin, to 20."));
  if (op.kind == Kind::Leggings && op.fabric.empty()) op.fabric = "jersey";  // narrower than the body
  if (op.trued == Choice::Auto && !context.recorded) op.trued = Choice::Yes;
  const bool lower = op.kind == Kind::Skirt || op.kind == Kind::Trousers || op.kind == Kind::Leggings;
  if (op.belly == Choice::Auto && !context.recorded && lower) op.belly = Choice::Yes;
  if (op.worn == DraftBlock::Worn::Auto && !context.recorded && lower) op.worn = DraftBlock::Worn::Holds;
  const bool upper = op.kind == Kind::Bodice || op.kind == Kind::Shirt || op.kind == Kind::Sleeve;
  if (op.armhole == Choice::Auto && !context.recorded && upper) op.armhole = Choice::Yes;
  if ((op.knee || op.hem || op.legs == Choice::Yes) && op.kind != Kind::Trousers)
    return refused(
        say("Only trousers have a width at the knee and the hem of a leg; leave knee=, hem= and legs= away."));
  for (const auto& width : {op.knee, op.hem})
    if (width && !(*width >= 0.1 && *width <= 3)) return refused(say("A leg is 10 cm to 3 m wide."));
  if (op.legs == Choice::Auto && !context.recorded && op.kind == Kind::Trousers) op.legs = Choice::Yes;
  if (op.bothLegs == Choice::Yes && !DraftBlock::has(op.kind, "both_legs"))
    return refused(say("Only a skirt, a bodice and a shirt go round both legs; leave both_legs= away."));
  if (op.bothLegs == Choice::Auto && !context.recorded && DraftBlock::has(op.kind, "both_legs"))
    op.bothLegs = Choice::Yes;
  const bool sleeves = op.kind == Kind::Sleeve || op.kind == Kind::Shirt;
  if (op.taper == Choice::Yes && !sleeves) return refused(say("Only sleeves stand tapered; leave taper= away."));
  if (op.taper == Choice::Auto && !context.recorded && sleeves) op.taper = Choice::Yes;
  if (op.meets == Choice::Yes && !lower)
    return refused(say("Only a skirt, trousers and leggings meet a bodice at the waist; leave meets= away."));
  // Leggings, which are narrower than the body, only where that is asked for.
  const bool asked = op.kind != Kind::Leggings || op.meets == Choice::Yes;
  if (lower && asked && !context.recorded && op.meets != Choice::No) {
    const auto waists = openWaists(before, **body);
    if (op.meets == Choice::Yes && !waists)
      return refused(
          say("There is no open waist that it could meet; one is edges called hem or waist of a front "
              "and a back, at the height of the waist."));
    if (op.meets == Choice::Auto) {
      const bool held = op.worn == DraftBlock::Worn::Waist || op.worn == DraftBlock::Worn::Holds;
      op.meets = waists && held && isNearWaist(*waists, Measured(**body)) ? Choice::Yes : Choice::Auto;
      if (op.meets == Choice::Yes && op.kind == Kind::Trousers && context.advise)
        context.advise(
            {say("The trousers are as long at the waist as what is there above it, to be sewn to that; trousers "
                 "that are worn by themselves: meets=no.")});
    }
  }
  if (!op.fabric.empty()) return checkFabricName(before, op.fabric);
  return {};
}

Result<Document> perform(const Document& before, const DraftBlock& op, Context& context) {
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  const Measured of(**body);
  BlockWish wish;
  if (op.ease) wish.ease = op.ease->metres;
  if (op.length) wish.length = op.length->metres;
  wish.belly = op.belly == Choice::Yes;
  if (op.worn != DraftBlock::Worn::Auto) wish.worn = op.worn;
  wish.armhole = op.armhole == Choice::Yes;
  if (op.knee) wish.knee = op.knee->metres;
  if (op.hem) wish.hem = op.hem->metres;
  wish.legs = op.legs == Choice::Yes;
  if (op.meets == Choice::Yes) wish.meets = openWaists(before, **body);
  Result<Draft> draft = refused(say("There is no such block."));
  switch (op.kind) {
    case Kind::Bodice:
      draft = bodiceDraft(of, wish);
      break;
    case Kind::Shirt:
      draft = shirtDraft(of, wish);
      break;
    case Kind::Skirt:
      draft = skirtDraft(of, wish);
      break;
    case Kind::Trousers:
      draft = trousersDraft(of, wish);
      break;
    case Kind::Leggings:
      draft = leggingsDraft(of, wish);
      break;
    case Kind::Sleeve:
      draft = sleevesFor(before, of, wish);
      break;
    case Kind::Collar:
      draft = collarFor(before, wish);
      break;
  }
  if (!draft) return draft.error();
  if (draft->advice && context.advise) context.advise({*draft->advice});
  Made made(before, op, **body, context);
  if (Done done = made.take(*draft); !done) return done.error();
  return made.document();
}

}  // namespace karinui
