// Fit in the real window: maps, girths, two states side by side.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QLabel>
#include <QScrollArea>
#include <QTabWidget>

#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(StudioFit, ThePressureIsSeenOnTheBody) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(3);
  w.rest();
  w.space().setMap(FitMap::Pressure);
  w.space().grabFramebuffer();
  EXPECT_TRUE(w.space().mapping()) << "worked out on a thread of its own, the window does not wait";
  w.rest();
  EXPECT_FALSE(w.space().mapping());
  w.keep("studio_pressure");
  EXPECT_GE(w.space().mapTop(), 100) << "pascals";
  Workers alone(1);
  const auto pressure = pressureOnBody(w.session().snapshot(), alone);
  const Body& body = *w.session().snapshot().body;
  ASSERT_EQ(pressure.size(), body.mesh().points.size());
  // It hangs from the shoulders: there it presses, on the head and the feet there is none.
  double shoulder = 0;
  std::size_t bare = 0, far = 0;
  for (std::size_t k = 0; k < pressure.size(); ++k) {
    const Vec3 p = body.mesh().points[k];
    if (p.y < 0.5 || p.y > 1.55) bare += pressure[k] < 0, far += 1;
    if (std::fabs(p.y - body.landmarks().at("shoulder_left").y) < 0.04 && std::fabs(p.x) < 0.2)
      shoulder = std::max(shoulder, static_cast<double>(pressure[k]));
  }
  EXPECT_GT(shoulder, 20);
  EXPECT_EQ(bare, far);
}

TEST(StudioFit, TellsTheGirthsAndTheirEaseAtAnyHeight) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(3);
  w.rest();
  const GarmentSnapshot& fitting = w.session().snapshot();
  const auto all = girthsOf(fitting);
  ASSERT_GE(all.size(), 4u);
  for (const Girths& g : all) EXPECT_GT(g.garment, g.body - 0.002) << text(g.name) << ": cloth goes round the body";
  const auto waist = std::find_if(all.begin(), all.end(), [](const Girths& g) { return text(g.name) == "waist"; });
  ASSERT_NE(waist, all.end());
  EXPECT_NEAR(waist->body, fitting.body->measured().value.at("waist_girth"), 0.004);
  bool told = false;
  for (QLabel* label : w.main().findChildren<QLabel*>())
    told |= label->isVisible() && label->text().contains("waist") &&
            label->text().replace("&nbsp;", " ").contains(lengthText(waist->garment));
  EXPECT_TRUE(told) << "the board says it";
  const QImage before = w.space().grabFramebuffer();
  w.type(w.box("Height above the floor"), "105cm");
  w.rest();
  const QStringList words = w.space().levelWords();
  ASSERT_GE(words.size(), 2);
  EXPECT_THAT(words[0].toStdString(), AllOf(HasSubstr("garment"), HasSubstr("cm"))) << "which of the two it is";
  EXPECT_THAT(words[1].toStdString(), AllOf(HasSubstr("body"), HasSubstr("cm")));
  w.keep("studio_girth");
  EXPECT_NE(before, w.space().grabFramebuffer()) << "the tapes are laid";
}

// Numbers of a metre and more need room beside the longest names of both languages.
TEST(StudioFit, TheGirthsLeaveRoomInTheBoard) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(*parseOperation("fasten kind=zip name=opening_at_the_left a=front.side_left b=back.side_left"));
  w.rest();
  ASSERT_TRUE(w.session().snapshot().document.drape.dirty.empty());
  w.main().resize(900, 600);
  w.main().boards().setCurrentIndex(3);
  for (const Language language : {Language::English, Language::Japanese}) {
    Theme::here().setLanguage(language);
    w.rest();
    const auto* board = qobject_cast<QScrollArea*>(w.main().boards().currentWidget());
    ASSERT_TRUE(board);
    EXPECT_EQ(board->horizontalScrollBarPolicy(), Qt::ScrollBarAsNeeded) << "what has no room is reached";
    for (QLabel* label : board->widget()->findChildren<QLabel*>())
      if (label->textFormat() == Qt::RichText) {
        const int digits = 3 * label->fontMetrics().horizontalAdvance("0");
        EXPECT_LE(label->minimumSizeHint().width() + digits + 28, board->viewport()->width())
            << label->text().toStdString();
      }
  }
  Theme::here().setLanguage(Language::English);
}

TEST(StudioFit, TwoStatesStandSideBySide) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(3);
  w.session().perform(CutPiece{.piece = PieceRef(w.session().snapshot().document.pieceNamed("front")->id),
                               .line = {{0.03, -0.05}, {0.03, 0.15}},
                               .name = "",
                               .keeps = {},
                               .edge = {},
                               .twins = {}});
  w.rest();
  QComboBox* beside = nullptr;
  for (QComboBox* one : w.main().findChildren<QComboBox*>())
    if (one->accessibleName() == "Beside it") beside = one;
  ASSERT_TRUE(beside);
  ASSERT_GT(beside->count(), 4) << "nothing, the drapes after the cut and before it, fabrics, another garment";
  EXPECT_TRUE(beside->itemText(3).startsWith("in ")) << "fabrics follow";
  w.space().setMap(FitMap::Ease);
  beside->setCurrentIndex(2);
  emit beside->activated(2);
  w.rest();
  w.keep("studio_beside");
  ASSERT_TRUE(w.space().beside());
  // At the left it stands as it was: with the slit when that was chosen, without it before.
  const auto left = [&] {
    const QImage both = w.space().grabFramebuffer();
    return both.copy(0, 60, both.width() / 2, both.height() - 240);
  };
  const QImage before = left();
  beside->setCurrentIndex(1);
  emit beside->activated(1);
  w.rest();
  EXPECT_NE(left(), before);
  // The hand works at the right, where the garment is as it is now.
  w.click(w.space(), w.inSpace("front", {0, 0.3}));
  EXPECT_EQ(w.session().selection().pieces.count(w.session().snapshot().document.pieceNamed("front")->id), 1u);
  beside->setCurrentIndex(0);
  emit beside->activated(0);
  w.rest();
  EXPECT_FALSE(w.space().beside());
}

TEST(StudioFit, WhatStandsBesideItIsToldWithinTheBoard) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().resize(1366, 768);
  w.main().boards().setCurrentIndex(3);
  w.rest();
  const auto* board = qobject_cast<QScrollArea*>(w.main().boards().currentWidget());
  ASSERT_TRUE(board);
  QComboBox* beside = nullptr;
  for (QComboBox* one : w.main().findChildren<QComboBox*>())
    if (one->accessibleName() == "Beside it") beside = one;
  ASSERT_TRUE(beside);
  beside->setCurrentIndex(1);
  emit beside->activated(1);
  w.rest();
  ASSERT_TRUE(w.space().beside());
  w.keep("studio_beside_board");
  for (const Language language : {Language::English, Language::Japanese})
    for (const bool inches : {false, true}) {
      Theme::here().setLanguage(language);
      Theme::here().setInches(inches);
      w.rest();
      EXPECT_LE(board->widget()->width(), board->viewport()->width())
          << (language == Language::Japanese ? "ja" : "en") << (inches ? " in" : " cm");
    }
  Theme::here().setInches(false);
  Theme::here().setLanguage(Language::English);
}

}  // namespace
}  // namespace karinui::studio
