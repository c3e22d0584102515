#include "pose_view.h"

#include <QMouseEvent>
#include <QPainter>

#include "karinui/view/picture.h"
#include "orbit.h"
#include "pixels.h"
#include "theme.h"

namespace karinui::studio {

namespace {
constexpr double kRoom = 1.3;       // around the figure as it stands: for raised arms
constexpr double kTurned = 0.0075;  // radians a pixel
}  // namespace

PoseView::PoseView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(260, 320);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setMouseTracking(true);
  thread_.setMaxThreadCount(1);
}

// The picture's context is left where it was made current: let go on the window's thread, it would leave that one
// without the context that GLX holds to be current there.
PoseView::~PoseView() {
  thread_.start([this] { picture_.reset(); });
  thread_.waitForDone();
}

void PoseView::setSkeleton(std::shared_ptr<const Skeleton> skeleton) {
  const bool first = !skeleton_ && skeleton;
  skeleton_ = std::move(skeleton);
  grip_.reset();
  if (!skeleton_) {
    image_ = {};
    return update();
  }
  if (first) frameFigure();
  show({});
}

void PoseView::frameFigure() {
  SceneFrame frame;
  frame.bodies.push_back({skeleton_->body()->mesh(), SceneBody().colour});
  camera_ = frameAll(frame, View::Oblique, aspect());
  camera_.eye = camera_.target + (camera_.eye - camera_.target) * kRoom;
}

void PoseView::show(const BodyPose& pose) {
  pose_ = pose;
  if (!skeleton_) return;
  mesh_ = {skeleton_->points(skeleton_->placements(pose_)), skeleton_->body()->mesh().faces};
  draw();
}

void PoseView::draw() {
  if (!skeleton_ || width() < 16 || height() < 16) return;
  if (drawing_) {
    waits_ = true;
    return;
  }
  drawing_ = true, waits_ = false;
  PictureOptions options;
  options.camera = camera_;
  options.width = width(), options.height = height();
  options.samples = grip_ || turning_ ? 1 : 2;
  options.lettering = false;
  thread_.start([this, options, mesh = mesh_] {
    QImage made;
    if (!picture_)
      if (auto opened = Picture::open()) picture_ = std::shared_ptr<Picture>(*std::move(opened));
    if (picture_) {
      SceneFrame frame;
      frame.bodies.push_back({mesh, SceneBody().colour});
      if (const auto image = picture_->draw(frame, options)) made = pixelsOf(*image).copy();
    }
    QMetaObject::invokeMethod(
        this,
        [this, made] {
          drawing_ = false;
          if (skeleton_) image_ = made;
          update();
          if (waits_) return draw();
          emit pictured();
        },
        Qt::QueuedConnection);
  });
}

QPointF PoseView::onScreen(const SurfacePoint& place) const {
  const OnPicture there = project(eyeOf(camera_, aspect()), at(mesh_, place), width(), height());
  return {there.x, there.y};
}

std::optional<PoseView::Grip> PoseView::gripAt(const QPointF& at) const {
  if (!skeleton_) return std::nullopt;
  const Ray ray = rayAt(camera_, at.x(), at.y(), width(), height());
  const auto hit = Bvh(mesh_).first(ray.origin, ray.direction);
  if (!hit) return std::nullopt;
  const auto joint = jointHolding(*skeleton_->body(), hit->place);
  return joint ? std::optional(Grip{*joint, hit->place}) : std::nullopt;
}

void PoseView::mousePressEvent(QMouseEvent* event) {
  last_ = event->position();
  if (event->button() == Qt::LeftButton && isEnabled()) grip_ = gripAt(last_);
  if (grip_) {
    emit taken(grip_->joint);
    update();
  } else {
    turning_ = true;
  }
}

void PoseView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF step = event->position() - last_;
  last_ = event->position();
  if (grip_) {
    const Ray ray = rayAt(camera_, last_.x(), last_.y(), width(), height());
    emit dragged(reaching(*skeleton_, pose_, grip_->joint, grip_->place, ray.origin, ray.direction));
  } else if (turning_) {
    camera_ = turned(camera_, step.x() * kTurned, step.y() * kTurned);
    draw();
  } else {
    setCursor(gripAt(last_) ? Qt::OpenHandCursor : Qt::ArrowCursor);
  }
}

void PoseView::mouseReleaseEvent(QMouseEvent*) {
  const bool held = grip_.has_value();
  grip_.reset(), turning_ = false;
  draw();
  if (held) emit letGo();
}

void PoseView::resizeEvent(QResizeEvent*) {
  if (skeleton_) frameFigure();
  draw();
}

void PoseView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  if (image_.isNull()) return;
  painter.drawImage(rect(), image_);
  if (grip_) paintRing(painter, onScreen(grip_->place), Theme::here().palette().accent);
}

}  // namespace karinui::studio
