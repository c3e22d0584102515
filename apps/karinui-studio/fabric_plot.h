#pragma once
// A fabric's law as curves whose points are dragged: tension over stretch, along the grain and across, or the force
// that shears it. Each point turns one number of the law. GUI thread.
#include <QWidget>
#include <functional>
#include <optional>

#include "karinui/base/message.h"
#include "karinui/cloth/fabric.h"

namespace karinui::studio {

class FabricPlot : public QWidget {
  Q_OBJECT
 public:
  enum class Law { Stretch, Shear };
  FabricPlot();
  void show(const Fabric& fabric, bool editable);
  void setLaw(Law law);
  const Fabric& fabric() const { return fabric_; }
  // Where the points are, on the widget: of the curve along the grain, then of that across.
  std::vector<QPointF> points() const;

 signals:
  void changed();  // by the hand

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent*) override;

 private:
  struct Line {
    bool across = false;
    std::function<double(const Fabric&, double)> force;
    struct Point {
      double strain;
      std::function<void(Fabric&, double strain, double force)> to;
      Message what;
    };
    std::vector<Point> points;
  };
  std::vector<Line> lines() const;
  QRectF box() const;
  QPointF at(double strain, double force) const;
  void fit();  // the axes to the fabric

  Fabric fabric_;
  Law law_ = Law::Stretch;
  bool editable_ = false;
  double widest_ = 0.03, top_ = 100;  // the axes: strain or radians, N/m
  std::optional<std::size_t> held_;
};

}  // namespace karinui::studio
