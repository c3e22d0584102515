#include "karinui/design/sewing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "design/sewn_corners.h"
#include "design/sides_up.h"
#include "design/spoken.h"
#include "karinui/base/number.h"
#include "karinui/base/said_lengths.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/seam_walk.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

namespace {

constexpr int kSamples = 24;

const Curve& curveOf(const Document& document, const EdgeRef& ref) {
  return *findCurve(*document.find(ref.piece.id), ref.edge);
}

Message runSaid(const Document& document, const std::vector<EdgeRef>& run) {
  const std::string first = spoken(document, run.front()), last = spoken(document, run.back());
  return first == last ? say("{0}", first) : say("{0} … {1}", first, last);
}

// Places in space along a side, evenly by length, in the outlines' order.
std::vector<Vec3> stood(const Document& document, const std::vector<EdgeRef>& side) {
  const double whole = lengthOf(document, side);
  std::vector<Vec3> places;
  double done = 0;
  std::size_t next = 0;
  for (const EdgeRef& ref : side) {
    const Stand stand(*document.find(ref.piece.id));
    const Curve& curve = curveOf(document, ref);
    const double part = lengthOf(document, {ref});
    for (; next <= kSamples; ++next) {
      const double s = whole * static_cast<double>(next) / kSamples - done;
      if (s > part + 1e-12 && &ref != &side.back()) break;
      places.push_back(stand(curve.atFraction(ref.from + (ref.to - ref.from) * std::fmin(1, s / part))));
    }
    done += part;
  }
  return places;
}

struct Corner {
  PieceId piece;
  Flat place;
};
Corner endOf(const Document& document, const EdgeRef& ref, bool last) {
  return {ref.piece.id, curveOf(document, ref).atFraction(last ? ref.to : ref.from)};
}

// Whether seams hold these two corners together, over the corners of other pieces too, as where four gores meet.
bool sewnTogether(const Document& document, const Corner& a, const Corner& b) {
  constexpr double kSame = 1e-4;  // metres
  const auto same = [](const Corner& one, const Corner& other) {
    return one.piece == other.piece && distance(one.place, other.place) < kSame;
  };
  std::vector<std::array<Corner, 2>> held;
  for (const auto& [id, seam] : document.pattern.seams) {
    const SeamSides sides(document.pattern, seam);
    for (const double at : sides.breaks()) {
      const auto cornerAt = [&](const SeamPlace& place) -> std::optional<Corner> {
        const Curve* curve = curveOf(document.pattern, place.piece, place.edge);
        if (!curve) return std::nullopt;
        return Corner{place.piece, curve->atFraction(place.fraction)};
      };
      const auto here = cornerAt(sides.a.at(at)), there = cornerAt(sides.b.at(at));
      if (here && there) held.push_back({*here, *there});
    }
  }
  std::vector<Corner> joined{a};
  for (std::size_t k = 0; k < joined.size(); ++k)
    for (const auto& pair : held)
      for (const std::size_t side : {0U, 1U}) {
        const Corner& next = pair[1 - side];
        if (!same(pair[side], joined[k])) continue;
        if (std::none_of(joined.begin(), joined.end(), [&](const Corner& one) { return same(one, next); }))
          joined.push_back(next);
      }
  return std::any_of(joined.begin(), joined.end(), [&](const Corner& one) { return same(one, b); });
}

// How far the edges of a run, one after the other, are from following each other.
double apart(const Document& document, const std::vector<EdgeRef>& side) {
  double sum = 0;
  for (std::size_t k = 1; k < side.size(); ++k) {
    const Corner from = endOf(document, side[k - 1], true), to = endOf(document, side[k], false);
    if (from.piece == to.piece)
      sum += distance(from.place, to.place);
    else if (!sewnTogether(document, from, to))
      sum += distance(Stand(*document.find(from.piece))(from.place), Stand(*document.find(to.piece))(to.place));
  }
  return sum;
}

Vec3 middleOf(const std::vector<Vec3>& places) {
  Vec3 middle;
  for (const Vec3 p : places) middle += p * (1.0 / static_cast<double>(places.size()));
  return middle;
}
Vec3 middleOf(const Document& document, const EdgeRef& ref) { return middleOf(stood(document, {ref})); }
Vec3 across(Vec3 p) { return {-p.x, p.y, p.z}; }

// The edge of `other` that is the mirror image of an edge of `piece`, where the outline of one is that of the other
// mirrored, wherever it lies on its paper.
const Edge* mirrorEdge(const Piece& piece, const Piece& other, std::size_t edge) {
  constexpr double kSame = 2e-5;  // metres
  const auto &mine = piece.outline.edges, &its = other.outline.edges;
  const std::size_t n = mine.size();
  if (its.size() != n) return nullptr;
  const auto image = [&](std::size_t k) { return mine[k].curve.mirrored({0, 0}, {0, 1}).reversed(); };
  for (std::size_t sum = 0; sum < n; ++sum) {
    const Flat lies = its[sum % n].curve.start - image(0).start;
    const auto same = [&](std::size_t k) {
      const Curve here = image(k), there = its[(sum + n - k) % n].curve;
      for (const double f : {0.0, 0.25, 0.5, 0.75})
        if (distance(here.atFraction(f) + lies, there.atFraction(f)) > kSame) return false;
      return true;
    };
    std::size_t k = 0;
    while (k < n && same(k)) ++k;
    if (k == n) return &its[(sum + n - edge) % n];
  }
  return nullptr;
}

// Edges that follow each other without an inward corner between them: sewn together they fold the cloth.
bool folds(const Document& document, const SewEdges& sew) {
  constexpr double kInward = 0.7;  // radians an inward corner turns at least: a dart's tip does by nearly three
  const auto follows = [&](const EdgeRef& before, const EdgeRef& after) {
    if (before.piece.id != after.piece.id) return false;
    if (before.edge == after.edge) return std::fabs(before.to - after.from) < 1e-6;
    const auto& edges = document.find(before.piece.id)->outline.edges;
    const auto k = document.find(before.piece.id)->outline.find(before.edge);
    if (!k || before.to < 1 || after.from > 0 || edges[(*k + 1) % edges.size()].name != after.edge) return false;
    const Flat in = edges[*k].curve.tangent(1), out = curveOf(document, after).tangent(0);
    const double turn = angleFrom(in, out);
    return turn > -kInward && turn < 3;  // the banks of a slit turn by just half a circle, either way
  };
  return follows(sew.a.back(), sew.b.front()) || follows(sew.b.back(), sew.a.front());
}

// How far a thread runs through the body.
double throughBody(const Body& body, Vec3 a, Vec3 b) {
  const double whole = distance(a, b);
  if (whole < 1e-6) return 0;
  const Vec3 way = (b - a) * (1 / whole);
  const auto in = body.bvh().first(a, way), out = body.bvh().first(b, -way);
  if (!in || !out || in->along > whole || out->along > whole) return 0;
  return std::fmax(0, whole - in->along - out->along);
}

std::optional<SeamDoubt> sewnAlready(const Document& document, const SewEdges& sew) {
  std::vector<EdgeRef> both = sew.a;
  both.insert(both.end(), sew.b.begin(), sew.b.end());
  std::erase_if(both, [&](const EdgeRef& ref) {  // to a line several things can be sewn
    const Piece* piece = document.find(ref.piece.id);
    return piece && !findEdge(*piece, ref.edge);
  });
  for (const EdgeRef& ref : both)
    for (const SeamId id : seamsOn(document, {ref})) {
      SeamDoubt doubt{SeamDoubt::Kind::Sewn,
                      say("{0} is already sewn by seam {1}.", spoken(document, ref), spoken(*document.find(id)))};
      doubt.instead = sew;
      doubt.instead->replace = true;
      doubt.proposal = say("Unpick that seam and sew this one");
      return doubt;
    }
  return std::nullopt;
}

// A piece as it comes out of a drawing: flat, and not yet stood anywhere by the body.
bool unplaced(const Piece& piece) { return !piece.form && piece.pose == Rigid(); }
bool anyUnplaced(const Document& document, const std::vector<EdgeRef>& side) {
  return std::any_of(side.begin(), side.end(),
                     [&](const EdgeRef& ref) { return unplaced(*document.find(ref.piece.id)); });
}

std::optional<SeamDoubt> otherSide(const Document& document, const SewEdges& sew, const Body* body) {
  constexpr double kClear = 0.02, kNear = 0.1, kThrough = 0.03;  // metres
  // A back that lies as it was drawn has its left where a front has its right: paper has no sides of a body.
  if (anyUnplaced(document, sew.a) && anyUnplaced(document, sew.b)) return std::nullopt;
  const std::vector<Vec3> a = stood(document, sew.a), b = stood(document, sew.b);
  const Vec3 here = middleOf(a), there = middleOf(b);
  if (here.x * there.x >= 0 || std::fmin(std::fabs(here.x), std::fabs(there.x)) < kClear) return std::nullopt;
  const bool against = sew.reversed == Choice::Auto ? facesReversed(document, sew, body) : sew.reversed == Choice::Yes;
  for (const bool last : {false, true})  // edges that begin at one corner, as a godet's and a gore's, are meant
    if (sewnTogether(document, endOf(document, last ? sew.a.back() : sew.a.front(), last),
                     endOf(document, last != against ? sew.b.back() : sew.b.front(), last != against)))
      return std::nullopt;
  // Left with right. Is there the partner of the same side, where it should be, nearer and free?
  SewEdges meant = sew;
  meant.b.clear();
  for (auto ref = sew.b.rbegin(); ref != sew.b.rend(); ++ref)
    if (auto image = mirrorImage(document, *ref)) {  // in numbers that are written as they are said
      image->from = std::round(image->from * 1e9) / 1e9, image->to = std::round(image->to * 1e9) / 1e9;
      meant.b.push_back(*std::move(image));
    }
  if (meant.b.size() == sew.b.size() && !overlap(meant.a, meant.b) && !overlap(meant.b, sew.b) &&
      seamsOn(document, meant.b).empty()) {
    const Vec3 image = middleOf(stood(document, meant.b));
    if (distance(image, across(there)) < kNear && distance(image, here) < 0.98 * distance(there, here)) {
      meant.reversed = facesReversed(document, meant, body) ? Choice::Yes : Choice::No;
      return SeamDoubt{SeamDoubt::Kind::OtherSide,
                       say("{0} and {1} lie on opposite sides of the body.", spoken(document, sew.a.front()),
                           spoken(document, sew.b.front())),
                       meant, say("Sew to {0}", spoken(document, meant.b.front()))};
    }
  }
  if (!body) return std::nullopt;
  std::size_t through = 0, threads = 0;
  for (std::size_t k = 0; k < a.size(); k += 3, ++threads)
    through += throughBody(*body, a[k], b[against ? b.size() - 1 - k : k]) > kThrough;
  if (2 * through <= threads) return std::nullopt;
  return SeamDoubt{SeamDoubt::Kind::Through,
                   say("{0} and {1} lie on opposite sides of the body; the seam would run through it.",
                       spoken(document, sew.a.front()), spoken(document, sew.b.front()))};
}

std::optional<SeamDoubt> gathered(const Document& document, const SewEdges& sew, const Body* body) {
  const double la = lengthOf(document, sew.a), lb = lengthOf(document, sew.b);
  const bool longerIsA = la > lb;
  const double ratio = std::fmax(la, lb) / std::fmin(la, lb);
  const Piece& piece = *document.find((longerIsA ? sew.a : sew.b).front().piece.id);
  const auto fabric = fabricOf(document, piece);
  const double most = fabric ? mostGather(*fabric) : 3;
  if (!(ratio > most * 1.001)) return std::nullopt;
  SeamDoubt doubt{SeamDoubt::Kind::Gathered,
                  say("{0} is {1} times as long as the other side; {2} is usually gathered up to {3} times.",
                      runSaid(document, longerIsA ? sew.a : sew.b), fixed(ratio, 1), piece.fabric, fixed(most, 1))};
  doubt.instead = sew;
  auto& longer = longerIsA ? doubt.instead->a : doubt.instead->b;
  const bool against = sew.reversed == Choice::Auto ? facesReversed(document, sew, body) : sew.reversed == Choice::Yes;
  longer = trimmed(document, longer, most * std::fmin(la, lb), !longerIsA && against);
  doubt.proposal = say("Gather {0}:1, the rest stays open", fixed(most, 1));
  return doubt;
}

}  // namespace

double lengthOf(const Document& document, const std::vector<EdgeRef>& side) {
  double sum = 0;
  for (const EdgeRef& ref : side) {
    const Piece* piece = document.find(ref.piece.id);
    if (const Curve* curve = piece ? findCurve(*piece, ref.edge) : nullptr)
      sum += curve->length() * (ref.to - ref.from);
  }
  return sum;
}

std::vector<EdgeRef> inOutlineOrder(const Document& document, std::vector<EdgeRef> side) {
  constexpr double kPlainly = 0.5;  // of what the run as it is listed is apart
  std::vector<EdgeRef> turned(side.rbegin(), side.rend());
  return apart(document, turned) < kPlainly * apart(document, side) ? turned : side;
}

std::vector<EdgeRef> asTheyFollow(const Document& document, std::vector<EdgeRef> side) {
  constexpr double kFar = 0.1;      // metres: a front that opens stands nearer to the other
  constexpr double kPlainly = 0.2;  // of what the run as it is listed is apart
  constexpr std::size_t kMost = 24;
  const std::size_t n = side.size();
  // What lies as it was drawn stands nowhere yet.
  const double listed = n < 2 || n > kMost || anyUnplaced(document, side) ? 0 : apart(document, side);
  if (listed < kFar) return side;
  std::vector<double> gap(n * n);  // from the end of one to the start of the other
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j) gap[i * n + j] = apart(document, {side[i], side[j]});
  std::vector<std::size_t> best;
  double least = kPlainly * listed;
  for (std::size_t first = 0; first < n; ++first) {  // from each on to the nearest that is left
    std::vector<std::size_t> left, order{first};
    for (std::size_t k = 0; k < n; ++k)
      if (k != first) left.push_back(k);
    double sum = 0;
    while (!left.empty()) {
      const double* from = &gap[order.back() * n];
      const auto next = std::min_element(left.begin(), left.end(),
                                         [&](std::size_t one, std::size_t other) { return from[one] < from[other]; });
      sum += from[*next];
      order.push_back(*next);
      left.erase(next);
    }
    if (sum < least) least = sum, best = std::move(order);
  }
  std::vector<EdgeRef> run;
  for (const std::size_t k : best) run.push_back(side[k]);
  return run.empty() ? side : run;
}

void meetAsRings(const Document& document, SewEdges& sew) {
  constexpr int kPlaces = 48;
  constexpr double kPlainly = 0.5;  // of what the rings as they are listed are apart
  constexpr std::size_t kMost = 24;
  if (sew.tie == SewEdges::Tie::Pleat || sew.a.size() > kMost || sew.b.size() > kMost) return;
  for (const auto* side : {&sew.a, &sew.b})
    if (anyUnplaced(document, *side) || !goesOnSewn(document, side->back(), side->front())) return;
  // Evenly along a ring, from each of its edges on.
  const auto rings = [&](const std::vector<EdgeRef>& side) {
    std::vector<std::vector<Vec3>> all;
    const double whole = lengthOf(document, side);
    for (std::size_t first = 0; first < side.size(); ++first) {
      std::vector<Vec3> places;
      double before = 0;
      for (std::size_t k = 0; k < side.size(); ++k) {
        const EdgeRef& edge = side[(first + k) % side.size()];
        const double own = lengthOf(document, {edge});
        const Stand stand(*document.find(edge.piece.id));
        const Curve& curve = *findCurve(*document.find(edge.piece.id), edge.edge);
        while (static_cast<int>(places.size()) < kPlaces) {
          const double along = whole * (static_cast<double>(places.size()) + 0.5) / kPlaces - before;
          if (along > own && k + 1 < side.size()) break;
          places.push_back(stand(curve.atFraction(edge.from + (edge.to - edge.from) * std::fmin(1, along / own))));
        }
        before += own;
      }
      all.push_back(std::move(places));
    }
    return all;
  };
  const auto a = rings(sew.a), b = rings(sew.b);
  std::size_t firstA = 0, firstB = 0;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < kPlaces; ++k)
        sum += distance(a[i][k], b[j][sew.reversed == Choice::Yes ? kPlaces - 1 - k : k]);
      if (i + j == 0) sum *= kPlainly;
      if (sum < least) least = sum, firstA = i, firstB = j;
    }
  std::rotate(sew.a.begin(), sew.a.begin() + static_cast<std::ptrdiff_t>(firstA), sew.a.end());
  std::rotate(sew.b.begin(), sew.b.begin() + static_cast<std::ptrdiff_t>(firstB), sew.b.end());
}

bool overlap(const EdgeRef& a, const EdgeRef& b) {
  return a.piece.id == b.piece.id && a.edge == b.edge && std::fmin(a.to, b.to) - std::fmax(a.from, b.from) > 1e-6;
}
bool overlap(const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b) {
  return std::any_of(a.begin(), a.end(), [&](const EdgeRef& one) {
    return std::any_of(b.begin(), b.end(), [&](const EdgeRef& other) { return overlap(one, other); });
  });
}

std::vector<SeamId> seamsOn(const Document& document, const std::vector<EdgeRef>& side) {
  std::vector<SeamId> found;
  for (const auto& [id, seam] : document.pattern.seams) {
    bool holds = false;
    for (const auto* held : takenSides(seam))
      for (const EdgeSpan& span : *held)
        holds = holds || overlap(side, {{PieceRef(span.piece), span.edge, span.from, span.to}});
    if (holds) found.push_back(id);
  }
  return found;
}

std::vector<EdgeRef> trimmed(const Document& document, const std::vector<EdgeRef>& side, double metres, bool fromLast) {
  std::vector<EdgeRef> kept;
  double left = metres;
  for (std::size_t k = 0; k < side.size() && left > 1e-6; ++k) {
    EdgeRef ref = side[fromLast ? side.size() - 1 - k : k];
    const double whole = lengthOf(document, {ref});
    if (whole > left) {
      const double share = (ref.to - ref.from) * left / whole;
      if (fromLast)
        ref.from = std::round((ref.to - share) * 1e6) / 1e6;
      else
        ref.to = std::round((ref.from + share) * 1e6) / 1e6;
    }
    left -= whole;
    kept.insert(fromLast ? kept.begin() : kept.end(), std::move(ref));
  }
  return kept;
}

namespace {

// The part of the same edge that stands over against it, on the body's other side.
std::optional<EdgeRef> overAgainst(const Document& document, const EdgeRef& part) {
  constexpr double kThere = 0.03;  // metres
  constexpr int kTried = 2000;
  const Piece& piece = *document.find(part.piece.id);
  const double half = (part.to - part.from) / 2;
  if (unplaced(piece) || half > 0.25) return std::nullopt;
  const Curve& curve = findEdge(piece, part.edge)->curve;
  const Stand stand(piece);
  const Vec3 wanted = across(middleOf(document, part));
  double nearest = kThere;
  std::optional<EdgeRef> found;
  for (int k = 0; k <= kTried; ++k) {
    const double at = std::round(std::lerp(half, 1 - half, k / double{kTried}) * 1e5) / 1e5;  // to be read in a record
    const double away = distance(stand(curve.atFraction(at)), wanted);
    if (away < nearest) nearest = away, found = EdgeRef{part.piece, part.edge, at - half, at + half};
  }
  if (found && (overlap(*found, part) || found->from < 0 || found->to > 1)) return std::nullopt;
  return found;
}

}  // namespace

std::optional<EdgeRef> mirrorImage(const Document& document, const EdgeRef& part, bool rings) {
  constexpr double kCentre = 0.05;  // metres a piece across the centre may stand beside it
  const Piece& piece = *document.find(part.piece.id);
  const auto edge = piece.outline.find(part.edge);
  if (!edge) return std::nullopt;
  const auto on = [&](const Piece& other, const std::string& name) {
    return EdgeRef{PieceRef(other.id), name, 1 - part.to, 1 - part.from};
  };
  std::optional<EdgeRef> best;
  double nearest = 1e9;
  const Vec3 wanted = across(middleOf(document, part));
  const auto offer = [&](EdgeRef image, double within) {
    const double away = distance(middleOf(document, image), wanted);
    if (away < std::fmin(within, nearest - 1e-3)) nearest = away, best = std::move(image);
  };
  // A copy that was made for the other side is meant, wherever it stands.
  for (const auto& [id, other] : document.pattern.pieces) {
    if (id == piece.id || (other->mirrorOf != piece.id && piece.mirrorOf != id)) continue;
    if (const Edge* image = mirrorEdge(piece, *other, *edge)) return on(*other, image->name);
    if (other->outline.find(otherSide(part.edge))) return on(*other, otherSide(part.edge));
  }
  if (const auto symmetry = symmetryOf(piece.outline)) {
    if (unplaced(piece) || std::fabs(Stand(piece)(symmetry->through).x) < kCentre)
      if (const auto partner = symmetry->partner[*edge]) offer(on(piece, piece.outline.edges[*partner].name), 1e9);
  }
  for (const auto& [id, other] : document.pattern.pieces)
    if (id != piece.id)
      if (const Edge* image = mirrorEdge(piece, *other, *edge)) offer(on(*other, image->name), 2 * kCentre);
  return !best && rings ? overAgainst(document, part) : best;
}

Result<SewEdges> mirrorImage(const Document& document, const SewEdges& sew, bool rings) {
  SewEdges image = sew;
  image.mirror = image.replace = false;
  for (const auto& [from, to] : {std::pair{&sew.a, &image.a}, std::pair{&sew.b, &image.b}}) {
    to->clear();
    for (auto ref = from->rbegin(); ref != from->rend(); ++ref) {
      auto found = mirrorImage(document, *ref, rings);
      if (!found) return refused(say("{0} has no mirror image; leave mirror= away.", spoken(document, *ref)));
      to->push_back(*std::move(found));
    }
  }
  for (const auto* mine : {&sew.a, &sew.b})
    for (const auto* its : {&image.a, &image.b})
      if (overlap(*mine, *its)) return refused(say("This seam is its own mirror image; leave mirror= away."));
  for (const auto* side : {&image.a, &image.b})
    for (const EdgeRef& ref : *side)
      for (const SeamId id : seamsOn(document, {ref}))
        return refused(say("{0} is already sewn by seam {1}; take that out first, or leave mirror= away.",
                           spoken(document, ref), spoken(*document.find(id))));
  if (!sew.name.empty()) {
    const auto taken = [&](const std::string& name) {
      return name == sew.name || std::any_of(document.pattern.seams.begin(), document.pattern.seams.end(),
                                             [&](const auto& seam) { return seam.second.name == name; });
    };
    image.name = otherSide(sew.name);
    for (int k = 2; taken(image.name); ++k) image.name = otherSide(sew.name) + "_" + std::to_string(k);
  }
  return image;
}

double mostGather(const Fabric& fabric) {
  constexpr double kFolded = 0.00064;  // metres: with it cotton gathers 3:1, denim 1.7:1
  return std::clamp(1 + kFolded / std::fmax(fabric.thickness, 1e-5), 1.5, 4.0);
}

bool goesOnSewn(const Document& document, const EdgeRef& ref, const EdgeRef& next) {
  constexpr double kOne = 1e-4;  // metres
  const Corner from = endOf(document, ref, true), to = endOf(document, next, false);
  return (from.piece == to.piece && distance(from.place, to.place) < kOne) || sewnTogether(document, from, to);
}

std::optional<Message> brokenRun(const Document& document, const std::vector<EdgeRef>& side) {
  constexpr double kApart = 0.002;  // metres
  for (std::size_t k = 1; k < side.size(); ++k) {
    const Corner from = endOf(document, side[k - 1], true), to = endOf(document, side[k], false);
    if (from.piece == to.piece && distance(from.place, to.place) > kApart && !sewnTogether(document, from, to))
      return say("{0} does not end where {1} begins; name the edges of a run as they follow each other.",
                 spoken(document, side[k - 1]), spoken(document, side[k]));
  }
  return std::nullopt;
}

Message longerSaid(const Document& document, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b) {
  constexpr double kTold = 5e-5;  // metres: what is less reads 0.0 mm
  const double more = lengthOf(document, a) - lengthOf(document, b);
  if (std::fabs(more) < kTold)
    return say("{0} is as long now as {1}, to which it is sewn.", runSaid(document, a), runSaid(document, b));
  return say("{0} is {1} mm longer than {2}, to which it is sewn.", runSaid(document, more > 0 ? a : b),
             fixed(std::fabs(more) * 1e3, 1), runSaid(document, more > 0 ? b : a));
}

std::optional<Message> longerSide(const Document& document, const SewEdges& sew) {
  constexpr double kPlainly = 1.1;  // a sleeve's cap is eased in by half as much
  const double a = lengthOf(document, sew.a), b = lengthOf(document, sew.b);
  if (sew.tie == SewEdges::Tie::Pleat || std::fmax(a, b) < kPlainly * std::fmin(a, b)) return std::nullopt;
  return longerSaid(document, sew.a, sew.b);
}

namespace {

// How far the right side of a run is turned away from the body, from -1 to 1, just within its edges.
double outwardness(const Document& document, const std::vector<EdgeRef>& side, const Body& body) {
  constexpr double kWithin = 0.01, kStep = 0.004;  // metres on paper
  constexpr int kPlaces = 8;
  double sum = 0;
  int looks = 0;
  for (const EdgeRef& ref : side) {
    const Piece& piece = *document.find(ref.piece.id);
    const Stand stand(piece);
    const Curve& curve = curveOf(document, ref);
    const double way = piece.outline.find(ref.edge) ? 1 : -1;  // round a hole the cloth is at the right
    for (int k = 0; k < kPlaces; ++k) {
      const double share = std::lerp(ref.from, ref.to, (k + 0.5) / kPlaces);
      const Flat in = leftOf(normalized(curve.tangent(curve.parameterAt(share * curve.length())))) * (way * kWithin);
      const Flat at = curve.atFraction(share) + in;
      const Vec3 across = stand(at + Flat{kStep, 0}) - stand(at + Flat{-kStep, 0}),
                 along = stand(at + Flat{0, kStep}) - stand(at + Flat{0, -kStep});
      const Vec3 normal = cross(across, along), away = body.field().sample(stand(at)).gradient;
      if (length(normal) < 1e-12 || length(away) < 1e-6) continue;
      sum += dot(normalized(normal), normalized(away));
      ++looks;
    }
  }
  return looks > 0 ? sum / looks : 0;
}

}  // namespace

bool facesReversed(const Document& document, const SewEdges& sew, const Body* body) {
  if (sew.tie != SewEdges::Tie::Pleat)  // there cloth is folded onto itself
    if (const auto told = reversedBySides(document, sew)) return *told;
  constexpr double kClearly = 0.25;  // of the squared distances the other way round
  constexpr double kTurned = 0.3;
  // About their own middles: so a piece that still hangs apart is judged by its shape.
  auto a = stood(document, sew.a), b = stood(document, sew.b);
  for (auto* side : {&a, &b}) {
    const Vec3 middle = middleOf(*side);
    for (Vec3& p : *side) p = p - middle;
  }
  if (facesReversed(a, b)) return true;
  double along = 0, against = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    along += squaredLength(a[k] - b[k]);
    against += squaredLength(a[k] - b[b.size() - 1 - k]);
  }
  if (!body || along < kClearly * against) return false;
  const double one = outwardness(document, sew.a, *body), other = outwardness(document, sew.b, *body);
  return std::fmin(std::fabs(one), std::fabs(other)) > kTurned && one * other > 0;
}

namespace {

// All pieces of a seam, more than one, lie on a table with their right sides up.
bool lieFlat(const Document& document, const SewEdges& sew) {
  const PieceId first = sew.a.front().piece.id;
  bool several = false;
  for (const auto* side : {&sew.a, &sew.b})
    for (const EdgeRef& ref : *side) {
      const Piece* piece = document.find(ref.piece.id);
      if (!piece || piece->form || piece->pose.turned({0, 0, 1}).z < 1 - 1e-9) return false;
      several = several || ref.piece.id != first;
    }
  return several;
}

}  // namespace

std::vector<SeamDoubt> seamDoubts(const Document& document, const SewEdges& sew, const Body* body) {
  std::vector<SeamDoubt> doubts;
  if (sew.tie == SewEdges::Tie::Pleat) return doubts;  // cloth is folded onto itself there
  const auto add = [&](std::optional<SeamDoubt> doubt) {
    if (doubt) doubts.push_back(*std::move(doubt));
  };
  if (!sew.replace) add(sewnAlready(document, sew));
  if (folds(document, sew))
    doubts.push_back({SeamDoubt::Kind::Folded,
                      say("{0} and {1} follow each other on one side of “{2}”; sewn together "
                          "they fold it onto itself.",
                          sew.a.front().edge, sew.b.front().edge, document.find(sew.a.front().piece.id)->name)});
  add(otherSide(document, sew, body));
  // Pieces that lie flat beside each other are turned to each other before they are sewn: their threads cross then.
  const bool laidOut = sew.reversed == Choice::Yes && !document.body.chosen() && lieFlat(document, sew);
  if (sew.reversed != Choice::Auto && !laidOut && (sew.reversed == Choice::Yes) != facesReversed(document, sew, body)) {
    SeamDoubt twisted{SeamDoubt::Kind::Twisted,
                      say("The threads between {0} and {1} cross; sewn this way round the cloth is twisted.",
                          runSaid(document, sew.a), runSaid(document, sew.b))};
    twisted.instead = sew;
    twisted.instead->reversed = sew.reversed == Choice::Yes ? Choice::No : Choice::Yes;
    twisted.proposal = say("Sew it the other way round");
    doubts.push_back(std::move(twisted));
  }
  add(gathered(document, sew, body));
  return doubts;
}

}  // namespace karinui
