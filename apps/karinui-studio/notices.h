#pragma once
// Sentences for the person, over the fitting: the newest on top, an older one below it until there was time to read it.
// A click on one takes it away, and so does a drag that begins on it, which goes to the view below. All of the
// session's sentences are kept to be read again. GUI thread.
#include <QLabel>
#include <QMouseEvent>
#include <QPointer>
#include <QStringList>
#include <QTimer>
#include <deque>
#include <memory>

#include "karinui/session/session.h"

namespace karinui::studio {

class Notices : public QObject {
  Q_OBJECT
 public:
  enum class Drags { Stop, GoThrough };
  Notices(QWidget* over, Drags drags);
  void tell(Notice::Kind kind, const QString& words, bool long_);  // long_: something can be done about it
  void moveTo(QWidget* over, Drags drags);                         // with all that is shown
  // Into so many pixels of width; `between` are left free under the newest, for its button. Gives where that ends.
  int place(int room, int between);
  void hold(bool on) { held_ = on; }  // while something is being worked out nothing goes by itself
  void clear();
  void clearNewest();
  void done(std::uint64_t last);  // the step done last: with a later one, what was refused before is past
  bool visible() const;
  QString newest() const { return said_.isEmpty() ? QString() : said_.back(); }  // also when it is gone
  void showAll(QWidget* parent) const;                                           // a dialog

 signals:
  void newestGone();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void take(QLabel* label);
  bool overView(QEvent* event);
  QWidget* over_;
  Drags drags_;
  QPointer<QLabel> pressed_;            // a click or a drag began on it
  std::unique_ptr<QEvent> firstPress_;  // not yet known to the view
  std::deque<QLabel*> shown_;           // the newest first
  QStringList said_;                    // the last ones, the newest at the end
  std::uint64_t done_ = 0;
  int room_ = 400, between_ = 0;
  bool held_ = false;
};

}  // namespace karinui::studio
