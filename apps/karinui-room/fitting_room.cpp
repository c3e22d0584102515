#include "fitting_room.h"

#include <algorithm>
#include <chrono>
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
constexpr double kMenuBelow = 0.10;    // metres its middle hangs below the eyes
constexpr double kMenuAside = 0.45;    // radians from straight ahead to its middle
constexpr double kStickDead = 0.25, kStickTurns = 0.7;
constexpr double kRise = 0.35;                       // metres a second, the stick all the way
constexpr double kStickTurn = 0.5235987755982988;    // 30 degrees a push
constexpr double kVignetteIn = 8, kVignetteOut = 3;  // shares a second
constexpr Vec3 kListAt{0, -0.12, -1};                // metres from the eyes: what a list hangs before
constexpr std::size_t kLongList = 8;                 // more than so many items are hung in two columns

std::string dayNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char said[32] = "";
  std::tm local{};
  if (localtime_r(&now, &local)) std::strftime(said, sizeof said, "%Y-%m-%d %H%M%S", &local);
  return said;
}

}  // namespace

FittingRoom::FittingRoom(Session& session, RoomOptions options) : session_(session), options_(std::move(options)) {
  session_.setLanguage(options_.language);
}

Viewpoint FittingRoom::menuViewpoint() const {
  // The session hangs its bar at the right edge of a picture: this picture is turned so that the edge is at the
  // tool hand's side, an arm's length away, and a little below the eyes.
  const double far = kMenuFar / 0.62;  // the session hangs it at this share of the distance (session/menu.cpp)
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

SceneMenu FittingRoom::strip() const {
  SceneMenu strip;
  const auto menu = session_.menu();
  if (!menu || menu->buttons.empty()) return strip;
  // Beside the menu, towards the middle of the view, its buttons as large.
  const SceneMenu::Button& like = menu->buttons.front();
  const double rim = like.left, gap = rim * 0.5, wide = length(menu->across), button = like.height;
  const std::vector<Offer> offers = stripOffers(session_, options_.scale, list_, !options_.documents.empty());
  const std::size_t count = offers.size();
  const double high = static_cast<double>(count) * (button * 0.62 + gap) - gap + 2 * rim;
  const Vec3 aside = normalized(menu->across) * (wide * 1.12) * (options_.left ? 1.0 : -1.0);
  strip.across = menu->across;
  strip.upward = normalized(menu->upward) * high;
  strip.corner = menu->corner + aside + menu->upward * 0.5 - strip.upward * 0.5;
  for (std::size_t i = 0; i < count; ++i) {
    SceneMenu::Button one;
    one.left = rim;
    one.width = wide - 2 * rim;
    one.height = button * 0.62;
    one.bottom = high - rim - one.height - static_cast<double>(i) * (one.height + gap);
    one.hot = hotStrip_ == i;
    one.label = offers[i].label, one.enabled = offers[i].enabled, one.chosen = offers[i].chosen;
    strip.buttons.push_back(std::move(one));
  }
  return strip;
}

void FittingRoom::perform(const Offer& offer) {
  if (!offer.enabled) return;
  const std::optional<RoomCommand> opened = std::exchange(list_, std::nullopt);
  if (const auto* command = std::get_if<Command>(&offer.what)) {
    if (opened && *command == Command::Cancel) return;  // the list is closed, nothing else
    return session_.command(*command);
  }
  if (const auto* operation = std::get_if<Operation>(&offer.what)) return session_.perform(*operation);
  switch (const auto own = std::get<RoomCommand>(offer.what)) {
    case RoomCommand::More:
      if (!opened) list_ = own;
      return;
    case RoomCommand::Figure:
    case RoomCommand::Fabric:
      list_ = own;
      return;
    case RoomCommand::ChangeScale:
      changeScale_ = true;
      return;
    case RoomCommand::Keep:
      return keep();
  }
}

void FittingRoom::pressOnChoice(std::size_t item) {
  if (!choiceOf_) return session_.choose(item);
  const std::vector<Offer> offers = listOffers(session_, *choiceOf_);
  if (item < offers.size()) perform(offers[item]);
}

void FittingRoom::keep() {
  if (session_.path().empty()) return;
  if (!session_.draft())
    return session_.advise(say("Every step is saved in “{0}” as it is done.", session_.path().string()));
  std::error_code trouble;
  std::filesystem::create_directories(options_.documents, trouble);
  session_.saveAs(options_.documents / (session_.path().stem().string() + " " + dayNow() + ".karinui"));
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
  toolBefore_ = otherBefore_ = {};
  if (session_.begun()) session_.command(Command::Cancel);
  session_.leave();
  haptics_.reset();
  for (HandShown& hand : shown_) hand = {};
}

void FittingRoom::buttons(const ControllerState& tool, const ControllerState& other) {
  const auto struck = [](bool now, bool before) { return now && !before; };
  if (struck(tool.confirm, toolBefore_.confirm)) session_.command(Command::Confirm);
  if (struck(tool.cancel, toolBefore_.cancel)) session_.command(Command::Cancel);
  if (struck(other.confirm, otherBefore_.confirm)) session_.command(Command::Undo);
  if (struck(other.cancel, otherBefore_.cancel)) session_.command(Command::Redo);
  if (struck(tool.scaleSwitch, toolBefore_.scaleSwitch) || struck(other.scaleSwitch, otherBefore_.scaleSwitch))
    changeScale_ = true;
}

// The other hand's stick: up and down is the height, a push aside turns the body.
void FittingRoom::sticks(const ControllerState& other, double passed) {
  const Flat now = other.stick, before = otherBefore_.stick;
  if (std::fabs(now.v) > kStickDead) placement_.foot.y += now.v * kRise * passed;
  if (std::fabs(now.u) > kStickTurns && std::fabs(before.u) <= kStickTurns)
    placement_.turn += now.u > 0 ? kStickTurn : -kStickTurn;
}

PointerSample FittingRoom::inStand(PointerSample sample) const {
  sample.ray.origin = placement_.fittingToStand(sample.ray.origin);
  sample.ray.direction = placement_.fittingToStand(sample.ray.direction);
  if (sample.tip) sample.tip->carry = placement_.fittingToStand(sample.tip->carry);
  return sample;
}

bool FittingRoom::onBoards(const PointerSample& sample) {
  if (!boardDown_ && (sample.phase == Phase::Drag || sample.phase == Phase::Release))
    return hotStrip_.reset(), hotChoice_.reset(), false;
  if (boardDown_) {  // what was pressed on a board is over with its release
    boardDown_ = sample.phase != Phase::Release;
    return true;
  }
  const auto onChoice = choice_ ? hitOf(choice_->panel, inStand(sample)) : std::nullopt;
  const auto onStrip = onChoice ? std::nullopt : hitOf(strip(), sample);
  hotChoice_ = onChoice ? onChoice->button : std::nullopt;
  hotStrip_ = onStrip ? onStrip->button : std::nullopt;
  if (!onChoice && !onStrip) return false;
  if (sample.phase == Phase::Press) {
    boardDown_ = true;
    if (hotChoice_) pressOnChoice(*hotChoice_);
    if (hotStrip_) perform(stripOffers(session_, options_.scale, list_, !options_.documents.empty())[*hotStrip_]);
  }
  return true;
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
  const ControllerMapper::Around around{placement_, table_, head.carry, seconds,
                                        [&](const PointerSample& sample) -> std::optional<double> {
                                          if (const auto board = boards(sample)) return board;
                                          const auto hit = pick(session_.snapshot(), session_.table(), sample);
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

void FittingRoom::hangChoice(const Rigid& head) {
  const auto menu = session_.dropMenu();
  const bool isList = !menu && list_;
  if (std::exchange(choiceOf_, isList ? list_ : std::nullopt) != choiceOf_ || (!menu && !isList)) choice_.reset();
  if (!menu && !isList) return;
  const std::vector<Offer> offers = isList ? listOffers(session_, *list_) : std::vector<Offer>();
  const std::vector<Message> title = isList ? std::vector{titleOf(*list_)} : menu->title;
  const std::size_t items = isList ? offers.size() : menu->items.size(), columns = items > kLongList ? 2 : 1;
  if (!choice_) {
    const Vec3 about = isList ? placement_.roomToStand(head.carry + turnedAboutUp(kListAt, headingOf(head)))
                       : menu->where == PointerSample::Where::Table ? table_.at(menu->table)
                                                                    : placement_.fittingToStand(menu->space);
    choice_ = choiceBefore(placement_.roomToStand(head.carry), about, placement_.scale, items, columns);
  }
  choice_->title = title;
  choice_->panel.buttons.clear();
  for (std::size_t i = 0; i < items; ++i) {
    SceneMenu::Button button = buttonOn(choice_->panel, i, items, columns);
    button.hot = hotChoice_ == i;
    if (isList) {
      button.label = offers[i].label, button.enabled = offers[i].enabled, button.chosen = offers[i].chosen;
    } else {
      const DropMenu::Item& item = menu->items[i];
      button.label = !item.checked ? item.label : *item.checked ? say("☑ {0}", item.label) : say("☐ {0}", item.label);
      button.chosen = menu->current == i;
    }
    choice_->panel.buttons.push_back(std::move(button));
  }
}

void FittingRoom::takeNotices(double seconds) {
  std::erase_if(captions_, [&](const Caption& caption) { return caption.until < seconds; });
  for (Notice& notice : session_.takeNotices()) captions_.push_back({std::move(notice), seconds + kRead});
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
  if (!placed_) {
    placement_ = placedBefore(head, options_.scale, options_.posture);
    anchor_.place(head);
    placed_ = true;
  }
  const ControllerState &tool = hands[toolSide()], &other = hands[1 - toolSide()];
  anchor_.follow(head, seconds, session_.begun() || input_.down() || overBoard_ || choice_.has_value());

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
  if (tool.tracked) toolBefore_ = tool;
  if (other.tracked) otherBefore_ = other;
}

std::array<std::vector<HapticPulse>, 2> FittingRoom::takeHapticPulses() { return std::exchange(pulses_, {}); }

}  // namespace karinui::room
