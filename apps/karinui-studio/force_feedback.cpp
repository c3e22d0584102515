#include "force_feedback.h"

#include <QPainter>
#include <QSettings>
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/devices/hd_stylus.h"
#include "karinui/devices/inverse3.h"
#include "karinui/devices/led_device.h"
#include "karinui/devices/space_mouse.h"
#include "karinui/session/menu.h"
#include "orbit.h"
#include "space_view.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr int kPeriod = 12;       // milliseconds between two looks at the hand
constexpr double kHover = 0.006;  // metres above what it points at the mouse leads the stylus
constexpr double kInto = 0.003;   // metres into it, while it draws, cuts or sews
constexpr double kNotch = 0.004;  // metres of depth for a notch of the wheel
constexpr double kDeepest = 0.3;  // metres
constexpr double kTurn = 8;       // radians for a metre of the hand
constexpr double kTestSeconds = 4;
constexpr std::chrono::milliseconds kLatest(1500);  // after the mouse's button the stylus' comes up at the latest
constexpr double kArrow = 0.3;                      // metres for a newton: the weight of a piece is some tenths
constexpr double kLongestArrow = 0.4;
constexpr double kFelt = 0.01;          // N: less is not shown
constexpr QPointF kWordBeside(48, 14);  // pixels from the ball to below its number

// Carried at right angles to who looks; all other tools work on the surface.
bool carries(Command tool) { return tool == Command::Move || tool == Command::Pull || tool == Command::Reshape; }

Vec3 onPlane(const Ray& ray, Vec3 through, Vec3 facing) {
  const double slope = dot(ray.direction, facing);
  return std::fabs(slope) < 0.05 ? through : ray.origin + ray.direction * (dot(through - ray.origin, facing) / slope);
}

// Along the way one looks there is no more of it than its head's width.
void paintArrow(QPainter& painter, const QPointF& from, const QPointF& to, const QColor& colour) {
  constexpr double kHead = 11, kHalf = 5.5;  // pixels
  const QLineF line(from, to);
  if (line.length() < kHead) return;
  const QPointF along = (to - from) / line.length(), across(-along.y(), along.x()), neck = to - along * kHead;
  for (const auto& [pen, wide] : {std::pair(QColor(Qt::white), 2.0), {colour, 0.0}}) {  // its rim first
    painter.setPen(QPen(pen, 3.5 + wide, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(from, neck);
    painter.setPen(QPen(pen, wide, wide > 0 ? Qt::SolidLine : Qt::NoPen, Qt::SquareCap, Qt::MiterJoin));
    painter.setBrush(pen);
    painter.drawPolygon(QPolygonF{to, neck + across * kHalf, neck - across * kHalf});
  }
}

Result<std::unique_ptr<HapticDevice>> opened(DeviceKind kind, DeviceKind main, bool other) {
  if (kind == DeviceKind::Inverse3) {
    auto found = Inverse3::connect(Inverse3::kPort, Inverse3::kPatience, other && main == kind ? 1 : 0);
    if (!found) return found.error();
    return std::unique_ptr<HapticDevice>(*std::move(found));
  }
  if (other && main == kind)
    return refused(say("One Touch serves one hand; choose another device for the other hand."));
  auto found = HdStylus::open();
  if (!found) return found.error();
  return std::unique_ptr<HapticDevice>(*std::move(found));
}

bool mouseLed(DeviceKind kind) { return kind == DeviceKind::Mouse || kind == DeviceKind::Simulated; }

}  // namespace

const std::vector<Message>& deviceNames() {
  static const std::vector<Message> all{say("none"), say("mouse: the force is shown"),
                                        say("simulated stylus, by mouse"), say("Haply Inverse3"),
                                        say("3D Systems Touch or Phantom")};
  return all;
}

Message ForceFeedback::said(ServoState state) {
  switch (state) {
    case ServoState::Waiting:
      return say("waits until nothing is touched");
    case ServoState::Ramping:
      return say("rises");
    case ServoState::Armed:
      return say("on");
    case ServoState::Fading:
      return say("fades out");
    case ServoState::Off:
      break;
  }
  return say("emergency off");
}

Message ForceFeedback::said(ServoFault fault) {
  switch (fault) {
    case ServoFault::None:
    case ServoFault::Off:
      return {};
    case ServoFault::NotFinite:
      return say("the device sent something that is no number");
    case ServoFault::Jump:
      return say("the device jumped");
    case ServoFault::Speed:
      return say("the hand was too quick");
    case ServoFault::Late:
    case ServoFault::Stale:
      return say("the computer was late");
    case ServoFault::NotReady:
      return say("the device is not ready");
    case ServoFault::Clutch:
      return say("the second button is held");
    case ServoFault::NoFocus:
      break;
  }
  return say("another window is in front");
}

ForceFeedback::ForceFeedback(Session& session, SpaceView& view)
    : session_(session),
      view_(view),
      opener_([this](DeviceKind kind, bool other) { return opened(kind, settings_.kind, other); }) {
  const QSettings kept;
  const auto number = [&](const char* key, double usual, double low, double high) {
    const double value = kept.value(key, usual).toDouble();
    return std::isfinite(value) ? std::clamp(value, low, high) : usual;
  };
  const auto choice = [&](const char* key, int usual, int count) {
    return std::clamp(kept.value(key, usual).toInt(), 0, count - 1);
  };
  settings_.kind = static_cast<DeviceKind>(choice("device/kind", 0, 5));
  const int other = choice("device/other", 0, 5);
  if (other >= static_cast<int>(DeviceKind::Inverse3)) settings_.other = static_cast<DeviceKind>(other);
  settings_.gain = number("device/gain", 0.5, 0, 1);
  settings_.limit = number("device/limit", 3, 0, 10);
  settings_.scale = number("device/scale", 2, 0.5, 6);
  settings_.hand = static_cast<PointerSample::Hand>(choice("device/hand", 0, 3));
  settings_.secondTurns = kept.value("device/second_turns", false).toBool();
  settings_.laws.pull = static_cast<PullLaw>(choice("device/pull", static_cast<int>(PullLaw::Curve), 4));
  settings_.laws.contact = kept.value("device/contact", true).toBool();
  settings_.laws.friction = kept.value("device/friction", true).toBool();
  settings_.laws.weight = kept.value("device/weight", true).toBool();
  settings_.laws.cutting = kept.value("device/cutting", true).toBool();
  settings_.laws.click = kept.value("device/click", true).toBool();
  settings_.laws.weave = kept.value("device/weave", false).toBool();
  connect(&clock_, &QTimer::timeout, this, &ForceFeedback::turn);
  clock_.setInterval(kPeriod);
  begin();
}

ForceFeedback::~ForceFeedback() = default;

void ForceFeedback::keep() const {
  QSettings kept;
  kept.setValue("device/kind", static_cast<int>(settings_.kind));
  kept.setValue("device/other", static_cast<int>(settings_.other));
  kept.setValue("device/gain", settings_.gain);
  kept.setValue("device/limit", settings_.limit);
  kept.setValue("device/scale", settings_.scale);
  kept.setValue("device/hand", static_cast<int>(settings_.hand));
  kept.setValue("device/second_turns", settings_.secondTurns);
  kept.setValue("device/pull", static_cast<int>(settings_.laws.pull));
  kept.setValue("device/contact", settings_.laws.contact);
  kept.setValue("device/friction", settings_.laws.friction);
  kept.setValue("device/weight", settings_.laws.weight);
  kept.setValue("device/cutting", settings_.laws.cutting);
  kept.setValue("device/click", settings_.laws.click);
  kept.setValue("device/weave", settings_.laws.weave);
}

void ForceFeedback::set(const DeviceSettings& settings) {
  const DeviceSettings before = settings_;
  settings_ = settings;
  const bool anew = before.kind != settings.kind || before.scale != settings.scale || before.hand != settings.hand ||
                    before.secondTurns != settings.secondTurns;
  if (anew) {
    begin();
  } else if (before.other != settings.other) {
    beginOther();
  }
  if (!anew && driver_) {
    driver_->servo().setGain(settings.gain);
    driver_->servo().setLimit(settings.limit);
    driver_->servo().setLaws(settings.laws);
  }
  keep();
  emit changed();
}

// The devices that are wished for, anew.
void ForceFeedback::begin() {
  other_.reset();  // it may be the one that is now wished for the main hand
  beginMain();
  beginOther();
}

void ForceFeedback::beginOther() {
  other_.reset();
  if (settings_.other != DeviceKind::None) {
    if (auto made = opener_(settings_.other, true)) {
      other_ = std::make_unique<OtherHand>(*std::move(made));
    } else {
      session_.refuse(made.error());
      settings_.other = DeviceKind::None;
    }
  }
  driver_ || other_ ? clock_.start() : clock_.stop();
}

void ForceFeedback::beginMain() {
  if (busy()) session_.command(Command::Cancel);  // what the old one had begun
  clock_.stop();
  driver_.reset();
  mouse_ = nullptr, led_ = nullptr, putDown_.reset(), leaving_ = false;
  depth_ = 0, mouseDown_ = false;
  pointed_.reset();
  shown_ = {};
  std::unique_ptr<HapticDevice> device;
  std::optional<Error> why;
  switch (settings_.kind) {
    case DeviceKind::None:
      return;
    case DeviceKind::Mouse: {
      auto made = std::make_unique<PoseSource>(shownRecord("mouse"));
      mouse_ = made.get();
      device = std::move(made);
      break;
    }
    case DeviceKind::Simulated: {
      auto made = std::make_unique<LedDevice>();
      led_ = made.get();
      device = std::move(made);
      break;
    }
    case DeviceKind::Inverse3:
    case DeviceKind::Touch:
      if (auto made = opener_(settings_.kind, false))
        device = *std::move(made);
      else
        why = made.error();
      break;
  }
  if (why) {
    session_.refuse(*why);
    settings_.kind = DeviceKind::None;
    return;
  }
  HapticSettings settings;
  settings.servo.gain = settings_.gain;
  settings.servo.limit = settings_.limit;
  settings.servo.laws = settings_.laws;
  settings.stylus.hand = settings_.hand;
  settings.feeds = !mouse_;
  if (mouseLed(settings_.kind)) {  // no motor moves a hand: where the computer is late the force is still shown
    constexpr double kNever = 1e9;
    settings.servo.latest = settings.servo.stalest = settings.servo.farthestJump = settings.servo.fastest = kNever;
  } else {  // the middle of its workspace is where one looks
    const Box& box = device->record().workspace;
    settings.placement.scale = settings_.scale;
    settings.placement.deviceCentre = box.empty() ? Vec3{} : box.centre();
    settings.placement.sceneCentre = view_.camera().target;
  }
  driver_ = std::make_unique<HapticDriver>(std::move(device), settings);
  driver_->record(recording_.get());
  if (off_) driver_->servo().emergencyOff();
  setFocus(view_.window()->isActiveWindow());
  through_ = view_.camera().target;
}

std::vector<std::pair<Message, Message>> ForceFeedback::look() const {
  std::vector<std::pair<Message, Message>> found;
  const auto haply = Inverse3::connect();
  found.emplace_back(say("Haply Inverse3"), haply ? say("found; not yet tried on hardware by us") : haply.error().what);
  found.emplace_back(say("3D Systems Touch or Phantom"),
                     HdStylus::libraryThere() ? say("its library is there; not yet tried on hardware by us")
                                              : say("the maker's library libHD.so is not installed"));
  const auto cap = SpaceMouse::taken() ? Result<std::unique_ptr<SpaceMouse>>(nullptr) : SpaceMouse::open();
  found.emplace_back(say("SpaceMouse"), cap ? say("found; it moves what you look at") : cap.error().what);
  return found;
}

QString ForceFeedback::name() const { return driver_ ? QString::fromStdString(driver_->record().name) : QString(); }

double ForceFeedback::limit() const {
  return driver_ ? std::min(settings_.limit, ServoSettings().nominalShare * driver_->record().force) : settings_.limit;
}

void ForceFeedback::emergencyOff(bool off) {
  off_ = off;
  if (driver_) off ? driver_->servo().emergencyOff() : driver_->servo().takeOffBack();
  emit changed();
}

void ForceFeedback::setFocus(bool focus) {
  if (driver_) driver_->servo().setFocus(focus);
}

void ForceFeedback::testFeel() {
  if (driver_) driver_->testFeel(kTestSeconds);
}

void ForceFeedback::calibrate() {
  if (driver_ && !mouseLed(settings_.kind)) driver_->bringTo(view_.camera().target);
}

Done ForceFeedback::record(const std::filesystem::path& path) {
  StylusSettings stylus;
  stylus.hand = settings_.hand;
  auto begun = HandRecording::begin(path, stylus);
  if (!begun) return begun.error();
  if (driver_) driver_->record(begun->get());
  recording_ = *std::move(begun);
  emit changed();
  return {};
}

Done ForceFeedback::endRecording() {
  if (driver_) driver_->record(nullptr);
  const auto ended = std::exchange(recording_, nullptr);
  emit changed();
  return ended ? ended->end() : Done();
}

bool ForceFeedback::busy() const { return driver_ && driver_->down(); }

Vec3 ForceFeedback::facing() const { return normalized(view_.camera().eye - view_.camera().target); }

void ForceFeedback::turnBody(Vec3 led) {
  if (led.x != 0 || led.y != 0) view_.setCamera(turned(view_.camera(), led.x * kTurn, -led.y * kTurn));
}

// Some eighty times a second.
void ForceFeedback::turn() {
  if (other_) turnBody(other_->takeLed() * settings_.scale);
  if (!driver_) return;
  const Camera& camera = view_.camera();
  if (!mouseLed(settings_.kind)) {  // right of the device is right of the picture
    const Vec3 right = camera.right();
    driver_->turnTo(turnAbout({0, 1, 0}, std::atan2(-right.z, right.x)));
  }
  if (putDown_)
    leadToPutDown();
  else if (pointed_ && (mouse_ || led_)) {  // the garment may have moved under the mouse
    const Rigid tip{1, 0, 0, 0, under(*pointed_)};
    if (mouse_) mouse_->place(tip, mouseDown_ ? 1 : 0);
    if (led_) led_->lead(tip, mouseDown_ ? 1 : 0);
  }
  if (driver_->update(session_, facing(), led_ || !mouseDown_)) emit fed();
  if (putDown_ && putDown_->up && !driver_->down()) putDown_.reset();
  if (leaving_ && led_ && !putDown_) led_->leave(), leaving_ = false;
  const Vec3 led = driver_->takeLed();
  if (settings_.secondTurns) turnBody({dot(led, camera.right()), dot(led, camera.up), 0});
  if (driver_->servo().isOff() != off_) off_ = driver_->servo().isOff(), emit changed();  // by the device's button
  const ServoTick now = driver_->last();
  const bool moved = distance(now.hand.tip.carry, shown_.hand.tip.carry) > 2e-4 ||
                     distance(now.out.force, shown_.out.force) > 0.01 || now.hand.ready != shown_.hand.ready;
  const bool other = now.state != shown_.state || now.fault != shown_.fault || now.limited != shown_.limited;
  if (moved || other) {
    shown_ = now;
    view_.update();
    emit felt();
  }
}

// The hand follows the mouse with a lag: the button stays down until it has come to where the mouse let go, or has
// stopped on the way, and its press was seen.
void ForceFeedback::leadToPutDown() {
  constexpr int kTurns = 4;                        // until it has set out
  constexpr double kThere = 5e-4, kStands = 0.01;  // metres, m/s
  const HandSample hand = driver_->last().hand;
  const bool there = distance(hand.tip.carry, putDown_->at) < kThere || length(hand.velocity) < kStands;
  const bool late = std::chrono::steady_clock::now() > putDown_->latest;
  putDown_->up = putDown_->up || late || (++putDown_->turns > kTurns && there && driver_->down());
  led_->lead({1, 0, 0, 0, putDown_->at}, putDown_->up ? 0 : 1);
}

// On what it points at; while something is carried, on a plane that faces who looks.
Vec3 ForceFeedback::under(const PointerSample& sample) const {
  const bool carried = mouseDown_ && carries(session_.tool());
  const Vec3 nearer = sample.facing * depth_;
  // The stylus stays as far above what it holds as it hovered: let go, it must not be behind the cloth.
  if (carried)
    return onPlane(sample.ray, through_, sample.facing) + nearer - sample.ray.direction * (led_ ? kHover : 0);
  const SnapshotPtr garment = session_.shownPtr();
  const Hit hit =
      session_.tool() == Command::Draw ? pickBody(*garment, sample) : pick(*garment, session_.table(), sample);
  if (hit.on == Hit::On::Nothing) return onPlane(sample.ray, through_, sample.facing) + nearer;
  if (mouse_) return hit.point + nearer;
  const bool into = mouseDown_ && !carries(session_.tool());
  return hit.point - sample.ray.direction * (into ? -kInto : kHover) + nearer;
}

bool ForceFeedback::pointed(PointerSample& sample) {
  using Phase = PointerSample::Phase;
  if (sample.where != PointerSample::Where::Space) return false;
  if (!mouse_ && !led_) {  // the stylus is at work: the mouse turns the body, and does nothing else
    if (busy()) return true;
    mouseDown_ = sample.phase == Phase::Press || (mouseDown_ && sample.phase == Phase::Drag);
    return false;
  }
  const SnapshotPtr garment = session_.shownPtr();
  if (sample.phase == Phase::Hover || sample.phase == Phase::Press) {
    if (const Hit hit = pick(*garment, session_.table(), sample); hit.on != Hit::On::Nothing) through_ = hit.point;
  }
  if (const auto bar = session_.menu(); led_ && !mouseDown_ && bar && meets(*bar, sample.ray)) {
    leave();
    return false;  // the floating bar is for the mouse itself
  }
  if (sample.phase == Phase::Press) mouseDown_ = true, depth_ = mouse_ ? 0 : depth_;
  if (sample.phase == Phase::Release) {
    if (led_ && mouseDown_) putDown_ = {under(sample), std::chrono::steady_clock::now() + kLatest};
    mouseDown_ = false;
  }
  if (sample.phase == Phase::Hover) mouseDown_ = false;
  pointed_ = sample;
  leaving_ = false;
  if (mouse_) {
    // Depth is what a ray has not: carried by a tip instead.
    if (depth_ != 0 && sample.phase != Phase::Press && carries(session_.tool()))
      sample.tip.emplace().carry = onPlane(sample.ray, through_, sample.facing) + sample.facing * depth_;
    if (sample.phase == Phase::Release) depth_ = 0;
    return false;
  }
  return true;
}

bool ForceFeedback::wheeled(double turns) {
  if (!pointed_ || !mouseDown_ || !(mouse_ || led_)) return false;
  depth_ = std::clamp(depth_ + turns * kNotch, -kDeepest, kDeepest);
  if (mouse_) {
    PointerSample sample = *pointed_;
    sample.phase = PointerSample::Phase::Drag;
    if (!pointed(sample)) session_.feed(sample), emit fed();
  }
  return true;
}

void ForceFeedback::left() {
  if (!mouseDown_) leave();
}

// The simulated stylus puts down what it holds first: a device that is gone with its button down drops it.
void ForceFeedback::leave() {
  leaving_ = led_ != nullptr;
  pointed_.reset();
  if (mouse_) mouse_->leave();
}

std::optional<std::array<Vec3, 2>> ForceFeedback::arrow() const {
  const double newtons = length(shown_.out.force);
  if (!driver_ || !shown_.hand.ready || newtons <= kFelt) return std::nullopt;
  const Vec3 from = shown_.touching ? shown_.proxy : shown_.hand.tip.carry;
  return std::array{from, from + normalized(shown_.out.force) * std::min(kLongestArrow, kArrow * newtons)};
}

void ForceFeedback::paint(QPainter& painter, const std::function<QPointF(Vec3)>& at, const QRectF& room) const {
  if (!driver_ || !shown_.hand.ready) return;
  const Vec3 proxy = shown_.touching ? shown_.proxy : shown_.hand.tip.carry;
  const QPointF ball = at(proxy), tip = at(shown_.hand.tip.carry);
  const QColor state = shown_.state == ServoState::Off     ? QColor("#b3261e")
                       : shown_.state == ServoState::Armed ? QColor("#1e7f4f")
                                                           : QColor("#8a8f98");
  if (shown_.touching) {  // from the ball to where the hand is, within the surface
    painter.setPen(QPen(state, 1.5, Qt::DotLine));
    painter.drawLine(ball, tip);
  }
  const auto force = arrow();
  if (force) paintArrow(painter, at((*force)[0]), at((*force)[1]), state);
  QRadialGradient shade(ball - QPointF(2.5, 2.5), 9);
  shade.setColorAt(0, state.lighter(190));
  shade.setColorAt(1, state);
  painter.setPen(QPen(shown_.limited ? QColor("#d4552a") : Qt::white, shown_.limited ? 3 : 1.5));
  painter.setBrush(shade);
  painter.drawEllipse(ball, 7, 7);
  if (!force) return;
  const double newtons = length(shown_.out.force);
  const QString words = QString::fromStdString(fixed(newtons, 2)) + " N" +
                        (shown_.limited ? " (" + inWords(say("at the limit")) + ")" : QString());
  paintWord(painter, ball + kWordBeside, words, room);  // above stands what the tool says
}

}  // namespace karinui::studio
