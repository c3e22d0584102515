#pragma once
// The flat pattern on the cutting table: what the session's table says, in metres, and the mouse as its pointer.
// GUI thread.
#include <QWidget>

#include "karinui/session/session.h"
#include "karinui/session/table_frame_of.h"
#include "mouse.h"
#include "table_painter.h"

class QToolButton;

namespace karinui::studio {

class PatternView : public QWidget {
  Q_OBJECT
 public:
  PatternView(Session& session, LatencyLog& latencyLog, QWidget* parent = nullptr);
  void showAll();
  void refresh();
  void setNest(bool on) { nest_ = on, update(); }  // graded pieces in all their sizes
  QPointF onScreen(Flat table) const;
  Flat onTable(const QPointF& screen) const;
  Message emptySaid() const;  // where no piece lies on it

 signals:
  void pointed(Flat table);
  void left();                                                        // by the pointer
  void menuAsked(const PointerSample& sample, const QPoint& global);  // as in the fitting

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void leaveEvent(QEvent* event) override;
  bool event(QEvent* event) override;
  bool focusNextPrevChild(bool) override { return false; }  // as in the fitting

 private:
  PointerSample sampleAt(const QPointF& at, Qt::KeyboardModifiers keys, PointerSample::Phase phase) const;
  void feed(const QPointF& at, Qt::KeyboardModifiers keys, PointerSample::Phase phase);
  void showScans(bool shown);
  TableOnScreen screen() const;
  FlatBox all() const;  // the pieces and scans that lie there

  Session& session_;
  QToolButton* scans_;  // whether they are seen
  LatencyLog& latencyLog_;
  LetteringRooms rooms_;
  double scale_ = 500;  // pixels a metre
  Flat middle_{0.4, -0.3};
  std::size_t piecesShown_ = 0;
  std::map<PieceId, Flat> lieShown_;
  Underlays scansShown_;
  Held held_ = Held::Nothing;
  bool nest_ = false;
  bool mine_ = false;
  QPointF last_;
  std::optional<QPointF> clicked_;  // where the right button went down; none once the mouse was dragged
};

}  // namespace karinui::studio
