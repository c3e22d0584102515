// A piece stood along a run of edges: a collar along its neckline, a waistband along a skirt.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "design/operations/limb.h"
#include "design/operations/new_piece.h"
#include "design/operations/strap_way.h"
#include "design/sewn_corners.h"
#include "karinui/design/edge_run.h"
#include "karinui/design/sewing.h"
#include "karinui/pattern/lattice.h"

namespace karinui {

namespace {

constexpr int kPlaces = 120;               // of a run
constexpr double kInside = 0.008;          // metres from the edge at which the cloth's direction is taken
constexpr double kMeet = 0.02;             // metres: ends in space this near follow each other
constexpr double kClear = 0.004;           // metres a stood piece keeps from the body
constexpr double kRoom = 0.015;            // metres from the body
constexpr int kWide = 5;                   // places about one from which what is turned back takes its direction
constexpr int kTurns = 13;                 // directions tried, up to a right angle outwards
constexpr double kBothLegs = 0.2;          // of a run's places by either leg: it goes round both
constexpr double kHips = 1, kArmpits = 6;  // levels of the trunk between which it is gone round

const Edge& edgeAt(const Document& document, const EdgeRef& ref, int beside = 0) {
  const auto& edges = document.find(ref.piece.id)->outline.edges;
  const std::size_t n = edges.size(), k = *document.find(ref.piece.id)->outline.find(ref.edge);
  return edges[(k + n + static_cast<std::size_t>(beside + static_cast<int>(n))) % n];
}

Vec3 endOf(const Document& document, const EdgeRef& ref, bool last) {
  const Curve& curve = edgeAt(document, ref).curve;
  return Stand(*document.find(ref.piece.id))(curve.atFraction(last ? ref.to : ref.from));
}

// Whether the edges beside the end of `ref` and the beginning of `next` are joined by one of these seams or fastenings.
template <class Joins>
bool joinedBeside(const Joins& joins, const Document& document, const EdgeRef& ref, const EdgeRef& next) {
  const std::string &after = edgeAt(document, ref, 1).name, &before = edgeAt(document, next, -1).name;
  const auto holds = [](const std::vector<EdgeSpan>& side, PieceId piece, const std::string& edge) {
    return std::any_of(side.begin(), side.end(),
                       [&](const EdgeSpan& span) { return span.piece == piece && span.edge == edge; });
  };
  return std::any_of(joins.begin(), joins.end(), [&](const auto& one) {
    const auto& join = one.second;
    return (holds(join.a, ref.piece.id, after) && holds(join.b, next.piece.id, before)) ||
           (holds(join.b, ref.piece.id, after) && holds(join.a, next.piece.id, before));
  });
}

// Whether `next` goes on where `ref` ends: on the same outline, across a seam that begins there, or by lying there.
bool follows(const Document& document, const EdgeRef& ref, const EdgeRef& next) {
  const bool whole = ref.to == 1 && next.from == 0;
  if (ref.piece == next.piece && ref.edge == next.edge && ref.to == next.from) return true;
  if (ref.piece == next.piece && whole && edgeAt(document, ref, 1).name == next.edge) return true;
  if (distance(endOf(document, ref, true), endOf(document, next, false)) < kMeet) return true;
  return whole && joinedBeside(document.pattern.seams, document, ref, next);
}

std::size_t links(const Document& document, const std::vector<EdgeRef>& run) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < run.size(); ++i) count += follows(document, run[i], run[i + 1]) ? 1 : 0;
  return count;
}

// "neck_left", "neck_right", "neck_2" and "neck" are called alike.
std::string_view stem(std::string_view name) {
  const std::size_t bar = name.rfind('_');
  if (bar == std::string_view::npos || bar == 0) return name;
  const std::string_view end = name.substr(bar + 1);
  const bool number = !end.empty() && std::all_of(end.begin(), end.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number || end == "left" || end == "right" ? stem(name.substr(0, bar)) : name;
}

struct Along {
  double share = 0, off = 0;  // along the edge; to its left, metres
  double beyond = 0;          // metres past the end of the edge, along its direction there; before its start negative
};

// Where places of a piece lie along one of its edges.
class AlongEdge {
 public:
  explicit AlongEdge(const Curve& curve) : line_(curve.evenly(0, 1, kPlaces)) {}
  Along operator()(Flat p, bool beyond) const {
    Along best;
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      const Flat way = line_[i + 1] - line_[i];
      const double t = std::clamp(dot(p - line_[i], way) / dot(way, way), 0.0, 1.0);
      const double d = distance(p, line_[i] + way * t);
      if (d < least - 1e-12) {
        least = d;
        best = {(static_cast<double>(i) + t) / kPlaces, std::copysign(d, cross(way, p - line_[i]))};
      }
    }
    if (!beyond || (best.share > 0 && best.share < 1)) return best;
    const bool last = best.share > 0;
    const Flat end = last ? line_.back() : line_.front();
    const Flat way = normalized(last ? end - line_[line_.size() - 2] : line_[1] - end);
    return {best.share, cross(way, p - end), dot(p - end, way)};
  }

 private:
  std::vector<Flat> line_;
};

// Whether a piece has cloth beyond the ends of an edge.
bool goesBeyond(const Piece& piece, const std::string& edge) {
  constexpr double kBeyond = 0.01, kFine = 0.001;  // metres
  const AlongEdge along(piece.outline.edges[*piece.outline.find(edge)].curve);
  const Ring ring = piece.outline.flattened(kFine);
  return std::any_of(ring.begin(), ring.end(), [&](Flat p) { return std::fabs(along(p, true).beyond) > kBeyond; });
}

// By how much a piece is turned outwards at each place of a run.
class TurnsAlong {
 public:
  TurnsAlong(const SpaceRun& run, const std::vector<Vec3>& on, const std::vector<Vec3>& out, double depth)
      : run_(run), on_(on), out_(out), depth_(depth), turns_(run.place.size()) {}

  // Outwards from `turn` on, so that it keeps clear of the body.
  std::vector<double> outwards(double turn, const Body& body) {
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      double best = -1;
      for (int t = 0; t < kTurns && best < kClear; ++t) {
        const double angle = turn + t * std::numbers::pi / 2 / (kTurns - 1),
                     clear = clearance(k, angle, &body, nullptr);
        if (clear > best) best = clear, turns_[k] = angle;
      }
    }
    return smooth([](double a, double b) { return std::fmax(a, b); });
  }

  // Turned back beyond a right angle towards `turn`, until it would meet the body or other cloth.
  std::vector<double> turnedBack(double turn, const Body* body, const Bvh* cloth) {
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      turns_[k] = std::numbers::pi / 2;
      for (int t = 1; t < kTurns; ++t) {
        const double angle = std::lerp(std::numbers::pi / 2, turn, t / double{kTurns - 1});
        if (clearance(k, angle, body, cloth) < kClear) break;
        turns_[k] = angle;
      }
    }
    return smooth([](double a, double b) { return std::fmin(a, b); });
  }

 private:
  double clearance(std::size_t k, double angle, const Body* body, const Bvh* cloth) const {
    double least = 1;
    for (const double d : {0.25, 0.5, 0.75, 1.0}) {
      const Vec3 place = run_.place[k] + (on_[k] * std::cos(angle) + out_[k] * std::sin(angle)) * (depth_ * d);
      if (body) least = std::fmin(least, body->bvh().signedDistance(place));
      if (const auto near = cloth ? cloth->nearest(place, kClear) : std::nullopt)
        least = std::fmin(least, near->distance);
    }
    return least;
  }

  // What the neighbourhood needs most, then its mean: every place gets what it needs.
  template <class Most>
  std::vector<double> smooth(Most&& most) const {
    const auto n = static_cast<int>(turns_.size());
    const auto at = [&](const std::vector<double>& all, int k) {
      return all[static_cast<std::size_t>(run_.closed ? (k + n) % n : std::clamp(k, 0, n - 1))];
    };
    std::vector<double> needed = turns_, mean = turns_;
    for (int k = 0; k < n; ++k)
      for (int d = -4; d <= 4; ++d) {
        double& here = needed[static_cast<std::size_t>(k)];
        here = most(here, at(turns_, k + d));
      }
    for (int k = 0; k < n; ++k) {
      double sum = 0;
      for (int d = -4; d <= 4; ++d) sum += at(needed, k + d);
      mean[static_cast<std::size_t>(k)] = sum / 9;
    }
    return mean;
  }

  const SpaceRun& run_;
  const std::vector<Vec3>&on_, &out_;
  double depth_;
  std::vector<double> turns_;
};

std::optional<BodyPoint> skinBeside(const Body& body, Vec3 place) {
  const auto skin = body.bvh().nearest(place);
  return skin ? std::optional(body.describe(skin->place)) : std::nullopt;
}

// The part of the body that most of a run lies by. What goes round both legs goes round the trunk, farther down.
BodyPoint::Part partWithin(const SpaceRun& run, const Body& body) {
  std::map<BodyPoint::Part, std::size_t> count;
  for (const Vec3 place : run.place)
    if (const auto skin = skinBeside(body, place)) ++count[skin->part];
  const auto many = [&](BodyPoint::Part part) {
    return static_cast<double>(count[part]) > kBothLegs * static_cast<double>(run.place.size());
  };
  if (many(BodyPoint::Part::LeftLeg) && many(BodyPoint::Part::RightLeg)) return BodyPoint::Part::Torso;
  return std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

// The place on a part of the body that is nearest to one in space.
std::optional<BodyPoint> placeOn(const Body& body, BodyPoint::Part part, Vec3 wished) {
  std::optional<BodyPoint> best;
  double least = 1e9;
  for (const LimbRing& ring : ringsOf(body, part)) {
    if (part == BodyPoint::Part::Torso && !(ring.along >= kHips && ring.along <= kArmpits)) continue;
    for (const Vec3 skin : ring.skin) {
      if (distance(skin, wished) >= least) continue;
      if (const auto place = skinBeside(body, skin); place && place->part == part)
        least = distance(skin, wished), best = place;
    }
  }
  if (best) {  // in thousandths, to be read in a record
    best->along = std::round(best->along * 1000) / 1000;
    best->around = std::fmod(std::round(best->around * 1000) / 1000, 1);
  }
  return best;
}

}  // namespace

std::unique_ptr<Bvh> standingSheets(const Document& document, const std::set<PieceId>& without) {
  TriangleMesh cloth;
  for (const auto& [id, piece] : document.pattern.pieces) {
    if (without.contains(id) || !piece->form) continue;
    const auto first = static_cast<std::uint32_t>(cloth.points.size());
    for (const Vec3 p : piece->form->space) cloth.points.push_back(piece->pose(p));
    for (auto face : piece->form->faces) {
      for (auto& corner : face) corner += first;
      cloth.faces.push_back(face);
    }
  }
  return cloth.faces.empty() ? nullptr : std::make_unique<Bvh>(cloth);
}

Done decideRound(const Document& before, const std::vector<EdgeRef>& edges, std::optional<BodyPoint>& round,
                 Context& context) {
  if (!before.body.chosen() || (!round && context.recorded)) return {};
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  if (round) {
    const auto place = (*body)->find(*round);
    return place ? Done() : Done(place.error());
  }
  const SpaceRun run = runOf(before, edges);
  if (run.together()) return {};
  const Vec3 middle = run.place[run.place.size() / 2];
  const auto beside = skinBeside(**body, middle);
  if (!beside || !isLimb(beside->part)) return {};
  if (const auto part = partWithin(run, **body); part != beside->part) round = placeOn(**body, part, middle);
  return {};
}

void decideClear(double turn, Choice& clear, const Context& context) {
  if (clear == Choice::Auto && !context.recorded && turn > std::numbers::pi / 2) clear = Choice::Yes;
}

bool opensSomewhere(const Document& document, const std::vector<EdgeRef>& run) {
  if (run.size() < 2 || !follows(document, run.back(), run.front())) return false;
  for (std::size_t k = 0; k < run.size(); ++k)
    if (!goesOnSewn(document, run[k], run[(k + 1) % run.size()])) return true;
  return false;
}

std::vector<EdgeRef> fromOpening(const Document& document, std::vector<EdgeRef> run) {
  if (!follows(document, run.back(), run.front())) return run;
  for (std::size_t k = 0; k < run.size(); ++k) {
    const std::size_t before = (k + run.size() - 1) % run.size();
    if (goesOnSewn(document, run[before], run[k])) continue;
    std::rotate(run.begin(), run.begin() + static_cast<std::ptrdiff_t>(k), run.end());
    break;
  }
  return run;
}

bool opensBetween(const Document& document, const EdgeRef& ref, const EdgeRef& next) {
  return !goesOnSewn(document, ref, next) && (joinedBeside(document.pattern.seams, document, ref, next) ||
                                              joinedBeside(document.allowances.fastenings, document, ref, next));
}

bool closesRing(const Document& document, const std::vector<EdgeRef>& run) {
  return follows(document, run.back(), run.front());
}

std::optional<std::vector<EdgeRef>> asOneRun(const Document& document, const std::vector<EdgeRef>& edges) {
  if (links(document, edges) + 1 == edges.size()) return edges;
  const auto first = std::find_if(edges.begin(), edges.end(), [&](const EdgeRef& edge) {
    return std::none_of(edges.begin(), edges.end(),
                        [&](const EdgeRef& other) { return other != edge && follows(document, other, edge); });
  });
  std::vector<EdgeRef> left = edges, run;
  std::size_t next = first == edges.end() ? 0 : static_cast<std::size_t>(first - edges.begin());  // of a ring any
  for (;;) {
    run.push_back(left[next]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
    if (left.empty()) return fromOpening(document, std::move(run));
    const auto on = std::find_if(left.begin(), left.end(),
                                 [&](const EdgeRef& edge) { return follows(document, run.back(), edge); });
    if (on == left.end()) return std::nullopt;
    next = static_cast<std::size_t>(on - left.begin());
  }
}

Done orderRun(const Document& before, std::vector<EdgeRef>& run) {
  for (EdgeRef& edge : run)
    if (Done done = resolve(before, edge); !done) return done;
  if (run.empty()) return refused(say("Say the run of edges: of=front.neck, or several, joined end to end."));
  for (std::size_t i = 0; i < run.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(run[i], run[j])) return refused(say("The edge {0} is in the run twice.", run[i].edge));
  std::vector<EdgeRef> turned(run.rbegin(), run.rend());
  if (links(before, turned) > links(before, run)) run = std::move(turned);
  if (auto chained = asOneRun(before, run)) run = *std::move(chained);
  for (std::size_t i = 0; i + 1 < run.size(); ++i)
    if (!follows(before, run[i], run[i + 1]))
      return refused(say("{0}.{1} does not go on as {2}.{3}: they neither meet nor are they joined by a seam there.",
                         before.find(run[i].piece.id)->name, run[i].edge, before.find(run[i + 1].piece.id)->name,
                         run[i + 1].edge));
  return {};
}

std::vector<EdgeRef> runThrough(const Document& document, const EdgeRef& edge) {
  std::vector<EdgeRef> run{{edge.piece, edge.edge}}, open;
  if (!seamsOn(document, run).empty()) return run;
  for (const auto& [id, piece] : document.pattern.pieces)
    for (const Edge& one : piece->outline.edges) {
      const EdgeRef ref{PieceRef(id), one.name};
      if (ref != run.front() && stem(one.name) == stem(edge.edge) && seamsOn(document, {ref}).empty())
        open.push_back(ref);
    }
  for (bool more = true; more;) {
    more = false;
    for (auto next = open.begin(); next != open.end() && !more; ++next) {
      const bool behind = follows(document, run.back(), *next);
      if (!behind && !follows(document, *next, run.front())) continue;
      run.insert(behind ? run.end() : run.begin(), *next);
      open.erase(next);
      more = true;
    }
  }
  return fromOpening(document, std::move(run));
}

SpaceRun runOf(const Document& document, const std::vector<EdgeRef>& run) {
  SpaceRun out;
  out.length = lengthOf(document, run);
  out.closed = follows(document, run.back(), run.front());
  // Where the ends of two edges stand apart, both are led to the middle between them.
  const std::size_t n = run.size();
  std::vector<Vec3> gap(n);
  for (std::size_t i = 0; i < n; ++i)
    if (i + 1 < n || out.closed) {
      gap[i] = (endOf(document, run[(i + 1) % n], false) - endOf(document, run[i], true)) * 0.5;
      out.apart = std::fmax(out.apart, 2 * length(gap[i]));
    }
  double done = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Stand stand(*document.find(run[i].piece.id));
    const Curve& curve = edgeAt(document, run[i]).curve;
    const double part = lengthOf(document, {run[i]});
    for (; next <= kPlaces; ++next) {
      const double s = out.length * static_cast<double>(next) / kPlaces - done;
      if (s > part + 1e-12 && i + 1 < n) break;
      const double share = std::fmin(1, s / part);
      const double t = curve.parameterAt((run[i].from + (run[i].to - run[i].from) * share) * curve.length());
      const Flat p = curve.at(t), inwards = leftOf(normalized(curve.tangent(t))) * kInside;
      const Vec3 place = stand(p);
      const Vec3 before = i > 0 || out.closed ? gap[(i + n - 1) % n] : Vec3{};
      out.onward.push_back(normalized(place - stand(p + inwards)));
      out.place.push_back(place + gap[i] * share - before * (1 - share));
    }
    done += part;
  }
  return out;
}

Result<Piece> attached(const Document& document, Piece piece, const std::string& edge, const SpaceRun& run,
                       const FoldedOn& fold, const Body* body) {
  const Curve& curve = piece.outline.edges[*piece.outline.find(edge)].curve;
  const AlongEdge alongEdge(curve);
  const auto laid = layAlone(piece, document.settings.spacing);
  if (!laid) return laid.error();
  auto form = std::make_shared<Form>();
  form->flat = (*laid)->nodes;
  form->faces = (*laid)->faces;
  std::vector<Along> on;
  double depth = 0;
  for (const Flat p : form->flat) on.push_back(alongEdge(p, fold.beyond)), depth = std::fmax(depth, on.back().off);

  // Frames along the run: onwards at right angles to it, and outwards from the cloth. What is turned back lies over all
  // of the run, small waves of a draped edge would toss it to and fro.
  const auto n = static_cast<int>(run.place.size());
  const bool back = fold.clear && fold.turn > std::numbers::pi / 2;
  const int wide = back ? kWide : 1;
  std::vector<Vec3> way(run.place.size()), onward(run.place.size()), out(run.place.size());
  for (int k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const int last = n - 1;
    const auto place = [&](int j) {
      return run.place[static_cast<std::size_t>(run.closed ? (j + last) % last : std::clamp(j, 0, last))];
    };
    way[at] = normalized(place(k + wide) - place(k - wide));
    Vec3 mean;
    for (int d = -3 * wide; d <= 3 * wide; ++d)
      mean += run.onward[static_cast<std::size_t>(run.closed ? (k + d + 3 * last) % last : std::clamp(k + d, 0, last))];
    onward[at] = normalized(mean - way[at] * dot(mean, way[at]));
    out[at] = cross(onward[at], way[at]);
  }
  std::vector<double> turns(run.place.size(), fold.turn);
  TurnsAlong along(run, onward, out, depth);
  if (back)
    turns = along.turnedBack(fold.turn, body, standingSheets(document, {piece.id}).get());
  else if (body)
    turns = along.outwards(fold.turn, *body);
  for (const Along& a : on) {
    // Two outlines that face each other run against each other, unless one is turned over.
    const double s = (fold.over ? a.share : 1 - a.share) * (n - 1);
    const int k = std::clamp(static_cast<int>(s), 0, n - 2);
    const auto i = static_cast<std::size_t>(k);
    const double t = s - k, angle = std::lerp(turns[i], turns[i + 1], t);
    const Vec3 o = normalized(lerp(onward[i], onward[i + 1], t)), f = normalized(lerp(out[i], out[i + 1], t));
    const double forward = fold.over ? a.beyond : -a.beyond;
    form->space.push_back(lerp(run.place[i], run.place[i + 1], t) +
                          (o * std::cos(angle) + f * std::sin(angle)) * a.off +
                          (forward < 0 ? way.front() : way.back()) * forward);
  }
  piece.form = std::move(form);
  piece.pose = Rigid();
  return piece;
}

Result<Piece> ledTo(const Document& document, Piece piece, const std::string& edge, const SpaceRun& run,
                    const FoldedOn& fold, const Body* body, const std::optional<BodyPoint>& round) {
  if (!body || run.together()) return attached(document, std::move(piece), edge, run, fold, body);
  if (fold.over)
    return refused(say("The edges that “{0}” comes along stand {1} cm apart; drape first, then turn it over onto them.",
                       piece.name, fixed(run.apart * 100, 0)));
  const Vec3 middle = run.place[run.place.size() / 2];
  const auto skin = body->bvh().nearest(middle);
  if (!skin) return attached(document, std::move(piece), edge, run, fold, body);
  PlacePiece place;
  place.at = round ? *round : body->describe(skin->place);
  place.point = piece.outline.edges[*piece.outline.find(edge)].curve.atFraction(0.5);
  place.ease = Length{kRoom};
  place.cone = Choice::No;
  place.wrap = fold.wrap;
  double up = 0;
  for (const Vec3 way : run.onward) up += way.y;
  if (up < 0) place.turn = Angle{std::numbers::pi};  // below a hem
  if (round && !isLimb(place.at.part)) {             // at the run's own height, which may be far below the trunk
    const auto trunk = body->find(place.at);
    if (!trunk) return trunk.error();
    *place.point -= turned(Flat{0, middle.y - at(body->mesh(), *trunk).y}, -place.turn);
  }
  auto stood = placed(document, piece, place, *body);
  return stood ? stood : attached(document, std::move(piece), edge, run, fold, body);
}

namespace {

// A strap has a second end, and a figure to go over.
Done resolveStrap(const Document& before, AttachPiece& op, Context& context) {
  if (!op.end || op.endTo.empty())
    return refused(
        say("A strap has two ends: say the edge at its other end and where that comes to: end=strap.top "
            "end_to=back.top."));
  if (op.turn != 0 || op.turned || op.clear != Choice::Auto || op.round || op.beyond != Choice::Auto)
    return refused(say("A strap lies on the body: leave turn=, turned=, clear=, round= and beyond= away."));
  op.end->from = 0, op.end->to = 1;
  if (Done done = resolve(before, *op.end); !done) return done;
  if (op.end->piece != op.edge.piece || op.end->edge == op.edge.edge)
    return refused(say("The other end of a strap is another edge of the same piece."));
  if (Done done = orderRun(before, op.endTo); !done) return done;
  for (const EdgeRef& edge : op.endTo)
    if (edge.piece == op.edge.piece) return refused(say("A piece cannot be led along its own edge."));
  return settleWay(before, strapEnd(before, op.to), strapEnd(before, op.endTo), op.over, context);
}

Result<Document> strapLed(const Document& before, const AttachPiece& op, const Body& body) {
  const Piece& piece = *before.find(op.edge.piece.id);
  const auto middle = [&](const EdgeRef& edge) { return findEdge(piece, edge.edge)->curve.atFraction(0.5); };
  const auto way = strapWay(before, piece.id, body, strapEnd(before, op.to), strapEnd(before, op.endTo), op.over);
  if (!way) return way.error();
  auto laid = laidAlong(before, piece, middle(op.edge), middle(*op.end), *way, body);
  if (!laid) return laid.error();
  return withPiece(before, *std::move(laid));
}

}  // namespace

Done resolve(const Document& before, AttachPiece& op, Context& context) {
  op.edge.from = 0, op.edge.to = 1;
  if (Done done = resolve(before, op.edge); !done) return done;
  if (Done done = orderRun(before, op.to); !done) return done;
  for (const EdgeRef& edge : op.to)
    if (edge.piece == op.edge.piece) return refused(say("A piece cannot be led along its own edge."));
  if (!(std::abs(op.turn) <= 4)) return refused(say("That turn is too large."));
  if (op.end || !op.endTo.empty() || op.over) return resolveStrap(before, op, context);
  decideClear(op.turn, op.clear, context);
  if (op.beyond == Choice::Auto && !context.recorded && goesBeyond(*before.find(op.edge.piece.id), op.edge.edge))
    op.beyond = Choice::Yes;
  return decideRound(before, op.to, op.round, context);
}

Result<Document> perform(const Document& before, const AttachPiece& op, Context& context) {
  BodyPtr body;
  if (before.body.chosen()) {
    auto found = bodyOf(before, context);
    if (!found) return found.error();
    body = *found;
  }
  if (op.end) return strapLed(before, op, *body);
  auto piece = ledTo(before, *before.find(op.edge.piece.id), op.edge.edge, runOf(before, op.to),
                     {op.turn, op.turned, op.clear == Choice::Yes, op.beyond == Choice::Yes}, body.get(), op.round);
  if (!piece) return piece.error();
  return withPiece(before, *std::move(piece));
}

}  // namespace karinui
