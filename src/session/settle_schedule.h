#pragma once
// What a drape under way brings to rest, what a step interrupted, and which drapes came without being asked for. State
// only: the session adds the tasks. At most one drape runs or waits; a piece is draped or interrupted, never both.
// One thread.
#include <cstdint>
#include <memory>
#include <set>

#include "karinui/cloth/stop_request.h"
#include "karinui/design/document.h"
#include "karinui/design/operation.h"

namespace karinui {

// The drape that brings these pieces to rest.
inline DrapePieces drapeOf(const std::set<PieceId>& live, DrapePieces drape = {}) {
  drape.live.clear();
  for (const PieceId id : live) drape.live.push_back(PieceRef(id));
  return drape;
}

// What an operation left to be brought to rest again by itself: pieces that rested before it.
inline std::set<PieceId> disturbedBy(const Document& before, const Document& after) {
  std::set<PieceId> disturbed;
  for (const PieceId id : after.drape.dirty)
    if (before.drape.last && !before.drape.dirty.contains(id)) disturbed.insert(id);
  return disturbed;
}

// The same by what the operation is; a ready block, and a band that is sewn to what hangs, are draped at once.
inline std::set<PieceId> disturbedBy(const Document& before, const Document& after, const Operation& operation) {
  const auto* band = std::get_if<DrawBand>(&operation);
  const bool sewnToWhatHangs = band && band->sew && before.drape.last && before.drape.dirty.empty();
  if (sewnToWhatHangs || std::holds_alternative<DraftBlock>(operation))
    return {after.drape.dirty.begin(), after.drape.dirty.end()};
  return disturbsDrape(operation) ? disturbedBy(before, after) : std::set<PieceId>();
}

// What stood still beside cloth that came to rest, and is pulled otherwise now, joins it.
inline std::set<PieceId> joinedBy(std::set<PieceId> live, const Document& document) {
  for (const PieceId id : document.drape.last->toActivate) {
    const Piece* piece = document.find(id);
    if (piece && !piece->frozen && !document.drape.dirty.contains(id)) live.insert(id);
  }
  return live;
}

class SettleSchedule {
 public:
  // A drape of these pieces takes the place of the one before. The request stops it where it is.
  std::shared_ptr<StopRequest> begin(std::set<PieceId> live, bool automatic) {
    live_ = std::move(live), automatic_ = automatic;
    for (const PieceId id : live_) interrupted_.erase(id);
    return stop_ = std::make_shared<StopRequest>();
  }
  // The drape with this request is over; an older one than that under way ends nothing.
  void end(const std::shared_ptr<StopRequest>& of) {
    if (stop_ == of) stop_.reset(), live_.clear();
  }
  // A step comes first: true where a drape is to be cancelled. One that is stopping is over in a moment by itself.
  bool interrupt() {
    if (live_.empty() || (stop_ && stop_->asked())) return false;
    interrupted_.merge(live_);
    stop_.reset(), live_.clear();
    return true;
  }
  enum class Stopping { UnderWay, NotBegun };  // it ends where the cloth is; it has not moved anything yet
  Stopping stop() {
    interrupted_.clear();
    return stop_ && (stop_->asked() || stop_->ask()) ? Stopping::UnderWay : Stopping::NotBegun;
  }
  void drop() { stop_.reset(), live_.clear(), interrupted_.clear(); }  // as if it had not begun

  const std::set<PieceId>& live() const { return live_; }
  bool automatic() const { return automatic_; }
  void disturb(PieceId id) {  // to be draped when steps are through
    if (!live_.contains(id)) interrupted_.insert(id);
  }
  const std::set<PieceId>& interrupted() const { return interrupted_; }
  void setInterrupted(std::set<PieceId> pieces) { interrupted_ = std::move(pieces); }

  // Steps that came by themselves: undone and redone with their cause.
  void cameByItself(std::uint64_t seq) { automaticSteps_.insert(seq); }
  const std::set<std::uint64_t>& automaticSteps() const { return automaticSteps_; }
  void forgetSteps() { automaticSteps_.clear(); }

 private:
  std::set<PieceId> live_, interrupted_;
  bool automatic_ = false;
  std::shared_ptr<StopRequest> stop_;  // null: no drape runs or waits
  std::set<std::uint64_t> automaticSteps_;
};

}  // namespace karinui
