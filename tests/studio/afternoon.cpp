#include "studio/afternoon.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QTest>
#include <QToolBar>
#include <cmath>

#include "karinui/body/lines.h"
#include "karinui/session/scene_of.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// The guide has its pictures in both languages.
std::string picture(const std::string& what) {
  return "first_" + what + (Theme::here().language() == Language::Japanese ? ".ja" : "");
}

}  // namespace

const std::vector<Afternoon::Chapter>& Afternoon::chapters() {
  static const std::vector<Chapter> all{
      {"figure", &Afternoon::figure},   {"front", &Afternoon::front},   {"back", &Afternoon::back},
      {"sewing", &Afternoon::sewing},   {"drape", &Afternoon::drape},   {"fit", &Afternoon::fit},
      {"take_in", &Afternoon::takeIn},  {"collar", &Afternoon::collar}, {"dart", &Afternoon::dart},
      {"stripes", &Afternoon::stripes}, {"paper", &Afternoon::paper},
  };
  return all;
}

void Afternoon::play(const std::function<void(std::size_t)>& after, std::size_t first, std::size_t end) {
  w.main().activateWindow();  // as a window manager does; else the keys of the menus go to nobody
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
  for (std::size_t k = first; k < std::min(end, chapters().size()); ++k) {
    SCOPED_TRACE(chapters()[k].name);
    (this->*chapters()[k].play)();
    w.rest();
    if (testing::Test::HasFailure()) return;
    if (chapters()[k].name == std::string_view("dart")) w.view(View::Front);  // for its picture
    if (pictures) w.keep(picture(chapters()[k].name));
    after(k);
    if (testing::Test::HasFailure()) return;
  }
}

const Piece& Afternoon::piece(const char* name) const {
  const Piece* found = w.session().snapshot().document.pieceNamed(name);
  if (!found) throw std::runtime_error(std::string("there is no piece ") + name);
  return *found;
}
Flat Afternoon::along(const char* name, const char* edge, double share) const {
  const Edge* found = findEdge(piece(name), edge);
  if (!found) throw std::runtime_error(std::string("there is no edge ") + edge);
  return found->curve.atFraction(share);
}

// A hand along lines of the body: a waver of a pixel or two, corners cut a little.
std::vector<QPointF> AfternoonByMouse::stroke(const std::vector<Leg>& legs) {
  const Body& body = *w.session().snapshot().body;
  std::vector<QPointF> path;
  for (const Leg& leg : legs) {
    const BodyLine* line = bodyLine(body, leg.line);
    const auto share = [&](const char* place) {
      double away = 0;
      return line->nearest(at(body.mesh(), *body.find(*parseBodyPoint(place))), away);
    };
    const double from = share(leg.from);
    double went = share(leg.to) - from;
    if (line->closed && leg.by == 0) went -= std::round(went);
    if (line->closed && leg.by * went < 0) went += leg.by;
    const int steps = std::max(4, static_cast<int>(std::fabs(went) * line->length / 0.012));
    for (int k = path.empty() ? 0 : 1; k <= steps; ++k) {
      const double where = from + went * k / steps;
      const auto seen = w.space().onScreen(line->at(where - std::floor(where)));
      if (!seen) continue;
      const double waver = 1.3 * std::sin(0.9 * static_cast<double>(path.size()));
      path.push_back(*seen + QPointF(waver, -0.7 * waver));
    }
  }
  return path;
}

std::vector<QPointF> AfternoonByMouse::run(const char* name, const char* edge, double from, double to) {
  std::vector<QPointF> path;
  for (int k = 0; k <= 12; ++k) path.push_back(w.onTable(name, along(name, edge, from + (to - from) * k / 12)));
  return path;
}

void AfternoonByMouse::figure() {
  ASSERT_EQ(w.main().boards().currentIndex(), kBody) << "what a garment begins with";
  person.click(person.box(say("Body height")));
  for (std::size_t k = 0; k < kMeasures.size(); ++k)
    person.type(kMeasures[k], k + 1 < kMeasures.size() ? Qt::Key_Tab : Qt::Key_Return);
}

void AfternoonByMouse::front() {
  person.key(Qt::Key_B);
  person.key(Qt::Key_D);
  w.rest();
  person.drag(w.space(), stroke({{"neck_base", "landmark:neck_front", "landmark:neck_left"},
                                 {"shoulder_left", "landmark:neck_left", "landmark:shoulder_left"},
                                 {"armhole_left", "landmark:shoulder_left", "torso:5.7@0.25", 1},
                                 {"side_left", "torso:5.7@0.25", "torso:hip@0.25"},
                                 {"hip", "torso:hip@0.25", "torso:hip@0"}}));
}

void AfternoonByMouse::back() {
  const QPointF beside(w.space().freeWidth() - 8, 0.9 * w.space().height());
  person.drag(w.space(), {beside, beside - QPointF(127, 0), beside - QPointF(253, 0)}, Qt::RightButton);  // half round
  w.rest();
  person.drag(w.space(), stroke({{"neck_base", "landmark:neck_back", "landmark:neck_left"},
                                 {"shoulder_left", "landmark:neck_left", "landmark:shoulder_left"},
                                 {"armhole_left", "landmark:shoulder_left", "torso:5.7@0.25", -1},
                                 {"side_left", "torso:5.7@0.25", "torso:hip@0.25"},
                                 {"hip", "torso:hip@0.25", "torso:hip@0.5"}}));
}

void AfternoonByMouse::sewing() {
  person.key(Qt::Key_N);
  w.rest();
  person.drag(w.table(), run("front", "side_left", 0.02, 0.98));
  person.drag(w.table(), run("back", "side_left", 0.98, 0.02));
  w.rest();
  person.drag(w.table(), {w.onTable("front", along("front", "shoulder_left", 0.5)),
                          w.onTable("back", along("back", "shoulder_left", 0.5))});
}

void AfternoonByMouse::drape() { person.key(Qt::Key_Space); }

void AfternoonByMouse::fit() { person.board(kFit); }

void AfternoonByMouse::takeIn() {
  person.board(kGarment);
  person.key(Qt::Key_Q);
  person.click(w.table(), w.onTable("front", along("front", "side_left", 0.5)));
  w.rest();
  person.click(person.box(say("Take in")));
  person.type("1", Qt::Key_Return);
}

void AfternoonByMouse::collar() {
  person.click(w.table(), w.onTable("back", along("back", "neck_left", 0.5)), Qt::RightButton);
  w.rest();
  person.inDialog([this](QWidget&) { person.key(Qt::Key_Return); });  // as it is offered: 3.5 cm, sewn
  person.choose(say("Band along it…"));
  w.rest();
  w.main().activateWindow();  // as a window manager does when a dialog closes
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
}

void AfternoonByMouse::dart() {
  person.click(w.table(), w.onTable("front", along("front", "side_left", 0.5)));
  w.rest();
  person.click(person.box(say("Along the edge")));
  person.type("31", Qt::Key_Return);
  person.click(person.button(say("Dart there")));
  w.rest();
}

void AfternoonByMouse::stripes() {
  person.board(kFabric);
  QComboBox* print = nullptr;
  for (QComboBox* one : w.main().findChildren<QComboBox*>("look_print"))
    if (one->isVisible()) print = one;
  ASSERT_TRUE(print);
  person.choose(*print, 1);
}

void AfternoonByMouse::paper() {
  person.inDialog([this](QWidget& dialog) {
    w.keepDialog(dialog, picture("export"));
    person.inDialog([this](QWidget& file) {
      file.findChild<QLineEdit*>()->setFocus();
      person.type(QString::fromStdString(pdf().string()), Qt::Key_Return);
    });
    person.click(*dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save));
  });
  person.key(Qt::Key_E, Qt::ControlModifier);
}

}  // namespace karinui::studio
