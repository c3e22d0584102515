// Several edges chosen at once, and an armhole let out with its cap.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QTreeWidget>

#include "karinui/design/script.h"
#include "length_box.h"
#include "menu_letters.h"
#include "studio/asked.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kSleeved[] = {
    "piece name=front outline=\"M -150 0; hem L 150 0; side_left L 150 200; armhole_left C 110 210 110 260 120 320; "
    "shoulder_left L 60 340; neck L -60 340; shoulder_right L -120 320; armhole_right C -110 260 -110 210 -150 200; "
    "side_right L -150 0\"",
    "piece name=back outline=\"M -150 0; hem L 150 0; side_left L 150 200; armhole_left C 120 210 120 260 120 320; "
    "shoulder_left L 60 340; neck L -60 340; shoulder_right L -120 320; armhole_right C -120 260 -120 210 -150 200; "
    "side_right L -150 0\" pose=\"0,0,-0.3 y 180deg\"",
    "piece name=sleeve outline=\"M -110 0; hem L 110 0; under_front L 130 200; cap C 60 220 60 270 0 270 -60 270 -60 "
    "220 -130 200; under_back L -110 0\" pose=\"0.5,0,0\"",
    "sew a=front.shoulder_left b=back.shoulder_right",
    "sew a=front.shoulder_right b=back.shoulder_left",
    "sew a=front.side_left b=back.side_right",
    "sew a=front.side_right b=back.side_left",
    "sew a=sleeve.under_front b=sleeve.under_back",
    "sew a=\"front.armhole_left back.armhole_right\" b=sleeve.cap name=armhole"};

struct Sleeved {
  Window w;
  Sleeved() {
    for (const char* line : kSleeved) w.session().perform(*parseOperation(line));
    w.rest();
    w.main().boards().setCurrentIndex(0);
  }
  void choose(std::vector<std::pair<const char*, const char*>> edges) {
    Selection chosen;
    for (const auto& [piece, edge] : edges) {
      if (chosen.edge) chosen.more.push_back(*chosen.edge);
      const PieceId id = w.session().snapshot().document.pieceNamed(piece)->id;
      chosen.pieces.insert(id);
      chosen.edge = EdgeNear{id, edge, 0.5, 0};
    }
    w.session().select(chosen);
    w.rest();
  }
  template <class Box>
  Box& named(const char* name) {
    return *w.main().boards().widget(0)->findChild<Box*>(name);
  }
  double length(const char* piece, const char* edge) {
    const Outline& outline = w.session().snapshot().document.pieceNamed(piece)->outline;
    return outline.edges[*outline.find(edge)].curve.length();
  }
};

TEST(StudioEdges, AnArmholeGetsLongerWithItsCap) {
  KARINUI_NEEDS_DISPLAY();
  Sleeved s;
  const double front = s.length("front", "armhole_left"), back = s.length("back", "armhole_right");
  const double cap = s.length("sleeve", "cap");
  const std::size_t steps = s.w.session().steps().size();
  s.choose({{"front", "armhole_left"}});
  auto& whole = s.named<QCheckBox>("longer_whole");
  EXPECT_TRUE(whole.isVisible());
  EXPECT_TRUE(whole.isChecked());
  EXPECT_THAT(whole.toolTip().toStdString(), HasSubstr("back"));
  s.w.type(s.named<LengthBox>("edge_longer"), "1.5");
  s.w.rest();
  EXPECT_THAT(s.w.last(), AllOf(HasSubstr("lengthen"), HasSubstr("by=15mm"), HasSubstr("armhole_right")))
      << s.w.main().said().toStdString();
  EXPECT_EQ(s.w.session().steps().size(), steps + 1);
  EXPECT_NEAR(s.length("front", "armhole_left") + s.length("back", "armhole_right"), front + back + 0.015, 1e-6);
  EXPECT_NEAR(s.length("sleeve", "cap"), cap + 0.015, 1e-6);
  s.w.key(Command::Undo);
  s.w.rest();
  EXPECT_NEAR(s.length("sleeve", "cap"), cap, 1e-9) << "one undo";
  EXPECT_NEAR(s.length("front", "armhole_left"), front, 1e-9);
  // One edge of it, to the side, and the cap stays.
  whole.setChecked(false);
  s.named<QCheckBox>("longer_partners").setChecked(false);
  s.named<QComboBox>("longer_beside").setCurrentIndex(1);
  s.w.type(s.named<LengthBox>("edge_longer"), "1");
  s.w.rest();
  EXPECT_THAT(s.w.last(), AllOf(HasSubstr("beside=keep"), HasSubstr("partners=no"), Not(HasSubstr("armhole_right"))));
  EXPECT_NEAR(s.length("front", "armhole_left"), front + 0.01, 1e-6);
}

// A waist with its band goes all round: the whole of it is let out in one act, whichever of the ways the list has can
// do it, and the list says which that was.
TEST(StudioEdges, AWaistWithABandIsLetOutInOneAct) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line :
       {"body size=eu38", "set spacing=30mm", "block kind=skirt",
        "band name=waistband depth=4cm sew=yes of=\"skirt_front.waist_left skirt_front.waist_left_2 "
        "skirt_front.waist_right skirt_front.waist_right_2 skirt_back.waist_right skirt_back.waist_right_2 "
        "skirt_back.waist_left skirt_back.waist_left_2\""})
    w.session().perform(*parseOperation(line)), w.rest();
  const auto length = [&](const char* piece, const char* edge) {
    return findEdge(*w.session().snapshot().document.pieceNamed(piece), edge)->curve.length();
  };
  const double band = length("waistband", "low");
  const std::size_t before = w.count();
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("skirt_front")->id};
  chosen.edge = EdgeNear{*chosen.pieces.begin(), "waist_left", 0.1};
  w.session().select(chosen);
  w.rest();
  auto& box = *w.main().findChild<LengthBox*>("edge_longer");
  w.type(box, "2");
  w.rest();
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  EXPECT_NEAR(length("waistband", "low"), band + 0.02, 1e-4);
  EXPECT_EQ(w.main().findChild<QComboBox*>("longer_beside")->currentIndex(), 1) << "the edges beside keep their length";
}

// The arrows go through the list, one row after the other, though each choice fills it anew.
TEST(StudioEdges, TheArrowsGoThroughTheTree) {
  KARINUI_NEEDS_DISPLAY();
  Sleeved s;
  auto* tree = s.w.main().findChild<QTreeWidget*>();
  ASSERT_TRUE(tree);
  tree->setFocus();
  tree->setCurrentItem(tree->topLevelItem(0));
  tree->topLevelItem(0)->setExpanded(true);
  s.w.rest();
  const Piece piece = *s.w.session().snapshot().document.find(*s.w.session().selection().pieces.begin());
  for (std::size_t k = 0; k < 3; ++k) {
    s.w.type(*tree, Qt::Key_Down);
    s.w.rest();
    ASSERT_TRUE(s.w.session().selection().edge) << k;
    EXPECT_EQ(s.w.session().selection().edge->edge, piece.outline.edges[k].name);
  }
  s.w.type(*tree, Qt::Key_Up);
  s.w.rest();
  EXPECT_EQ(s.w.session().selection().edge->edge, piece.outline.edges[1].name);
  // What the keys are on stays theirs where a step changes the garment.
  s.w.session().perform(*parseOperation("notch edge=front.hem at=0.3"));
  s.w.rest();
  s.w.type(*tree, Qt::Key_Down);
  s.w.rest();
  EXPECT_EQ(s.w.session().selection().edge->edge, piece.outline.edges[2].name);
}

TEST(StudioEdges, WhatTakesAListTakesAllThatAreChosen) {
  KARINUI_NEEDS_DISPLAY();
  Sleeved s;
  s.choose({{"front", "hem"}, {"back", "hem"}});
  auto& label = s.named<QLabel>("several_edges");
  EXPECT_TRUE(label.isVisible());
  EXPECT_THAT(label.text().toStdString(), AllOf(HasSubstr("Several edges are chosen"), HasSubstr("back")));
  EXPECT_FALSE(s.w.box("Length").isEnabled()) << "it takes one edge";
  EXPECT_THAT(s.w.box("Length").toolTip().toStdString(), HasSubstr("one edge"));
  const std::size_t steps = s.w.session().steps().size();
  s.w.type(s.named<LengthBox>("edge_hem"), "4");
  s.w.rest();
  EXPECT_EQ(s.w.session().steps().size(), steps + 1);
  const auto& hems = s.w.session().snapshot().document.allowances.hems;
  EXPECT_EQ(hems.size(), 2u) << s.w.last();
  s.choose({{"front", "hem"}, {"back", "hem"}});
  auto& follow = s.named<QCheckBox>("take_in_follow");
  EXPECT_TRUE(follow.isVisible());
  EXPECT_TRUE(follow.isChecked()) << "a hem goes down along the sides";
  s.w.type(s.w.box("Take in"), "-1");
  s.w.rest();
  EXPECT_THAT(s.w.last(), AllOf(HasSubstr("takein"), HasSubstr(";"), HasSubstr("follow=yes")))
      << s.w.main().said().toStdString();
  s.choose({{"front", "armhole_left"}});
  EXPECT_FALSE(follow.isChecked()) << "what is no hem goes square to itself";
  s.choose({{"front", "hem"}, {"back", "hem"}});
  follow.setChecked(false);
  s.w.type(s.w.box("Take in"), "1");
  s.w.rest();
  EXPECT_THAT(s.w.last(), HasSubstr("follow=no"));
  s.choose({{"front", "hem"}});
  EXPECT_FALSE(label.isVisible());
  EXPECT_TRUE(s.w.box("Length").isEnabled());
}

TEST(StudioEdges, TheMenuIsOfAllThatAreChosen) {
  KARINUI_NEEDS_DISPLAY();
  Sleeved s;
  const auto click = [&](const char* of, const char* edge, Qt::KeyboardModifiers keys) {
    const Curve& curve = findEdge(piece(s.w, of), edge)->curve;
    s.w.drag(s.w.table(), {s.w.onTable(of, curve.atFraction(0.4))}, keys);
    s.w.rest();
  };
  click("front", "hem", {});
  click("sleeve", "hem", Qt::ControlModifier);
  ASSERT_EQ(s.w.session().selection().edges().size(), 2u);
  menuOn(s.w, "front", "hem");
  ASSERT_EQ(s.w.session().selection().edges().size(), 2u) << "they stay chosen";
  EXPECT_FALSE(choose(s.w, "Notch there"));
  for (QMenu* menu : s.w.main().findChildren<QMenu*>("context"))
    EXPECT_THAT(withoutLetter(*menu->actions().front()).toStdString(), HasSubstr("one edge"));
  ASSERT_TRUE(choose(s.w, "Topstitch…"));
  Numbers numbers(s.w);
  ASSERT_TRUE(numbers);
  numbers.accept();
  EXPECT_EQ(s.w.session().snapshot().document.allowances.topstitches.size(), 2u) << s.w.last();
  menuOn(s.w, "back", "hem");
  EXPECT_EQ(s.w.session().selection().edges().size(), 1u) << "another one, alone";
  EXPECT_TRUE(choose(s.w, "Notch there"));
}

TEST(StudioEdges, ADartIsMovedAlongItsEdge) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(
      *parseOperation("piece name=half outline=\"M 0 0; waist L 250 0; side L 250 300; top L 0 300; fold L 0 0\""));
  w.session().perform(*parseOperation("dart edge=half.waist at=0.5 tip=125mm,150mm width=20mm"));
  w.rest();
  menuOn(w, "half", "dart");
  ASSERT_TRUE(choose(w, "Move the dart along its edge towards side…"));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  numbers.accept();
  EXPECT_THAT(w.last(), AllOf(HasSubstr("shift_dart"), HasSubstr("by=20mm"), HasSubstr("towards=side")))
      << w.main().said().toStdString();
  EXPECT_NEAR(findEdge(piece(w, "half"), "dart")->curve.end.u, 0.145, 1e-6);
}

}  // namespace
}  // namespace karinui::studio
