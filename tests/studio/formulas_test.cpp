// Numbers by formula, the table of variables and the board of measures, in the real window.
#include <gmock/gmock.h>

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QTableWidget>
#include <QTest>
#include <fstream>

#include "karinui/body/tape_path.h"
#include "karinui/design/script.h"
#include "karinui/exchange/measurement_files.h"
#include "karinui/geometry/section.h"
#include "measure_drawing.h"
#include "menu_letters.h"
#include "studio/window.h"
#include "variables_dialog.h"

namespace karinui::studio {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Two pieces on a figure, nothing draped.
void begin(Window& w) {
  const auto script = parseScript(
      "body size=eu38\n"
      "piece name=front outline=\"M 0 0; hem L 240 0; side L 240 500; top L 0 500; fold L 0 0\" pose=\"0,0.8,0.4\"\n"
      "piece name=back outline=\"M 0 0; hem L 250 0; side L 250 480; top L 0 480; fold L 0 0\" pose=\"0,0.8,-0.4\"\n");
  for (const ScriptLine& line : *script) w.session().perform(line.operation);
  w.rest();
}

void chooseEdge(Window& w, const char* piece, const char* edge) {
  const PieceId id = w.session().snapshot().document.pieceNamed(piece)->id;
  w.main().boards().setCurrentIndex(0);
  w.session().select({{id}, EdgeNear{id, edge, 0.5, 0}, {}});
  w.rest();
}

double lengthTyped(Window& w, const char* piece, const char* edge) {
  return findEdge(*w.session().snapshot().document.pieceNamed(piece), edge)->curve.length();
}

QLineEdit* lineCalled(QWidget& in, const char* name) {
  for (QLineEdit* one : in.findChildren<QLineEdit*>())
    if (one->accessibleName() == name) return one;
  return nullptr;
}

TEST(StudioFormulas, ALengthTypedByFormulaFollowsTheFigureAndTheVariables) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  begin(w);
  chooseEdge(w, "front", "hem");
  const std::size_t steps = w.count();
  w.type(w.box("Length"), "bust_girth/4 + 2");
  w.rest();
  EXPECT_EQ(w.count(), steps);
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("they do not go together"));
  w.type(w.box("Length"), "bust_girth/4 + 1.5cm");
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("to=\"bust_girth/4 + 1.5cm\"")) << w.main().said().toStdString();
  EXPECT_NEAR(lengthTyped(w, "front", "hem"), 0.22 + 0.015, 1e-7);
  EXPECT_THAT(w.box("Length").text().toStdString(), HasSubstr("23.5")) << "the value";

  // The table: a variable, and another edge by it.
  for (QAction* action : w.main().findChildren<QAction*>())
    if (withoutLetter(*action) == "Variables…") action->trigger();
  auto* table = w.main().findChild<VariablesDialog*>();
  ASSERT_TRUE(table);
  const auto add = [&](const char* name, const char* formula) {
    lineCalled(*table, "Name")->setText(name);
    lineCalled(*table, "Formula")->setText(formula);
    w.type(*lineCalled(*table, "Formula"), Qt::Key_Return);
    w.rest();
  };
  add("ease", "3cm");
  add("quarter", "(bust_girth + ease)/4");
  auto* rows = table->findChild<QTableWidget*>();
  ASSERT_EQ(rows->rowCount(), 2) << w.main().said().toStdString();
  EXPECT_EQ(rows->item(1, 2)->text(), "22.75 cm");
  w.keepDialog(*table, "studio_variables");
  chooseEdge(w, "back", "hem");
  w.type(w.box("Length"), "quarter + 1cm");
  w.rest();
  EXPECT_NEAR(lengthTyped(w, "back", "hem"), 0.2375, 1e-7);
  w.keep("studio_formula");
  rows->item(0, 1)->setText("quarter");
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("quarter")) << "which is not there yet at that step";
  add("ease", "7cm");
  EXPECT_NEAR(lengthTyped(w, "back", "hem"), 0.2475, 1e-7) << "all later steps were played again";
  EXPECT_EQ(rows->item(1, 2)->text(), "23.75 cm");

  // Another figure.
  w.main().boards().setCurrentIndex(1);
  w.rest();
  w.type(w.box("Bust girth"), "96");
  w.rest();
  EXPECT_NEAR(lengthTyped(w, "front", "hem"), 0.24 + 0.015, 1e-7) << w.main().said().toStdString();
  EXPECT_NEAR(lengthTyped(w, "back", "hem"), (0.96 + 0.07) / 4 + 0.01, 1e-7);
  table->close();
}

TEST(StudioFormulas, EveryMeasureHasARowAndADrawing) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  begin(w);
  w.main().boards().setCurrentIndex(1);
  w.rest();
  const Body& body = *w.session().snapshot().body;
  for (const std::string_view key : mannequinKeys()) {
    SCOPED_TRACE(key);
    w.box(text(*termSaid(Term::Measure, key)).c_str());
    EXPECT_FALSE(tapeSaid(key).empty());
    const auto paths = tapePath(body, key);
    ASSERT_FALSE(paths.empty());
    // The tape is as long as the measure, but where the definition runs through the flesh.
    double whole = 0;
    for (const TapePath& path : paths)
      if (&path == &paths.front()) whole += lineLength(path.points, path.closed);
    const double measured = body.measured().value.at(std::string(key));
    EXPECT_NEAR(whole, measured, 0.10 * measured);
  }
  w.type(w.box("Upper arm girth"), "31");
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("piece")) << "the figure's own step was changed";
  EXPECT_NEAR(w.session().snapshot().body->measured().value.at("upper_arm_girth"), 0.31, 0.003);
  w.type(w.box("Hip girth"), "waist_girth + 28cm");
  w.rest();
  EXPECT_NEAR(w.session().snapshot().body->measured().value.at("hip_girth"), 1.0, 0.003)
      << w.main().said().toStdString();
  w.type(w.box("Waist girth"), "hip_girth - 28cm");
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("round in a circle"));
  // The drawing has the tape's colour, and none without a measure.
  auto* drawing = w.main().findChild<MeasureDrawing*>();
  const auto inked = [&] {
    const QImage seen = drawing->grab().toImage();
    const QColor ink = Theme::here().palette().accent;
    int count = 0;
    for (int y = 0; y < seen.height(); ++y)
      for (int x = 0; x < seen.width(); ++x) {
        const QColor at = seen.pixelColor(x, y);
        if (std::abs(at.red() - ink.red()) + std::abs(at.green() - ink.green()) + std::abs(at.blue() - ink.blue()) < 60)
          ++count;
      }
    return count;
  };
  drawing->show(w.session().snapshot().body, "hip_girth");
  EXPECT_GT(inked(), 60);
  w.keep("studio_measures");
  drawing->show(w.session().snapshot().body, "");
  EXPECT_LT(inked(), 10);
  // Only what is looked for.
  lineCalled(w.main(), "Find a measure")->setText("arm");
  w.rest();
  EXPECT_TRUE(w.box("Upper arm girth").isVisible());
  EXPECT_FALSE(w.box("Knee girth").isVisible());
}

TEST(StudioFormulas, AFileOfMeasuresIsWorn) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  begin(w);
  const Folder folder;
  const fs::path file = folder.path / "her.vit";
  std::ofstream(file) << "<vit><unit>cm</unit><body-measurements><m name=\"bust_circ\" value=\"94\"/>"
                         "<m name=\"waist_circ\" value=\"bust_circ - 18\"/><m name=\"hip_circ\" value=\"102\"/>"
                         "<m name=\"height\" value=\"170\"/><m name=\"rise\" value=\"3\"/></body-measurements></vit>";
  w.open(file);
  const auto measured = [&](const char* key) { return w.session().snapshot().body->measured().value.at(key); };
  EXPECT_NEAR(measured("waist_girth"), 0.76, 0.003) << w.main().said().toStdString();
  EXPECT_NEAR(measured("hip_girth"), 1.02, 0.003);
  // What it left out stays in sight when the next sentence comes, until it is clicked away; and can be read again.
  const auto shown = [&] {
    QStringList words;
    for (const QLabel* toast : w.main().findChildren<QLabel*>("toast")) words << toast->text();
    return words.join("\n").toStdString();
  };
  EXPECT_THAT(shown(), HasSubstr("Left out"));
  w.session().refuse(refused(say("There is no such step in this document.")));
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("no such step"));
  EXPECT_THAT(shown(), AllOf(HasSubstr("no such step"), HasSubstr("Left out")));
  const auto both = w.main().findChildren<QLabel*>("toast");
  ASSERT_EQ(both.size(), 2);
  EXPECT_FALSE(both[0]->geometry().intersects(both[1]->geometry()));
  w.keep("studio_notices");
  for (QLabel* toast : both)
    if (toast->text().startsWith("Left out")) w.click(w.space(), toast->geometry().center());
  EXPECT_THAT(shown(), Not(HasSubstr("Left out")));
  auto* again = w.main().findChild<QAction*>("what_was_said");
  ASSERT_TRUE(again);
  again->trigger();
  auto* said = w.main().findChild<QDialog*>("said");
  ASSERT_TRUE(said);
  EXPECT_FALSE(said->findChild<QListWidget*>()->findItems("Left out", Qt::MatchStartsWith).isEmpty());
  delete said;
  std::ofstream(file) << "<!DOCTYPE vit [<!ELEMENT m ANY>]><vit/>";
  const double waist = measured("waist_girth");
  w.open(file);
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("DOCTYPE"));
  EXPECT_EQ(measured("waist_girth"), waist);
}

}  // namespace
}  // namespace karinui::studio
