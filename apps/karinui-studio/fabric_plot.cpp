#include "fabric_plot.h"

#include <QMouseEvent>
#include <QPainter>
#include <cmath>
#include <numbers>

#include "karinui/base/number.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr double kTensile = 490;  // N/m: how far a tensile test pulls
constexpr double kNear = 12;      // pixels

double shearForce(const Fabric& f, double angle) { return f.shear * (angle + f.shearStiffen * angle * angle * angle); }

// A round number at least so large.
double roundUp(double value) {
  const double ten = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0})
    if (step * ten >= value * (1 - 1e-9)) return step * ten;
  return 10 * ten;
}

// Two figures are as fine as a hand.
double readable(double value) {
  if (!(value > 0)) return 0;
  const double grain = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::round(value / grain) * grain;
}

// The stiffening that brings the curve to this force there.
double stiffeningFor(ThreadCurve curve, double strain, double force) {
  double low = 0, high = 5000;
  for (int i = 0; i < 60; ++i) {
    curve.stiffening = (low + high) / 2;
    (curve.force(strain) < force ? low : high) = curve.stiffening;
  }
  return readable(low) < 1 ? 0 : readable(low);
}

}  // namespace

FabricPlot::FabricPlot() {
  setMinimumHeight(150);
  setMouseTracking(true);
}

void FabricPlot::fit() {
  if (law_ == Law::Shear) {
    widest_ = 30 * std::numbers::pi / 180;
    top_ = roundUp(1.15 * std::max(1e-3, shearForce(fabric_, widest_)));
    return;
  }
  const ThreadCurve warp = fabric_.warpCurve(), weft = fabric_.weftCurve();
  widest_ = roundUp(std::max({0.01, warp.strainAt(kTensile), weft.strainAt(kTensile)}));
  widest_ = std::min(widest_, 1.0);
  top_ = roundUp(1.15 * kTensile);
}

void FabricPlot::show(const Fabric& fabric, bool editable) {
  fabric_ = fabric;
  editable_ = editable;
  fit();
  update();
}
void FabricPlot::setLaw(Law law) {
  law_ = law;
  held_.reset();
  fit();
  update();
}

std::vector<FabricPlot::Line> FabricPlot::lines() const {
  if (law_ == Law::Shear) {
    const double half = widest_ / 2, far = widest_ * 0.9;
    Line line{false, shearForce, {}};
    line.points.push_back({half,
                           [half](Fabric& f, double, double force) {
                             f.shear = readable(force / (half + f.shearStiffen * half * half * half));
                           },
                           say("shear")});
    line.points.push_back({far,
                           [far](Fabric& f, double, double force) {
                             const double bare = f.shear * far;
                             f.shearStiffen = bare > 0 ? readable(std::max(0.0, force / bare - 1) / (far * far)) : 0;
                           },
                           say("how it grows stiffer")});
    return {line};
  }
  std::vector<Line> both;
  for (const bool across : {false, true}) {
    const auto toe = across ? &Fabric::toeWeft : &Fabric::toeWarp;
    const auto stretch = across ? &Fabric::stretchWeft : &Fabric::stretchWarp;
    const auto stiffen = across ? &Fabric::stiffenWeft : &Fabric::stiffenWarp;
    const auto curve = [across](const Fabric& f) { return across ? f.weftCurve() : f.warpCurve(); };
    Line line{across, [curve](const Fabric& f, double strain) { return curve(f).force(strain); }, {}};
    // At a third and at four fifths of a tensile test, so that the points stay apart.
    const double middle = std::clamp(curve(fabric_).strainAt(0.3 * kTensile), 1e-4, widest_ / 2);
    const double high = std::clamp(curve(fabric_).strainAt(0.8 * kTensile), middle + 1e-4, widest_);
    const double most = widest_ / 2;
    line.points.push_back({std::min(fabric_.*toe, most),
                           [toe, most](Fabric& f, double strain, double) {
                             f.*toe = std::round(std::clamp(strain, 0.0, most) * 1e4) / 1e4;
                           },
                           say("where it begins to hold")});
    line.points.push_back({middle,
                           [stretch, curve, middle](Fabric& f, double, double force) {
                             const double now = curve(f).force(middle);
                             if (now > 0) f.*stretch = std::clamp(readable(f.*stretch * force / now), 1.0, 1e6);
                           },
                           say("stretch")});
    line.points.push_back(
        {high,
         [stiffen, curve, high](Fabric& f, double, double force) { f.*stiffen = stiffeningFor(curve(f), high, force); },
         say("how it grows stiffer")});
    both.push_back(std::move(line));
  }
  return both;
}

QRectF FabricPlot::box() const { return QRectF(rect()).adjusted(44, 8, -10, -24); }

QPointF FabricPlot::at(double strain, double force) const {
  return {box().left() + box().width() * strain / widest_,
          box().bottom() - box().height() * std::min(1.0, force / top_)};
}

std::vector<QPointF> FabricPlot::points() const {
  std::vector<QPointF> all;
  for (const Line& line : lines())
    for (const Line::Point& point : line.points) all.push_back(at(point.strain, line.force(fabric_, point.strain)));
  return all;
}

void FabricPlot::mousePressEvent(QMouseEvent* event) {
  if (!editable_) return;
  double nearest = kNear;
  const auto all = points();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const double away = QLineF(all[i], event->position()).length(); away < nearest) nearest = away, held_ = i;
  update();
}

void FabricPlot::mouseMoveEvent(QMouseEvent* event) {
  const auto all = lines();
  std::size_t k = 0;
  for (const Line& line : all)
    for (const Line::Point& point : line.points) {
      const QPointF here = at(point.strain, line.force(fabric_, point.strain));
      if (!held_ && QLineF(here, event->position()).length() < kNear)
        setToolTip(inWords(point.what) + (law_ == Law::Shear ? QString()
                                                             : " – " + inWords(line.across ? say("across the grain")
                                                                                           : say("along the grain"))));
      if (held_ == k) {
        const double strain = (event->position().x() - box().left()) / box().width() * widest_;
        const double force = (box().bottom() - event->position().y()) / box().height() * top_;
        point.to(fabric_, std::clamp(strain, 0.0, widest_), std::clamp(force, 0.01 * top_, top_));
        update();
        emit changed();
        return;
      }
      ++k;
    }
}

void FabricPlot::mouseReleaseEvent(QMouseEvent*) {
  if (!held_) return;
  held_.reset();
  fit();
  update();
}

void FabricPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Palette& p = Theme::here().palette();
  painter.setPen(QPen(p.line, 1));
  painter.setBrush(p.raised);
  painter.drawRect(box());
  for (int i = 1; i < 4; ++i) {
    painter.drawLine(QPointF(box().left() + box().width() * i / 4, box().top()),
                     QPointF(box().left() + box().width() * i / 4, box().bottom()));
    painter.drawLine(QPointF(box().left(), box().top() + box().height() * i / 4),
                     QPointF(box().right(), box().top() + box().height() * i / 4));
  }
  painter.setPen(p.faint);
  painter.drawText(QRectF(0, box().top() - 6, 40, 14), Qt::AlignRight,
                   QString::fromStdString(fixed(top_, top_ < 10 ? 1 : 0)));
  painter.drawText(QRectF(0, box().center().y() - 7, 40, 14), Qt::AlignRight, "N/m");
  const bool shear = law_ == Law::Shear;
  const double most = shear ? widest_ * 180 / std::numbers::pi : 100 * widest_;
  painter.drawText(QRectF(box().left(), box().bottom() + 4, box().width(), 18), Qt::AlignRight,
                   QString::fromStdString(fixed(most, most < 10 && !shear ? 1 : 0)) + (shear ? "°" : " %"));
  painter.setClipRect(box().adjusted(-6, -6, 6, 6));
  std::size_t k = 0;
  for (const Line& line : lines()) {
    const QColor ink = line.across ? QColor(0x44, 0x77, 0xAA) : p.accent;
    QPolygonF drawn;
    for (int i = 0; i <= 120; ++i) {
      const double strain = widest_ * i / 120, force = line.force(fabric_, strain);
      if (force > top_) break;
      drawn << at(strain, force);
    }
    painter.setPen(QPen(ink, 2, line.across ? Qt::DashLine : Qt::SolidLine));
    painter.setBrush(Qt::NoBrush);
    painter.drawPolyline(drawn);
    for (const Line::Point& point : line.points) {
      painter.setPen(QPen(ink, 1.6));
      painter.setBrush(held_ == k++ ? ink : p.raised);
      if (editable_) painter.drawEllipse(at(point.strain, line.force(fabric_, point.strain)), 4.5, 4.5);
    }
  }
}

}  // namespace karinui::studio
