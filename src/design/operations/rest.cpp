// drape and pull as steps of a document: what they record and what they leave. The work itself is done by the context's
// solver, or by drapeOnBody() and pullOnBody().
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "design/operations/dressing.h"
#include "karinui/geometry/bvh.h"
#include "karinui/pattern/facing.h"

namespace karinui {

namespace {

// Records the live pieces by name, so that a piece added to an earlier step later on does not join.
Done resolveLive(const Document& before, std::vector<PieceRef>& live) {
  if (live.empty()) {
    for (const PieceId id : livePieces(before, {})) live.emplace_back(id);
    if (live.empty()) return refused(say("There is no piece to drape."));
  }
  if (Done done = resolve(before, live); !done) return done;
  for (const PieceRef& ref : live) {
    const Piece& piece = *before.find(ref.id);
    if (piece.frozen) return refused(say("“{0}” is frozen; thaw it first: freeze piece={0} frozen=no.", piece.name));
  }
  return {};
}

// Heights above the floor.
struct Heights {
  double sum = 0, top = -HUGE_VAL;
  std::size_t points = 0;
  void add(double height) { sum += height, top = std::fmax(top, height), ++points; }
  double mean() const { return sum / static_cast<double>(std::max<std::size_t>(points, 1)); }
};

// What slid down as a whole is not where it is worn, even if it came to rest there.
void tellFallen(const Document& before, const DrapeOutcome& outcome, const Context& context) {
  constexpr double kFallen = 0.25;  // metres, its top and its mean
  std::set<PieceId> told;
  for (const auto& [id, form] : outcome.forms) {
    if (!told.insert(id).second) continue;
    Heights was, is;
    bool pinned = false;
    for (const PieceId one : hangTogether(before, id)) {
      told.insert(one);
      pinned = pinned || before.pins.contains(one);
      const Piece& piece = *before.find(one);
      const auto now = outcome.forms.find(one);
      if (now == outcome.forms.end()) continue;
      const Stand stand(piece);
      for (const Flat place : now->second->flat) was.add(stand(place).y);
      for (const Vec3 place : now->second->space) is.add(place.y);
    }
    const double by = std::fmin(was.mean() - is.mean(), was.top - is.top);
    if (!pinned && by > kFallen)
      context.advise({say("“{0}” has slid down by {1} cm, for nothing holds it up. Sew or fasten it closed, make it "
                          "narrower where it is to stay, or pin it.",
                          before.find(id)->name, std::round(by * 100)),
                      id});
  }
}

// How much of one piece's cloth lies over another, and on which side of it as seen from the body.
struct LaidOver {
  int outside = 0, inside = 0;
};
LaidOver laidOver(const Form& form, const Form& other, const Body& body) {
  constexpr double kNear = 0.02, kClearly = 2e-3;  // metres
  TriangleMesh mesh;
  mesh.points = other.space, mesh.faces = other.faces;
  const Bvh cloth(mesh);
  LaidOver laid;
  for (const Vec3 place : form.space) {
    const auto near = cloth.nearest(place, kNear);
    if (!near) continue;
    const double by = body.field().distance(place) - body.field().distance(near->point);
    if (by > kClearly) ++laid.outside;
    if (by < -kClearly) ++laid.inside;
  }
  return laid;
}

// A lower layer that came to rest outside a higher one, as the shield of a fly that was sewn on before the garment
// hung: what is sewn up at once lies as its pieces came together. A facing turned out with a lapel is meant.
void tellLayers(const Document& before, const DrapeOutcome& outcome, Context& context) {
  constexpr double kShare = 0.3, kMostly = 4;  // of its cloth; times as much as lies inside
  const auto body = bodyOf(before, context);
  if (!body) return;
  const std::set<PieceId> insideOut = wornInsideOut(before.pattern);
  for (const auto& [id, form] : outcome.forms)
    for (const auto& [above, other] : outcome.forms) {
      const Piece &lower = *before.find(id), &upper = *before.find(above);
      if (lower.layer >= upper.layer || insideOut.contains(id) || insideOut.contains(above)) continue;
      const LaidOver laid = laidOver(*form, *other, **body);
      if (laid.outside < kShare * static_cast<double>(form->space.size()) || laid.outside < kMostly * laid.inside)
        continue;
      context.advise({say("“{0}” came to rest outside “{1}”, though its layer is the lower one. Drape the garment "
                          "without it, then lead it to its edge (attach), sew it there and drape again.",
                          lower.name, upper.name),
                      id});
      break;
    }
}

}  // namespace

Done resolve(const Document& before, DrapePieces& op, Context&) {
  if (!(length(op.gravity) <= 100)) return refused(say("Gravity is about 9.81 m/s2; that is too much."));
  if (op.stop < 0) return refused(say("A drape stops after a number of steps that is not negative."));
  return resolveLive(before, op.live);
}

Result<Document> perform(const Document& before, const DrapePieces& op, Context& context) {
  const Result<DrapeOutcome> outcome = draped(before, op, context);
  if (!outcome) return outcome.error();
  if (context.advise) tellFallen(before, *outcome, context), tellLayers(before, *outcome, context);
  return adopted(before, *outcome);
}

Done resolve(const Document& before, PullCloth& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  const Piece& piece = *before.find(op.piece.id);
  const Ring ring = piece.outline.flattened(1e-4);
  if (!contains(ring, op.at) && !(distanceToRing(ring, op.at) <= 0.01)) {
    return refused(say("The place {0} mm, {1} mm is not on “{2}”.", std::round(op.at.u * 1000),
                       std::round(op.at.v * 1000), piece.name));
  }
  if (op.by.empty()) return refused(say("Say where the cloth is pulled: by=\"0,5cm,10cm\"."));
  for (const Vec3 step : op.by)
    if (!(length(step) <= 10)) return refused(say("The cloth is pulled by at most 10 m."));
  if (!(op.seconds >= 0.01 && op.seconds <= 60)) return refused(say("A pull takes between 0.01 and 60 seconds."));
  if (!(op.patch >= 0.001 && op.patch <= 0.2)) return refused(say("Fingers hold between 1 mm and 20 cm of cloth."));
  if (op.live.empty())
    for (const PieceId id : hangTogether(before, op.piece.id)) op.live.emplace_back(id);
  if (Done done = resolveLive(before, op.live); !done) return done;
  if (!livePieces(before, op.live).contains(op.piece.id)) {
    return refused(say("“{0}” is pulled, so it must be among the live pieces.", piece.name));
  }
  return {};
}

Result<Document> perform(const Document& before, const PullCloth& op, Context& context) {
  auto outcome = context.pull ? context.pull(before, op, context) : pullOnBody(before, op, context);
  if (!outcome) return outcome.error();
  return adopted(before, *outcome);
}

}  // namespace karinui
