// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "space_view.h"

#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLPaintDevice>
#include <QPainter>
#include <cmath>

#include "eye_compositor.h"
#include "karinui/body/lines.h"
#include "karinui/session/menu.h"
#include "karinui/session/scene_of.h"
#include "karinui/view/strain_scale.h"
#include "mouse.h"
#include "orbit.h"
#include "quad_window.h"
#include "theme.h"
#include "thumbnail_renderer.h"

namespace karinui::studio {

namespace {

constexpr double kEaseTop = 0.05;    // metres
constexpr double kLyingScale = 84;   // pixels
constexpr int kStillAfter = 140;     // milliseconds without a move until the fine picture is drawn
constexpr double kQuickShare = 0.5;  // of the pixels, each way, while it moves and the processor draws

// The painter takes the state of a fresh context for granted.
void readyForPainter() {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, 0);
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  glUseProgram(0);
}

// Where only a share of the pixels is drawn, no soft light is gathered: that would take longer than the picture.
Studio studioFor(bool software, bool roughly) {
  Studio studio;
  if (software) studio.keyMap = 1024, studio.skyDirections = 20, studio.skyMap = 384;
  if (software && roughly) studio.keyMap = 256, studio.skyDirections = 0;
  return studio;
}

}  // namespace

const std::vector<Message>& stereoNames() {
  static const std::vector<Message> all{say("off"),
                                        say("side by side"),
                                        say("top and bottom"),
                                        say("red-cyan glasses"),
                                        say("row by row"),
                                        say("two pictures at once, on a screen of its own")};
  return all;
}

SpaceView::SpaceView(Session& session, LatencyLog& latencyLog, QWidget* parent)
    : QOpenGLWidget(parent), session_(session), latencyLog_(latencyLog) {
  preparePointing(*this, {320, 280});
  camera_ = frameAll({}, View::Oblique, 1);
  rest_.setSingleShot(true);
  connect(&rest_, &QTimer::timeout, this, [this] {
    const Busy busy = session_.busy();
    // A fine picture that the processor draws would keep the next one waiting.
    if (moving_ && software_ && (busy.settling || busy.posing)) return rest_.start(kStillAfter);
    fine_ = true;
    stale_ = stale_ || finest_ || moving_;
    moving_ = false;
    update();
  });
  walk_.setDuration(260);
  walk_.setEasingCurve(QEasingCurve::InOutCubic);
  connect(&Theme::here(), &Theme::changed, this, [this] { update(); });
  connect(&pressure_, &PressureMap::ready, this, [this] {
    if (map_ == FitMap::Pressure) garmentShown_ = ~0ull;
    refresh();
  });
}

SpaceView::~SpaceView() {
  giveBack();
  if (context()) disconnect(context(), nullptr, this, nullptr);  // it ends after this view, and would still tell it
}

// What lives in graphics memory goes while its context is there.
void SpaceView::giveBack() {
  if (!renderer_) return;
  makeCurrent();
  renderer_.reset();
  beside_.renderer.reset();
  quad_.reset();
  compositor_.reset();
  thumbnailRenderer_.reset();
  doneCurrent();
}

double SpaceView::aspect() const {
  const QSize parts = halves();
  return std::max(0.1,
                  (static_cast<double>(width()) / parts.width()) / (std::max(1.0, 1.0 * height()) / parts.height()));
}

QSize SpaceView::halves() const {
  if (beside()) return {2, 1};
  return {stereo_ == Stereo::SideBySide ? 2 : 1, stereo_ == Stereo::TopBottom ? 2 : 1};
}

void SpaceView::initializeGL() {
  const QSurfaceFormat format = context()->format();
  const char* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  driver_ = QString::fromLatin1(name ? name : "");
  software_ = driver_.contains("llvmpipe") || driver_.contains("softpipe") || driver_.contains("swrast");
  if (format.majorVersion() * 10 + format.minorVersion() < 33) {
    trouble_ = notFound(say("This machine offers OpenGL {0}; Karinui needs 3.3. A newer graphics driver may help.",
                            written(format.majorVersion()) + "." + written(format.minorVersion())));
    emit failed(inWords(trouble_->what));
    return;
  }
  auto made = Renderer::make(studioFor(software_, quickShare_.has_value()));
  if (!made) {
    trouble_ = made.error();
    emit failed(inWords(trouble_->what));
    return;
  }
  renderer_ = std::move(*made);
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &SpaceView::giveBack, Qt::UniqueConnection);
  compositor_ = std::make_unique<EyeCompositor>();
  garmentShown_ = ~0ull;
}

void SpaceView::resizeGL(int, int) { frameAnew(); }

void SpaceView::restSoon() {
  fine_ = false;
  stale_ = true;
  rest_.start(finest_ || moving_ ? kStillAfter : 0);  // 0: there is no finer picture to wait for
  update();
}

void SpaceView::cameraMoved(bool moving) {
  session_.setViewpoint(sight());
  moving_ = moving_ || moving;
  restSoon();
}

void SpaceView::setCamera(const Camera& camera) {
  walk_.stop();
  framedAs_.reset();
  camera_ = camera;
  cameraMoved();
}

Viewpoint SpaceView::sight() const {
  Viewpoint seen = sightOf(camera_, aspect());
  seen.points = static_cast<double>(height()) / halves().height();
  return seen;
}

double SpaceView::freeWidth() const { return width() * (1 - menuShare(sight()) / halves().width()); }

Camera SpaceView::framed(View view) const {
  const QSize parts = halves();
  const double w = 1.0 * width() / parts.width(), h = std::max(1.0, 1.0 * height() / parts.height());
  const double bar = w * menuShare(sight());
  const double scale = beside() && map_ != FitMap::None ? std::min(kLyingScale, h / 3) : 0;  // lies below the feet
  Camera to = frameAll(session_.shown().frame, view, std::max(0.1, (w - bar) / (h - scale)));
  to.eye = to.target + (to.eye - to.target) * (h / (h - scale));
  return panned(to, -bar / 2, -scale / 2, h);
}

void SpaceView::frameAnew() {
  if (framedAs_) {
    walk_.stop();
    camera_ = framed(*framedAs_);
    framedTall_ = tall();
  }
  cameraMoved(false);
}

void SpaceView::look(View view) {
  session_.leave();  // what was under the pointer is there no more
  const Camera to = framed(view);
  framed_ = true;
  walkTo(to);
  framedAs_ = view;
  framedTall_ = tall();
}

void SpaceView::turnTo(View view) {
  if (framedAs_) return look(view);  // nobody has gone near yet, and the floating bar is to leave the figure free
  const Camera all = frameAll(session_.shown().frame, view, aspect());
  Camera to = camera_;
  to.eye = to.target + normalized(all.eye - all.target) * camera_.distance();
  session_.leave();
  walkTo(to);
  framedAs_.reset();
}

void SpaceView::walkTo(const Camera& to) {
  const Camera from = camera_;
  walk_.stop();
  walk_.disconnect(this);
  walk_.setStartValue(0.0);
  walk_.setEndValue(1.0);
  connect(&walk_, &QVariantAnimation::valueChanged, this, [this, from, to](const QVariant& t) {
    camera_ = between(from, to, t.toDouble());
    cameraMoved();
  });
  if (!isVisible() || software_) {
    camera_ = to;
    cameraMoved(false);
  } else {
    walk_.start();
  }
}

void SpaceView::setStereo(Stereo stereo) {
  if (stereo == Stereo::QuadBuffer && !QuadWindow::mayBeHad())
    return session_.refuse(notFound(say(
        "No screen of this machine shows two pictures at once; side by side, red-cyan or row by row always work.")));
  stereo_ = stereo;
  quad_.reset();
  if (stereo == Stereo::QuadBuffer) {
    quad_ = std::make_unique<QuadWindow>(context());
    quad_->showFullScreen();
  }
  frameAnew();
}
void SpaceView::setEyes(double separation, double convergence) {
  separation_ = separation;
  convergence_ = convergence;
  cameraMoved(false);
}
void SpaceView::setMap(FitMap map) {
  map_ = map;
  garmentShown_ = ~0ull;
  if (beside()) frameAnew();
  refresh();
}
void SpaceView::setBeside(SnapshotPtr other, const QString& caption) {
  beside_.fitting = std::move(other);
  beside_.caption = caption;
  garmentShown_ = ~0ull;
  frameAnew();
}
void SpaceView::setLevel(std::optional<double> height) {
  level_ = height;
  levelShown_ = level_ ? girthsAt(session_.shown(), *level_) : std::vector<Girths>();
  update();
}
void SpaceView::setFine(bool on) {
  finest_ = on;
  soft_ = false;
  stale_ = true;
  update();
}
void SpaceView::setTape(bool on) {
  tape_ = on;
  tapeShown_ = {};
  refresh();
}

double SpaceView::tall() const {
  const BodyPtr& body = session_.shown().body;
  if (!body) return 0;
  const auto& measured = body->measured().value;
  const auto height = measured.find("height");
  return height == measured.end() ? 0 : height->second;
}

void SpaceView::refresh() {
  if (!framed_ && session_.snapshot().body) look(View::Oblique);
  // A child's figure after a woman's, not the same one a little smaller; one that is taller stands out of the picture.
  constexpr double kSmaller = 0.1, kTaller = 0.03;
  if (const double now = tall(), was = framedTall_;
      framedAs_ && was > 0 && now > 0 && !session_.begun() && (now < (1 - kSmaller) * was || now > (1 + kTaller) * was))
    look(*framedAs_);
  const bool carried = !session_.preview().carried.empty();
  if (garmentShown_ != session_.changes().garment || carried) {
    moving_ = moving_ || carried || session_.begun() || session_.busy().settling || session_.busy().posing;
    restSoon();
  }
  update();
}

// What the map tells of a fitting: per point of the cloth, or, of pressure, per point of the bared body.
SpaceView::Mapped SpaceView::mapped(const SnapshotPtr& garment) {
  const GarmentSnapshot& fitting = *garment;
  Mapped own{fitting.frame, {}};
  if (fitting.underWay) return own;  // the map is of a figure that stands
  if (map_ == FitMap::Ease && fitting.body) {
    for (SceneCloth& cloth : own.frame.cloths) {
      cloth.strain = easeOf(cloth, *fitting.body);
      for (float& s : cloth.strain) s = std::max(0.0f, s);
    }
  } else if (map_ == FitMap::Pressure && fitting.body) {
    // Until the newest is known the one shown last stays, where it is of the same body.
    const std::size_t points = fitting.body->mesh().points.size();
    if (const auto known = pressure_.of(garment)) pressureShown_ = known;
    if (pressureShown_ && pressureShown_->size() == points) own.values = *pressureShown_;
    own.frame = pressureFrame(fitting, own.values);
  }
  return own;
}

// Kept while body and cut are the same.
std::shared_ptr<const VisibleParts> SpaceView::visibleOf(const BodyPtr& body) {
  auto& kept = visible_[body];
  if (!kept || !(visibleCut_ == session_.viewCut())) {
    visibleCut_ = session_.viewCut();
    visible_.clear();
    return visible_[body] = std::make_shared<const VisibleParts>(visibleCut_, body);
  }
  return kept;
}

// The garment as it was, while the new one is being worked out: it can be told from one that is at rest.
void SpaceView::dim(SceneFrame& frame) {
  constexpr float kCover = 0.42f, kGrey = 0.55f, kTo = 0.6f;
  for (SceneCloth& cloth : frame.cloths) {
    cloth.look.cover = std::min(cloth.look.cover, kCover);
    for (float& part : cloth.colour) part += kTo * (kGrey - part);
  }
}

void SpaceView::showGarment() {
  const SnapshotPtr fitting = session_.shownPtr();
  const Preview preview = session_.preview();
  const bool carried = !preview.carried.empty();
  const std::uint64_t now = session_.changes().garment;
  if (garmentShown_ == now && !carried && (!fine_ || soft_)) return;
  Mapped own = mapped(fitting);
  SceneFrame& frame = own.frame;
  if (session_.busy().past && map_ == FitMap::None) dim(frame);
  Mapped then;
  if (beside()) then = mapped(beside_.fitting);
  if (!fitting->underWay) pressure_.keepOnly({fitting, beside_.fitting});
  own.values.insert(own.values.end(), then.values.begin(), then.values.end());
  const double top = map_ == FitMap::None || fitting->underWay ? 0
                     : map_ == FitMap::Ease                    ? (fitting->body ? kEaseTop : 0)
                     : map_ == FitMap::Pressure                ? roundTop(std::move(own.values), kPressureLeast)
                                                               : std::max(strainTop(frame), strainTop(then.frame));
  mapTop_ = top;
  for (std::size_t k = 0; k < fitting->worn.size() && carried; ++k) {
    const auto at = preview.carried.find(fitting->worn[k].id);
    if (at == preview.carried.end()) continue;
    if (map_ != FitMap::Pressure)
      for (Vec3& p : frame.cloths[k].mesh.points) p = at->second(p);
  }
  if (session_.linesShown() && fitting->body && !fitting->underWay)
    for (const BodyLine& line : fitting->body->lines()) {
      SceneLine shown{line.points, {0.10f, 0.28f, 0.52f}, 1.6f, false};
      if (line.closed) shown.points.push_back(shown.points.front());
      frame.lines.push_back(std::move(shown));
    }
  for (const auto& [garment, part] : {std::pair(fitting, &frame), std::pair(beside_.fitting, &then.frame)})
    if (session_.viewCut().any() && garment) visibleOf(garment->body)->cut(*part, garment->underWay);
  const bool quick = !finest_ || (!fine_ && (carried || garmentShown_ != ~0ull));
  soft_ = !quick || !finest_;
  stale_ = true;
  const SoftLight light = !quick ? SoftLight::Anew : fitting->underWay ? SoftLight::Carried : SoftLight::Kept;
  renderer_->show(frame, top, light);
  if (beside()) {
    if (!beside_.renderer)
      if (auto made = Renderer::make(studioFor(software_, quickShare_.has_value())))
        beside_.renderer = std::move(*made);
    if (beside_.renderer) beside_.renderer->show(then.frame, top, light);
  }
  levelShown_ = level_ && !fitting->underWay ? girthsAt(*fitting, *level_) : std::vector<Girths>();
  seamThreads_ = carried ? std::vector<SceneLine>{} : threadsOf(*fitting);
  garmentShown_ = carried ? ~1ull : now;
}

void SpaceView::showOverlay() {
  const Preview preview = session_.preview();
  const SnapshotPtr fitting = session_.shownPtr();
  std::vector<SceneLine> lines = preview.space.lines;
  lines.insert(lines.end(), seamThreads_.begin(), seamThreads_.end());
  for (std::size_t k = 0; k < fitting->worn.size(); ++k) {
    if (!session_.selection().pieces.contains(fitting->worn[k].id)) continue;
    if (preview.carried.contains(fitting->worn[k].id)) continue;
    const SceneCloth& cloth = fitting->frame.cloths[k];
    for (const auto& run : cloth.outlines) {
      SceneLine line{{}, {0.86f, 0.26f, 0.08f}, 2.4f, false};
      for (const std::uint32_t n : run) line.points.push_back(cloth.mesh.points[n]);
      lines.push_back(std::move(line));
    }
  }
  for (const EdgeRef& edge : session_.selection().edges()) {
    auto line = edgeInSpace(*fitting, edge);
    if (line.size() > 1) lines.push_back({std::move(line), {0.05f, 0.25f, 0.62f}, 4, false});
  }
  for (const Girths& girths : levelShown_) {
    lines.push_back({girths.round, {0.85f, 0.60f, 0.02f}, 5, false});
    lines.push_back({girths.under, {0.05f, 0.25f, 0.62f}, 3, false});
  }
  if (!tapeShown_.line.empty()) lines.push_back({tapeShown_.line, {0.85f, 0.60f, 0.02f}, 5, false});
  overlaid_ = !lines.empty();
  renderer_->overlay(lines);
}

// The camera, with the screen at the depth that was asked for.
Camera SpaceView::lens() const {
  Camera camera = camera_;
  if (convergence_ != 1) camera.target = camera.eye + (camera.target - camera.eye) * convergence_;
  return camera;
}

void SpaceView::paintGL() {
  const QPalette& q = palette();
  if (!renderer_) {
    QPainter painter(this);
    painter.fillRect(rect(), q.window());
    if (trouble_)
      painter.drawText(rect().adjusted(40, 40, -40, -40), Qt::AlignCenter | Qt::TextWordWrap, inWords(trouble_->what));
    return;
  }
  showGarment();
  showOverlay();
  const double ratio = devicePixelRatioF();
  const int w = static_cast<int>(width() * ratio), h = static_cast<int>(height() * ratio);
  const bool two = beside() && beside_.renderer, stereo = !two && stereo_ != Stereo::Off;
  const int ew = w / halves().width(), eh = h / halves().height();
  const bool quick = (moving_ || quickShare_) && software_;
  const double share = fine_ && finest_ ? 2 : quick ? quickShare_.value_or(kQuickShare) : 1;
  const int sw = std::max(1, static_cast<int>(ew * share)), sh = std::max(1, static_cast<int>(eh * share));
  if (stale_) renderer_->light(camera_);
  if (stale_ && two) beside_.renderer->light(camera_);
  for (int k = 0; k < (stereo || two ? 2 : 1); ++k) {
    const double sideways = stereo ? (k == 0 ? -0.5 : 0.5) * separation_ : 0;
    const bool then = two && k == 0;  // at the left as it was, at the right as it is
    const Renderer& scene = then ? *beside_.renderer : *renderer_;
    // The scene is drawn anew only when something in it moved; words, lines and the bar over it every time.
    if (stale_) {
      compositor_->scene(k, sw, sh).bind();
      scene.draw(eyeOf(lens(), static_cast<double>(ew) / eh, sideways), {.x = 0, .y = 0, .width = sw, .height = sh},
                 Onto::Cleared, quick ? DrawQuality::Quick : DrawQuality::Fine);
    }
    compositor_->onScreen(k, ew, eh, overlaid_);
    scene.drawOver(eyeOf(lens(), static_cast<double>(ew) / eh, sideways), {.x = 0, .y = 0, .width = ew, .height = eh});
    readyForPainter();
    // Not the widget: a picture of the window must hold what is painted here too.
    QOpenGLPaintDevice device(ew, eh);
    device.setDevicePixelRatio(ratio);
    QPainter painter(&device);
    if (then)
      paintThen(painter, static_cast<int>(ew / ratio), static_cast<int>(eh / ratio));
    else
      paintOver(painter, sideways, static_cast<int>(ew / ratio), static_cast<int>(eh / ratio));
  }
  if (stale_ && moving_ && rest_.isActive()) rest_.start(kStillAfter);  // the time a picture took is no pause
  stale_ = false;
  compositor_->show(two ? Stereo::SideBySide : stereo ? stereo_ : Stereo::Off, defaultFramebufferObject(), w, h);
  if (quad_) quad_->show(eyes());
  latencyLog_.end("event to picture");
  emit painted();
}

std::array<unsigned, 2> SpaceView::eyes() const {
  return compositor_ ? compositor_->textures() : std::array<unsigned, 2>{};
}

QImage SpaceView::portrait(const SceneFrame& frame, QSize pixels) {
  if (!renderer_) return {};
  makeCurrent();
  if (!thumbnailRenderer_) thumbnailRenderer_ = std::make_unique<ThumbnailRenderer>();
  QImage image = thumbnailRenderer_->of(frame, pixels);
  doneCurrent();
  return image;
}

std::optional<QPointF> SpaceView::onScreen(Vec3 place) const {
  const QSize parts = halves();
  const double w = 1.0 * width() / parts.width(), h = 1.0 * height() / parts.height();
  const OnPicture on = project(eyeOf(camera_, aspect()), place, w, h);
  if (on.depth <= 0) return std::nullopt;
  return QPointF(on.x + (beside() ? w : 0), on.y);
}

}  // namespace karinui::studio
