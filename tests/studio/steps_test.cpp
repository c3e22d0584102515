// The list of steps in the real window: seen, gone back to, changed.
#include <gmock/gmock.h>

#include <QLineEdit>
#include <QListWidget>

#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

QListWidget& stepsOf(Window& w) {
  w.main().boards().setCurrentIndex(4);
  w.rest();
  for (QListWidget* one : w.main().findChildren<QListWidget*>())
    if (one->accessibleName() == "Steps") return *one;
  std::abort();
}
QLineEdit& field(Window& w, const char* name) {
  QApplication::processEvents();  // what was just put on the board is shown
  for (QLineEdit* one : w.main().findChildren<QLineEdit*>())
    if (one->objectName() == name && one->isVisible()) return *one;
  ADD_FAILURE() << "no field is called " << name;
  std::abort();
}

TEST(StudioSteps, EachHasThePictureOfTheGarmentAsItWas) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  QListWidget& list = stepsOf(w);
  const auto picture = [&](int row) { return list.item(row)->icon().pixmap(list.iconSize()).toImage(); };
  ASSERT_EQ(list.count(), static_cast<int>(w.count()) + 1);
  const QImage draped = picture(static_cast<int>(w.count()));
  list.scrollToTop();
  w.rest();
  const QImage bare = picture(1), front = picture(3);
  ASSERT_EQ(bare.size(), draped.size());
  EXPECT_FALSE(bare == front) << "the first piece is on it";
  EXPECT_FALSE(front == draped);
  int blue = 0;
  for (int y = 0; y < draped.height(); ++y)
    for (int x = 0; x < draped.width(); ++x) {
      const QColor c = draped.pixelColor(x, y);
      blue += c.blue() > c.red() + 10;
    }
  EXPECT_GT(blue, draped.width() * draped.height() / 20) << "the garment is seen on it";
}

// After a long day there are more steps than pictures are kept: those in sight are made, then it is still.
TEST(StudioSteps, ManyHaveTheirPicturesWhereOneLooks) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  for (int k = 0; k < 80; ++k)
    w.session().perform(*parseOperation(k % 2 ? "move piece=front by=0,0,-1mm" : "move piece=front by=0,0,1mm"));
  w.session().finish();
  QListWidget& list = stepsOf(w);
  const auto picture = [&](int row) { return list.item(row)->icon().pixmap(list.iconSize()).toImage(); };
  const auto last = static_cast<int>(w.count());
  const QImage icon = picture(last / 2), bare = picture(1);  // out of sight: the sign of its kind
  EXPECT_NE(picture(last), icon);
  list.scrollToTop();
  w.rest();
  EXPECT_NE(picture(1), bare);
  list.scrollToItem(list.item(last / 2));
  w.rest();
  EXPECT_NE(picture(last / 2), icon);
  EXPECT_TRUE(w.session().idle());
}

TEST(StudioSteps, GoesBackToAnyAndForthAgain) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t all = w.count();
  QListWidget& list = stepsOf(w);
  emit list.itemActivated(list.item(4));
  w.rest();
  EXPECT_EQ(w.count(), 4u);
  emit list.itemActivated(list.item(static_cast<int>(all)));
  w.rest();
  EXPECT_EQ(w.count(), all);
}

TEST(StudioSteps, AStepIsChangedAndAllThatFollowedIsDoneAgain) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t all = w.count();
  const std::string before = hash(w.session().snapshot().document);
  QListWidget& list = stepsOf(w);
  list.setCurrentRow(2);  // set spacing=30mm ease=12mm
  field(w, "ease").setText("20mm");
  w.keep("studio_steps");
  w.button("Play again with this").click();
  w.rest();
  EXPECT_EQ(w.count(), all) << w.main().said().toStdString();
  EXPECT_EQ(list.currentRow(), 2) << "one stays where one was";
  EXPECT_EQ(text(w.session().steps()[1].operation), "set spacing=30mm ease=20mm");
  EXPECT_TRUE(w.session().snapshot().document.drape.last->settled) << "draped anew";
  EXPECT_NE(hash(w.session().snapshot().document), before) << "the drawn paper is wider";
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(hash(w.session().snapshot().document), before) << "one undo";
  EXPECT_EQ(w.count(), all);
}

TEST(StudioSteps, WhatCannotBeFollowedIsASentenceAndChangesNothing) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::string before = hash(w.session().snapshot().document);
  QListWidget& list = stepsOf(w);
  list.setCurrentRow(3);
  field(w, "edges").setText("a b c d");
  w.button("Play again with this").click();
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), StartsWith("Step "));
  EXPECT_EQ(hash(w.session().snapshot().document), before);
  EXPECT_EQ(field(w, "edges").text(), "a b c d") << "what was typed is still there to be mended";
  field(w, "ease").setText("a lot");
  w.button("Play again with this").click();
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("“lot” after “a ”"));
  EXPECT_EQ(hash(w.session().snapshot().document), before);
}

}  // namespace
}  // namespace karinui::studio
