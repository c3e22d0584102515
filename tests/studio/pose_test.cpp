// The dialog of poses in the real window: joints turned by sliders, limbs dragged, one step when let go.
#include <gmock/gmock.h>

#include <QAction>
#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QSlider>
#include <QSpinBox>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "menu_letters.h"
#include "pose_dialog.h"
#include "pose_view.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct Posing {
  Window w;
  PoseDialog* dialog = nullptr;
  PoseView* view = nullptr;

  Posing() {
    w.openTunic();
    for (QAction* action : w.main().findChildren<QAction*>())
      if (withoutLetter(*action) == "Joint by joint…") action->trigger();
    dialog = w.main().findChild<PoseDialog*>("pose_dialog");
    if (dialog) view = dialog->findChild<PoseView*>();
    w.rest();
  }
  ~Posing() { delete dialog; }
  QSlider* slider(const char* name) {
    for (QSlider* one : dialog->findChildren<QSlider*>())
      if (one->isVisible() && one->accessibleName() == name) return one;
    return nullptr;
  }
  QSpinBox* box(const char* name) {
    for (QSpinBox* one : dialog->findChildren<QSpinBox*>())
      if (one->isVisible() && one->accessibleName() == name) return one;
    return nullptr;
  }
  SurfacePoint skin(const char* place) {
    return w.session().snapshot().body->own().find(parseBodyPoint(place).value()).value();
  }
  void pictured() {
    // Not the window's event: it may have come to rest before.
    ASSERT_TRUE(QTest::qWaitFor([this] { return view->drawn(); }, 30'000));
  }
  double abduct(Joint joint) {
    const BodyPose& pose = w.session().snapshot().document.body.pose;
    const auto there = pose.find(joint);
    return there == pose.end() ? 0 : there->second.abduct * 57.29577951;
  }
};

TEST(StudioPose, TheWindowIsDrawnOnAfterTheDialogIsClosed) {
  KARINUI_NEEDS_DISPLAY();
  Posing p;
  ASSERT_TRUE(p.view);
  p.pictured();
  const QImage before = p.w.space().grabFramebuffer();
  p.w.space().update();
  QTest::qWait(50);
  QTest::keyClick(p.dialog, Qt::Key_Escape);
  p.dialog = nullptr;
  QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  for (int k = 0; k < 3; ++k) {
    p.w.space().update();
    QTest::qWait(50);
  }
  EXPECT_EQ(p.w.space().grabFramebuffer(), before);
}

TEST(StudioPose, TheOpenDialogFollowsTheLanguage) {
  KARINUI_NEEDS_DISPLAY();
  Posing p;
  const auto* said = p.dialog->findChild<QLabel*>("pose_said");
  ASSERT_TRUE(said);
  const QString english = said->text();
  EXPECT_THAT(english.toStdString(), HasSubstr("Drag a hand"));
  Theme::here().setLanguage(Language::Japanese);
  EXPECT_NE(said->text(), english);
  Theme::here().setLanguage(Language::English);
  EXPECT_EQ(said->text(), english);
}

TEST(StudioPose, TheFigureIsSeenOnItsWayWithItsGarment) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  const auto begin = [&](const char* name) {
    const std::uint64_t predicted = w.session().changes().predicted;
    PoseBody take;
    take.name = name;
    w.session().perform(take);
    until(w.main(), [&] { return w.session().changes().predicted != predicted || w.count() != before; });
  };
  begin("overhead");
  ASSERT_EQ(w.count(), before);
  ASSERT_TRUE(w.session().shown().underWay);
  EXPECT_THAT(w.main().findChild<QLabel*>("hint")->text().toStdString(), HasSubstr("Space stops"));
  w.key(Command::Settle);
  w.rest();
  EXPECT_EQ(w.count(), before);
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("Stopped; nothing was changed."));
  // More than one picture of a way that is gone to its end, the body farther in each.
  std::vector<double> raised;
  const auto hand = [&] { return extent(SceneFrame{w.session().shown().frame.bodies, {}, {}, {}}).high.y; };
  raised.push_back(hand());
  const std::uint64_t predicted = w.session().changes().predicted;
  begin("overhead");
  std::uint64_t seen = predicted;
  until(w.main(), [&] {
    if (w.session().changes().predicted != seen && w.session().shown().underWay) {
      seen = w.session().changes().predicted;
      raised.push_back(hand());
    }
    return w.count() != before;
  });
  w.rest();
  EXPECT_GT(raised.size(), 4u);
  EXPECT_TRUE(std::is_sorted(raised.begin(), raised.end()));
  EXPECT_EQ(w.count(), before + 2) << "the pose, and the drape that follows by itself";
}

TEST(StudioPose, AJointIsTurnedWithASliderAndTheGarmentFollows) {
  KARINUI_NEEDS_DISPLAY();
  Posing p;
  ASSERT_TRUE(p.view);
  const SurfacePoint hand = p.skin("left_arm:wrist+0.5@0.25");
  const QPointF hung = p.view->onScreen(hand);
  const std::size_t steps = p.w.count();
  QSlider* slider = p.slider("Sideways");
  ASSERT_TRUE(slider);
  const int before = slider->value();
  const QPointF knob = knobOf(*slider);
  p.w.drag(*slider, {knob, knob + QPointF(slider->width() * 0.25, 0)}, {}, [&] {
    EXPECT_LT(p.view->onScreen(hand).y(), hung.y() - 20) << "the figure's arm rises at once";
    EXPECT_EQ(p.w.count(), steps) << "nothing is done before it is let go";
  });
  p.w.rest();
  EXPECT_THAT(p.w.last(), Not(StartsWith("pose"))) << "the drape that follows by itself";
  ASSERT_EQ(p.w.count(), steps + 2) << p.w.main().said().toStdString();
  EXPECT_THAT(text(p.w.session().steps()[steps].operation),
              AllOf(StartsWith("pose joint=left_shoulder"), HasSubstr("abduct=")));
  EXPECT_GT(p.abduct(Joint::LeftShoulder), before + 20);
  EXPECT_NEAR(p.abduct(Joint::LeftShoulder), slider->value(), 0.5);
  EXPECT_TRUE(p.w.session().snapshot().document.drape.last->settled);
  p.pictured();
  p.w.keepDialog(*p.dialog, "studio_pose");
  p.w.key(Command::Undo);
  p.w.rest();
  EXPECT_TRUE(p.w.session().snapshot().document.body.pose.empty());
  EXPECT_EQ(slider->value(), before) << "the dialog shows how the figure stands";
}

TEST(StudioPose, ANumberTypedWhileTheFigureMovesIsTakenThen) {
  KARINUI_NEEDS_DISPLAY();
  Posing p;
  ASSERT_TRUE(p.view);
  QSpinBox* box = p.box("Sideways");
  ASSERT_TRUE(box);
  const int before = box->value();
  const auto type = [&](const QString& text, bool enter = true) {
    auto* line = box->findChild<QLineEdit*>();
    line->selectAll();
    QTest::keyClicks(line, text);
    if (enter) QTest::keyClick(box, Qt::Key_Return);
    QApplication::processEvents();
  };
  box->setFocus();
  type("60");
  ASSERT_TRUE(p.w.session().busy().posing);
  type("30", false);
  emit p.w.main().refreshed();
  p.dialog->refresh();
  EXPECT_EQ(box->findChild<QLineEdit*>()->text().left(2), "30") << "the hand is still typing";
  QTest::keyClick(box, Qt::Key_Return);
  type(QString::number(before));
  EXPECT_TRUE(p.w.session().busy().posing);
  type("25");
  p.w.rest();
  EXPECT_NEAR(p.abduct(Joint::LeftShoulder), 25, 0.5) << p.w.main().said().toStdString();
  EXPECT_EQ(box->value(), 25);
  type("60");
  ASSERT_TRUE(p.w.session().busy().posing);
  type("25");  // as it still stands
  p.w.rest();
  EXPECT_NEAR(p.abduct(Joint::LeftShoulder), 25, 0.5);
  EXPECT_EQ(box->value(), 25);
}

TEST(StudioPose, WhatNoJointCanDoIsRefusedWithWhatItCan) {
  KARINUI_NEEDS_DISPLAY();
  Posing p;
  ASSERT_TRUE(p.view);
  QSpinBox* box = p.box("Sideways");
  ASSERT_TRUE(box);
  const int before = box->value();
  const std::size_t steps = p.w.count();
  const auto said = [&] { return p.dialog->findChild<QLabel*>("pose_said")->text().toStdString(); };
  const auto type = [&](const QString& text) {
    auto* line = box->findChild<QLineEdit*>();
    line->selectAll();
    line->insert(text);
    QTest::keyClick(box, Qt::Key_Return);
    p.w.rest();
  };
  type("999");
  EXPECT_EQ(box->value(), before) << "not the most it can, unasked";
  EXPECT_THAT(said(), AllOf(HasSubstr("Sideways"), HasSubstr("between"), HasSubstr("999")));
  type("abc");
  EXPECT_EQ(box->value(), before);
  EXPECT_THAT(said(), HasSubstr("“abc”"));
  EXPECT_EQ(p.w.count(), steps);
  type(QString::fromUtf8("４０"));
  EXPECT_EQ(box->value(), 40) << "digits of a Japanese keyboard are digits";
  EXPECT_NEAR(p.abduct(Joint::LeftShoulder), 40, 0.5);
  EXPECT_THAT(said(), HasSubstr("Drag a hand")) << "what was refused is over";
}

TEST(StudioPose, ADraggedHandSwingsTheArmOrBoth) {
  KARINUI_NEEDS_DISPLAY();
  Posing p;
  ASSERT_TRUE(p.view);
  const SurfacePoint hand = p.skin("left_arm:wrist+0.5@0.25");
  const std::size_t steps = p.w.count();
  const QPointF from = p.view->onScreen(hand), to = from + QPointF(30, -60);
  p.w.drag(*p.view, {from, to}, {}, [&] {
    const QPointF here = p.view->onScreen(hand);
    EXPECT_LT(std::hypot(here.x() - to.x(), here.y() - to.y()), 6) << "the hand is under the pointer";
    EXPECT_EQ(p.w.count(), steps);
  });
  p.w.rest();
  ASSERT_GT(p.w.count(), steps) << p.w.main().said().toStdString();
  EXPECT_THAT(text(p.w.session().steps()[steps].operation), StartsWith("pose joint=left_shoulder"));
  const QPointF there = p.view->onScreen(hand);
  EXPECT_LT(std::hypot(there.x() - to.x(), there.y() - to.y()), 12) << "whole degrees are kept";

  p.dialog->findChild<QCheckBox*>()->setChecked(true);
  const double right = p.abduct(Joint::RightShoulder);
  const std::size_t now = p.w.count();
  p.w.drag(*p.view, {there, there + QPointF(5, -30)});
  p.w.rest();
  ASSERT_GT(p.w.count(), now);
  EXPECT_THAT(text(p.w.session().steps()[now].operation),
              AllOf(HasSubstr("left_shoulder"), HasSubstr("right_shoulder")));
  EXPECT_GT(p.abduct(Joint::RightShoulder), right + 5);
  EXPECT_EQ(p.abduct(Joint::RightShoulder), p.abduct(Joint::LeftShoulder));

  // Beside the figure the pointer turns it, and nothing is done.
  const std::size_t then = p.w.count();
  const QPointF before = p.view->onScreen(hand);
  p.w.drag(*p.view, {QPointF(8, 8), QPointF(80, 8)});
  EXPECT_NE(p.view->onScreen(hand), before);
  EXPECT_EQ(p.w.count(), then);
}

}  // namespace
}  // namespace karinui::studio
