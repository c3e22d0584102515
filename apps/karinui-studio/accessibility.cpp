#include "accessibility.h"

#include <QAccessibleWidget>
#include <QPointer>

#include "lay_view.h"
#include "pattern_view.h"
#include "space_view.h"

namespace karinui::studio {

namespace {

class Place : public QAccessibleInterface {
 public:
  explicit Place(QWidget* view) : view_(view) {}
  void say(const QString& words) { words_ = words; }
  bool isSaying() const { return !words_.isEmpty(); }

  bool isValid() const override { return !view_.isNull(); }
  QObject* object() const override { return nullptr; }
  QAccessibleInterface* parent() const override { return QAccessible::queryAccessibleInterface(view_); }
  QAccessibleInterface* child(int) const override { return nullptr; }
  QAccessibleInterface* childAt(int, int) const override { return nullptr; }
  int childCount() const override { return 0; }
  int indexOfChild(const QAccessibleInterface*) const override { return -1; }
  QString text(QAccessible::Text which) const override { return which == QAccessible::Name ? words_ : QString(); }
  void setText(QAccessible::Text, const QString&) override {}
  QRect rect() const override { return view_ ? QRect(view_->mapToGlobal(QPoint()), view_->size()) : QRect(); }
  QAccessible::Role role() const override { return QAccessible::Client; }  // said without a word for what it is
  QAccessible::State state() const override {
    QAccessible::State state;
    state.focusable = state.readOnly = true;
    state.focused = isSaying() && view_ && view_->hasFocus();
    return state;
  }

 private:
  QPointer<QWidget> view_;
  QString words_;
};

// Two places in turn, for what has the focus already is not told again.
class SpeakingView : public QAccessibleWidget {
 public:
  explicit SpeakingView(QWidget* view) : QAccessibleWidget(view, QAccessible::Client) {
    for (const int own : {0, 1}) {
      place_[own] = new Place(view);
      id_[own] = QAccessible::registerAccessibleInterface(place_[own]);
    }
  }
  ~SpeakingView() override {
    for (const QAccessible::Id id : id_)  // at the very end Qt may have let go of them first
      if (QAccessible::accessibleInterface(id)) QAccessible::deleteAccessibleInterface(id);
  }
  void say(const QString& words) {
    if (place_[now_]->text(QAccessible::Name) == words) return;
    place_[now_]->say({});
    if (!words.isEmpty()) {
      now_ = 1 - now_;
      place_[now_]->say(words);
    }
    QAccessibleEvent focused(widget(), QAccessible::Focus);
    if (!words.isEmpty()) focused.setChild(QAccessibleWidget::childCount() + now_);
    QAccessible::updateAccessibility(&focused);
  }
  QAccessibleInterface* focusChild() const override {
    return place_[now_]->isSaying() ? place_[now_] : QAccessibleWidget::focusChild();
  }
  // After the widgets in the view.
  int childCount() const override { return QAccessibleWidget::childCount() + 2; }
  QAccessibleInterface* child(int index) const override {
    const int own = index - QAccessibleWidget::childCount();
    return own == 0 || own == 1 ? place_[own] : QAccessibleWidget::child(index);
  }
  int indexOfChild(const QAccessibleInterface* child) const override {
    for (const int own : {0, 1})
      if (child == place_[own]) return QAccessibleWidget::childCount() + own;
    return QAccessibleWidget::indexOfChild(child);
  }

 private:
  Place* place_[2] = {};  // owned by Qt's register, until this ends
  QAccessible::Id id_[2] = {};
  int now_ = 0;
};

QAccessibleInterface* speaking(const QString& kind, QObject* object) {
  const bool view = kind == SpaceView::staticMetaObject.className() ||
                    kind == PatternView::staticMetaObject.className() || kind == LayView::staticMetaObject.className();
  return view ? new SpeakingView(static_cast<QWidget*>(object)) : nullptr;
}

}  // namespace

void letViewsSpeak() {
  static const bool once = (QAccessible::installFactory(speaking), true);
  static_cast<void>(once);
}

void announce(QWidget* view, const QString& words) {
  if (auto* heard = dynamic_cast<SpeakingView*>(QAccessible::queryAccessibleInterface(view))) heard->say(words);
}

}  // namespace karinui::studio
