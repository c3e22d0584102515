// Pulling with live drape, and reshaping with live paper: the same hand, once with force and once without.
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/pattern/seam_walk.h"
#include "karinui/session/touch_scene_of.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kLeastPull = 0.003;  // metres: less is a click
constexpr double kInside = 0.001;     // metres from an edge that was pointed at from beside the cloth

// Where the hand takes hold: of the cloth under it or, a little beside the cloth, of the edge within its reach.
struct Hold {
  PieceId piece;
  Flat at;
  Vec3 point;
};
std::optional<Hold> holdAt(const Hit& hit, const GestureContext& context) {
  if (hit.on == Hit::On::Cloth) return Hold{hit.piece, tenth(hit.paper), hit.point};
  if (!hit.edge) return std::nullopt;
  const Piece* piece = context.snapshot->document.find(hit.edge->piece);
  const Edge* edge = piece ? findEdge(*piece, hit.edge->edge) : nullptr;
  if (!edge) return std::nullopt;
  const Curve& curve = edge->curve;
  const double t = curve.parameterAt(hit.edge->fraction * curve.length());
  const Flat at = tenth(curve.at(t) + leftOf(normalized(curve.tangent(t))) * kInside);
  const auto point = spaceOf(*context.snapshot, piece->id, at);
  return point ? std::optional(Hold{piece->id, at, *point}) : std::nullopt;
}

// The places of the paper that lie where `at` does once the piece's own seams are sewn, as beyond the underarm of a
// sleeve: its paper goes on there beyond the other edge. Those nearer than `within`.
std::vector<Flat> beyondOwnSeams(const Document& document, PieceId id, Flat at, double within) {
  constexpr int kParts = 200;     // of an edge, looked at for the nearest place
  constexpr double kOne = 0.002;  // metres: places nearer than this are one
  std::vector<Flat> all;
  const Piece& piece = *document.find(id);
  for (const Edge& edge : piece.outline.edges) {
    double nearest = within, fraction = -1;
    for (int k = 0; k <= kParts; ++k)
      if (const double away = distance(edge.curve.atFraction(double(k) / kParts), at); away < nearest)
        nearest = away, fraction = double(k) / kParts;
    if (fraction < 0) continue;
    for (const SeamPlace& other : sewnTo(document.pattern, {id, edge.name, fraction})) {
      const Edge* partner = other.piece == id ? findEdge(piece, other.edge) : nullptr;
      if (!partner) continue;
      const auto along = [](const Curve& curve, double share) {
        return normalized(curve.tangent(curve.parameterAt(share * curve.length())));
      };
      const Flat from = edge.curve.atFraction(fraction), own = along(edge.curve, fraction), off = at - from;
      const Flat theirs = along(partner->curve, other.fraction) * -1;  // outlines meet in a seam running opposite ways
      const Flat there = tenth(partner->curve.atFraction(other.fraction) + theirs * dot(off, own) +
                               leftOf(theirs) * dot(off, leftOf(own)));
      const auto known = [&](Flat one) { return distance(one, there) < kOne; };
      if (distance(there, at) >= kOne && std::none_of(all.begin(), all.end(), known)) all.push_back(there);
    }
  }
  return all;
}

class HandOnCloth : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    if (sample.where != PointerSample::Where::Space) {
      if (sample.phase == PointerSample::Phase::Press) return {.why = say("Take hold of the cloth on the body.")};
      return {};
    }
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        hover_.reset();
        if (const auto hold = holdAt(hit, context)) hover_ = hold->point;
        return {};
      case PointerSample::Phase::Press: {
        const auto hold = holdAt(hit, context);
        if (!hold) return {.why = say("Take hold of the cloth on the body.")};
        if (const Piece* piece = context.snapshot->document.find(hold->piece); piece && piece->frozen && !mayBeFrozen())
          return {.why = say("“{0}” is frozen; thaw it first.", piece->name)};
        held_ = hold->piece;
        at_ = hold->at;
        start_ = hold->point;
        grip_ = handAt(sample, start_);
        path_ = {Vec3{}};
        began_ = sample.seconds;
        hover_.reset();
        took(context);
        return {};
      }
      case PointerSample::Phase::Drag:
      case PointerSample::Phase::Release:
        break;
    }
    if (!held_) return {};
    const Vec3 by = tenth(handAt(sample, grip_) - grip_);
    const bool moved = distance(by, path_.back()) > 0;
    if (moved) path_.push_back(by);
    keep_ = sample.shift;
    if (sample.phase == PointerSample::Phase::Drag)
      return {.request = moved || goesOn() ? request() : PreviewRequest{}};
    const double most = furthest();
    GestureResult told{.over = true};
    if (most >= kLeastPull) told.operation = operation(sample.seconds - began_);
    held_ = {};
    return told;
  }

  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (hover_) shown.space.dots.push_back(*hover_);
    if (!held_) return shown;
    const Vec3 hand = start_ + by();
    shown.space.dots.push_back(hand);
    showHeld(shown, hand, context);
    return shown;
  }
  Message hint() const override { return words(); }
  bool begun() const override { return static_cast<bool>(held_); }

 protected:
  virtual bool mayBeFrozen() const { return false; }
  virtual bool goesOn() const { return false; }  // while the hand is still, too
  virtual void took(const GestureContext& context) = 0;
  virtual PreviewRequest request() const = 0;
  virtual Operation operation(double seconds) const = 0;
  virtual Message words() const = 0;
  virtual void showHeld(Preview& shown, Vec3 hand, const GestureContext& context) const = 0;
  Vec3 by() const { return path_.back(); }
  double furthest() const {
    double most = 0;
    for (const Vec3 p : path_) most = std::max(most, length(p));
    return most;
  }

  PieceId held_;
  Flat at_;
  Vec3 start_, grip_;
  std::vector<Vec3> path_;
  std::optional<Vec3> hover_;
  double began_ = 0;
  bool keep_ = false;
};

class PullGesture : public HandOnCloth {
 public:
  void previewed(const PreviewReply& reply) override {
    if (reply.force) force_ = reply.force;
    why_ = reply.why;
  }
  void addTo(Handling& handling) const override {
    if (held_) handling.pull = Handling::Pull{held_, at_, grip_, grip_ + by(), force_};
  }

 protected:
  void showHeld(Preview& shown, Vec3 hand, const GestureContext&) const override {
    // The arrow is what the cloth does to the hand: 1 cm for a tenth of a newton, never longer than an arm.
    const double newtons = force_ ? length(*force_) : 0;
    if (force_ && newtons > 1e-3) {
      const Vec3 arrow = normalized(*force_) * std::min(0.4, 0.1 * newtons);
      shown.space.lines.push_back({{hand, hand + arrow}, kPartner, 5, true});
    } else {
      shown.space.lines.push_back({{start_, hand}, kChalk, 2, true});
    }
    if (force_) shown.space.words.push_back({hand, fixed(newtons, 2) + " N"});
  }
  void took(const GestureContext&) override { force_.reset(), why_.reset(); }
  bool goesOn() const override { return true; }  // the cloth comes to rest, and pulls less
  PreviewRequest request() const override { return PullPreview{held_, at_, by()}; }
  Operation operation(double seconds) const override {
    PullCloth pull;
    pull.piece = held_;
    pull.at = at_;
    const auto kept = mattering<Vec3>(path_, 0.005);
    for (std::size_t k = 1; k < kept.size(); ++k) pull.by.push_back(path_[kept[k]]);
    if (pull.by.empty()) pull.by.push_back(path_.back());
    pull.seconds = std::clamp(std::round(seconds * 10) / 10, 0.3, 3.0);
    pull.letGo = !keep_;
    return pull;
  }
  Message words() const override {
    if (why_) return *why_;
    if (held_ && force_)
      return say("The cloth pulls with {0} N. Let go and it swings back; with Shift it stays held.",
                 fixed(length(*force_), 2));
    return info(Command::Pull).hint;
  }

 private:
  std::optional<Vec3> force_;
  std::optional<Message> why_;
};

class ReshapeGesture : public HandOnCloth {
 public:
  void previewed(const PreviewReply& reply) override {
    after_ = reply.after ? reply.after : after_;
    why_ = reply.why;
  }
  void addTo(Handling& handling) const override { handling.still = static_cast<bool>(held_); }

 protected:
  void showHeld(Preview& shown, Vec3 hand, const GestureContext& context) const override {
    shown.space.lines.push_back({{start_, hand}, kChalk, 3, true});
    shown.space.words.push_back({hand, context.said(length(by()))});
    if (after_)
      if (const Piece* piece = after_->document.find(held_)) shown.outlines[held_] = piece->outline;
  }
  bool mayBeFrozen() const override { return true; }
  void took(const GestureContext& context) override {
    after_.reset(), why_.reset();
    beyond_ = beyondOwnSeams(context.snapshot->document, held_, at_, ReshapePiece().within);
  }
  PreviewRequest request() const override { return OperationPreview{reshape()}; }
  Operation operation(double) const override { return reshape(); }
  Message words() const override { return why_ ? *why_ : info(Command::Reshape).hint; }

 private:
  ReshapePiece reshape() const {
    ReshapePiece op;
    op.piece = held_;
    op.at = {at_};
    op.at.insert(op.at.end(), beyond_.begin(), beyond_.end());
    op.by.assign(op.at.size(), by());
    return op;
  }
  std::vector<Flat> beyond_;
  SnapshotPtr after_;
  std::optional<Message> why_;
};

}  // namespace

std::unique_ptr<Gesture> pullGesture() { return std::make_unique<PullGesture>(); }
std::unique_ptr<Gesture> reshapeGesture() { return std::make_unique<ReshapeGesture>(); }

}  // namespace karinui
