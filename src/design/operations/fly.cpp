// A fly: the zip of a seam with what lies behind it. The facing is the strip of the piece that lies over, beside the
// zip and round its lower end; it is caught in above and along the edge, and sewn to the piece along its inner line,
// the J that is stitched. The shield is a wider and longer strip of the same paper: the other edge's cloth goes on with
// it, beneath both.
#include <algorithm>
#include <cmath>

#include "design/operations/cut_parts.h"
#include "design/operations/down_edge.h"
#include "design/operations/lifted_form.h"
#include "design/operations/operations.h"
#include "design/operations/said.h"
#include "design/operations/sewn_runs.h"
#include "karinui/pattern/finish.h"

namespace karinui {

namespace {

constexpr double kLeastStraight = 0.01;                        // metres
constexpr double kBelowZip = 0.015;                            // metres that the facing ends below the zip
constexpr double kShieldWider = 0.005, kShieldLonger = 0.005;  // metres, than the facing
constexpr double kLeastZip = 0.05, kMostZip = 0.6;             // metres

// The strip of the piece beside its edge, so wide, which ends so far down in a quarter of a circle. Of the piece's
// edges it has a part of this one and of the one above.
Result<DividedPart> flyStrip(const DownEdge& over, double width, double down) {
  const Error noRoom = refused(say("“{0}” has no room for a fly that is {1} cm long and {2} cm wide beside {3}.",
                                   over.piece.name, centimetres(down), centimetres(width), over.edge.name));
  const double straight = down - width;
  if (!(straight > kLeastStraight && down < over.whole)) return noRoom;
  const EdgeSpan upper = over.span(0, straight);
  const auto split = splitEdge(over.piece, over.edge.name, over.down ? upper.to : upper.from);
  if (!split) return split.error();
  const auto& edges = split->piece.outline.edges;
  const std::size_t first = *split->piece.outline.find(over.edge.name);
  std::string above = edges[first].name, below = edges[(first + 1) % edges.size()].name;
  if (!over.down) std::swap(above, below);
  auto strip = facingOf(split->piece, {above}, width);
  if (!strip || strip->edges.size() != 3) return noRoom;
  const auto partOf = [&](const std::string& name) {
    return std::find_if(strip->edges.begin(), strip->edges.end(), [&](const auto& p) { return p.piece.edge == name; });
  };
  const auto low = partOf(below);
  if (partOf(above) == strip->edges.end() || low == strip->edges.end()) return noRoom;
  const double reached = straight + (low->piece.to - low->piece.from) * (over.whole - straight);
  // Both parts are one edge again, called as on the piece.
  Outline& outline = strip->outline;
  Edge& start = outline.edges[*outline.find((over.down ? partOf(above) : low)->own.edge)];
  const std::size_t next = *outline.find((over.down ? low : partOf(above))->own.edge);
  const Curve& goesOn = outline.edges[next].curve;
  const bool straightOn = start.curve.kind == Curve::Kind::Line && goesOn.kind == Curve::Kind::Line;
  start.curve =
      straightOn ? Curve::line(start.curve.start, goesOn.end) : Curve::joined(std::vector<Curve>{start.curve, goesOn});
  start.name = over.edge.name;
  outline.edges.erase(outline.edges.begin() + static_cast<std::ptrdiff_t>(next));
  std::erase_if(strip->edges, [&](const auto& part) { return part.piece.edge == above || part.piece.edge == below; });
  strip->edges.insert(over.down ? strip->edges.end() : strip->edges.begin(),
                      {over.span(0, reached), {{}, over.edge.name, 0, 1}});
  return strip;
}

double facedDown(const SewFly& op) { return op.length + kBelowZip; }

// The zip of a fly, all of it decided.
Fasten zipOf(const Document& document, const SewFly& op) {
  Fasten zip;
  zip.name = op.name;
  zip.kind = FasteningKind::Zip;
  zip.a = {op.a}, zip.b = {op.b};
  zip.reversed = Choice::Yes;  // the outlines of two pieces that lie side by side run against each other
  zip.from = downEdgeOf(document, op.a).down ? Fasten::From::Start : Fasten::From::End;
  zip.first = Length{0}, zip.length = op.length;
  zip.unpick = Choice::Yes;
  return zip;
}

// The pieces, seams and line of a fly, with ids counted on from those that the zip has made.
class FlyMade {
 public:
  FlyMade(const Document& before, const SewFly& op, Document zipped)
      : before_(before), op_(op), after_(std::move(zipped)) {
    while (after_.pattern.seams.contains(mint<SeamId>(before_, seams_))) ++seams_;
  }

  Result<Document> performed() {
    const PieceId over = op_.a.piece.id, under = op_.b.piece.id;
    for (int layers = op_.shield ? 2 : 1; layers > 0; --layers) {
      auto room = withLayersBeneath(std::move(after_), {over, under});
      if (!room) return room;
      after_ = *std::move(room);
    }
    const int layer = after_.find(over)->layer;
    const auto facing = add("facing", op_.width, facedDown(op_), layer - 1, kLayersApart);
    if (!facing) return facing.error();
    Piece faced = *after_.find(over);
    const std::string line = lineName(faced);
    faced.lines.push_back({line, {findEdge(*after_.find(facing->id), facing->strip.inner)->curve}, std::nullopt});
    after_ = withPiece(std::move(after_), std::move(faced));
    Seam caught;
    for (const DividedPart::EdgePart& part : facing->strip.edges)
      caught.a.push_back(part.piece), caught.b.push_back({facing->id, part.own.edge, 0, 1});
    caught.reversed = false;
    sew(std::move(caught));
    Seam stitched;
    stitched.a = {{over, line, 0, 1}}, stitched.b = {{facing->id, facing->strip.inner, 0, 1}};
    stitched.reversed = false;
    sew(std::move(stitched));
    if (op_.rows > 0) {
      Topstitch rows;
      rows.rows = op_.rows;
      if (op_.colour)
        rows.colour = std::uint32_t{op_.colour->red} << 16 | std::uint32_t{op_.colour->green} << 8 | op_.colour->blue;
      after_.allowances.topstitches[{over, line}] = rows;
    }
    if (!op_.shield) return std::move(after_);
    const int beneath = std::min(layer - 2, after_.find(under)->layer - 1);
    const auto shield =
        add("shield", op_.width + kShieldWider, facedDown(op_) + kShieldLonger, beneath, 2 * kLayersApart);
    if (!shield) return shield.error();
    Seam extended;  // the cloth of the edge beneath goes on with it
    extended.a = {downEdgeOf(after_, op_.b).span(0, findEdge(*after_.find(shield->id), op_.a.edge)->curve.length())};
    extended.b = {{shield->id, op_.a.edge, 0, 1}};
    sew(std::move(extended));
    after_.cutting[shield->id] = {2, true};  // outside and inside
    return std::move(after_);
  }

 private:
  struct Strip {
    PieceId id;
    DividedPart strip;
  };

  Result<Strip> add(const char* what, double width, double down, int layer, double apart) {
    const Piece outer = *after_.find(op_.a.piece.id);
    auto strip = flyStrip(downEdgeOf(after_, op_.a), width, down);
    if (!strip) return strip.error();
    Piece piece;
    piece.id = mint<PieceId>(before_, pieces_++);
    piece.name = usableName(after_, op_.name + "_" + what);
    piece.outline = strip->outline;
    piece.grain = outer.grain;
    piece.fabric = op_.fabric.empty() ? outer.fabric : op_.fabric;
    piece.layer = layer;
    piece.pose = outer.pose;
    auto form = liftedForm(piece, outer, before_.settings.spacing, [&](Flat place) {
      return LiftedPlace{place, -apart};
    });
    if (!form) return form.error();
    piece.form = *std::move(form);
    for (DividedPart::EdgePart& part : strip->edges) part.own.piece = piece.id;
    gradeParts(after_.grading, outer, strip->edges, piece);
    const PieceId id = piece.id;
    after_ = withPiece(std::move(after_), std::move(piece));
    return Strip{id, *std::move(strip)};
  }

  void sew(Seam seam) {
    seam.id = mint<SeamId>(before_, seams_++);
    seam.tie = Seam::Tie::Pleat;  // the edge is sewn to others as well
    after_.pattern.seams[seam.id] = std::move(seam);
  }

  std::string lineName(const Piece& piece) const {
    const std::string wanted = op_.name + "_line";
    std::string name = wanted;
    const auto taken = [&] {
      return findEdge(piece, name) || std::any_of(piece.lines.begin(), piece.lines.end(),
                                                  [&](const InternalLine& line) { return line.name == name; });
    };
    for (int n = 2; taken(); ++n) name = wanted + "_" + std::to_string(n);
    return name;
  }

  const Document& before_;
  const SewFly& op_;
  Document after_;
  std::uint32_t pieces_ = 0, seams_ = 0;
};

}  // namespace

Done resolve(const Document& before, SewFly& op, Context& context) {
  for (EdgeRef* edge : {&op.a, &op.b}) {
    edge->from = 0, edge->to = 1;
    if (Done done = resolve(before, *edge); !done) return done;
    if (!before.find(edge->piece.id)->outline.find(edge->edge))
      return refused(say("A fly is sewn between two edges of outlines; {0} is none.", edge->edge));
  }
  if (op.a == op.b) return refused(say("An edge cannot be fastened to itself."));
  if (Done done = checkName(op.name); !done) return done;
  if (!(op.length >= kLeastZip && op.length <= kMostZip)) return refused(say("The zip of a fly is 5 to 60 cm long."));
  if (!(op.width >= 0.015 && op.width <= 0.1)) return refused(say("A fly is stitched 1.5 to 10 cm from its edge."));
  if (op.rows < 0 || op.rows > kMostRows) return refused(say("A fly is stitched in 0 to {0} rows.", kMostRows));
  if (op.colour && op.rows == 0) return refused(say("Where no row is to be seen leave the colour of the thread away."));
  if (!op.fabric.empty())
    if (Done done = checkFabricName(before, op.fabric); !done) return done;
  Context silent = context;
  silent.advise = {};
  Fasten zip = zipOf(before, op);
  if (Done done = resolve(before, zip, silent); !done) return done;
  const DownEdge over = downEdgeOf(before, op.a);
  for (const double more : {0.0, op.shield ? 1.0 : 0.0}) {
    const auto strip = flyStrip(over, op.width + more * kShieldWider, facedDown(op) + more * kShieldLonger);
    if (!strip) return strip.error();
  }
  if (const double under = downEdgeOf(before, op.b).whole; op.shield && under < facedDown(op) + kShieldLonger)
    return refused(say("{0} is {1} cm long; the shield of this fly takes {2} cm of it.", op.b.edge, centimetres(under),
                       centimetres(facedDown(op) + kShieldLonger)));
  return {};
}

Result<Document> perform(const Document& before, const SewFly& op, Context& context) {
  auto zipped = perform(before, zipOf(before, op), context);
  if (!zipped) return zipped;
  return FlyMade(before, op, *std::move(zipped)).performed();
}

}  // namespace karinui
