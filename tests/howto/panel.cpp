// docs/develop/howto.md, A panel of the studio: how many pieces and seams there are. Built into test_studio.
#include <gtest/gtest.h>

#include <QLabel>

#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

class CountPanel : public Panel {
 public:
  explicit CountPanel(Session& session) : Panel(session) {
    auto* column = new QVBoxLayout(this);
    column->addWidget(title(say("Counted")));
    count_ = new QLabel;
    column->addWidget(count_);
    column->addStretch(1);
  }
  void refresh() override {
    const Pattern& pattern = session_.snapshot().document.pattern;
    count_->setText(
        inWords(say("{0} {0|piece|pieces}, {1} {1|seam|seams}", pattern.pieces.size(), pattern.seams.size())));
  }
  QString shown() const { return count_->text(); }

 private:
  QLabel* count_;
};

TEST(StudioHowTo, APanelIsDockedInTheWindowAndFollowsTheSession) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  auto* panel = new CountPanel(w.session());
  w.main().addPanel(panel, say("Count"));
  QTabWidget& boards = w.main().boards();
  boards.setCurrentIndex(boards.count() - 1);
  EXPECT_EQ(boards.tabText(boards.count() - 1), "Count");
  EXPECT_TRUE(panel->isVisible());
  EXPECT_EQ(panel->shown(), "0 pieces, 0 seams");
  w.session().perform(*parseOperation("piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; back L 0 0\""));
  w.rest();
  EXPECT_EQ(panel->shown(), "1 piece, 0 seams");
}

}  // namespace
}  // namespace karinui::studio
