#pragma once
// The fitting in 3D: draws what the session shows, and hands it the mouse as a pointer. GUI thread.
#include <QOpenGLWidget>
#include <QTimer>
#include <QVariantAnimation>
#include <memory>

#include "karinui/session/fit.h"
#include "karinui/session/session.h"
#include "karinui/session/tape.h"
#include "karinui/view/camera.h"
#include "karinui/view/renderer.h"
#include "mouse.h"
#include "pressure_map.h"

namespace karinui::studio {

class EyeCompositor;
class ForceFeedback;
class ThumbnailRenderer;
class QuadWindow;

// In the order of the names stereoNames() gives them.
enum class Stereo { Off, SideBySide, TopBottom, Anaglyph, Interleaved, QuadBuffer };
const std::vector<Message>& stereoNames();
enum class FitMap { None, Strain, Ease, Pressure };

class SpaceView : public QOpenGLWidget {
  Q_OBJECT
 public:
  SpaceView(Session& session, LatencyLog& latencyLog, QWidget* parent = nullptr);
  ~SpaceView() override;

  void look(View view);           // from a side, all of it in view
  void turnTo(View view);         // to a side, round what is looked at: pan and zoom stay
  void setStereo(Stereo stereo);  // a quad buffer only where one may be had; else it stays, and says so
  void setEyes(double separation, double convergence);  // metres; share of the distance to what is looked at
  Stereo stereo() const { return stereo_; }
  void setMap(FitMap map);
  FitMap map() const { return map_; }
  bool mapping() const { return pressure_.busy(); }  // the map shown is not yet that of the garment
  double mapTop() const { return mapTop_; }
  // Another state of the garment beside the one that is worked on, on the same scale; null: none.
  void setBeside(SnapshotPtr other, const QString& caption);
  bool beside() const { return beside_.fitting != nullptr; }
  QStringList levelWords() const;  // what is written beside the tapes there: garment and body, from one to the next
  void setLevel(std::optional<double> height);  // shows the level tapes there
  void setTape(bool on);
  bool tape() const { return tape_; }
  void setBlenderKeys(bool on) { blender_ = on; }
  void setFine(bool on);  // whether still pictures are drawn finer than moving ones; not where drawing is slow
  // Still pictures, too, are drawn as while things move, in this share of the pixels each way: where only what is in
  // them matters.
  void setQuick(std::optional<double> share) { quickShare_ = share; }
  void refresh();                                                  // the session has something new
  void setForceFeedback(ForceFeedback* force) { force_ = force; }  // outlives this view; null: none
  const Camera& camera() const { return camera_; }
  void setCamera(const Camera& camera);
  std::array<unsigned, 2> eyes() const;  // textures of its context: what each eye was shown last
  QString driver() const { return driver_; }
  bool drawnByProcessor() const { return software_; }
  const std::optional<Error>& trouble() const { return trouble_; }
  std::optional<QPointF> onScreen(Vec3 place) const;  // for tests and guides
  bool still() const { return fine_ && !pressure_.busy(); }
  Viewpoint sight() const;
  double freeWidth() const;  // pixels of the view, from its left edge, that the floating bar leaves
  // A small picture of a fitting, for lists and dialogs; empty where nothing can be drawn.
  QImage portrait(const SceneFrame& frame, QSize pixels);

 signals:
  void failed(const QString& why);
  void painted();
  // The right button was clicked without a drag, or the menu key struck: what lies at `sample` is asked about.
  void menuAsked(const PointerSample& sample, const QPoint& global);

 protected:
  void initializeGL() override;
  void paintGL() override;
  void resizeGL(int width, int height) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  bool event(QEvent* event) override;
  bool focusNextPrevChild(bool) override { return false; }  // Tab goes from place to place; F6 leaves
  void leaveEvent(QEvent* event) override;

 private:
  PointerSample sampleAt(const QPointF& at, Qt::KeyboardModifiers keys, PointerSample::Phase phase) const;
  void feed(PointerSample sample);  // the session, unless the pointer leads a stylus
  void giveBack();
  void walkTo(const Camera& to);
  void cameraMoved(bool moving = true);  // false: a single step to another view
  Camera framed(View view) const;        // all of the fitting, in the part of the view that is free
  double tall() const;                   // metres, the figure that is seen; 0: none, or not known
  void restSoon();                       // the still picture, when nothing has moved for a moment
  static void dim(SceneFrame& frame);
  void frameAnew();  // after the view's shape changed, unless it was turned, panned or zoomed
  void showGarment();
  std::shared_ptr<const VisibleParts> visibleOf(const BodyPtr& body);
  ViewCut visibleCut_;
  std::map<BodyPtr, std::shared_ptr<const VisibleParts>> visible_;
  struct Mapped {  // a fitting in the colours of the map
    SceneFrame frame;
    std::vector<float> values;
  };
  Mapped mapped(const SnapshotPtr& garment);
  void showOverlay();
  Camera lens() const;
  void paintOver(QPainter& painter, double sideways, int width, int height);
  void paintThen(QPainter& painter, int width, int height) const;  // over the state beside
  void paintScale(QPainter& painter, int w, int h) const;
  double aspect() const;
  QSize halves() const;  // how many pictures across and down

  Session& session_;
  LatencyLog& latencyLog_;
  ForceFeedback* force_ = nullptr;
  Camera camera_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<EyeCompositor> compositor_;
  std::unique_ptr<ThumbnailRenderer> thumbnailRenderer_;
  std::unique_ptr<QuadWindow> quad_;  // while both eyes have a screen of their own
  std::optional<Error> trouble_;
  QString driver_;
  bool software_ = false;
  struct Beside {
    SnapshotPtr fitting;
    QString caption;
    std::unique_ptr<Renderer> renderer;
  } beside_;
  std::optional<double> level_;
  std::vector<Girths> levelShown_;
  std::uint64_t garmentShown_ = ~0ull;
  std::pair<QString, QImage> bar_;  // the floating bar's last picture, and of what it is one
  bool stale_ = true, overlaid_ = false, fine_ = false, finest_ = true, framed_ = false;
  std::optional<double> quickShare_;
  bool soft_ = false;    // the soft light is that of a still picture
  bool moving_ = false;  // view or cloth, until still: then less is drawn where the processor draws
  Stereo stereo_ = Stereo::Off;
  double separation_ = 0.063, convergence_ = 1;
  FitMap map_ = FitMap::None;
  PressureMap pressure_;
  PressureMap::Values pressureShown_;
  double mapTop_ = 0;
  bool tape_ = false, blender_ = false;
  Tape tapeShown_;
  std::vector<SceneLine> seamThreads_;
  QTimer rest_;
  QVariantAnimation walk_;
  std::optional<View> framedAs_;
  double framedTall_ = 0;  // metres, the figure then
  Held held_ = Held::Nothing;
  std::optional<QPointF> clicked_;  // where the right button went down; none once the mouse was dragged
  bool toolDown_ = false;           // the left button holds the tool, also while another turns the view
  QPointF last_;
};

}  // namespace karinui::studio
