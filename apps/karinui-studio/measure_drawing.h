#pragma once
// The figure from the front, the side and behind, with the tape where one measure is taken. GUI thread.
#include <QImage>
#include <QWidget>
#include <array>
#include <vector>

#include "karinui/body/body.h"

namespace karinui::studio {

class MeasureDrawing : public QWidget {
  Q_OBJECT
 public:
  MeasureDrawing();
  void show(const BodyPtr& body, const std::string& key);  // null or empty: nothing
  QSize sizeHint() const override { return {280, 190}; }
  QSize minimumSizeHint() const override { return {180, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Look {  // from one side
    QImage picture;
    std::vector<float> depth;  // nearest, per pixel; larger is nearer
  };
  void draw();  // the figure, when it or the size is another
  BodyPtr body_;
  std::string key_, drawn_;
  std::array<Look, 3> looks_;
};

}  // namespace karinui::studio
