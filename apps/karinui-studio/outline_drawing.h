#pragma once
// A piece as it will be cut, with the length of each edge beside it. GUI thread.
#include <QPainterPath>
#include <QWidget>
#include <utility>
#include <vector>

#include "karinui/design/document.h"

namespace karinui::studio {

class OutlineDrawing : public QWidget {
  Q_OBJECT
 public:
  explicit OutlineDrawing(QWidget* parent = nullptr);
  void show(std::shared_ptr<const Piece> piece);  // null: nothing
  QSize sizeHint() const override { return {360, 190}; }
  // In pixels: the paper, and what is said of each edge with the place above which it stands.
  struct Drawn {
    QPainterPath paper;
    std::vector<std::pair<QPointF, QString>> words;
  };
  Drawn drawn() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void pushApart(std::vector<std::pair<QPointF, QString>>& words, std::vector<double> lengths) const;
  std::shared_ptr<const Piece> piece_;
};

}  // namespace karinui::studio
