#include "measure_drawing.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "karinui/body/tape_path.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr double kMargin = 0.06;  // metres round the figure
constexpr double kHidden = 0.02;  // metres that the tape may lie below the nearest skin and is still seen

// Across and towards the eye: from the front, from the body's left, from behind.
double across(int look, Vec3 p) { return look == 0 ? p.x : look == 1 ? -p.z : -p.x; }
double towards(int look, Vec3 p) { return look == 0 ? p.z : look == 1 ? p.x : -p.z; }

// Metres to pixels of one of three fields side by side.
struct Frame {
  double scale = 1, floor = 0, middle = 0;
  QPointF operator()(int look, Vec3 p) const { return {middle + scale * across(look, p), floor - scale * p.y}; }
};
Frame frameOf(const Body& body, QSizeF field) {
  double tall = 0, wide = 0;
  for (const Vec3 p : body.mesh().points) {
    tall = std::max(tall, p.y);
    wide = std::max({wide, std::fabs(p.x), std::fabs(p.z)});
  }
  Frame frame;
  frame.scale = std::min(field.height() / (tall + 2 * kMargin), field.width() / (2 * (wide + kMargin)));
  frame.middle = field.width() / 2;
  frame.floor = field.height() / 2 + frame.scale * tall / 2;
  return frame;
}

}  // namespace

MeasureDrawing::MeasureDrawing() {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  Theme::here().keep(this, [this] {
    const Message how = tapeSaid(key_);
    setToolTip(how.empty() ? QString() : inWords(how));
    setAccessibleName(inWords(say("Where the measure is taken")));
    setAccessibleDescription(toolTip());
  });
}

void MeasureDrawing::show(const BodyPtr& body, const std::string& key) {
  if (body == body_ && key == key_) return;
  body_ = body;
  key_ = key;
  const Message how = tapeSaid(key);
  setToolTip(how.empty() ? QString() : inWords(how));
  setAccessibleDescription(toolTip());
  update();
}

// Each face by its own light, the nearest wins.
void MeasureDrawing::draw() {
  const double ratio = devicePixelRatioF();
  const QSize field(static_cast<int>(width() * ratio / 3), static_cast<int>(height() * ratio));
  const std::string now = body_->hash() + " " + std::to_string(field.width()) + " " + std::to_string(field.height()) +
                          (Theme::here().dark() ? "d" : "l");
  if (now == drawn_) return;
  drawn_ = now;
  const Frame frame = frameOf(*body_, field);
  const TriangleMesh& mesh = body_->mesh();
  const bool dark = Theme::here().dark();
  for (int look = 0; look < 3; ++look) {
    Look& made = looks_[static_cast<std::size_t>(look)];
    made.picture = QImage(field, QImage::Format_ARGB32_Premultiplied);
    made.picture.fill(Qt::transparent);
    made.depth.assign(static_cast<std::size_t>(field.width()) * static_cast<std::size_t>(field.height()), -1e9F);
    for (const Triangle& t : mesh.faces) {
      const Vec3 a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
      const Vec3 out = cross(b - a, c - a);
      const double facing = towards(look, out) / std::max(1e-12, length(out));
      if (facing <= 0) continue;
      const int grey = static_cast<int>((dark ? 70 : 150) + 85 * facing);
      const QRgb colour = qRgb(grey, grey, std::min(255, grey + 4));
      const QPointF p = frame(look, a), q = frame(look, b), r = frame(look, c);
      const double area = (q.x() - p.x()) * (r.y() - p.y()) - (r.x() - p.x()) * (q.y() - p.y());
      if (std::fabs(area) < 1e-12) continue;
      const auto low = [](double u, double v, double w) { return static_cast<int>(std::floor(std::min({u, v, w}))); };
      const auto high = [](double u, double v, double w) { return static_cast<int>(std::ceil(std::max({u, v, w}))); };
      for (int y = std::max(0, low(p.y(), q.y(), r.y())); y < std::min(field.height(), high(p.y(), q.y(), r.y()) + 1);
           ++y)
        for (int x = std::max(0, low(p.x(), q.x(), r.x())); x < std::min(field.width(), high(p.x(), q.x(), r.x()) + 1);
             ++x) {
          const double u = ((q.x() - x) * (r.y() - y) - (r.x() - x) * (q.y() - y)) / area,
                       v = ((r.x() - x) * (p.y() - y) - (p.x() - x) * (r.y() - y)) / area, w = 1 - u - v;
          if (u < -1e-9 || v < -1e-9 || w < -1e-9) continue;
          const auto near = static_cast<float>(u * towards(look, a) + v * towards(look, b) + w * towards(look, c));
          float& held = made.depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(field.width()) +
                                   static_cast<std::size_t>(x)];
          if (near <= held) continue;
          held = near;
          made.picture.setPixel(x, y, colour);
        }
    }
  }
}

void MeasureDrawing::paintEvent(QPaintEvent*) {
  if (!body_ || width() < 60 || height() < 40) return;
  draw();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double ratio = devicePixelRatioF();
  const QSizeF field(looks_[0].picture.width(), looks_[0].picture.height());
  const Frame frame = frameOf(*body_, field);
  const std::vector<TapePath> paths = key_.empty() ? std::vector<TapePath>() : tapePath(*body_, key_);
  painter.scale(1 / ratio, 1 / ratio);
  for (int look = 0; look < 3; ++look) {
    const Look& made = looks_[static_cast<std::size_t>(look)];
    painter.save();
    painter.translate(look * field.width(), 0);
    painter.drawImage(0, 0, made.picture);
    const auto seen = [&](Vec3 p) {
      const QPointF at = frame(look, p);
      const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
      if (x < 0 || y < 0 || x >= made.picture.width() || y >= made.picture.height()) return true;
      return towards(look, p) + kHidden >
             made.depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(made.picture.width()) +
                        static_cast<std::size_t>(x)];
    };
    for (const TapePath& path : paths) {
      const std::size_t count = path.points.size();
      for (std::size_t i = 0; i + (path.closed ? 0 : 1) < count; ++i) {
        const Vec3 a = path.points[i], b = path.points[(i + 1) % count];
        QColor ink = Theme::here().palette().accent;
        const bool front = path.beside || seen(lerp(a, b, 0.5));
        ink.setAlphaF(front ? 1.0F : 0.25F);
        painter.setPen(QPen(ink, ratio * (path.beside ? 1.2 : front ? 2.6 : 1.4), Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(frame(look, a), frame(look, b));
      }
    }
    painter.restore();
  }
}

}  // namespace karinui::studio
