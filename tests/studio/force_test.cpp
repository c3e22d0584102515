// Force feedback in the real window: the simulated stylus that the mouse leads, the mouse with its force shown, the
// board, emergency off.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QTest>

#include "device_panel.h"
#include "force_feedback.h"
#include "karinui/design/script.h"
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
  void until(const std::function<bool()>& so) {
    constexpr int kMost = 4000;  // turns of the clock that looks at the hand
    for (int k = 0; k < kMost && !so(); ++k) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    ASSERT_TRUE(so());
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
  std::optional<Window> window_;
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
  EXPECT_THAT(panel().findChild<QLabel*>("device_state")->text().toStdString(), testing::HasSubstr("Force: on"));
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
  QTest::mouseRelease(&w().space(), Qt::LeftButton, {}, (at + QPointF(60, -20)).toPoint());
  until([&] { return w().count() > steps; });
  EXPECT_THAT(text(w().session().steps()[steps].operation), testing::StartsWith("move piece="));
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

}  // namespace
}  // namespace karinui::studio
