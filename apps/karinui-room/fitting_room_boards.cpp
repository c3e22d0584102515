// The boards of the room: the strip beside the menu, the lists it opens, and what is to be chosen of a seam.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "fitting_room.h"
#include "karinui/base/number.h"
#include "panel_hit.h"

namespace karinui::room {

using Phase = PointerSample::Phase;

namespace {

constexpr Vec3 kListAt{0, -0.12, -1};                    // metres from the eyes: what a list hangs before
constexpr double kListWide = 0.46;                       // of its distance
constexpr double kListLeft = -0.21, kListRight = -0.25;  // its left edge (kBeside): clear of the words and the strip
constexpr double kPatience = 0.5;                        // seconds until it is told what is worked out
constexpr double kRatioStep = 0.25, kLengthStep = 1;     // a press turns a number by so much
constexpr double kWorn = 0.08;                           // metres of the fitting that cloth stands off the figure
constexpr double kNearest = 0.28;                        // metres from the eyes: no board hangs nearer
constexpr std::size_t kColumn = 8, kMostColumns = 3;     // items of a column: a higher board covers the strip

std::string dayNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char said[32] = "";
  std::tm local{};
  if (localtime_r(&now, &local)) std::strftime(said, sizeof said, "%Y-%m-%d %H%M%S", &local);
  return said;
}

}  // namespace

Message FittingRoom::hint() const {
  const Message hint = session_.hint();
  // Nobody is flown to another place here: see takeView().
  return text(hint) == text(info(Command::ViewOblique).hint) ? say("Brings body and table before you again.") : hint;
}

std::optional<Message> FittingRoom::working() const {
  const Busy busy = session_.busy();
  const int percent = static_cast<int>(std::lround(100 * busy.fraction));
  if (busy.any && busy.settling) return say("Settling: {0} %", percent);
  if (!busy.any || busy_ < kPatience || busy.doing.empty()) return std::nullopt;
  return say("{0}: {1} %", busy.doing, percent);
}

double FittingRoom::clearShare(Vec3 eyes, Vec3 corner, Vec3 across, Vec3 upward) const {
  const BodyPtr& body = session_.snapshot().body;
  if (!body) return 1;
  constexpr int kSteps = 4;
  const Vec3 from = placement_.standToFitting(eyes);
  double share = 1;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Vec3 to = placement_.standToFitting(corner + across * (1.0 * i / kSteps) + upward * (1.0 * j / kSteps));
      const double far = distance(from, to);
      if (!(far > 0)) continue;
      const auto met = body->bvh().first(from, (to - from) * (1 / far));
      if (met && met->along < far + kWorn) share = std::min(share, (met->along - kWorn) / far);
    }
  const double middle = distance(eyes, corner + (across + upward) * 0.5);
  return std::clamp(share, std::min(1.0, kNearest / (placement_.scale * std::max(middle, 1e-6))), 1.0);
}

// The menu and its strip hang nearer where the figure would hide them: a person within reach of it stands so.
void FittingRoom::hangMenuClear() {
  const auto menu = session_.menu();
  if (!menu) return;
  const SceneMenu beside = strip();
  const Vec3 eyes = placement_.roomToStand(anchor_.eyes() - Vec3{0, kMenuBelow, 0});
  double share = 1;
  for (const SceneMenu* panel : {&*menu, &beside}) {  // where they would hang at their full distance
    const Vec3 corner = eyes + (placement_.fittingToStand(panel->corner) - eyes) * (1 / menuNear_);
    share = std::min(share, clearShare(eyes, corner, placement_.fittingToStand(panel->across) * (1 / menuNear_),
                                       placement_.fittingToStand(panel->upward) * (1 / menuNear_)));
  }
  if (share == menuNear_) return;
  menuNear_ = share;
  session_.setViewpoint(menuViewpoint());
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

// Nothing is typed here: less, take it, more.
void FittingRoom::pressOnNumber(const DropMenu& menu, std::size_t button) {
  const double step = menu.number->unit > 0 ? kLengthStep : kRatioStep;
  if (button == 1) return session_.chooseNumber(*number_);
  number_ = std::clamp(*number_ + (button == 0 ? -step : step), menu.number->least, menu.number->most);
}

void FittingRoom::pressOnChoice(std::size_t item) {
  if (!choiceOf_) {
    const auto menu = session_.dropMenu();
    if (menu && menu->number && number_ && item >= menu->items.size())
      return pressOnNumber(*menu, item - menu->items.size());
    return session_.choose(item);
  }
  const std::vector<Offer> offers = listOffers(session_, *choiceOf_);
  if (item < offers.size()) perform(offers[item]);
}

void FittingRoom::keep() {
  if (session_.path().empty()) return;
  if (!session_.draft() && !session_.readOnly())
    return session_.advise(say("Every step is saved in “{0}” as it is done.", session_.path().string()));
  std::error_code trouble;
  std::filesystem::create_directories(options_.documents, trouble);
  session_.saveAs(options_.documents / (session_.path().stem().string() + " " + dayNow() + ".karinui"));
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
  auto onChoice = choice_ ? hitOf(choice_->panel, inStand(sample)) : std::nullopt;
  auto onStrip = hitOf(strip(), sample);
  if (onChoice && onStrip)  // the one in front
    (onStrip->along < onChoice->along ? onChoice : onStrip).reset();
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

void FittingRoom::hangChoice(const Rigid& head) {
  const auto menu = session_.dropMenu();
  const bool isList = !menu && list_;
  if (std::exchange(choiceOf_, isList ? list_ : std::nullopt) != choiceOf_ || (!menu && !isList)) choice_.reset();
  if (!menu && !isList) return;
  const std::vector<Offer> offers = isList ? listOffers(session_, *list_) : std::vector<Offer>();
  const std::vector<Message> title = isList ? std::vector{titleOf(*list_)} : menu->title;
  const bool turned = !isList && menu->number && menu->number->asked;  // a number is
  if (!turned)
    number_.reset();
  else if (!number_)
    number_ = menu->number->value;
  const std::size_t items = isList ? offers.size() : menu->items.size() + (turned ? 3 : 0);
  if (choice_ && !isList && items != choice_->panel.buttons.size()) choice_.reset();
  const std::size_t columns = std::clamp<std::size_t>((items + kColumn - 1) / kColumn, 1, kMostColumns);
  if (!choice_) {
    const Vec3 about = isList ? placement_.roomToStand(head.carry + turnedAboutUp(kListAt, headingOf(head)))
                       : menu->where == PointerSample::Where::Table ? table_.at(menu->table)
                                                                    : placement_.fittingToStand(menu->space);
    const Vec3 eyes = placement_.roomToStand(head.carry);
    const auto before = [&](Vec3 there) {
      return isList ? choiceBefore(eyes, there, placement_.scale, items, columns,
                                   options_.left ? kListRight : kListLeft, kListWide)
                    : choiceBefore(eyes, there, placement_.scale, items, columns);
    };
    choice_ = before(about);
    const SceneMenu& panel = choice_->panel;
    if (const double share = clearShare(eyes, panel.corner, panel.across, panel.upward); share < 1)
      choice_ = before(eyes + (about - eyes) * share);
  }
  choice_->title = title;
  choice_->panel.buttons.clear();
  for (std::size_t i = 0; i < items; ++i) {
    SceneMenu::Button button = buttonOn(choice_->panel, i, items, columns);
    button.hot = hotChoice_ == i;
    if (isList) {
      button.label = offers[i].label, button.enabled = offers[i].enabled, button.chosen = offers[i].chosen;
    } else if (i >= menu->items.size()) {
      const std::size_t k = i - menu->items.size();
      button.label = k == 0   ? say("−")
                     : k == 1 ? say("{0}: {1}", menu->number->label, fixed(*number_, menu->number->decimals))
                              : say("+");
    } else {
      const DropMenu::Item& item = menu->items[i];
      button.label = !item.checked ? item.label : *item.checked ? say("☑ {0}", item.label) : say("☐ {0}", item.label);
      button.chosen = menu->current == i;
    }
    choice_->panel.buttons.push_back(std::move(button));
  }
}

}  // namespace karinui::room
