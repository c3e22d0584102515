// Sizes in the real window: all of them over one another, and the one that stands.
#include <gtest/gtest.h>

#include <QMenu>

#include "karinui/design/script.h"
#include "karinui/pattern/grading.h"
#include "menu_letters.h"
#include "studio/asked.h"

namespace karinui::studio {
namespace {

const char* const kGraded =
    "piece name=front outline=\"M -240 0; hem L 240 0; side_right L 250 340; top L -250 340; side_left L -240 0\"\n"
    "grade sizes=\"S M L\" base=M\ngrade corners=\"front.side_right front.top\" by=5mm,0\n";

TEST(StudioSizes, AreSeenOverOneAnotherAndChosen) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  const auto lines = parseScript(kGraded);
  ASSERT_TRUE(lines) << text(lines.error().what);
  for (const ScriptLine& line : *lines) w.session().perform(line.operation);
  w.rest();
  const QImage alone = w.table().grab().toImage();
  w.main().findChild<QAction*>("nest")->trigger();
  w.rest();
  EXPECT_NE(w.table().grab().toImage(), alone);
  w.keep("studio_sizes");
  w.main().findChild<QAction*>("nest")->trigger();
  w.rest();
  EXPECT_EQ(w.table().grab().toImage(), alone);

  auto* sizes = w.main().findChild<QMenu*>("sizes");
  emit sizes->aboutToShow();
  ASSERT_GE(sizes->actions().size(), 3);
  EXPECT_TRUE(sizes->actions().at(1)->isChecked());
  sizes->actions().at(2)->trigger();
  w.rest();
  EXPECT_EQ(w.last(), "size name=L");
  const auto& document = w.session().snapshot().document;
  EXPECT_NEAR(findEdge(*document.pattern.pieces.begin()->second, "hem")->curve.length(), 0.49, 1e-6);
}

// Sizes are named in the menu, and a corner beside which the right button is pressed is graded.
TEST(StudioSizes, AreNamedAndACornerGraded) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(
      *parseOperation("piece name=front outline=\"M 0 0; hem L 300 0; side L 320 400; top L 0 400; centre L 0 0\""));
  w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  auto* sizes = w.main().findChild<QMenu*>("sizes");
  const auto fromSizes = [&](const QString& words) {
    emit sizes->aboutToShow();
    for (QAction* action : sizes->actions())
      if (withoutLetter(*action) == words) return action->trigger(), w.rest(), true;
    return false;
  };
  EXPECT_FALSE(fromSizes("One size only"));
  ASSERT_TRUE(fromSizes(QString::fromUtf8("Name the sizes…")));
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("sizes").text().toStdString(), "S, M, L");
    EXPECT_FALSE(numbers.dialog->findChild<QLineEdit*>("points")) << "no more is asked than is meant";
    numbers.type("sizes", "36 38 40 42");
    EXPECT_NE(numbers.said(), "") << "M is not among them";
    numbers.type("base", "38");
    EXPECT_EQ(numbers.said(), "");
    numbers.accept();
  }
  EXPECT_EQ(w.last(), "grade sizes=\"36; 38; 40; 42\" base=38");
  const Curve& hem = findEdge(piece(w, "front"), "hem")->curve;
  const auto gradeBesideTheSide = [&](const char* shown, const char* by) {
    w.drag(w.table(), {w.onTable("front", hem.atFraction(0.9))}, {}, {}, Qt::RightButton);
    ASSERT_TRUE(choose(w, QString::fromUtf8("Grade the corner beside it…")));
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("by").text().toStdString(), shown);
    numbers.type("by", by);
    EXPECT_EQ(numbers.said(), "");
    w.keepDialog(*numbers.dialog, "studio_grade");
    numbers.accept();
  };
  gradeBesideTheSide("", "5mm,0");
  const Document graded = w.session().snapshot().document;
  const auto larger = inSize(piece(w, "front"), graded.grading, 3);
  ASSERT_TRUE(larger);
  EXPECT_NEAR(findEdge(*larger, "hem")->curve.length(), 0.31, 1e-9);
  gradeBesideTheSide("0.5 cm, 0 cm", "6mm,0");
  ASSERT_TRUE(fromSizes("One size only"));
  EXPECT_TRUE(w.session().snapshot().document.grading.empty());
}

}  // namespace
}  // namespace karinui::studio
