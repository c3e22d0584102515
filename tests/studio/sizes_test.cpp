// Sizes in the real window: all of them over one another, and the one that stands.
#include <gtest/gtest.h>

#include <QMenu>

#include "karinui/design/script.h"
#include "studio/window.h"

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
  ASSERT_EQ(sizes->actions().size(), 3);
  EXPECT_TRUE(sizes->actions().at(1)->isChecked());
  sizes->actions().at(2)->trigger();
  w.rest();
  EXPECT_EQ(w.last(), "size name=L");
  const auto& document = w.session().snapshot().document;
  EXPECT_NEAR(findEdge(*document.pattern.pieces.begin()->second, "hem")->curve.length(), 0.49, 1e-6);
}

}  // namespace
}  // namespace karinui::studio
