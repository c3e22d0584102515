// The six operations with keys alone, in the real window: no pointer moves here, and nothing is called but keys.
#include <gmock/gmock.h>

#include <QAccessible>
#include <QLabel>
#include <QTest>

#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// One window for all of them; each begins with the tunic as it was.
class StudioKeys : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!displayTrouble().empty()) return;
    window = std::make_unique<Window>();
    window->openTunic();
    window->main().activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window->main()));
  }
  static void TearDownTestSuite() { window.reset(); }
  void SetUp() override {
    KARINUI_NEEDS_DISPLAY();
    w = window.get();
    key(Qt::Key_Escape), key(Qt::Key_Escape);
    if (!began) began = w->count();
    w->session().goTo(began);
    w->rest();
    while (!w->space().hasFocus()) key(Qt::Key_F6);
  }
  void key(int which, int times = 1, Qt::KeyboardModifiers with = {}) {
    for (int k = 0; k < times; ++k) strike(which, with);
    QApplication::processEvents();
  }
  void strike(int which, Qt::KeyboardModifiers with = {}) {
    QWidget* focused = QApplication::focusWidget();
    QTest::keyClick(focused ? focused : &w->main(), static_cast<Qt::Key>(which), with);
  }
  // Tab until what is heard under the fingertip begins so, and says this too.
  void tabTo(const std::string& words, const std::string& too = "") {
    std::set<std::string> met;
    for (int k = 0; k < 90; ++k) {
      strike(Qt::Key_Tab);
      const std::string here = text(w->session().underFingertip());
      if (here.starts_with(words) && here.find(too) != std::string::npos) return QApplication::processEvents();
      met.insert(here);
    }
    FAIL() << "never came to " << words << " but to " << testing::PrintToString(met);
  }
  std::string step(std::size_t which) { return karinui::text(w->session().steps().at(which).operation); }

  static inline std::unique_ptr<Window> window;
  static inline std::size_t began = 0;
  Window* w = nullptr;
};

// F6 goes from part to part of the window, and each shows that the keys are its own now.
TEST_F(StudioKeys, WhatHasTheKeysIsFramed) {
  auto* frame = w->main().findChild<QWidget*>("focusFrame");
  ASSERT_TRUE(frame);
  std::set<QWidget*> framed;
  for (int k = 0; k < 4; ++k) {
    key(Qt::Key_F6);
    QWidget* now = QApplication::focusWidget();
    ASSERT_TRUE(now);
    EXPECT_TRUE(frame->isVisible()) << now->metaObject()->className();
    const QRect here(now->mapToGlobal(QPoint()), now->size());
    EXPECT_TRUE(here.adjusted(-4, -4, 4, 4).contains(QRect(frame->mapToGlobal(QPoint()), frame->size())));
    framed.insert(now);
  }
  EXPECT_EQ(framed.size(), 4u);
  while (!w->space().hasFocus()) key(Qt::Key_F6);
  w->keep("studio_focus");
  w->click(w->space(), {w->space().freeWidth() / 2, 12});
  EXPECT_FALSE(frame->isVisible()) << "a hand with a mouse needs none";
}

TEST_F(StudioKeys, Draw) {
  key(Qt::Key_D);
  key(Qt::Key_Tab);
  EXPECT_THAT(w->main().findChild<QLabel*>("hint")->text().toStdString(), HasSubstr("Enter clicks"));
  tabTo("On the body, at torso:bust@0.1");
  key(Qt::Key_Return);
  key(Qt::Key_Down, 12);
  key(Qt::Key_Return);
  key(Qt::Key_Left, 10);
  key(Qt::Key_Return, 2);
  w->rest();
  ASSERT_EQ(w->count(), began + 1) << w->main().said().toStdString();
  EXPECT_THAT(w->last(), StartsWith("draw name=front"));
}

TEST_F(StudioKeys, MoveAndUndoInMidCarry) {
  key(Qt::Key_G);
  tabTo("On “front”");
  key(Qt::Key_Return);
  key(Qt::Key_Right, 4);
  EXPECT_EQ(w->session().preview().carried.size(), 1u);
  key(Qt::Key_Z, 1, Qt::ControlModifier);
  w->rest();
  EXPECT_EQ(w->count(), began) << "undo drops what is carried";
  key(Qt::Key_PageUp);
  key(Qt::Key_Return, 1, Qt::AltModifier);
  key(Qt::Key_Right, 2, Qt::AltModifier);
  key(Qt::Key_Return, 1, Qt::AltModifier);
  key(Qt::Key_PageDown);
  w->rest();
  ASSERT_EQ(w->count(), began + 1) << w->main().said().toStdString();
  EXPECT_THAT(w->last(), StartsWith("move piece=p"));
}

TEST_F(StudioKeys, SewOnTheTableAfterUnpicking) {
  key(Qt::Key_F6);
  ASSERT_TRUE(w->table().hasFocus());
  key(Qt::Key_Q);
  tabTo("On “front”, edge “left shoulder”");
  key(Qt::Key_Return);
  w->rest();  // the edge is chosen by the next picture
  key(Qt::Key_Delete);
  w->rest();
  ASSERT_THAT(step(began), StartsWith("unsew"));
  key(Qt::Key_N);
  tabTo("On “front”, edge “left shoulder”");
  key(Qt::Key_Return);
  tabTo("On “back”, edge “left shoulder”");
  w->keep("studio_keys");
  key(Qt::Key_Return);
  w->rest();
  EXPECT_THAT(step(began + 2), StartsWith("sew a=p"));
  EXPECT_EQ(w->session().snapshot().document.pattern.seams.size(), 4u);
}

TEST_F(StudioKeys, Cut) {
  key(Qt::Key_C);
  tabTo("On “front”, edge “right hem", "12.6 cm of 25.1");  // the middle of either half
  key(Qt::Key_Return);
  key(Qt::Key_Up, 8);
  EXPECT_THAT(text(w->session().hint()), HasSubstr("slit"));
  key(Qt::Key_Return, 1, Qt::ShiftModifier);
  w->rest();
  ASSERT_GT(w->count(), began) << w->main().said().toStdString();
  EXPECT_THAT(step(began), StartsWith("cut piece=p"));
}

TEST_F(StudioKeys, Pull) {
  key(Qt::Key_P);
  tabTo("On “front”");
  key(Qt::Key_Return);
  key(Qt::Key_Right, 3);
  w->session().finish();
  EXPECT_THAT(text(w->session().hint()), HasSubstr(" N."));
  key(Qt::Key_Return);
  w->rest();
  ASSERT_EQ(w->count(), began + 1) << w->main().said().toStdString();
  EXPECT_THAT(w->last(), StartsWith("pull piece=p"));
}

TEST_F(StudioKeys, Reshape) {
  key(Qt::Key_R);
  tabTo("On “front”");
  key(Qt::Key_Return);
  key(Qt::Key_Right, 2);
  key(Qt::Key_Return);
  w->rest();
  ASSERT_GT(w->count(), began) << w->main().said().toStdString();
  EXPECT_THAT(step(began), StartsWith("reshape piece=p"));
}

// What has the focus by now is told by every screen reader, whatever else it can read.
TEST_F(StudioKeys, WhatTheFingertipMeetsAndWhatIsRefusedIsHeard) {
  const auto heard = [&] {
    w->rest();
    QAccessibleInterface* view = QAccessible::queryAccessibleInterface(QApplication::focusWidget());
    return view->focusChild()->text(QAccessible::Name).toStdString();
  };
  key(Qt::Key_G);
  tabTo("On “front”");
  EXPECT_THAT(heard(), StartsWith("On “front”"));
  key(Qt::Key_PageUp);
  EXPECT_THAT(heard(), StartsWith("Arrows go")) << "where it is was said already";
  EXPECT_THAT(heard(), HasSubstr("Enter takes hold"));
  key(Qt::Key_Left, 12);
  EXPECT_EQ(heard(), "Beside everything.");
  key(Qt::Key_PageDown);
  key(Qt::Key_Return);
  w->rest();
  EXPECT_THAT(heard(), HasSubstr("Take hold of a piece to move it."));
  key(Qt::Key_D);
  for (int k = 0; k < 12; ++k) {
    key(Qt::Key_Tab);
    EXPECT_THAT(text(w->session().underFingertip()), testing::Not(HasSubstr("above the floor")))
        << "a place has a name";
  }
  w->hover(w->space(), {40, 300});
  EXPECT_EQ(heard(), "Fitting in 3D") << "the mouse has it now";
}

}  // namespace
}  // namespace karinui::studio
