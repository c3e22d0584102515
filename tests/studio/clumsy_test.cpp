// A hand that knows nothing of the program: any tool, drags from anywhere to anywhere, the wheel, keys, undo in the
// middle. Whatever it does, the file holds what the window shows, and undo leads back to the beginning.
#include <random>

#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

constexpr Command kTools[] = {Command::Select, Command::Draw, Command::Move,    Command::Sew,
                              Command::Cut,    Command::Pull, Command::Reshape, Command::Points,
                              Command::Notch,  Command::Dart, Command::Line,    Command::Pin};
constexpr Command kDone[] = {Command::Undo,     Command::Redo,      Command::Cancel,   Command::Confirm,
                             Command::Mirror,   Command::Duplicate, Command::ViewBack, Command::ViewFront,
                             Command::ViewLeft, Command::Settle,    Command::Freeze,   Command::Mend,
                             Command::BodyLines};

class ClumsyHand {
 public:
  ClumsyHand(Window& w, unsigned seed) : w_(w), random_(seed) {}
  void act() {
    const int what = upTo(20);
    if (what < 5) w_.key(kTools[upTo(std::size(kTools))]);
    if (what == 5 || what == 6) w_.key(kDone[upTo(std::size(kDone))]);
    if (what == 7) wheel();
    if (what == 8) w_.main().boards().setCurrentIndex(upTo(5));
    if (what == 9) w_.type(view(), upTo(2) ? Qt::Key_Tab : Qt::Key_Return);
    if (what == 10) w_.rest();
    if (what > 10) drag();
  }

 private:
  int upTo(std::size_t n) { return static_cast<int>(random_() % n); }
  QWidget& view() { return upTo(3) ? static_cast<QWidget&>(w_.space()) : w_.table(); }
  QPointF place(const QWidget& widget) {
    return {1.0 * upTo(static_cast<std::size_t>(widget.width())),
            1.0 * upTo(static_cast<std::size_t>(widget.height()))};
  }
  // Towards the middle, where the garment is, more often than not.
  QPointF near(const QWidget& widget) {
    const QPointF middle = QRectF(widget.rect()).center();
    return upTo(4) ? middle + (place(widget) - middle) * 0.35 : place(widget);
  }
  void drag() {
    QWidget& widget = view();
    std::vector<QPointF> path;
    for (int k = 1 + upTo(5); k > 0; --k) path.push_back(near(widget));
    Qt::KeyboardModifiers keys;
    if (upTo(4) == 0) keys |= Qt::ShiftModifier;
    if (upTo(4) == 0) keys |= Qt::ControlModifier;
    if (upTo(6) == 0) keys |= Qt::AltModifier;
    w_.drag(widget, path, keys, [&] {
      if (upTo(8) == 0) w_.key(kDone[upTo(std::size(kDone))]);
    });
  }
  void wheel() {
    QWidget& widget = upTo(2) ? view() : *w_.main().boards().currentWidget();
    const QPointF at = place(widget);
    QWheelEvent event(at, widget.mapToGlobal(at), {}, {0, upTo(2) ? 120 : -120}, {}, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&widget, &event);
  }

  Window& w_;
  std::mt19937 random_;
};

std::vector<std::string> stepsOf(const Session& session) {
  std::vector<std::string> all;
  for (const Step& step : session.steps()) all.push_back(text(step.operation));
  return all;
}

TEST(StudioClumsy, WhateverIsDoneIsOnTheDiskAndCanBeUndone) {
  KARINUI_NEEDS_DISPLAY();
  const char* asked = std::getenv("KARINUI_LONG");
  const unsigned seeds = asked && *asked ? 40 : 1;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Window w;
    Theme::here().setLanguage(seed % 2 ? Language::Japanese : Language::English);
    w.main().resize(1000, 620);
    w.openTunic();
    ClumsyHand hand(w, seed);
    for (int k = 0; k < 60; ++k) hand.act();
    w.key(Command::Cancel);
    w.rest();
    w.session().finish();
    w.rest();
    const std::vector<std::string> shown = stepsOf(w.session());
    const fs::path copy = w.session().path().parent_path() / "copy.karinui";
    fs::copy_file(w.session().path(), copy);
    {
      Session again;
      again.open(copy);
      again.finish();
      again.update();
      EXPECT_EQ(stepsOf(again), shown) << "the file holds what the window shows";
    }
    for (std::size_t k = 0; k < 200 && w.count() > 0; ++k) w.key(Command::Undo), w.rest();
    EXPECT_EQ(w.count(), 0u) << "undo leads back to the beginning";
  }
  Theme::here().setLanguage(Language::English);
}

// The window is closed while everything is under way; what was done is in the file.
TEST(StudioClumsy, ClosedInTheMiddleOfADragNothingIsLost) {
  KARINUI_NEEDS_DISPLAY();
  Folder kept;
  const fs::path file = kept.path / "mine.karinui";
  std::vector<std::string> shown;
  {
    Window w;
    w.openTunic();
    w.session().saveAs(file);
    w.rest();
    w.session().perform(*parseOperation("notch edge=front.hem_left at=0.3"));
    w.rest();
    shown = stepsOf(w.session());
    w.key(Command::Settle);
    w.key(Command::Move);
    w.drag(w.space(), {w.inSpace("front", {0, 0.1}), w.inSpace("front", {0, 0.1}) + QPointF(40, 10)}, {}, {},
           Qt::LeftButton, false);
    w.main().close();
  }
  Session again;
  again.open(file);
  again.finish();
  again.update();
  const std::vector<std::string> now = stepsOf(again);
  ASSERT_GE(now.size(), shown.size());
  EXPECT_TRUE(std::equal(shown.begin(), shown.end(), now.begin()));
}

}  // namespace
}  // namespace karinui::studio
