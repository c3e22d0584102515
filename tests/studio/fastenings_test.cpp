// Buttons and zips set by the right button in the real window.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>

#include "karinui/design/script.h"
#include "outline_drawing.h"
#include "step_dialog.h"
#include "studio/asked.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// The right button on an edge that is sewn: the seam is opened along the zip, in one step.
TEST(StudioFastenings, AZipInASeamByTheRightButton) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  for (const char* line : {"rectangle name=over width=20cm height=45cm", "rectangle name=under width=20cm height=45cm",
                           "sew a=over.side_right b=under.side_left name=side"})
    w.session().perform(*parseOperation(line)), w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  const std::size_t before = w.count();
  menuOn(w, "under", "side_left");
  ASSERT_TRUE(choose(w, "Zip in seam side*")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("length").text(), "20 cm");
    const QRect fitting(w.space().mapToGlobal(QPoint()), w.space().size());
    EXPECT_FALSE(numbers.dialog->frameGeometry().intersects(fitting)) << "what it is about is seen";
    numbers.accept();
  }
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), AllOf(StartsWith("fasten "), HasSubstr("unpick=yes")));
  const Pattern& pattern = w.session().snapshot().document.pattern;
  const auto side = std::find_if(pattern.seams.begin(), pattern.seams.end(),
                                 [](const auto& seam) { return seam.second.name == "side"; });
  ASSERT_NE(side, pattern.seams.end());
  EXPECT_NEAR(length(pattern, side->second.a), 0.25, 1e-6);
}

// In the middle of the front, from the waist down, the menu offers a fly; Enter makes all of it.
TEST(StudioFastenings, AFlyOverASewnEdgeByTheRightButton) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const Body& body = *w.session().snapshot().body;
  const double waist = at(body.mesh(), *body.find(*parseBodyPoint("torso:waist@0"))).y;
  const std::string at = std::to_string(waist - 0.45) + ",0.3\"";
  for (const std::string& line :
       {"piece name=over outline=\"M 0 0; hem L 200 0; side_right L 200 450; top L 0 450; side_left L 0 0\" "
        "pose=\"-0.2," +
            at,
        "piece name=under outline=\"M 0 0; hem L 200 0; side_right L 200 450; top L 0 450; side_left L 0 0\" "
        "pose=\"0," +
            at,
        std::string("sew a=over.side_right b=under.side_left name=middle")})
    w.session().perform(*parseOperation(line)), w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  const std::size_t before = w.count();
  menuOn(w, "over", "side_right");
  ASSERT_TRUE(choose(w, "Fly…")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("length").text(), "15 cm");
    EXPECT_EQ(numbers.line("width").text(), "3.5 cm");
    numbers.accept();
  }
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("fly "));
  const Document& document = w.session().snapshot().document;
  EXPECT_TRUE(document.pieceNamed("fly_facing") && document.pieceNamed("fly_shield"));
  EXPECT_TRUE(document.allowances.fastenings.contains("fly"));
}

// One edge chosen, the right button on the other; the same menu opens them again, and the edge's board tells of them.
TEST(StudioFastenings, ButtonsBetweenTwoEdgesByTheRightButton) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  for (const char* line : {"rectangle name=over width=20cm height=45cm", "rectangle name=under width=20cm height=45cm"})
    w.session().perform(*parseOperation(line)), w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  const std::size_t before = w.count();
  const auto chooseOver = [&] {
    w.click(w.table(), w.onTable("over", findEdge(piece(w, "over"), "side_right")->curve.atFraction(0.4)));
  };
  chooseOver();
  ASSERT_TRUE(w.session().selection().edge);
  menuOn(w, "under", "side_left");
  ASSERT_TRUE(choose(w, "Buttons or a zip with*")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("count").text(), "6");
    numbers.type("spacing", "3");
    EXPECT_EQ(numbers.said(), "") << "as many as there is room for";
    EXPECT_TRUE(numbers.make().isEnabled());
    numbers.line("spacing").clear();
    EXPECT_LE(numbers.dialog->height(), w.main().screen()->availableGeometry().height()) << "its buttons are reached";
    EXPECT_FALSE(numbers.dialog->findChild<OutlineDrawing*>()->isVisible());
    auto* kind = numbers.dialog->findChild<QComboBox*>("kind");
    kind->setCurrentIndex(kind->findText("Zip"));
    EXPECT_EQ(numbers.said(), "") << "a zip is not told how many";
    EXPECT_TRUE(numbers.make().isEnabled());
    EXPECT_FALSE(numbers.line("count").isVisible());
    EXPECT_TRUE(numbers.line("length").isVisible());
    kind->setCurrentIndex(kind->findText("Hooks and eyes"));
    EXPECT_TRUE(numbers.line("count").isVisible());
    EXPECT_FALSE(numbers.line("length").isVisible());
    EXPECT_FALSE(numbers.dialog->findChild<QWidget*>("size")->isVisible()) << "a hook has no diameter";
    kind->setCurrentIndex(kind->findText("Button"));
    numbers.type("count", "5");
    numbers.accept();
  }
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("fasten "));
  const Fastening& made = w.session().snapshot().document.allowances.fastenings.at("buttons");
  EXPECT_EQ(made.at.size(), 5u);
  EXPECT_EQ(made.closed, 5);
  menuOn(w, "under", "side_left");
  ASSERT_TRUE(choose(w, "Open buttons"));
  EXPECT_EQ(w.session().snapshot().document.allowances.fastenings.at("buttons").closed, 0);
  menuOn(w, "under", "side_left");
  ASSERT_TRUE(choose(w, "Close some of buttons*"));
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("closed").text(), "0");
    EXPECT_FALSE(numbers.dialog->findChild<QWidget*>("more")->isVisible()) << "what they are stays";
    numbers.type("closed", "9");
    EXPECT_NE(numbers.said(), "");
    numbers.type("closed", "3");
    numbers.accept();
  }
  EXPECT_EQ(w.session().snapshot().document.allowances.fastenings.at("buttons").closed, 3);
  menuOn(w, "under", "side_left");
  ASSERT_TRUE(choose(w, "Open buttons"));
  chooseOver();
  w.rest();
  EXPECT_EQ(w.main().findChild<QLabel*>("edge_fastened")->text(), "5 buttonholes 1.40 cm");
}

// A side seam gets no fly, and neither does the front of a shirt.
TEST(StudioFastenings, AFlyIsOfferedWhereOneBelongs) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  menuOn(w, "front", "side_left");
  EXPECT_FALSE(choose(w, "Fly…"));
  EXPECT_FALSE(choose(w, "Buttons…"));
  EXPECT_TRUE(choose(w, "Zip in seam *"));
}

// Trousers: a fly, but no buttons down to the inseam; and a zip behind.
TEST(StudioFastenings, ACrotchIsNotButtoned) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line : {"body size=eu38", "set spacing=30mm", "block kind=trousers"})
    w.session().perform(*parseOperation(line)), w.rest();
  w.key(Command::Select);
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  menuOn(w, "leg_front_left", "crotch");
  EXPECT_FALSE(choose(w, "Buttons…"));
  EXPECT_TRUE(choose(w, "Fly…"));
  Numbers(w).dialog->reject();
  w.rest();
  menuOn(w, "leg_back_left", "crotch");
  EXPECT_FALSE(choose(w, "Fly…"));
  EXPECT_TRUE(choose(w, "Zip in seam *"));
}

// A shirt block is buttoned from the menu of its front: one choice, one Enter, one step.
TEST(StudioFastenings, AShirtIsButtonedByTheRightButton) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line : {"body size=eu38", "set spacing=30mm", "block kind=shirt"})
    w.session().perform(*parseOperation(line)), w.rest();
  w.key(Command::Select);
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  const std::size_t before = w.count();
  menuOn(w, "front_right", "centre");
  EXPECT_FALSE(choose(w, "Fly…"));
  ASSERT_TRUE(choose(w, "Buttons…")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("stand").text(), "1.5 cm");
    EXPECT_EQ(numbers.line("count").text(), "7");
    EXPECT_EQ(numbers.line("b").text(), "centre of left front");
    EXPECT_EQ(numbers.said(), "");
    numbers.accept();
  }
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), AllOf(StartsWith("fasten "), HasSubstr("stand=15mm")));
  const Document& document = w.session().snapshot().document;
  ASSERT_TRUE(document.allowances.fastenings.contains("buttons"));
  EXPECT_EQ(document.allowances.fastenings.at("buttons").closed, 7);
  EXPECT_TRUE(document.drape.last && document.drape.last->settled);
  // The ends of the collar are free now, and lap.
  menuOn(w, "collar", "end_right");
  ASSERT_TRUE(choose(w, "Buttons…")) << w.main().said().toStdString();
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers.line("count").text(), "1");
}

}  // namespace
}  // namespace karinui::studio
