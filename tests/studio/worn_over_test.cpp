// A second block over what the figure wears, from the menu and from the dialog.
#include <gmock/gmock.h>

#include <QAction>
#include <QComboBox>

#include "studio/asked.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;

TEST(StudioWornOver, ASecondBlockIsWornOverTheFirst) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();  // of a front and a back, as a bodice is
  std::size_t before = w.count();
  w.main().findChild<QAction*>("block_bodice")->trigger();
  EXPECT_TRUE(QTest::qWaitFor([&] { return w.main().said().contains("worn over what is there, in layer 1"); }))
      << w.main().said().toStdString();
  w.rest();
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  const auto& block = std::get<DraftBlock>(w.session().steps()[before].operation);
  EXPECT_EQ(block.layer, 1);
  EXPECT_TRUE(block.over) << "it stands off the tunic";
  EXPECT_EQ(piece(w, "vest_front").layer, 1);
  // In the dialog it is said before it is made.
  w.main().findChild<QAction*>("block_numbers")->trigger();
  w.rest();
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  auto& kinds = *numbers.dialog->findChild<QComboBox*>("kind");
  EXPECT_THAT(numbers.said().toStdString(), HasSubstr("left front of coat")) << "a shirt has a back, too";
  kinds.setCurrentIndex(kinds.findData("skirt"));
  EXPECT_EQ(numbers.said().toStdString(), "") << "there is none";
  EXPECT_EQ(numbers.dialog->findChild<QComboBox*>("fabric")->currentText(), "as usual: Cotton");
  kinds.setCurrentIndex(kinds.findData("bodice"));
  EXPECT_THAT(numbers.said().toStdString(), HasSubstr("in layer 2; its pieces are called"));
  EXPECT_TRUE(numbers.make().isEnabled());
  numbers.type("prefix", "vest");
  EXPECT_THAT(numbers.said().toStdString(), HasSubstr("already")) << "before it is closed";
  EXPECT_FALSE(numbers.make().isEnabled());
  numbers.type("prefix", "my");
  EXPECT_EQ(numbers.said().toStdString(), "");
}

}  // namespace
}  // namespace karinui::studio
