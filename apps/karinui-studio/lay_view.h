#pragma once
// The cloth with the pieces that are cut from it, one fabric at a time: pieces are carried and turned half round with
// the mouse or the keys. A piece that would overlap another, or leave the cloth, is red while it is held and goes back
// to where it was when it is let go. The cloth runs to the right from its beginning; the fold is below. GUI thread.
#include <QWidget>
#include <optional>

#include "karinui/design/lay_plan.h"

namespace karinui::studio {

class LayView : public QWidget {
  Q_OBJECT
 public:
  explicit LayView(QWidget* parent = nullptr);
  // The caller keeps the plan, and calls again when it is another. Null: there is none.
  void setLay(LayPlan* plan, std::size_t fabric);
  QPointF onScreen(Flat cloth) const;
  Flat onCloth(QPointF screen) const;
  bool holding() const { return held_.has_value(); }
  QSize sizeHint() const override { return {760, 460}; }

 signals:
  void changed();                            // a piece lies elsewhere, perhaps only while it is held
  void said(const karinui::Message& words);  // what lies under the ring, what was done or refused; for the foot

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool focusNextPrevChild(bool next) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  struct Held {
    FabricLay before;
    Flat by;
    bool turned = false;
    std::optional<Flat> grip;  // of the mouse, on the cloth
  };
  FabricLay* lay() const;
  std::optional<std::size_t> pieceAt(QPointF screen) const;
  void choose(std::optional<std::size_t> piece);
  void take(std::optional<Flat> grip);
  void carry();  // from where it was by what it is held now
  void letGo();
  void putBack();
  void undo();
  void turn();
  void frame(double& scale, QPointF& origin) const;
  void zoom(double by, QPointF about);
  Message about(std::size_t piece) const;
  std::string nameOf(const LaidPiece& piece) const;
  void paintCloth(QPainter& painter) const;
  void paintPiece(QPainter& painter, std::size_t nth) const;

  LayPlan* plan_ = nullptr;
  std::size_t fabric_ = 0;
  std::optional<std::size_t> chosen_;
  std::optional<Held> held_;
  std::optional<LayClash> clash_;  // of the held piece
  std::vector<FabricLay> moves_;   // the fabric before each, to be taken back
  double zoom_ = 1;                // 1: all of the cloth is seen
  QPointF pan_;                    // pixels
  std::optional<QPointF> panning_;
};

}  // namespace karinui::studio
