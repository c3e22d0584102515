// Force feedback in the real window: the simulated stylus that the mouse leads, the mouse with its force shown, the
// board, emergency off.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QTimer>
#include <chrono>
#include <numbers>
#include <source_location>

#include "device_panel.h"
#include "force_feedback.h"
#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "karinui/devices/pose_source.h"
#include "karinui/devices/simulated_device.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

class StudioForce : public testing::Test {
 protected:
  void SetUp() override {
    KARINUI_NEEDS_DISPLAY();
    application();
    QSettings().remove("device");
    window_.emplace();
  }
  void TearDown() override { QSettings().remove("device"); }
  Window& w() { return *window_; }
  ForceFeedback& force() { return w().main().force(); }

  // Handles events, the force loop going on meanwhile, until it is so.
  void until(const std::function<bool()>& so, std::source_location at = std::source_location::current()) {
    const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!so() && std::chrono::steady_clock::now() < late) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    ASSERT_TRUE(so()) << "line " << at.line() << ", " << w().main().said().toStdString();
  }
  void choose(DeviceKind kind) {
    auto* box = w().main().findChild<QComboBox*>("device");
    ASSERT_TRUE(box);
    box->setCurrentIndex(static_cast<int>(kind));
    emit box->activated(static_cast<int>(kind));
    ASSERT_EQ(force().settings().kind, kind);
    force().setFocus(true);  // without a window manager no window is ever in front
  }
  void show() {
    QTabWidget& boards = w().main().boards();
    boards.setCurrentIndex(boards.count() - 1);
  }
  DevicePanel& panel() { return *w().main().findChild<DevicePanel*>(); }
  // A device of a maker's that the test holds in its hand instead; where it was left, it hovers.
  PoseSource*& held(bool other) { return held_[other ? 1 : 0]; }
  void holdInHand() {
    force().setOpener([this](DeviceKind, bool other) -> Result<std::unique_ptr<HapticDevice>> {
      auto made = std::make_unique<PoseSource>(shownRecord("test"));
      held(other) = made.get();
      made->place({}, 0);
      return std::unique_ptr<HapticDevice>(std::move(made));
    });
  }
  void chooseIn(const char* name, int which) {
    auto* box = w().main().findChild<QComboBox*>(name);
    ASSERT_TRUE(box);
    box->setCurrentIndex(which);
    emit box->activated(which);
  }
  void lead(bool other, Vec3 to, std::uint32_t buttons) { held(other)->place({1, 0, 0, 0, to}, buttons); }
  Vec3 tip() { return force().last().hand.tip.carry; }
  double turnOfView() {
    const Camera& c = w().space().camera();
    return std::atan2(c.eye.x - c.target.x, c.eye.z - c.target.z);
  }
  double newtons() { return length(force().last().out.force); }
  // The simulated stylus, armed, its button down on the front of the tunic.
  QPointF pressOnCloth() {
    w().openTunic();
    show();
    choose(DeviceKind::Simulated);
    w().key(Command::Cut);
    const QPointF at = w().inSpace("front", {0, 0.1});
    w().hover(w().space(), at);
    until([&] { return force().last().state == ServoState::Armed; });
    QTest::mousePress(&w().space(), Qt::LeftButton, {}, at.toPoint());
    return at;
  }
  // The pictures beside each other, for the manual, their names in both languages.
  void keepStrip(const std::vector<std::pair<QImage, QPointF>>& pictures) {  // each with the middle of what is done
    const char* folder = std::getenv("KARINUI_PICTURES");
    if (!folder) return;
    constexpr int kWide = 330, kHigh = 300, kAcross = 3, kName = 26;
    const std::array tools{Command::Draw, Command::Move, Command::Sew, Command::Cut, Command::Pull, Command::Reshape};
    for (const Language language : {Language::English, Language::Japanese}) {
      QImage all(kAcross * kWide, 2 * (kHigh + kName), QImage::Format_RGB32);
      all.fill(Qt::white);
      QPainter painter(&all);
      painter.setRenderHint(QPainter::SmoothPixmapTransform);
      for (std::size_t k = 0; k < pictures.size(); ++k) {
        const auto& [picture, middle] = pictures[k];
        const int x = static_cast<int>(k) % kAcross * kWide, y = static_cast<int>(k) / kAcross * (kHigh + kName);
        const double scale = std::max(1.0 * kWide / picture.width(), 1.0 * kHigh / picture.height()) * 1.4;
        const QSizeF part(kWide / scale, kHigh / scale);
        const QPointF corner(std::clamp(middle.x() - part.width() / 2, 0.0, picture.width() - part.width()),
                             std::clamp(middle.y() - part.height() / 2, 0.0, picture.height() - part.height()));
        painter.drawImage(QRectF(x + 3, y + kName, kWide - 6, kHigh - 3), picture, QRectF(corner, part));
        painter.drawText(QRect(x, y, kWide, kName), Qt::AlignCenter,
                         QString::fromStdString(karinui::text(info(tools[k]).label, language)));
      }
      painter.end();
      const char* ending = language == Language::English ? "touch_operations.png" : "touch_operations.ja.png";
      EXPECT_TRUE(all.save(QString::fromStdString((fs::path(folder) / ending).string())));
    }
  }
  std::optional<Window> window_;
  std::array<PoseSource*, 2> held_{};
};

TEST_F(StudioForce, TheSimulatedStylusFeelsTheGarmentAndMovesAPiece) {
  w().openTunic();
  show();
  choose(DeviceKind::Simulated);
  w().key(Command::Move);
  const QPointF at = w().inSpace("front", {0, 0.1});
  w().hover(w().space(), at);
  until([&] { return force().last().state == ServoState::Armed; });
  EXPECT_EQ(newtons(), 0) << "it hovers";
  until([&] { return panel().findChild<QLabel*>("device_state")->text().contains("Force: on"); });
  w().keep("studio_device");
  // Takes hold and carries the piece aside: its weight is felt.
  const std::size_t steps = w().count();
  QTest::mousePress(&w().space(), Qt::LeftButton, {}, at.toPoint());
  until([&] { return w().session().begun(); });
  QTest::mouseMove(&w().space(), (at + QPointF(60, -20)).toPoint());
  const Piece& front = *w().session().snapshot().document.pieceNamed("front");
  const double weight = 0.5 * 9.81 * front.outline.area() * fabricOf(w().session().snapshot().document, front)->weight;
  until([&] { return std::fabs(newtons() - weight) < 0.05 * weight; });
  EXPECT_LT(force().last().out.force.y, 0);
  until([&] {
    return force().arrow() &&
           std::fabs((*force().arrow())[1].y - (*force().arrow())[0].y + 0.3 * weight) < 0.02 * weight;
  });
  w().keep("studio_device_carried");
  // Let go, and out of the view at once: what was carried is put down all the same.
  QTest::mouseRelease(&w().space(), Qt::LeftButton, {}, (at + QPointF(60, -20)).toPoint());
  QEvent out(QEvent::Leave);
  QApplication::sendEvent(&w().space(), &out);
  until([&] { return w().count() > steps; });
  ASSERT_GT(w().count(), steps);
  EXPECT_THAT(text(w().session().steps()[steps].operation), testing::StartsWith("move piece="));
  const auto lies = w().space().onScreen(*spaceOf(w().session().snapshot(), front.id, {0, 0.1}));
  ASSERT_TRUE(lies);
  EXPECT_LT(QLineF(*lies, at + QPointF(60, -20)).length(), 6) << "where the mouse let go, however far behind the hand";
  // Led away from everything; where it was the cloth goes on to fall.
  w().hover(w().space(), QPointF(30, 30));
  until([&] { return newtons() == 0; });
}

TEST_F(StudioForce, TheStylusIsFeltOnTheSurfaceAndAtItsLimit) {
  const QPointF at = pressOnCloth();
  until([&] { return force().last().touching && newtons() > 0.2; });
  // The wheel leads it deeper; the limit holds.
  auto* limit = panel().findChild<QDoubleSpinBox*>("limit");
  limit->setValue(0.5);
  EXPECT_EQ(force().settings().limit, 0.5);
  const Camera before = w().space().camera();
  for (int k = 0; k < 3; ++k) {
    QWheelEvent wheel(at, w().space().mapToGlobal(at), {}, {0, -120}, Qt::LeftButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&w().space(), &wheel);
  }
  EXPECT_EQ(distance(w().space().camera().eye, before.eye), 0) << "depth, not zoom";
  until([&] { return force().last().limited; });
  EXPECT_LE(newtons(), 0.5 + 1e-9);
  until([&] { return panel().findChild<QLabel*>("newtons_said")->text().contains("limit"); });
  w().keep("studio_device_touch");
  QTest::mouseRelease(&w().space(), Qt::LeftButton, {}, at.toPoint());
  w().key(Command::Cancel);
}

TEST_F(StudioForce, EmergencyOffByKeyAndByButton) {
  const QPointF at = pressOnCloth();
  until([&] { return newtons() > 0.2; });
  auto* off = w().main().findChild<QAction*>("force_off");
  ASSERT_TRUE(off);
  EXPECT_THAT(off->shortcuts(), testing::Contains(QKeySequence(Qt::Key_F9)));
  off->trigger();
  until([&] { return force().last().state == ServoState::Off; });
  EXPECT_EQ(newtons(), 0);
  auto* button = panel().findChild<QPushButton*>("emergency_off");
  EXPECT_TRUE(button->isChecked());
  until([&] { return panel().findChild<QLabel*>("device_state")->text().contains("emergency off"); });
  w().keep("studio_device_off");
  // It stays off for another device too, until it is taken back.
  QTest::mouseRelease(&w().space(), Qt::LeftButton, {}, at.toPoint());
  w().key(Command::Cancel);
  choose(DeviceKind::Mouse);
  choose(DeviceKind::Simulated);
  w().hover(w().space(), at + QPointF(1, 0));
  until([&] { return force().last().hand.ready && force().last().state == ServoState::Off; });
  button->click();
  EXPECT_FALSE(force().isOff());
  until([&] { return force().last().state == ServoState::Armed; });
}

// Also of a device that is chosen, or found again at the start, while another window is in front.
TEST_F(StudioForce, ThereIsNoForceWhileAnotherWindowIsInFront) {
  w().openTunic();
  choose(DeviceKind::Simulated);
  w().key(Command::Move);
  w().hover(w().space(), w().inSpace("front", {0, 0.1}));
  until([&] { return force().last().state == ServoState::Armed; });
  force().setFocus(false);
  until([&] { return force().last().fault == ServoFault::NoFocus; });
  force().setFocus(true);
  until([&] { return force().last().state == ServoState::Armed; });
  ASSERT_FALSE(w().main().isActiveWindow()) << "without a window manager no window is ever in front";
  DeviceSettings settings = force().settings();
  settings.hand = PointerSample::Hand::Left;  // begins anew
  force().set(settings);
  w().hover(w().space(), w().inSpace("front", {0, 0.1}) + QPointF(1, 0));
  until([&] { return force().last().hand.ready && force().last().fault == ServoFault::NoFocus; });
  EXPECT_EQ(force().last().state, ServoState::Waiting);
}

TEST_F(StudioForce, TheMouseShowsItsForceAndItsWheelIsDepth) {
  w().openTunic();
  show();
  choose(DeviceKind::Mouse);
  w().key(Command::Pull);
  const QPointF at = w().inSpace("front", {0, 0.1});
  w().hover(w().space(), at);
  until([&] { return force().last().state == ServoState::Armed; });
  const std::size_t steps = w().count();
  w().drag(w().space(), {at, at + QPointF(3, 0)}, {}, [&] {
    const Camera before = w().space().camera();
    for (int k = 0; k < 5; ++k) {
      QWheelEvent wheel(at, w().space().mapToGlobal(at), {}, {0, 120}, Qt::LeftButton, {}, Qt::NoScrollPhase, false);
      QApplication::sendEvent(&w().space(), &wheel);
    }
    EXPECT_EQ(distance(w().space().camera().eye, before.eye), 0) << "depth, not zoom";
    // The cloth pulls back, away from who looks.
    until([&] { return force().arrow() && ((*force().arrow())[1] - (*force().arrow())[0]).z < -0.09; });
    EXPECT_GT(newtons(), 0.3);
    w().keep("studio_device_mouse");
  });
  w().rest();
  ASSERT_GT(w().count(), steps);
  const auto* pull = std::get_if<PullCloth>(&w().session().steps()[steps].operation);
  ASSERT_TRUE(pull);
  EXPECT_NEAR(pull->by.back().z, 0.02, 0.002) << "five notches towards who looks from the front";
}

TEST_F(StudioForce, TheTipIsCalibratedAndTheSecondButtonLeadsItOrTurnsTheBody) {
  w().openTunic();
  show();
  holdInHand();
  choose(DeviceKind::Inverse3);
  const auto isAt = [&](Vec3 place) { return [this, place] { return distance(tip(), place) < 1e-4; }; };
  // "The tip is here": wherever the device is, its tip is in the middle of the view.
  lead(false, {0.05, 0.02, 0}, 0);
  const Vec3 middle = w().space().camera().target, right = w().space().camera().right();
  until(isAt(middle + right * 0.1 + Vec3{0, 0.04, 0}));
  auto* calibrate = panel().findChild<QPushButton*>("calibrate");
  ASSERT_TRUE(calibrate && calibrate->isEnabled());
  calibrate->click();
  until(isAt(middle));
  // The second button: the tip stays while the device is led elsewhere, and goes on from there.
  const double before = turnOfView();
  const auto press = [&](Vec3 where) {
    lead(false, where, 2);
    until([&] { return force().last().hand.buttons == 2; });
  };
  press({0.05, 0.02, 0});
  lead(false, {-0.05, 0.02, 0}, 2);
  // All the way, 10 cm twice, and still for a fifth of a second of the loop's own time.
  until([&, last = 0.0, since = 0.0]() mutable {
    const ServoTick now = force().last();
    if (std::fabs(now.hand.led.x - std::exchange(last, now.hand.led.x)) > 1e-9) since = now.seconds;
    return now.hand.led.x < -0.19 && now.seconds - since > 0.2;
  });
  EXPECT_LT(distance(tip(), middle), 1e-4);
  EXPECT_EQ(turnOfView(), before);
  lead(false, {-0.05, 0.02, 0}, 0);
  until([&] { return force().last().hand.buttons == 0; });
  lead(false, {-0.04, 0.02, 0}, 0);
  until(isAt(middle + right * 0.02));
  // Or it turns the body.
  chooseIn("second_button", 1);
  EXPECT_TRUE(force().settings().secondTurns);
  until([&] { return force().last().hand.ready; });
  press({});
  lead(false, {0.02, 0, 0}, 2);
  until([&] { return std::fabs(turnOfView() - before) > 0.31; });  // 2 cm, twice, at 8 radians a metre
  EXPECT_NEAR(std::fabs(turnOfView() - before), 0.32, 0.01);
  EXPECT_FALSE(w().session().begun());
}

// Two devices at once: one carries a piece, the other turns the body meanwhile.
TEST_F(StudioForce, TheOtherHandsDeviceTurnsTheBodyWhileThisOneWorks) {
  w().openTunic();
  show();
  holdInHand();
  choose(DeviceKind::Simulated);
  chooseIn("other_device", 1);
  ASSERT_EQ(force().settings().other, DeviceKind::Inverse3);
  ASSERT_TRUE(held(true) && force().other());
  w().key(Command::Move);
  const QPointF at = w().inSpace("front", {0, 0.1});
  w().hover(w().space(), at);
  until([&] { return force().last().state == ServoState::Armed; });
  const std::size_t steps = w().count();
  QTest::mousePress(&w().space(), Qt::LeftButton, {}, at.toPoint());
  until([&] { return w().session().begun(); });
  const double before = turnOfView();
  lead(true, {0.03, 0, 0}, 0);
  until([&] { return force().other()->last().hand.tip.carry.x > 0.0299; });
  EXPECT_EQ(turnOfView(), before) << "its button is up";
  lead(true, {0.06, 0, 0}, 1);
  until([&] { return std::fabs(turnOfView() - before) > 0.44; });
  // 3 cm, twice, at 8 radians a metre, less what it went before its button was known.
  EXPECT_NEAR(std::fabs(turnOfView() - before), 0.48, 0.04);
  EXPECT_TRUE(w().session().begun()) << "what the main hand holds is held on";
  EXPECT_EQ(held(true)->force(), HandForce()) << "and the other hand feels nothing";
  const Vec3 from = tip();
  QTest::mouseMove(&w().space(), (at + QPointF(40, 0)).toPoint());
  until([&] { return distance(tip(), from) > 0.02; });
  QTest::mouseRelease(&w().space(), Qt::LeftButton, {}, (at + QPointF(40, 0)).toPoint());
  until([&] { return w().count() > steps; });
  EXPECT_THAT(text(w().session().steps()[steps].operation), testing::StartsWith("move piece="));
  // Nobody to hold it: told, and not used.
  force().setOpener([](DeviceKind, bool) -> Result<std::unique_ptr<HapticDevice>> { return notFound(say("none")); });
  chooseIn("other_device", 0);
  EXPECT_FALSE(force().other());
  chooseIn("other_device", 1);
  w().rest();
  EXPECT_FALSE(force().other());
  EXPECT_EQ(w().main().findChild<QComboBox*>("other_device")->currentIndex(), 0);
  EXPECT_THAT(w().main().said().toStdString(), testing::HasSubstr("none"));
}

TEST_F(StudioForce, TestFeelLaysAFloorBelowTheTip) {
  w().openTunic();
  show();
  choose(DeviceKind::Simulated);
  const QPointF free(40, w().space().height() / 2.0);  // beside the body
  w().hover(w().space(), free);
  until([&] { return force().last().state == ServoState::Armed; });
  const double high = tip().y;
  auto* test = panel().findChild<QPushButton*>("test_feel");
  ASSERT_TRUE(test && test->isEnabled());
  test->click();
  const auto below = w().space().onScreen(tip() - Vec3{0, 0.03, 0});
  const auto here = w().space().onScreen(tip());
  ASSERT_TRUE(below && here);
  w().hover(w().space(), free + *below - *here);
  until([&] { return force().last().touching && force().last().out.force.y > 0.3; });
  EXPECT_NEAR(force().last().proxy.y, high - 0.01, 0.002) << "a level floor, 1 cm below where the tip was";
  until([&] { return newtons() == 0 && !force().last().touching; });  // it is over
}

// A figure, two squares of cotton before it, and the simulated stylus at work, each operation by itself.
TEST_F(StudioForce, AllSixOperationsAreDoneByTheStylus) {
  for (const char* line : {"body size=jis9ar",
                           "piece name=one outline=\"M 0 0; a L 150 0; b L 150 150; c L 0 150; d L 0 0\" "
                           "pose=\"-0.2,1.1,0.3\"",
                           "piece name=two outline=\"M 0 0; a L 150 0; b L 150 150; c L 0 150; d L 0 0\" "
                           "pose=\"0.05,1.1,0.3\""}) {
    w().session().perform(*parseOperation(line));
    w().session().finish();
  }
  w().rest();
  w().view(View::Front);
  show();
  choose(DeviceKind::Simulated);
  const Camera& c = w().space().camera();
  w().space().setCamera({c.target + (c.eye - c.target) * 0.45 + Vec3{0, 0.15, 0}, c.target + Vec3{0, 0.15, 0}});
  w().rest();
  const Vec3 one{-0.2, 1.1, 0.3}, two{0.05, 1.1, 0.3};
  const auto seen = [&](Vec3 place) { return w().space().onScreen(place).value_or(QPointF()); };
  std::vector<QPointF> ring;
  for (int k = 0; k <= 12; ++k)
    ring.push_back(w().onSkin("torso:hip+0.3@0") +
                   25.0 * QPointF(std::sin(k * std::numbers::pi / 6), std::cos(k * std::numbers::pi / 6)));
  const struct {
    Command tool;
    std::vector<QPointF> path;
    const char* expected;
  } works[] = {
      {Command::Draw, ring, "draw "},
      {Command::Move, {seen(one + Vec3{0.07, 0.07, 0}), seen(one + Vec3{0.02, 0.16, 0})}, "move piece="},
      {Command::Sew, {seen(one + Vec3{0.147, 0.075, 0}), seen(two + Vec3{0.003, 0.075, 0})}, "sew a="},
      {Command::Cut,
       {seen(one + Vec3{0.01, 0.05, 0}), seen(one + Vec3{0.14, 0.1, 0}), seen(one + Vec3{0.18, 0.11, 0})},
       "cut piece="},
      {Command::Pull, {seen(two + Vec3{0.07, 0.07, 0}), seen(two + Vec3{0.085, 0.06, 0})}, "pull piece="},
      {Command::Reshape, {seen(two + Vec3{0.13, 0.075, 0}), seen(two + Vec3{0.19, 0.075, 0})}, "reshape piece="}};
  // The hand that is led there has come to rest, and the session has seen it.
  const auto rested = [&] {
    int still = 0;
    until([&] { return still = length(force().last().hand.velocity) < 0.003 ? still + 1 : 0, still > 6; });
  };
  std::vector<std::pair<QImage, QPointF>> strip;
  for (const auto& work : works) {
    SCOPED_TRACE(std::string(info(work.tool).name));
    w().key(work.tool);
    w().hover(w().space(), work.path.front());
    until([&] { return force().last().state == ServoState::Armed; });
    rested();
    const std::size_t steps = w().count();
    QTest::mousePress(&w().space(), Qt::LeftButton, {}, work.path.front().toPoint());
    until([&] { return w().session().begun(); });
    for (const QPointF& at : work.path) QTest::mouseMove(&w().space(), at.toPoint()), rested();
    QPointF sum;
    for (const QPointF& at : work.path) sum += at;
    strip.emplace_back(w().space().grabFramebuffer(), sum / static_cast<double>(work.path.size()));
    QTest::mouseRelease(&w().space(), Qt::LeftButton, {}, work.path.back().toPoint());
    until([&] { return w().count() > steps; });
    EXPECT_THAT(text(w().session().steps()[steps].operation), testing::StartsWith(work.expected));
    w().key(Command::Cancel);
    w().session().goTo(steps);
    w().rest();
    ASSERT_EQ(w().count(), steps);
  }
  keepStrip(strip);
}

TEST_F(StudioForce, SettingsAreKeptAndWhatIsNotThereIsTold) {
  w().rest();
  show();
  panel().findChild<QSlider*>("gain")->setValue(30);
  panel().findChild<QDoubleSpinBox*>("limit")->setValue(1.5);
  choose(DeviceKind::Mouse);
  window_.reset();
  window_.emplace();
  EXPECT_EQ(force().settings().kind, DeviceKind::Mouse);
  EXPECT_EQ(force().settings().gain, 0.3);
  EXPECT_EQ(force().settings().limit, 1.5);
  EXPECT_EQ(panel().findChild<QSlider*>("gain")->value(), 30);
  // No library of the maker here.
  auto* box = w().main().findChild<QComboBox*>("device");
  emit box->activated(static_cast<int>(DeviceKind::Touch));
  w().rest();
  EXPECT_EQ(force().settings().kind, DeviceKind::None);
  EXPECT_EQ(box->currentIndex(), 0);
  EXPECT_THAT(w().main().said().toStdString(), testing::HasSubstr("libHD"));
  w().button("Look for devices").click();
  show();
  QApplication::processEvents();
  Theme::here().setLanguage(Language::Japanese);
  w().rest();
  w().keep("studio_device_ja");
  Theme::here().setLanguage(Language::English);
}

// The button asks for a file, tells how long it has been recorded, and ends it; what was led stands in the file.
TEST_F(StudioForce, AHandIsRecorded) {
  w().openTunic();
  show();
  const Folder folder;
  auto* button = panel().findChild<QPushButton*>("record_hand");
  ASSERT_TRUE(button);
  EXPECT_FALSE(button->isEnabled()) << "there is no hand";
  choose(DeviceKind::Simulated);
  ASSERT_TRUE(button->isEnabled());
  const fs::path path = folder.path / "hand.txt";
  const auto answer = [](const fs::path& with) {
    QTimer::singleShot(0, [with] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      ASSERT_TRUE(dialog);
      dialog->selectFile(QString::fromStdString(with.string()));
      QMetaObject::invokeMethod(dialog, "accept");
    });
  };
  QTimer::singleShot(0, [] { qobject_cast<QFileDialog*>(QApplication::activeModalWidget())->reject(); });
  button->click();
  EXPECT_FALSE(force().recording());
  EXPECT_FALSE(button->isChecked()) << "the dialog was left again";
  answer(folder.path / "hand");
  button->click();
  ASSERT_TRUE(force().recording());
  EXPECT_TRUE(button->isChecked());
  const QPointF at = w().inSpace("front", {0, 0.1});
  w().hover(w().space(), at);
  until([&] { return force().recording()->seconds() > 1; });
  until([&] { return button->text().contains("1 s") || button->text().contains("2 s"); });
  w().keep("studio_record");
  button->click();
  EXPECT_FALSE(force().recording());
  EXPECT_FALSE(button->isChecked());
  const auto lines = readFile(path);
  ASSERT_TRUE(lines);
  EXPECT_THAT(*lines, testing::AllOf(testing::HasSubstr("\ntool "), testing::HasSubstr("\nfelt ")));
  EXPECT_TRUE(ScriptedDevice::read(*lines, simulatedRecord())) << "it can be played again";
  // Where nothing can be written it is said, and nothing is recorded.
  EXPECT_FALSE(force().record(folder.path / "none" / "hand.txt"));
  EXPECT_FALSE(force().recording());
}

}  // namespace
}  // namespace karinui::studio
