#include "fitting_room.h"

#include <algorithm>
#include <cmath>

#include "panel_hit.h"

namespace karinui::room {

using Phase = PointerSample::Phase;

namespace {

constexpr double kRead = 7;            // seconds a sentence stays
constexpr std::size_t kMostRead = 3;   // sentences at once
constexpr double kMenuFar = 0.62;      // metres from the eyes to the menu
constexpr double kMenuTanHalf = 0.42;  // of the picture it is hung into,
constexpr double kMenuAspect = 0.70;   // and that picture's width
constexpr double kMenuAside = 0.45;    // radians from straight ahead to its middle
constexpr double kStickDead = 0.25, kStickTurns = 0.7;
constexpr double kRise = 0.35;                       // metres a second, the stick all the way
constexpr double kStickTurn = 0.5235987755982988;    // 30 degrees a push
constexpr double kVignetteIn = 8, kVignetteOut = 3;  // shares a second

}  // namespace

FittingRoom::FittingRoom(Session& session, RoomOptions options) : session_(session), options_(std::move(options)) {
  session_.setLanguage(options_.language);
}

Viewpoint FittingRoom::menuViewpoint() const {
  // The session hangs its bar at the right edge of a picture: this picture is turned so that the edge is at the
  // tool hand's side, an arm's length away, and a little below the eyes.
  const double far =
      menuNear_ * kMenuFar / 0.62;  // the session hangs it at this share of the distance (session/menu.cpp)
  const double edge = std::atan2(kMenuTanHalf * kMenuAspect * kMenuFar * 0.72, kMenuFar);
  const double heading = anchor_.heading() - (options_.left ? -kMenuAside : kMenuAside) + edge;
  const double back = heading - placement_.heading - placement_.turn;
  Viewpoint viewpoint;
  viewpoint.eye = placement_.roomToFitting(anchor_.eyes() - Vec3{0, kMenuBelow, 0});
  viewpoint.right = turnedAboutUp({1, 0, 0}, back);
  viewpoint.up = {0, 1, 0};
  viewpoint.back = turnedAboutUp({0, 0, 1}, back);
  viewpoint.tanHalf = kMenuTanHalf;
  viewpoint.aspect = kMenuAspect;
  viewpoint.distance = far / placement_.scale;
  return viewpoint;
}

void FittingRoom::changeScale(const Rigid& head) {
  options_.scale = options_.scale == Scale::One ? Scale::TableTop : Scale::One;
  const double turn = placement_.turn;
  placement_ = placedBefore(head, options_.scale, options_.posture);
  placement_.turn = turn;
  anchor_.place(head);
}

void FittingRoom::dropHands() {
  input_.drop();
  toolGrip_.release(), otherGrip_.release();
  GrabLocomotion none;
  grip_ = none;
  boardDown_ = false;
  handsBack_ = true;
  if (session_.begun()) {
    session_.command(Command::Cancel);
    session_.advise(say("The hand was lost; what it was doing is dropped."));
  }
  session_.leave();
  haptics_.reset();
  for (HandShown& hand : shown_) hand = {};
}

void FittingRoom::buttons(const ControllerState& tool, const ControllerState& other) {
  const auto struck = [](bool now, bool before) { return now && !before; };
  if (struck(tool.confirm, toolBefore_.confirm)) session_.command(Command::Confirm);
  if (struck(tool.cancel, toolBefore_.cancel)) {
    if (choiceOf_)
      list_.reset();  // as the strip's Cancel does: the list is closed, nothing else
    else
      session_.command(Command::Cancel);
  }
  if (struck(other.confirm, otherBefore_.confirm)) session_.command(Command::Undo);
  if (struck(other.cancel, otherBefore_.cancel)) session_.command(Command::Redo);
  const bool leap =
      struck(tool.scaleSwitch, toolBefore_.scaleSwitch) || struck(other.scaleSwitch, otherBefore_.scaleSwitch);
  if (leap && !dragging()) changeScale_ = true;  // or what is held would be thrown
}

// The other hand's stick: up and down is the height, a push aside turns the body.
void FittingRoom::sticks(const ControllerState& other, double passed) {
  const Flat now = other.stick, before = otherBefore_.stick;
  if (std::fabs(now.v) > kStickDead) placement_.foot.y += now.v * kRise * passed;
  if (std::fabs(now.u) > kStickTurns && std::fabs(before.u) <= kStickTurns)
    placement_.turn += now.u > 0 ? kStickTurn : -kStickTurn;
}

void FittingRoom::point(const Rigid& head, const ControllerState& tool, const ControllerState& other, double seconds) {
  const auto boards = [&](const PointerSample& sample) {
    std::optional<double> nearest;
    const auto take = [&](const std::optional<PanelHit>& hit) {
      if (hit && (!nearest || hit->along < *nearest)) nearest = hit->along;
    };
    if (const auto menu = session_.menu()) take(hitOf(*menu, sample));
    take(hitOf(strip(), sample));
    if (choice_) take(hitOf(choice_->panel, inStand(sample)));
    return nearest;
  };
  const SnapshotPtr picked = session_.pickedPtr();
  const ControllerMapper::Around around{placement_, table_, head.carry, seconds,
                                        [&](const PointerSample& sample) -> std::optional<double> {
                                          if (const auto board = boards(sample)) return board;
                                          const auto hit = pick(*picked, session_.table(), sample);
                                          if (hit.on == Hit::On::Nothing && !(sample.tip && hit.edge))
                                            return std::nullopt;
                                          return hit.along;
                                        }};
  const auto which = options_.left ? PointerSample::Hand::Left : PointerSample::Hand::Right;
  ControllerMapper::Mapped came = input_.follow(tool, which, around);
  HandShown& shown = shown_[toolSide()];
  shown.ray = came.sample ? std::optional(came.ray) : std::nullopt;
  shown.along = came.along;
  shown.touching = came.touching;
  shown.down = input_.down();
  if (came.lost) return dropHands();
  if (!came.sample) {
    haptics_.reset();
    return;
  }
  PointerSample sample = *came.sample;
  sample.shift = other.tracked && other.trigger > kPressed;
  sample.control = tool.stick.v > kPressed;
  sample.alt = tool.stick.v < -kPressed;
  const bool mine = onBoards(sample);
  if (mine && !overBoard_) session_.leave();
  overBoard_ = mine;
  if (!mine) session_.feed(sample);
  if (mine) return haptics_.reset();
  const bool inSpace = sample.tip && sample.where == PointerSample::Where::Space;
  const std::optional<Vec3> tip = inSpace ? std::optional(sample.tip->carry) : std::nullopt;
  if (const auto pulse = haptics_.follow(session_, tip, seconds)) pulses_[toolSide()].push_back(*pulse);
}

void FittingRoom::takeNotices(double seconds) {
  std::erase_if(captions_, [&](const Caption& caption) { return caption.until < seconds; });
  if (session_.takeAsked()) session_.refuse(badInput(say("Nothing is typed here: drag it in its size.")));
  for (Notice& notice : session_.takeNotices()) {
    const std::string said = text(notice.what);  // once, however often
    std::erase_if(captions_, [&](const Caption& caption) { return text(caption.notice.what) == said; });
    captions_.push_back({std::move(notice), seconds + kRead});
  }
  if (captions_.size() > kMostRead)
    captions_.erase(captions_.begin(), captions_.end() - static_cast<std::ptrdiff_t>(kMostRead));
}

// The menu's View places the fitting before the person again; the views from a side turn the body.
void FittingRoom::takeView(const Rigid& head) {
  const auto asked = session_.takeView();
  if (!asked) return;
  const double turn = *asked == Command::ViewBack    ? 3.14159265358979323846
                      : *asked == Command::ViewLeft  ? -1.57079632679489662
                      : *asked == Command::ViewRight ? 1.57079632679489662
                                                     : 0;
  placement_ = placedBefore(head, options_.scale, options_.posture);
  placement_.turn = turn;
  anchor_.place(head);
}

void FittingRoom::step(const Rigid& head, const Hands& hands, double seconds) {
  const double passed = begun_ ? std::clamp(seconds - before_, 0.0, 0.1) : 0;
  before_ = seconds, begun_ = true;
  session_.update();
  const ControllerState &tool = hands[toolSide()], &other = hands[1 - toolSide()];
  busy_ = session_.busy().any ? busy_ + passed : 0;
  unseen_ = tool.tracked ? 0 : unseen_ + passed;
  if (std::exchange(handsBack_, false)) toolBefore_ = tool, otherBefore_ = other;
  if (!placed_) {
    if (dragging()) dropHands();
    placement_ = placedBefore(head, options_.scale, options_.posture);
    anchor_.place(head);
    placed_ = true;
  }
  const bool kept = input_.down() || overBoard_ || choice_.has_value();
  anchor_.follow(head, seconds, kept);

  const bool moved = grip_.follow(placement_, {tool.tracked && toolGrip_.follow(tool.hold), tool.grip.carry},
                                  {other.tracked && otherGrip_.follow(other.hold), other.grip.carry});
  const Placement sticked = placement_;
  if (other.tracked) sticks(other, passed);
  const bool flown = moved || sticked.foot.y != placement_.foot.y;
  vignette_ = std::clamp(vignette_ + (flown ? kVignetteIn : -kVignetteOut) * passed, 0.0, 1.0);

  // Not while something is held: a table that makes room for paper as it grows would carry it away under the ray.
  if (!session_.begun() && tableOf_ != session_.changes().garment)
    table_ = patternTableFor(session_, options_.left), tableOf_ = session_.changes().garment;
  session_.setViewpoint(menuViewpoint());
  if (!kept) hangMenuClear();
  for (const std::size_t side : {kLeft, kRight}) {
    const ControllerState& hand = hands[side];
    shown_[side] = {};
    shown_[side].seen = hand.tracked;
    shown_[side].tool = side == toolSide();
    shown_[side].grip = placement_.roomToStand(hand.grip);
  }
  buttons(tool, other);
  point(head, tool, other, seconds);
  if (std::exchange(changeScale_, false)) changeScale(head);
  session_.update();
  takeView(head);
  hangChoice(head);
  takeNotices(seconds);
  toolBefore_ = tool, otherBefore_ = other;  // out of sight, too: their buttons still tell
}

std::array<std::vector<HapticPulse>, 2> FittingRoom::takeHapticPulses() { return std::exchange(pulses_, {}); }

}  // namespace karinui::room
