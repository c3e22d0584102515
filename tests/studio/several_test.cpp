// Several pieces chosen at once: the boards and menus show what all have, and change all of them in one step.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QTest>
#include <QTreeWidget>

#include "karinui/design/script.h"
#include "mixed_box.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;

class StudioSeveral : public testing::Test {
 protected:
  void SetUp() override {
    KARINUI_NEEDS_DISPLAY();
    window.emplace();
    for (const char* line : {"rectangle name=front width=40cm height=50cm fabric=cotton",
                             "rectangle name=back width=40cm height=50cm fabric=linen", "layer piece=back layer=2",
                             "freeze piece=back", "grain piece=back to=1,1", "quantity piece=back count=3",
                             "look piece=front colour=204060", "move piece=back by=60cm,0,0"})
      window->session().perform(*parseOperation(line));
    window->rest();
  }
  Window& w() { return *window; }
  const Piece& piece(const char* name) { return *w().session().snapshot().document.pieceNamed(name); }
  void chooseAll() {
    w().key(Command::SelectAll);
    w().rest();
  }
  QDoubleSpinBox& grain() { return named<QDoubleSpinBox>("piece_grain"); }
  void typeInto(QAbstractSpinBox& box, const char* number) {
    box.setFocus();
    box.selectAll();
    QTest::keyClicks(&box, number);
    QTest::keyClick(&box, Qt::Key_Return);
    w().rest();
  }
  template <class Box>
  Box& named(const char* name) {
    return *w().main().boards().widget(0)->findChild<Box*>(name);
  }
  std::optional<Window> window;
};

TEST_F(StudioSeveral, WhatDiffersIsADashAndWhatIsTypedIsGivenToAll) {
  if (!window) return;
  chooseAll();
  EXPECT_EQ(named<QLabel>("piece_title").text(), "2 pieces");
  auto& layer = named<QSpinBox>("piece_layer");
  auto& count = named<QSpinBox>("cut_count");
  auto& fabric = named<QComboBox>("piece_fabric");
  auto& frozen = named<QCheckBox>("piece_frozen");
  EXPECT_EQ(layer.text(), mixedWord());
  EXPECT_EQ(count.text(), mixedWord());
  EXPECT_EQ(grain().text(), mixedWord());
  EXPECT_EQ(fabric.currentIndex(), -1);
  EXPECT_EQ(frozen.checkState(), Qt::PartiallyChecked);
  EXPECT_FALSE(named<QLineEdit>("piece_name").isEnabled());
  EXPECT_THAT(named<QLineEdit>("piece_name").toolTip().toStdString(), HasSubstr("choose one alone"));
  EXPECT_EQ(named<QLineEdit>("look_colour").text(), "");
  w().keep("studio_several_pieces");
  // Who only passes through the boxes changes nothing.
  const std::size_t steps = w().count();
  for (QWidget* box : {static_cast<QWidget*>(&layer), static_cast<QWidget*>(&count), static_cast<QWidget*>(&grain()),
                       static_cast<QWidget*>(&named<QLineEdit>("look_colour"))}) {
    box->setFocus();
    w().type(*box, Qt::Key_Return);
  }
  w().main().setFocus();
  w().rest();
  EXPECT_EQ(w().count(), steps) << w().last();

  // What the first has already is given to the others.
  typeInto(layer, "0");
  EXPECT_EQ(w().count(), steps + 1);
  EXPECT_EQ(piece("front").layer, 0);
  EXPECT_EQ(piece("back").layer, 0);
  EXPECT_EQ(layer.text(), "0");
  frozen.click();
  w().rest();
  EXPECT_TRUE(piece("front").frozen && piece("back").frozen);
  EXPECT_EQ(frozen.checkState(), Qt::Checked);
  frozen.click();
  w().rest();
  EXPECT_FALSE(piece("front").frozen || piece("back").frozen);
  typeInto(grain(), "0");
  EXPECT_NEAR(piece("back").grain.u, 0, 1e-9);
  EXPECT_EQ(grain().text(), "0.0 °");
  fabric.setCurrentIndex(fabric.findData("cotton"));
  emit fabric.activated(fabric.currentIndex());
  w().rest();
  EXPECT_EQ(piece("back").fabric, "cotton");
  auto& colour = named<QLineEdit>("look_colour");
  colour.setText("#204060");
  colour.setModified(true);
  emit colour.editingFinished();
  w().rest();
  const auto& looks = w().session().snapshot().document.looks.pieces;
  EXPECT_EQ(looks.size(), 2u) << w().last();
  // One undo takes one of these back, of both pieces.
  const std::size_t all = w().count();
  w().key(Command::Undo);
  w().rest();
  EXPECT_EQ(w().count(), all - 1);
  EXPECT_EQ(w().session().snapshot().document.looks.pieces.size(), 1u);
}

// A symmetric copy has the mirror image of the grain: that is no difference.
TEST_F(StudioSeveral, TheGrainOfAPieceAndItsCopyIsOne) {
  if (!window) return;
  w().session().perform(*parseOperation("mirror piece=front"));
  w().session().perform(*parseOperation("grain piece=front to=1,1"));
  w().rest();
  Selection pair;
  pair.pieces = {piece("front").id, piece("front_mirrored").id};
  w().session().select(pair);
  w().rest();
  EXPECT_EQ(grain().text(), "45.0 °");
  typeInto(grain(), "30");
  EXPECT_NEAR(piece("front").grain.u, 0.5, 1e-9);
  EXPECT_NEAR(piece("front_mirrored").grain.u, -0.5, 1e-9);
}

// Of notches, lines and edges the list chooses one: that of the row that was clicked last.
TEST_F(StudioSeveral, OfMarksTheListChoosesOne) {
  if (!window) return;
  for (const char* line : {"notch edge=front.top at=0.25", "notch edge=back.top at=0.75"})
    w().session().perform(*parseOperation(line));
  w().rest();
  auto* tree = w().main().findChild<QTreeWidget*>();
  const auto notchOf = [&](int row) {
    QTreeWidgetItem* item = tree->topLevelItem(row);
    for (int k = 0; k < item->childCount(); ++k)
      if (item->child(k)->text(0).startsWith("Notch")) return item->child(k);
    return item;
  };
  tree->setCurrentItem(notchOf(0));
  w().rest();
  tree->setCurrentItem(notchOf(1), 0, QItemSelectionModel::Select);
  w().rest();
  EXPECT_EQ(w().session().selection().pieces, std::set<PieceId>{piece("back").id});
  w().key(Command::Remove);
  w().rest();
  EXPECT_EQ(piece("front").marks.size(), 1u);
  EXPECT_EQ(piece("back").marks.size(), 0u) << w().last();
}

}  // namespace
}  // namespace karinui::studio
