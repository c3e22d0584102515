// The guide through a first garment: it follows what is done and undone, counts the right seams, and covers nothing.
#include <QLabel>
#include <QTabWidget>

#include "guide.h"
#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

QString titleOf(Window& w) {
  auto* guide = w.main().findChild<QWidget*>("guide");
  if (!guide || !guide->isVisible()) return {};
  for (QLabel* label : guide->findChildren<QLabel*>())
    if (label->property("role") == "title") return label->text();
  return {};
}
void perform(Window& w, const std::string& line) {
  w.session().perform(*parseOperation(line));
  w.session().finish();
  w.rest();
}

TEST(StudioGuide, CountsTheRightSeamsAndGoesBackOnUndo) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().begin(DocumentFile::inMemory());
  w.main().startGuide();
  w.rest();
  EXPECT_EQ(titleOf(w), "A figure");
  perform(w, "body size=jis9ar");
  perform(w, "set spacing=30mm ease=12mm");
  EXPECT_EQ(titleOf(w), "The front");
  const std::string edges = "symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" line=";
  perform(w, "draw name=front " + edges +
                 "\"torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
                 "torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; "
                 "torso:hip@0\"");
  EXPECT_EQ(titleOf(w), "The back");
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(titleOf(w), "The front") << "one step back";
  w.key(Command::Redo);
  w.rest();
  EXPECT_EQ(titleOf(w), "The back");
  perform(w, "draw name=back " + edges +
                 "\"torso:neck_base@0.5; torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
                 "torso:armpit+0.5@0.34; torso:armpit@0.31; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; "
                 "torso:hip@0.5\"");
  EXPECT_EQ(titleOf(w), "Sewing");
  for (const char* edge : {"shoulder", "side"})
    for (const bool left : {true, false})
      perform(w, std::string("sew a=front.") + edge + (left ? "_left" : "_right") + " b=back." + edge +
                     (left ? "_right" : "_left"));
  ASSERT_EQ(w.session().snapshot().document.pattern.seams.size(), 4u);
  EXPECT_EQ(titleOf(w), "Sewing") << "a left edge to a right one is none of the four";
  EXPECT_EQ(firstSeams(w.session().snapshot()).count(), 0);
  for (int k = 0; k < 4; ++k) w.key(Command::Undo), w.rest();
  int sewn = 0;
  for (const char* edge : {"shoulder_left", "shoulder_right", "side_left", "side_right"}) {
    EXPECT_EQ(titleOf(w), "Sewing");
    EXPECT_EQ(firstSeams(w.session().snapshot()).count(), sewn++);
    perform(w, std::string("sew a=front.") + edge + " b=back." + edge);
  }
  for (int k = 0; k < 100 && titleOf(w) != "Settling"; ++k) w.rest();  // the guide looks when the window has drawn
  EXPECT_EQ(titleOf(w), "Settling");
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(titleOf(w), "Sewing");
  w.button("Go back").click();
  w.rest();
  EXPECT_EQ(titleOf(w), "The back") << "and stays there";
  w.button("Go back").click(), w.button("Go back").click(), w.button("Go back").click();
  w.rest();
  EXPECT_EQ(titleOf(w), "A figure");
  w.button("Next").click();
  EXPECT_EQ(titleOf(w), "The front");
}

TEST(StudioGuide, LeadsOnFromTheDrapeToThePaper) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().startGuide();
  w.rest();
  const std::pair<const char*, const char*> then[] = {
      {"Taking in", "takein edges=front.side_left by=5mm"},
      {"A collar", "band name=collar of=\"front.neck_left front.neck_right\" depth=3cm"},
      {"A dart", "dart edge=front.hem_left at=0.5 tip=8cm,12cm"},
      {"Colour and print", "look piece=front print=stripe repeat=2cm"},
  };
  for (const auto& [title, line] : then) {
    for (int k = 0; k < 100 && titleOf(w) != title; ++k) w.rest();
    EXPECT_EQ(titleOf(w), title) << w.main().said().toStdString();
    perform(w, line);
  }
  for (int k = 0; k < 100 && titleOf(w) != "The pattern"; ++k) w.rest();
  EXPECT_EQ(titleOf(w), "The pattern") << w.main().said().toStdString();
}

TEST(StudioGuide, CoversNothingAndIsNotCovered) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().startGuide();
  for (const QSize size : {QSize(1000, 620), QSize(1366, 768)}) {
    w.main().resize(size);
    w.session().refuse(notFound(say("There is no body yet; choose a figure in the body panel.")));
    w.rest();
    const auto in = [&](const QWidget* one) { return QRect(one->mapTo(&w.main(), QPoint()), one->size()); };
    auto* guide = w.main().findChild<QWidget*>("guide");
    auto* toast = w.main().findChild<QWidget*>("toast");
    ASSERT_TRUE(guide && guide->isVisible());
    ASSERT_TRUE(toast && toast->isVisible());
    const QWidget* views[] = {&w.space(), &w.table(), &w.main().boards(), toast};
    for (const QWidget* one : views) EXPECT_FALSE(in(guide).intersects(in(one))) << one->metaObject()->className();
    EXPECT_LT(toast->geometry().right(), w.space().freeWidth()) << "nor is the bar covered";
    for (QLabel* label : guide->findChildren<QLabel*>())
      EXPECT_LE(label->heightForWidth(label->width()), label->height()) << label->text().toStdString();
  }
}

}  // namespace
}  // namespace karinui::studio
