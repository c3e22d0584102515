#pragma once
// The figure by itself, in a pose that is being tried: limbs are dragged, the rest of the picture turns it. Pictures
// are made on a thread of its own, the newest pose only. GUI thread.
#include <QImage>
#include <QThreadPool>
#include <QWidget>
#include <memory>
#include <optional>

#include "karinui/body/reach.h"
#include "karinui/geometry/bvh.h"
#include "karinui/view/camera.h"

namespace karinui {
class Picture;
}

namespace karinui::studio {

class PoseView : public QWidget {
  Q_OBJECT
 public:
  explicit PoseView(QWidget* parent = nullptr);
  ~PoseView() override;                                        // waits for a picture under way
  void setSkeleton(std::shared_ptr<const Skeleton> skeleton);  // null: nothing is shown
  void show(const BodyPose& pose);
  bool held() const { return grip_.has_value(); }
  bool drawn() const { return !drawing_ && !waits_; }  // what it shows is the newest pose
  QPointF onScreen(const SurfacePoint& place) const;   // of the skin as it is posed
  QSize sizeHint() const override { return {460, 580}; }

 signals:
  void taken(karinui::Joint joint);             // a limb was taken hold of
  void dragged(const karinui::BodyPose& pose);  // and is in hand
  void letGo();                                 // and let go
  void pictured();                              // a picture was made

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  struct Grip {
    Joint joint;
    SurfacePoint place;
  };
  std::optional<Grip> gripAt(const QPointF& at) const;
  double aspect() const { return 1.0 * width() / std::max(1, height()); }
  void frameFigure();
  void draw();

  std::shared_ptr<const Skeleton> skeleton_;
  BodyPose pose_;
  TriangleMesh mesh_;  // of the pose
  Camera camera_;
  QImage image_;
  std::optional<Grip> grip_;
  bool turning_ = false;
  QPointF last_;
  bool drawing_ = false, waits_ = false;
  std::shared_ptr<Picture> picture_;  // of the thread's
  QThreadPool thread_;
};

}  // namespace karinui::studio
