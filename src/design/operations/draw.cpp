#include <algorithm>
#include <cmath>
#include <numbers>

#include "design/operations/drawn_sheet.h"
#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/design/drawing.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {
namespace {

constexpr double kNearlyMeet = 0.015;                    // metres: ends this near are one
constexpr double kUsualDart = 0.06;                      // metres
constexpr double kShortestDart = 0.015;                  // metres: a shorter one would take nothing in
constexpr double kCorner = 35 * std::numbers::pi / 180;  // a line that turns more has a corner
constexpr double kSquaredUpTo = 0.75;                    // radians, 43 degrees: steeper a half line is a V
constexpr double kSquaredBefore = 0.6;                   // radians: the same, in documents of before `level`
constexpr double kSteepest = 80 * std::numbers::pi / 180;
constexpr std::string_view kCurvesOn = "~";

std::string millimetres(double metres) { return fixed(metres * 1000, 1); }

Result<std::vector<SurfacePoint>> placesOf(const Body& body, const std::vector<BodyPoint>& line) {
  std::vector<SurfacePoint> places;
  for (const BodyPoint& point : line) {
    const auto place = body.find(point);
    if (!place) return place.error();
    places.push_back(*place);
  }
  return places;
}

// How far the line turns at a place, in the surface.
Result<double> turnAt(const DrawingGround& ground, const SurfacePoint& before, const SurfacePoint& here,
                      const SurfacePoint& next) {
  const auto in = ground.guide.straight(before, here), out = ground.guide.straight(here, next);
  if (!in) return in.error();
  if (!out) return out.error();
  const auto reach = [&](const SurfacePath& path, double metres) {
    return path.length > 0 ? along(ground.mesh, path, std::fmin(1.0, metres / path.length)) : path.places.front();
  };
  const Vec3 p = at(ground.mesh, here);
  const Vec3 a = p - at(ground.mesh, reach(reversed(*in), 0.01)), b = at(ground.mesh, reach(*out, 0.01)) - p;
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// Makes `edges` speak of every place: a name where an edge begins, ~ where the line curves on.
Done nameEdges(DrawPiece& draw, const DrawingGround& ground, const std::vector<SurfacePoint>& places) {
  const std::size_t n = places.size(), last = draw.symmetric ? n - 1 : n;  // a half's last place begins the centre
  std::vector<std::string> names = draw.edges;
  const bool oneByOne = names.size() == n || (draw.symmetric && names.size() == n - 1);
  if (!oneByOne) {
    std::vector<bool> corner(n, false);
    corner[0] = true;
    for (std::size_t i = 1; i < last; ++i) {
      const auto turn = turnAt(ground, places[i - 1], places[i], places[(i + 1) % n]);
      if (!turn) return turn.error();
      corner[i] = *turn > kCorner;
    }
    const auto corners =
        static_cast<std::size_t>(std::count(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(last), true));
    if (!names.empty() && names.size() != corners)
      return refused(
          say("There {0|is|are} {0} {0|name|names} for {1} {1|edge|edges}: the line turns sharply at {1} of its "
              "places. Name each place's "
              "edge, with ~ where the line curves on.",
              names.size(), corners));
    std::vector<std::string> spread(last, std::string(kCurvesOn));
    std::size_t next = 0;
    for (std::size_t i = 0; i < last; ++i)
      if (corner[i]) {
        spread[i] = names.empty() ? "e" + written(next + 1) : names[next];
        ++next;
      }
    names = std::move(spread);
  }
  names.resize(last);
  if (names.front() == kCurvesOn)
    return refused(say("The first place of a line begins an edge: give it a name, not ~."));
  std::vector<std::string> seen;
  for (const std::string& name : names) {
    if (name == kCurvesOn) continue;
    const bool good = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    if (!good) return refused(say("\"{0}\" cannot be an edge's name: use letters, digits, _ and -.", name));
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
      return refused(say("Two edges are called {0}; each needs a name of its own.", name));
    seen.push_back(name);
  }
  draw.edges = std::move(names);
  return {};
}

// Leaves nothing open but the piece's name: ends that nearly meet become one, every place's edge is named.
Done settleLine(DrawPiece& draw, const DrawingGround& ground, const Body& body) {
  for (const BodyPoint& point : draw.line)
    if (const auto place = body.find(point); !place) return place.error();
  if (draw.symmetric && draw.mirror)
    return refused(say("A symmetric piece is its own mirror image: choose symmetric or mirror, not both."));
  if (draw.level && !(draw.level->radians >= 0 && draw.level->radians <= kSteepest))
    return refused(say("A line is led square to the centre up to {0} degrees, not up to {1}.",
                       fixed(kSteepest * 180 / std::numbers::pi, 0),
                       fixed(draw.level->radians * 180 / std::numbers::pi, 1)));
  if (!draw.symmetric && draw.square == Choice::Yes)
    return refused(say("Only a half line crosses the centre square: choose symmetric, or leave square away."));
  auto places = placesOf(body, draw.line);
  if (!places) return places.error();
  if (!draw.symmetric && draw.line.size() >= 2) {
    const auto closing = ground.guide.straight(places->back(), places->front());
    if (!closing) return closing.error();
    if (!draw.closed && closing->length > kNearlyMeet)
      return refused(say("The line is open: its ends are {0} mm apart. End it within {1} mm of where it began.",
                         millimetres(closing->length), millimetres(kNearlyMeet)));
    if (closing->length <= kNearlyMeet && draw.line.size() > 3) {
      if (draw.edges.size() == draw.line.size()) draw.edges.pop_back();
      draw.line.pop_back();
      places->pop_back();
    }
  }
  draw.closed = true;
  if (draw.line.size() < 3) return refused(say("A line needs at least three places to hold a piece of cloth."));
  return nameEdges(draw, ground, *places);
}

Message strainSaid(const DrawnSheet& sheet) {
  const std::string stretch = fixed(100 * std::fmax(sheet.distortion.warp.p99, sheet.distortion.weft.p99), 1),
                    shear = fixed(sheet.distortion.shear.p99 * 180 / std::numbers::pi, 0),
                    high = fixed(sheet.worst.y * 100, 0);
  if (sheet.cutLength < kShortestDart)
    return say(
        "Cloth cannot lie as drawn: it would stretch by up to {0} % and shear by {1} {1|degree|degrees}, most {2} cm "
        "above the "
        "floor, at “{3}”. Another course of that edge, or a seam through there, would help.",
        stretch, shear, high, sheet.nearestEdge);
  return say(
      "Cloth cannot lie as drawn: it would stretch by up to {0} % and shear by {1} {1|degree|degrees}, most {2} cm "
      "above the "
      "floor. A dart or cut from “{3}”, {4} cm long, would help.",
      stretch, shear, high, sheet.nearestEdge, fixed(sheet.cutLength * 100, 0));
}

FairEdges withFairEdge(const Piece& piece, std::size_t edge) {
  FairEdges fair;
  fair.edges = {EdgeRef{PieceRef(), piece.outline.edges[edge].name}};
  fair.edges.front().piece.name = piece.name;
  return fair;
}

double wholeMillimetres(double metres) { return std::round(metres * 1e3) / 1e3; }
Flat wholeMillimetres(Flat place) { return {wholeMillimetres(place.u), wholeMillimetres(place.v)}; }

// A dart where paper is too wide for the drawn shape, a cut where it is too narrow.
std::optional<Operation> cutOrDart(const Piece& piece, const DrawnSheet& sheet, const Edge& edge, double share) {
  const double t = edge.curve.parameterAt(share * edge.curve.length());
  const Flat mouth = edge.curve.at(t);
  // Strained at the edge itself: a usual dart, straight in.
  Flat tip = sheet.worstFlat;
  if (sheet.cutLength < kShortestDart) tip = mouth + leftOf(normalized(edge.curve.tangent(t))) * kUsualDart;
  tip = wholeMillimetres(tip);
  if (!contains(piece.outline.flattened(2e-4), tip)) return std::nullopt;
  if (sheet.shrunk > 0) {
    AddDart dart;
    dart.edge = EdgeRef{PieceRef(), edge.name};
    dart.edge.piece.name = piece.name;
    dart.at = share;
    dart.tip = tip;
    dart.width = Length{wholeMillimetres(std::clamp(2 * distance(mouth, tip) * sheet.shrunk, 0.01, 0.04))};
    return dart;
  }
  CutPiece cut;
  cut.piece.name = piece.name;
  cut.line = {wholeMillimetres(mouth + normalized(mouth - tip) * 0.01), tip};
  return cut;
}

std::vector<Advice> adviceOn(const DrawnSheet& sheet, const Piece& piece) {
  std::vector<Advice> all;
  const auto& edges = piece.outline.edges;
  if (sheet.distortion.gate == Distortion::Gate::Red) {
    Advice advice{strainSaid(sheet), {}, {}, sheet.worstFlat, {}};
    std::size_t nearest = 0;
    double share = 0, least = 1e9;
    // The edge that the sentence names; both halves of it are called after it.
    const auto meant = [&](const Edge& edge) {
      return edge.name == sheet.nearestEdge || edge.name.starts_with(sheet.nearestEdge + "_");
    };
    const bool any = std::any_of(edges.begin(), edges.end(), meant);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (any && !meant(edges[k])) continue;
      constexpr int kSteps = 100;
      const std::vector<Flat> points = edges[k].curve.evenly(0, 1, kSteps);
      for (int i = 0; i <= kSteps; ++i)
        if (const double d = distance(points[static_cast<std::size_t>(i)], sheet.worstFlat); d < least)
          least = d, nearest = k, share = static_cast<double>(i) / kSteps;
    }
    advice.edge = edges[nearest].name;
    share = std::clamp(share, 0.1, 0.9);
    if (wavers(edges[nearest].curve) > 0 && sheet.cutLength < kShortestDart)
      advice.mend = withFairEdge(piece, nearest);
    else
      advice.mend = cutOrDart(piece, sheet, edges[nearest], share);
    all.push_back(std::move(advice));
  }
  const auto symmetry = symmetryOf(piece.outline);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (symmetry && symmetry->partner[k] < k) continue;  // told of its partner
    if (wavers(edges[k].curve) == 0) continue;
    Advice advice{say("The edge “{0}” of “{1}” wavers more than cloth follows; a fair line would sew better.",
                      edges[k].name, piece.name),
                  {},
                  edges[k].name,
                  edges[k].curve.atFraction(0.5),
                  withFairEdge(piece, k)};
    all.push_back(std::move(advice));
  }
  return all;
}

}  // namespace

Result<DrawnPiece> drawn(const Document& document, const DrawPiece& given, Context& context) {
  DrawPiece draw = given;
  const auto body = bodyOf(document, context);
  if (!body) return body.error();
  const DrawingGround ground((*body)->mesh(), (*body)->bvh());
  if (auto fine = settleLine(draw, ground, **body); !fine) return fine.error();
  const auto places = placesOf(**body, draw.line);
  if (!places) return places.error();

  DrawnPiece out;
  out.piece.name = draw.name;
  if (!draw.fabric.empty()) out.piece.fabric = draw.fabric;
  out.piece.layer = draw.layer;
  const auto fabric = fabricOf(document, out.piece);
  if (!fabric) return fabric.error();

  DrawnLine line;
  line.places = *places;
  line.symmetric = draw.symmetric;
  if (draw.square == Choice::Yes) line.square = draw.level ? draw.level->radians : kSquaredBefore;
  for (const std::string& name : draw.edges) line.edges.push_back(name == kCurvesOn ? "" : name);
  line.edges.resize(line.places.size());
  if (draw.inside) {
    const auto place = (*body)->find(*draw.inside);
    if (!place) return place.error();
    line.inside = *place;
  }
  DrawnSettings settings;
  settings.ease = draw.ease ? draw.ease->metres : document.settings.ease;
  if (!(settings.ease >= 0 && settings.ease <= 0.2))
    return refused(say("An ease of {0} mm is not between 0 and 200 mm.", millimetres(settings.ease)));
  settings.flatten.warp = fabric->stretchWarp;
  settings.flatten.weft = fabric->stretchWeft;
  settings.flatten.shear = fabric->shear;
  auto sheet = drawnSheet(ground, line, settings, context.token);
  if (!sheet) return sheet.error();
  auto outline = checked(std::move(sheet->outline));
  if (!outline) return outline.error();
  out.piece.outline = std::move(*outline);
  out.piece.form = sheet->form;
  out.distortion = sheet->distortion;
  out.advice = adviceOn(*sheet, out.piece);
  return out;
}

Done resolve(const Document& before, DrawPiece& draw, Context& context) {
  if (auto fine = checkNewName(before, draw.name); !fine) return fine;
  if (draw.layer < 0 || draw.layer > 20) return refused(say("A layer is a number from 0, next to the skin, to 20."));
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  const DrawingGround ground((*body)->mesh(), (*body)->bvh());
  if (auto fine = settleLine(draw, ground, **body); !fine) return fine;
  if (!draw.ease) draw.ease = Length{before.settings.ease};
  if (draw.symmetric && draw.square == Choice::Auto && !context.recorded) draw.square = Choice::Yes;
  if (draw.square == Choice::Yes && !draw.level && !context.recorded) draw.level = Angle{kSquaredUpTo};
  if (!draw.fabric.empty()) return checkFabricName(before, draw.fabric);
  return {};
}

Result<Document> perform(const Document& before, const DrawPiece& draw, Context& context) {
  auto made = drawn(before, draw, context);
  if (!made) return made.error();
  Piece piece = std::move(made->piece);
  piece.id = mint<PieceId>(before, 0);
  for (Advice& advice : made->advice) {
    advice.piece = piece.id;
    if (context.advise) context.advise(advice);
  }
  std::optional<Piece> copy;
  if (draw.mirror) {
    copy = mirrored(piece);
    copy->id = mint<PieceId>(before, 1);
    copy->mirrorOf = piece.id;
    copy->name = otherSide(piece.name);
    if (copy->name == piece.name) copy->name += "_mirror";
    if (auto fine = checkNewName(before, copy->name); !fine) return fine.error();
  }
  Document after = withPiece(before, std::move(piece));
  return copy ? withPiece(std::move(after), std::move(*copy)) : after;
}

}  // namespace karinui
