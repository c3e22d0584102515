// What each piece of a pattern is: by its name, by its shape, and by what the other pieces are.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "karinui/base/message.h"
#include "karinui/pattern/symmetry.h"
#include "piece_names.h"
#include "piece_shape.h"

namespace karinui {

namespace {

constexpr double kLikely = 0.35;                            // of a fit, where the name says what the piece is
constexpr double kPlain = 0.6;                              // and where it does not
constexpr double kAlongGrain = 0.12;                        // pieces stand upright along their grain
constexpr double kEven = 0.02;                              // of its length two sides of an even piece may differ by
constexpr double kDoubleLeast = 0.003, kDoubleMost = 0.02;  // metres between the two of a double notch

bool isBand(PieceRole role) {
  return role == PieceRole::Collar || role == PieceRole::CollarStand || role == PieceRole::Waistband ||
         role == PieceRole::Cuff;
}

// Whether a piece that is called so may have that shape.
bool agrees(PieceRole named, PieceRole shape) {
  switch (named) {
    case PieceRole::Unknown:
      return true;
    case PieceRole::Front:
      return shape == PieceRole::Front || shape == PieceRole::LegFront || shape == PieceRole::SkirtFront;
    case PieceRole::Back:
      return shape == PieceRole::Front || shape == PieceRole::Back || shape == PieceRole::LegFront ||
             shape == PieceRole::SkirtFront;
    case PieceRole::Leg:
      return shape == PieceRole::Leg || shape == PieceRole::LegFront;
    case PieceRole::Sleeve:
    case PieceRole::Yoke:
      return shape == named;
    case PieceRole::Collar:
    case PieceRole::CollarStand:
      return shape == PieceRole::Waistband || shape == PieceRole::CollarStand;
    case PieceRole::Waistband:
    case PieceRole::Cuff:
      return shape == PieceRole::Waistband;
    default:
      return false;
  }
}

PieceRole roleOf(PieceRole named, PieceRole shape) {
  if (isBand(named) || named == PieceRole::Yoke) return named;
  const bool back = named == PieceRole::Back;
  switch (shape) {
    case PieceRole::Front:
      return back ? PieceRole::Back : PieceRole::Front;
    case PieceRole::LegFront:
      return back ? PieceRole::LegBack : PieceRole::LegFront;
    case PieceRole::SkirtFront:
      return back ? PieceRole::SkirtBack : PieceRole::SkirtFront;
    default:
      return shape;
  }
}

struct Candidate {
  ShapeFit fit;
  double turn = 0, score = 0;
  Shape shape;
};

std::vector<Candidate> candidatesOf(const Piece& piece, PieceRole named) {
  std::vector<Candidate> all;
  const Shape shape = shapeOf(piece);
  const double grain = std::atan2(piece.grain.v, piece.grain.u);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double turn = std::numbers::pi / 2 - grain + quarter * std::numbers::pi / 2;
    const Shape upright = shape.turned(turn);
    for (ShapeFit& fit : fitsOf(upright)) {
      if (!agrees(named, fit.role)) continue;
      if (named == PieceRole::Unknown && fit.role == PieceRole::SkirtFront && upright.darts.empty()) {
        // A rectangle may be anything; a skirt without darts is known by its wider hem.
        const auto hem = fit.parts.at(PiecePart::Hem), top = fit.parts.at(PiecePart::Top);
        if (upright.length(hem[0], hem[1]) < 1.03 * upright.length(top[0], top[1])) continue;
      }
      const bool along = quarter % 2 == 0;
      const bool band = fit.role == PieceRole::Waistband || fit.role == PieceRole::CollarStand;
      const double score = fit.score + (along && !band ? kAlongGrain : 0);
      all.push_back({std::move(fit), std::remainder(turn, 2 * std::numbers::pi), score, upright});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return all;
}

EdgeRun runOf(const Piece& piece, const Shape& shape, std::array<std::size_t, 2> ends) {
  EdgeRun run;
  for (std::size_t k = ends[0]; k != ends[1]; k = (k + 1) % shape.size()) {
    for (const std::size_t edge : shape.runs[k].edges) run.edges.push_back(piece.outline.edges[edge].name);
    run.length += shape.runs[k].length;
  }
  return run;
}

PieceReading readingOf(const Piece& piece, const Candidate& found, PieceRole named) {
  PieceReading out;
  out.role = roleOf(named, found.fit.role);
  out.byName = named != PieceRole::Unknown;
  out.turn = Angle{found.turn};
  out.sure = std::clamp(found.fit.score + (out.byName ? 0.2 : 0), 0.0, 1.0);
  for (const auto& [part, ends] : found.fit.parts) out.parts[part] = runOf(piece, found.shape, ends);
  for (const auto& dart : found.shape.darts)
    out.darts.push_back({piece.outline.edges[dart[0]].name, piece.outline.edges[dart[1]].name});
  out.low = found.shape.low.v, out.high = found.shape.high.v;
  return out;
}

double lengthOf(const PieceReading& reading, PiecePart part) {
  const auto found = reading.parts.find(part);
  return found == reading.parts.end() ? 0 : found->second.length;
}

bool even(const PieceReading& reading, PiecePart a, PiecePart b) {
  const double x = lengthOf(reading, a), y = lengthOf(reading, b);
  return std::abs(x - y) <= kEven * std::max(x, y);
}

// Of a half the side of the body it lies on. Seen from outside, the wearer's left of a front is at plus, that of a back
// at minus.
PieceReading::Side sideOfHalf(bool back, bool centreAtPlus) {
  return back == centreAtPlus ? PieceReading::Side::Left : PieceReading::Side::Right;
}

// The pieces' names without what all of them begin with: the style's.
std::map<PieceId, std::string> ownNames(const Pattern& pattern) {
  std::map<PieceId, std::string> names;
  std::vector<std::vector<std::string>> words;
  for (const auto& [id, piece] : pattern.pieces) words.push_back(wordsOf(piece->name));
  std::size_t common = 0;
  const auto shared = [&](std::size_t k) {
    return std::all_of(words.begin(), words.end(),
                       [&](const auto& one) { return one.size() > k + 1 && one[k] == words.front()[k]; });
  };
  while (words.size() > 1 && shared(common)) ++common;
  std::size_t nth = 0;
  for (const auto& [id, piece] : pattern.pieces) {
    const auto& own = words[nth++];
    if (common == 0) {
      names[id] = piece->name;
      continue;
    }
    for (std::size_t k = common; k < own.size(); ++k) names[id] += (k > common ? " " : "") + own[k];
  }
  return names;
}

// Of pieces that would all be the same part of a garment the first is it; the others are other versions of it.
void takeOneOfEach(const Pattern& pattern, PieceReadings& readings) {
  for (auto& [id, reading] : readings) {
    if (reading.role != PieceRole::Leg && reading.role != PieceRole::Waistband && reading.role != PieceRole::Collar &&
        reading.role != PieceRole::CollarStand && reading.role != PieceRole::Yoke && reading.role != PieceRole::Sleeve)
      continue;
    for (auto& [other, also] : readings)
      if (other > id && also.role == reading.role && also.side == reading.side) {
        also.role = PieceRole::Aside;
        // What is the copy of a version goes with it.
        for (auto& [copy, follows] : readings)
          if (pattern.pieces.at(copy)->mirrorOf == other) follows.role = PieceRole::Aside;
      }
  }
}

// Bands that only their shape tells: a waistband where there is a waist as long as they are, a collar where a neck.
void nameBands(PieceReadings& readings) {
  const auto sum = [&](std::initializer_list<PieceRole> roles, PiecePart part) {
    double whole = 0;
    for (const auto& [id, reading] : readings)
      if (std::find(roles.begin(), roles.end(), reading.role) != roles.end())
        if (const auto found = reading.parts.find(part); found != reading.parts.end())
          whole += found->second.length * (reading.paired && roles.size() > 2 ? 2 : 1);
    return whole;
  };
  const double waist =
      sum({PieceRole::Leg, PieceRole::LegFront, PieceRole::LegBack, PieceRole::SkirtFront, PieceRole::SkirtBack},
          PiecePart::Top);
  const double neck = sum({PieceRole::Front, PieceRole::Back}, PiecePart::Neck);
  for (auto& [id, reading] : readings) {
    if (!isBand(reading.role) || reading.byName) continue;
    const double own = reading.parts.at(PiecePart::Hem).length;
    const auto like = [&](double of) { return of > 0 && own > 0.75 * of && own < 1.25 * of; };
    const bool rounded = reading.role == PieceRole::CollarStand;
    reading.role = rounded       ? like(neck) ? PieceRole::CollarStand : PieceRole::Unknown
                   : like(waist) ? PieceRole::Waistband
                   : like(neck)  ? PieceRole::Collar
                                 : PieceRole::Unknown;
  }
}

PieceReading::Side otherOf(PieceReading::Side side) {
  return side == PieceReading::Side::Left    ? PieceReading::Side::Right
         : side == PieceReading::Side::Right ? PieceReading::Side::Left
                                             : side;
}

// Where on a run, as a share of its length, two notches lie side by side, if they do so on one half of it only.
std::optional<double> doubleNotch(const Piece& piece, const EdgeRun& run) {
  const std::vector<double> notches = notchesAlong(piece, run.edges);
  std::optional<double> found;
  for (std::size_t i = 0; i + 1 < notches.size(); ++i) {
    const double gap = notches[i + 1] - notches[i], at = 0.5 * (notches[i] + notches[i + 1]) / run.length;
    if (gap < kDoubleLeast || gap > kDoubleMost) continue;
    if (found && (*found < 0.5) != (at < 0.5)) return std::nullopt;
    found = at;
  }
  return found;
}

// How deep the neck is cut below the shoulders' inner ends, over its width: fronts are cut deeper.
double neckDepth(const Piece& piece, const PieceReading& reading) {
  const auto neck = reading.parts.find(PiecePart::Neck);
  if (neck == reading.parts.end()) return 0;
  double low = 1e9, high = -1e9;
  for (const std::string& name : neck->second.edges)
    for (const Flat p : findEdge(piece, name)->curve.flattened(1e-4)) {
      const double v = reading.upright(p).v;
      low = std::min(low, v), high = std::max(high, v);
    }
  return high - low;
}

// The pieces of two roles, none of which has a name, by a measure that is the larger for the first of them.
void partInTwo(PieceReadings& readings, PieceRole first, PieceRole second,
               const std::function<double(PieceId)>& measure) {
  std::vector<std::pair<double, PieceId>> order;
  for (const auto& [id, reading] : readings) {
    if (reading.role != first && reading.role != second) continue;
    if (reading.byName) return;
    order.push_back({measure(id), id});
  }
  if (order.size() < 2) return;
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  // The largest step from one to the next parts the two.
  std::size_t cut = 1;
  double most = -1;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (const double step = order[k - 1].first - order[k].first; step > most) most = step, cut = k;
  for (std::size_t k = 0; k < order.size(); ++k) readings[order[k].second].role = k < cut ? first : second;
}

// Half of a skirt, where it is no whole one: the centre is the straighter and more upright of its sides.
void readSkirtSide(const Piece& piece, PieceReading& reading) {
  constexpr double kUpright = 0.04;  // metres across that a centre may take
  if (symmetryOf(piece.outline)) return;
  const auto lean = [&](PiecePart part) {
    double low = 1e9, high = -1e9;
    for (const std::string& name : reading.parts.at(part).edges)
      for (const Flat p : findEdge(piece, name)->curve.flattened(1e-4)) {
        const double u = reading.upright(p).u;
        low = std::min(low, u), high = std::max(high, u);
      }
    return high - low;
  };
  const bool atPlus = lean(PiecePart::SidePlus) < lean(PiecePart::SideMinus);
  const PiecePart centre = atPlus ? PiecePart::SidePlus : PiecePart::SideMinus;
  if (lean(centre) >= kUpright) return;
  reading.parts[PiecePart::Centre] = reading.parts.at(centre);
  reading.parts.erase(centre);
  reading.side = sideOfHalf(reading.role == PieceRole::SkirtBack, atPlus);
}

// The back of the cap is fuller than its front; seen from outside, the left sleeve's front is at minus.
PieceReading::Side sleeveSide(const Piece& piece, const Candidate& found, const EdgeRun& cap) {
  // A double notch of the cap is the back's, whatever the cap's shape.
  if (const auto back = doubleNotch(piece, cap))
    return *back < 0.5 ? PieceReading::Side::Left : PieceReading::Side::Right;
  const Shape& shape = found.shape;
  const auto ends = found.fit.parts.at(PiecePart::Top);
  const double middle = 0.5 * (shape.place(ends[0]).u + shape.place(ends[1]).u);
  double plus = 0, minus = 0;
  for (std::size_t k = ends[0]; k != ends[1]; k = (k + 1) % shape.size()) {
    const Ring& line = shape.runs[k].line;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double slice = (line[i].u - line[i + 1].u) * 0.5 * (line[i].v + line[i + 1].v - 2 * shape.low.v);
      (0.5 * (line[i].u + line[i + 1].u) > middle ? plus : minus) += slice;
    }
  }
  return plus < minus ? PieceReading::Side::Right : PieceReading::Side::Left;
}

// On which side of the wearer it goes, and whether there is another on the other side.
void findSide(const Piece& piece, const Candidate& found, PieceReading& reading) {
  switch (reading.role) {
    case PieceRole::Front:
    case PieceRole::Back:
      if (!found.fit.whole) reading.side = sideOfHalf(reading.role == PieceRole::Back, found.fit.mirrored);
      break;
    case PieceRole::LegFront:
    case PieceRole::LegBack:
      reading.side = sideOfHalf(reading.role == PieceRole::LegBack, found.fit.mirrored);
      break;
    case PieceRole::Leg:
      // Seen from the wearer's left the front lies at minus, and the back's crotch is the longer one.
      reading.side = lengthOf(reading, PiecePart::CrotchPlus) >= lengthOf(reading, PiecePart::CrotchMinus)
                         ? PieceReading::Side::Left
                         : PieceReading::Side::Right;
      break;
    case PieceRole::SkirtFront:
    case PieceRole::SkirtBack:
      readSkirtSide(piece, reading);
      break;
    case PieceRole::Sleeve:
      reading.side = sleeveSide(piece, found, reading.parts.at(PiecePart::Top));
      break;
    case PieceRole::Cuff:
      reading.side = PieceReading::Side::Left;
      break;
    default:
      break;
  }
  if (reading.side == PieceReading::Side::Both) return;
  reading.paired = true;
  // A name outranks the shape only where the shape is the same on both sides.
  if (const auto named = sideNamed(piece.name);
      named && (reading.role == PieceRole::Cuff ||
                (reading.role == PieceRole::Sleeve && even(reading, PiecePart::SidePlus, PiecePart::SideMinus))))
    reading.side = *named;
}

}  // namespace

Flat PieceReading::upright(Flat p) const {
  const double c = std::cos(turn), s = std::sin(turn);
  return {c * p.u - s * p.v, s * p.u + c * p.v};
}

Message roleSaid(PieceRole role) {
  switch (role) {
    case PieceRole::Front:
      return say("front");
    case PieceRole::Back:
      return say("back");
    case PieceRole::Yoke:
      return say("yoke");
    case PieceRole::Sleeve:
      return say("sleeve");
    case PieceRole::Leg:
      return say("trouser leg");
    case PieceRole::LegFront:
      return say("front of a trouser leg");
    case PieceRole::LegBack:
      return say("back of a trouser leg");
    case PieceRole::SkirtFront:
      return say("front of a skirt");
    case PieceRole::SkirtBack:
      return say("back of a skirt");
    case PieceRole::Collar:
      return say("collar");
    case PieceRole::CollarStand:
      return say("collar stand");
    case PieceRole::Waistband:
      return say("waistband");
    case PieceRole::Cuff:
      return say("cuff");
    case PieceRole::Aside:
      return say("not needed to drape");
    case PieceRole::Unknown:
      break;
  }
  return say("not recognised");
}

PieceReadings readPieces(const Pattern& pattern, const ToldRoles& told) {
  PieceReadings out;
  std::map<PieceId, Candidate> chosen;
  const std::map<PieceId, std::string> names = ownNames(pattern);
  for (const auto& [id, piece] : pattern.pieces) {
    const auto said = told.find(id);
    const PieceRole named = said != told.end() ? said->second : roleNamed(names.at(id));
    PieceReading& reading = out[id];
    reading.role = named == PieceRole::Aside ? named : PieceRole::Unknown;
    if (named == PieceRole::Aside || (said != told.end() && named == PieceRole::Unknown)) continue;
    const auto all = candidatesOf(*piece, named);
    if (all.empty() || all.front().score < (named == PieceRole::Unknown ? kPlain : kLikely)) continue;
    reading = readingOf(*piece, all.front(), named);
    chosen[id] = all.front();
  }
  // Which of the unnamed is front and which is back: of trunks the neck tells, of legs the crotch, of skirts nothing.
  partInTwo(out, PieceRole::Front, PieceRole::Back,
            [&](PieceId id) { return neckDepth(*pattern.pieces.at(id), out[id]); });
  partInTwo(out, PieceRole::LegBack, PieceRole::LegFront, [&](PieceId id) {
    return lengthOf(out[id], PiecePart::CrotchPlus) + lengthOf(out[id], PiecePart::CrotchMinus);
  });
  partInTwo(out, PieceRole::SkirtFront, PieceRole::SkirtBack,
            [&](PieceId id) { return lengthOf(out[id], PiecePart::Hem); });
  for (auto& [id, reading] : out)
    if (const auto found = chosen.find(id); found != chosen.end())
      findSide(*pattern.pieces.at(id), found->second, reading);

  // A symmetric copy lies on the other side of what it is the copy of; two that look alike lie one on each.
  for (auto& [id, reading] : out)
    if (const auto original = out.find(pattern.pieces.at(id)->mirrorOf); original != out.end() && reading.paired)
      reading.side = otherOf(original->second.side);
  for (auto& [id, reading] : out)
    for (auto& [other, twin] : out)
      if (other > id && reading.paired && twin.paired && twin.role == reading.role && twin.side == reading.side &&
          !pattern.pieces.at(id)->mirrorOf && !pattern.pieces.at(other)->mirrorOf &&
          (reading.role == PieceRole::Sleeve || reading.role == PieceRole::Cuff))
        twin.side = otherOf(reading.side);
  nameBands(out);
  takeOneOfEach(pattern, out);
  return out;
}

std::vector<Operation> copiesFor(const Document& document, const PieceReadings& readings) {
  std::vector<Operation> out;
  for (const auto& entry : readings) {
    const PieceId id = entry.first;
    const PieceReading& reading = entry.second;
    const Piece* piece = document.find(id);
    const auto often = document.cutting.find(id);
    const bool pairs = piece && !piece->mirrorOf && often != document.cutting.end() && often->second.pairs;
    if (!piece || !(reading.paired || (pairs && reading.role == PieceRole::Unknown))) continue;
    const bool there = reading.paired && std::any_of(readings.begin(), readings.end(), [&](const auto& other) {
                         return other.first != id && other.second.role == reading.role && other.second.paired &&
                                other.second.side != reading.side;
                       });
    // Two of one kind that lie alike are a left and a right one whose sides could not be told.
    const bool twin = reading.paired && std::count_if(readings.begin(), readings.end(), [&](const auto& other) {
                                          return other.second.role == reading.role && other.second.paired;
                                        }) > 1;
    if (there || twin) continue;
    MirrorPiece copy;
    copy.pieces = {PieceRef(id)};
    const std::string side = !reading.paired ? "mirrored" : reading.side == PieceReading::Side::Left ? "right" : "left";
    if (otherSide(piece->name) == piece->name) copy.name = usableName(document, piece->name + "_" + side);
    out.push_back(copy);
  }
  return out;
}

}  // namespace karinui
