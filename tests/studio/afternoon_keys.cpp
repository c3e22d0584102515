// The same garment with keys alone: F6 goes from part to part of the window, Tab from place to place.
#include <QComboBox>
#include <QContextMenuEvent>
#include <QDialogButtonBox>
#include <QLineEdit>
#include <QMenu>
#include <QTabBar>
#include <QTabWidget>
#include <QTest>

#include "karinui/body/lines.h"
#include "menu_letters.h"
#include "studio/afternoon.h"

namespace karinui::studio {

namespace {

constexpr int kMostKeys = 120;  // to one place

}  // namespace

void AfternoonByKeys::go(QWidget& part) {
  for (int k = 0; k < 8 && !part.hasFocus(); ++k) person.key(Qt::Key_F6);
  ASSERT_TRUE(part.hasFocus());
}

void AfternoonByKeys::board(int which) {
  QTabBar* tabs = w.main().boards().tabBar();
  go(*tabs);
  while (tabs->currentIndex() != which) person.key(tabs->currentIndex() < which ? Qt::Key_Right : Qt::Key_Left);
}

void AfternoonByKeys::tabTo(QWidget& widget) {
  for (int k = 0; k < kMostKeys && !widget.hasFocus(); ++k) person.key(Qt::Key_Tab);
  ASSERT_TRUE(widget.hasFocus()) << widget.accessibleName().toStdString();
}

void AfternoonByKeys::skinTo(Vec3 place) {
  const auto there = [&] {
    const auto tip = w.session().fingertip();
    if (!tip) return false;
    const Vec3 way = place - tip->ray.origin;
    return length(cross(way, tip->ray.direction)) < 0.012;  // a landmark stands for what crosses there
  };
  for (int k = 0; k < kMostKeys && !there(); ++k) person.key(Qt::Key_Tab);
  ASSERT_TRUE(there());
}

void AfternoonByKeys::edgeTo(const char* name, const char* edge) {
  go(w.table());
  const Flat place = along(name, edge, 0.5) + w.session().table().at(piece(name).id);
  const auto there = [&] {
    const auto tip = w.session().fingertip();
    return tip && tip->where == PointerSample::Where::Table &&
           distance(tip->place, place) < 0.0065;  // Select takes hold just inside
  };
  for (int k = 0; k < kMostKeys && !there(); ++k) person.key(Qt::Key_Tab);
  ASSERT_TRUE(there()) << edge;
}

void AfternoonByKeys::half(const std::vector<std::pair<std::vector<Qt::Key>, std::string>>& corners) {
  go(w.space());
  const Body& body = *w.session().snapshot().body;
  for (const auto& [keys, corner] : corners) {
    for (const Qt::Key key : keys) person.key(key);
    w.rest();
    const std::size_t star = corner.find('*');
    if (star == std::string::npos) {
      skinTo(body.landmarks().at(corner));
    } else {
      for (const LineCrossing& c : lineCrossings(body))
        if (body.lines()[c.a].name == corner.substr(0, star) && body.lines()[c.b].name == corner.substr(star + 1))
          skinTo(c.place);
    }
    ASSERT_FALSE(testing::Test::HasFailure()) << corner;
    person.key(Qt::Key_Return);
  }
}

void AfternoonByKeys::figure() {
  board(kBody);
  tabTo(person.box(say("Body height")));
  for (std::size_t k = 0; k < kMeasures.size(); ++k)
    person.type(kMeasures[k], k + 1 < kMeasures.size() ? Qt::Key_Tab : Qt::Key_Return);
}

void AfternoonByKeys::front() {
  person.key(Qt::Key_F6);  // out of the boards, where letters are typed
  person.key(Qt::Key_B);
  person.key(Qt::Key_D);
  half({{{Qt::Key_2}, "neck_front"},
        {{Qt::Key_2}, "neck_left"},
        {{Qt::Key_2}, "shoulder_left"},
        {{Qt::Key_2}, "side_left*armhole_left"},
        {{Qt::Key_2}, "side_left*hip"},
        {{Qt::Key_2}, "centre_front*hip"}});
}
void AfternoonByKeys::back() {
  half({{{Qt::Key_3}, "neck_back"},
        {{Qt::Key_3}, "neck_left"},
        {{Qt::Key_2}, "shoulder_left"},
        {{Qt::Key_A, Qt::Key_4}, "side_left*armhole_left"},
        {{Qt::Key_4}, "side_left*hip"},
        {{Qt::Key_3}, "centre_back*hip"}});
}

void AfternoonByKeys::sewing() {
  person.key(Qt::Key_N);
  for (const char* edge : {"side_left", "shoulder_left"}) {
    edgeTo("front", edge);
    person.key(Qt::Key_Return);
    edgeTo("back", edge);
    person.key(Qt::Key_Return);
    w.rest();
  }
}

void AfternoonByKeys::drape() { person.key(Qt::Key_Space); }
void AfternoonByKeys::fit() { board(kFit); }

void AfternoonByKeys::takeIn() {
  board(kGarment);
  go(w.table());
  person.key(Qt::Key_Q);
  edgeTo("front", "side_left");
  person.key(Qt::Key_Return);
  w.rest();
  go(*w.main().boards().tabBar());
  tabTo(person.box(say("Take in")));
  person.type("1", Qt::Key_Return);
}

void AfternoonByKeys::collar() {
  edgeTo("back", "neck_left");
  person.menuKey(w.table());
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  ASSERT_TRUE(menu);
  const QString wanted = inWords(say("Band along it…"));
  for (int k = 0; k < 30 && !(menu->activeAction() && withoutLetter(*menu->activeAction()) == wanted); ++k)
    QTest::keyClick(menu, Qt::Key_Down);
  ASSERT_TRUE(menu->activeAction() && withoutLetter(*menu->activeAction()) == wanted);
  person.inDialog([this](QWidget&) { person.key(Qt::Key_Return); });  // as it is offered: 3.5 cm, sewn
  QTest::keyClick(menu, Qt::Key_Return);
  w.rest();
  w.main().activateWindow();  // as a window manager does when a dialog closes
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
}

void AfternoonByKeys::dart() {
  edgeTo("front", "side_left");
  person.key(Qt::Key_Return);
  w.rest();
  go(*w.main().boards().tabBar());
  tabTo(person.box(say("Along the edge")));
  person.type("31", Qt::Key_Tab);
  tabTo(person.button(say("Dart there")));
  person.key(Qt::Key_Space);
  w.rest();
}

void AfternoonByKeys::stripes() {
  board(kFabric);
  for (QComboBox* one : w.main().findChildren<QComboBox*>("look_print"))
    if (one->isVisible()) tabTo(*one);
  person.key(Qt::Key_Down);
}

void AfternoonByKeys::paper() {
  person.inDialog([this](QWidget&) {
    person.inDialog([this](QWidget& file) {
      tabTo(*file.findChild<QLineEdit*>());
      person.type(QString::fromStdString(pdf().string()), Qt::Key_Return);
    });
    person.key(Qt::Key_Return);
  });
  person.key(Qt::Key_E, Qt::ControlModifier);
}

}  // namespace karinui::studio
