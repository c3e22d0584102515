// Drawing in the real window: lines of the body, views turned in the middle of a line, advice with its button.
#include <gmock/gmock.h>

#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;

constexpr const char* kFront =
    "draw name=front symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
    "line=\"torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
    "torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0\"";

void giveFigure(Window& w) {
  w.session().begin(DocumentFile::inMemory());
  w.session().perform(SetBody{.size = "jis9ar", .sex = {}, .set = {}, .mesh = {}});
  w.rest();
  w.view(View::Front);
}

TEST(StudioDraw, AKeyShowsTheLinesOnTheBody) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  giveFigure(w);
  const QImage bare = w.space().grab().toImage();
  w.key(Command::BodyLines);
  w.rest();
  EXPECT_TRUE(w.main().action(Command::BodyLines)->isChecked());
  const QImage lined = w.space().grab().toImage();
  EXPECT_NE(bare, lined);
  w.keep("studio_lines");
  w.key(Command::BodyLines);
  w.rest();
  EXPECT_FALSE(w.main().action(Command::BodyLines)->isChecked());
}

TEST(StudioDraw, ViewKeysKeepPanAndZoomInTheMiddleOfALine) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  giveFigure(w);
  w.key(Command::Draw);
  Camera near = w.space().camera();
  near.target = {0.05, 1.05, 0};
  near.eye = {0.05, 1.05, 1.6};
  w.space().setCamera(near);
  w.rest();
  w.click(w.space(), w.onSkin("torso:waist+0.5@0.05"));
  w.click(w.space(), w.onSkin("torso:waist+0.5@0.15"));
  w.key(Command::ViewLeft);
  w.rest();
  EXPECT_NEAR(w.space().camera().distance(), 1.6, 1e-6);
  EXPECT_LT(distance(w.space().camera().target, near.target), 1e-6);
  EXPECT_GT(w.space().camera().eye.x, 1.2) << "from the left";
  w.click(w.space(), w.onSkin("torso:waist+0.5@0.3"));
  w.key(Command::ViewBack);
  w.rest();
  w.click(w.space(), w.onSkin("torso:hip@0.35"));
  w.key(Command::Confirm);
  w.rest();
  ASSERT_EQ(w.count(), 2u) << w.main().said().toStdString();
  w.key(Command::Draw);
  w.key(Command::ViewAll);
  w.rest();
  EXPECT_GT(w.space().camera().distance(), 3) << "all of it";
}

// Whoever has not gone near yet is shown the other side as at first, beside the floating bar.
TEST(StudioDraw, ViewKeysKeepTheFigureBesideTheFloatingBar) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  giveFigure(w);
  w.view(View::Front);
  w.key(Command::Draw);
  w.rest();
  for (const Command side : {Command::ViewLeft, Command::ViewBack, Command::ViewRight, Command::ViewFront}) {
    w.key(side);
    w.rest();
    const SceneMenu panel = *w.session().menu();
    const auto at = [&](Vec3 place) { return *w.space().onScreen(place); };
    const QRectF bar = QRectF(at(panel.corner), at(panel.corner + panel.across + panel.upward)).normalized();
    int covered = 0;
    for (const Vec3 p : w.session().snapshot().body->mesh().points) covered += bar.contains(at(p));
    EXPECT_EQ(covered, 0) << static_cast<int>(side);
  }
}

TEST(StudioDraw, AStrokeGoesOnAfterTheViewIsTurnedWithTheButtonHeld) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  giveFigure(w);
  w.key(Command::Draw);
  w.drag(w.space(), {w.onSkin("torso:waist+0.5@0.95"), w.onSkin("torso:waist+0.5@0.1")}, {}, {}, Qt::LeftButton, false);
  const auto send = [&](QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held) {
    QMouseEvent event(type, at, w.space().mapToGlobal(at), button, held, Qt::NoModifier);
    QApplication::sendEvent(&w.space(), &event);
    QApplication::processEvents();
  };
  QPointF at = w.onSkin("torso:waist+0.5@0.1");
  send(QEvent::MouseButtonPress, at, Qt::RightButton, Qt::LeftButton | Qt::RightButton);
  send(QEvent::MouseMove, at - QPointF(150, 0), Qt::NoButton, Qt::LeftButton | Qt::RightButton);
  send(QEvent::MouseButtonRelease, at - QPointF(150, 0), Qt::RightButton, Qt::LeftButton);
  for (const char* place : {"torso:waist+0.5@0.12", "torso:waist+0.5@0.16", "torso:waist+0.5@0.2"})
    send(QEvent::MouseMove, w.onSkin(place), Qt::NoButton, Qt::LeftButton);
  send(QEvent::MouseButtonRelease, w.onSkin("torso:waist+0.5@0.2"), Qt::LeftButton, Qt::NoButton);
  w.click(w.space(), w.onSkin("torso:hip@0.15"));
  w.key(Command::Confirm);
  w.rest();
  ASSERT_EQ(w.count(), 2u) << w.main().said().toStdString();
  double most = 0;
  for (const BodyPoint& point : std::get<DrawPiece>(w.session().steps().back().operation).line)
    if (point.part == BodyPoint::Part::Torso && point.around < 0.5) most = std::max(most, point.around);
  EXPECT_NEAR(most, 0.2, 0.02);
}

TEST(StudioDraw, AdviceIsMarkedAndItsButtonMendsIt) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  giveFigure(w);
  w.session().perform(*parseOperation(kFront));
  w.rest();
  ASSERT_EQ(w.count(), 2u);
  auto& button = w.button("Mend it");
  ASSERT_TRUE(button.isVisible()) << w.main().said().toStdString();
  EXPECT_FALSE(w.session().preview().table.lines.empty());
  w.keep("studio_advice");
  w.click(button, QPointF(button.width() / 2.0, button.height() / 2.0));
  w.rest();
  EXPECT_EQ(w.count(), 3u) << w.main().said().toStdString();
  EXPECT_FALSE(button.isVisible());
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(w.count(), 2u);
}

}  // namespace
}  // namespace karinui::studio
