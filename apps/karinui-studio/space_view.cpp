// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "space_view.h"

#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLPaintDevice>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/geometry/section.h"
#include "karinui/session/scene_of.h"
#include "karinui/view/strain_scale.h"
#include "look.h"
#include "orbit.h"
#include "view_eyes.h"

namespace karinui::studio {

namespace {

constexpr int kQuickSky = 6;       // directions of soft light while things move
constexpr double kEaseTop = 0.05;  // metres

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

// Threads between edges that are to be sewn but hang apart.
std::vector<SceneLine> threadsOf(const Fitting& fitting) {
  std::vector<SceneLine> lines;
  for (const auto& [id, seam] : fitting.document.pattern.seams) {
    const auto run = [&](const std::vector<EdgeSpan>& side) {
      std::vector<Vec3> points;
      for (const EdgeSpan& s : side) {
        const auto part = edgeInSpace(fitting, {PieceRef(s.piece), s.edge, s.from, s.to});
        points.insert(points.end(), part.begin(), part.end());
      }
      return points;
    };
    const auto a = run(seam.a);
    auto b = run(seam.b);
    if (a.size() < 2 || b.size() < 2) continue;
    if (seam.reversed) std::reverse(b.begin(), b.end());
    const int count = std::clamp(static_cast<int>(lineLength(a, false) / 0.025), 4, 40);
    for (int i = 0; i <= count; ++i) {
      const auto at = [&](const std::vector<Vec3>& line) {
        return line[static_cast<std::size_t>(i) * (line.size() - 1) / static_cast<std::size_t>(count)];
      };
      if (distance(at(a), at(b)) > 0.012) lines.push_back({{at(a), at(b)}, {0.75f, 0.40f, 0.12f}, 0.8f, false});
    }
  }
  return lines;
}

// The floating bar as a flat picture, so many pixels wide.
QImage boardPicture(const ScenePanel& panel, int pixels, QFont font) {
  const Palette& p = Look::here().palette();
  const double wide = length(panel.across), high = length(panel.upward), scale = pixels / wide;
  QImage image(pixels, std::max(1, static_cast<int>(high * scale)), QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  const double unit = panel.buttons.front().width * scale;
  QColor board = p.raised;
  board.setAlphaF(0.94f);
  painter.setPen(QPen(p.line, 1.2));
  painter.setBrush(board);
  painter.drawRoundedRect(QRectF(image.rect()).adjusted(1, 1, -1, -1), unit * 0.24, unit * 0.24);
  for (const ScenePanel::Button& b : panel.buttons) {
    const QRectF box(b.left * scale, (high - b.bottom - b.height) * scale, b.width * scale, b.height * scale);
    QColor ink = b.chosen ? p.accent : p.ink;
    if (!b.enabled) ink.setAlphaF(0.3f);
    if (b.chosen || (b.hot && b.enabled)) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(b.chosen ? p.accentSoft : p.window);
      painter.drawRoundedRect(box, unit * 0.17, unit * 0.17);
    }
    drawIcon(painter, b.icon, QRectF(box.center().x() - unit * 0.24, box.top() + unit * 0.13, unit * 0.48, unit * 0.48),
             ink);
    const QString caption = inWords(b.label);
    font.setPixelSize(std::max(1, static_cast<int>(unit * 0.2)));
    if (const double w = QFontMetricsF(font).horizontalAdvance(caption); w > unit * 0.96)
      font.setPixelSize(std::max(1, static_cast<int>(unit * 0.2 * 0.96 * unit / w)));
    painter.setFont(font);
    painter.setPen(ink);
    painter.drawText(QRectF(box.left(), box.bottom() - unit * 0.36, box.width(), unit * 0.3), Qt::AlignCenter, caption);
  }
  return image;
}

}  // namespace

SpaceView::SpaceView(Session& session, Clockwork& clockwork, QWidget* parent)
    : QOpenGLWidget(parent), session_(session), clockwork_(clockwork) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(320, 280);
  setAccessibleName("3D");
  camera_ = frameAll({}, View::Oblique, 1);
  rest_.setSingleShot(true);
  rest_.setInterval(140);
  connect(&rest_, &QTimer::timeout, this, [this] {
    fine_ = true;
    stale_ = true;
    update();
  });
  walk_.setDuration(260);
  walk_.setEasingCurve(QEasingCurve::InOutCubic);
  connect(&Look::here(), &Look::changed, this, [this] { update(); });
}

SpaceView::~SpaceView() { giveBack(); }

// What lives in graphics memory goes while its context is there.
void SpaceView::giveBack() {
  if (!renderer_) return;
  makeCurrent();
  renderer_.reset();
  compositor_.reset();
  doneCurrent();
}

double SpaceView::aspect() const {
  double w = width();
  double h = std::max(1, height());
  if (stereo_ == Stereo::SideBySide) w /= 2;
  if (stereo_ == Stereo::TopBottom) h /= 2;
  return std::max(0.1, w / h);
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
  Studio studio;
  if (software_) studio.keyMap = 1024, studio.skyDirections = 20, studio.skyMap = 384;
  auto made = Renderer::make(studio);
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

void SpaceView::resizeGL(int, int) { cameraMoved(); }

void SpaceView::cameraMoved() {
  session_.setSight(sightOf(camera_, aspect()));
  fine_ = false;
  stale_ = true;
  rest_.start();
  update();
}

void SpaceView::setCamera(const Camera& camera) {
  walk_.stop();
  camera_ = camera;
  cameraMoved();
}

void SpaceView::look(View view) {
  Camera to = frameAll(session_.shown().frame, view, aspect());
  framed_ = true;
  // Room for the bar at the foot of the picture.
  const double room = 1.13;
  to.eye = to.target + (to.eye - to.target) * room;
  const Vec3 down{0, -0.045 * to.distance() * std::tan(to.fieldOfView / 2) * 2, 0};
  to.eye += down, to.target += down;
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
    cameraMoved();
  } else {
    walk_.start();
  }
}

void SpaceView::setStereo(Stereo stereo) { stereo_ = stereo, cameraMoved(); }
void SpaceView::setEyes(double separationMm, double convergence) {
  separation_ = separationMm / 1000;
  convergence_ = convergence;
  cameraMoved();
}
void SpaceView::setMap(FitMap map) {
  map_ = map;
  garmentShown_ = ~0ull;
  refresh();
}
void SpaceView::setTape(bool on) {
  tape_ = on;
  tapeLine_.clear();
  refresh();
}

void SpaceView::refresh() {
  if (!framed_ && session_.fitting().body) look(View::Oblique);
  if (garmentShown_ != session_.news().garment || !session_.preview().carried.empty()) {
    stale_ = true;
    fine_ = false;
    rest_.start();
  }
  update();
}

void SpaceView::showGarment() {
  const FittingPtr fitting = session_.shownPtr();
  const Preview preview = session_.preview();
  const bool carried = !preview.carried.empty();
  const std::uint64_t now = session_.news().garment;
  if (garmentShown_ == now && !carried && (!fine_ || soft_)) return;
  SceneFrame frame = fitting->frame;
  double top = 0;
  if (map_ == FitMap::Strain) {
    top = strainTop(frame);
  } else if (map_ == FitMap::Ease && fitting->body) {
    top = kEaseTop;
    for (SceneCloth& cloth : frame.cloths) {
      cloth.strain = easeOf(cloth, *fitting->body);
      for (float& s : cloth.strain) s = std::max(0.0f, s);
    }
  }
  mapTop_ = top;
  for (std::size_t k = 0; k < fitting->worn.size() && carried; ++k) {
    const auto at = preview.carried.find(fitting->worn[k].id);
    if (at == preview.carried.end()) continue;
    for (Vec3& p : frame.cloths[k].mesh.points) p = at->second(p);
  }
  const bool quick = !fine_ && (carried || garmentShown_ != ~0ull);
  soft_ = !quick;
  stale_ = true;
  renderer_->show(frame, top, quick ? kQuickSky : -1);
  seamThreads_ = carried ? std::vector<SceneLine>{} : threadsOf(*fitting);
  garmentShown_ = carried ? ~1ull : now;
}

void SpaceView::showOverlay() {
  const Preview preview = session_.preview();
  const FittingPtr fitting = session_.shownPtr();
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
  if (session_.selection().edge) {
    const EdgeNear& e = *session_.selection().edge;
    auto line = edgeInSpace(*fitting, {PieceRef(e.piece), e.edge});
    if (line.size() > 1) lines.push_back({std::move(line), {0.05f, 0.25f, 0.62f}, 4, false});
  }
  if (tapeLine_.size() > 1) lines.push_back({tapeLine_, {0.85f, 0.60f, 0.02f}, 5, false});
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
  const bool stereo = stereo_ != Stereo::Off, side = stereo_ == Stereo::SideBySide, top = stereo_ == Stereo::TopBottom;
  const int ew = side ? w / 2 : w, eh = top ? h / 2 : h, finer = fine_ ? 2 : 1;
  if (stale_) renderer_->light(camera_);
  for (int k = 0; k < (stereo ? 2 : 1); ++k) {
    const double sideways = stereo ? (k == 0 ? -0.5 : 0.5) * separation_ : 0;
    // The scene is drawn anew only when something in it moved; words, lines and the bar over it every time.
    if (stale_) {
      compositor_->scene(k, ew * finer, eh * finer).bind();
      renderer_->draw(eyeOf(lens(), static_cast<double>(ew) / eh, sideways),
                      {.x = 0, .y = 0, .width = ew * finer, .height = eh * finer});
    }
    compositor_->onScreen(k, ew, eh);
    renderer_->drawOver(eyeOf(lens(), static_cast<double>(ew) / eh, sideways),
                        {.x = 0, .y = 0, .width = ew, .height = eh});
    readyForPainter();
    // Not the widget: a picture of the window must hold what is painted here too.
    QOpenGLPaintDevice device(ew, eh);
    device.setDevicePixelRatio(ratio);
    QPainter painter(&device);
    paintOver(painter, sideways, static_cast<int>(ew / ratio), static_cast<int>(eh / ratio));
  }
  stale_ = false;
  compositor_->show(stereo_, defaultFramebufferObject(), w, h);
  clockwork_.end("event to picture");
  emit painted();
}

// Words, dots and the floating bar, as this eye sees them.
void SpaceView::paintOver(QPainter& painter, double sideways, int w, int h) {
  painter.setRenderHint(QPainter::Antialiasing);
  const Eye eye = eyeOf(lens(), static_cast<double>(w) / h, sideways);
  const Palette& p = Look::here().palette();
  const auto at = [&](Vec3 place) {
    const OnPicture on = project(eye, place, w, h);
    return QPointF(on.x, on.y);
  };
  const Preview preview = session_.preview();
  for (const Vec3 dot : preview.space.dots) {
    painter.setPen(QPen(Qt::white, 2));
    painter.setBrush(QColor("#d4552a"));
    painter.drawEllipse(at(dot), 5, 5);
  }
  QFont small = font();
  small.setPointSizeF(9.5);
  small.setWeight(QFont::DemiBold);
  painter.setFont(small);
  const auto label = [&](QPointF where, const QString& words) {
    QRectF box = painter.fontMetrics().boundingRect(words);
    box.moveCenter(where + QPointF(0, -22));
    box.adjust(-9, -4, 9, 4);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(40, 36, 32, 215));
    painter.drawRoundedRect(box, 8, 8);
    painter.setPen(Qt::white);
    painter.drawText(box, Qt::AlignCenter, words);
  };
  for (const SceneWord& word : preview.space.words) label(at(word.place), QString::fromStdString(word.text));
  if (tapeLine_.size() > 1) label(at(tapeLine_.front()), QString::fromStdString(fixed(tapeLength_ * 100, 1)) + " cm");

  const auto panel = session_.menu();
  if (!panel) return;
  // The board is drawn flat and hung in space by the projection of its corners.
  const QPolygonF seen({at(panel->corner + panel->upward), at(panel->corner + panel->across + panel->upward),
                        at(panel->corner + panel->across), at(panel->corner)});
  const double ratio = painter.device()->devicePixelRatioF();
  const int pixels = static_cast<int>(std::hypot(seen[1].x() - seen[0].x(), seen[1].y() - seen[0].y()) * ratio);
  const QImage board = boardPicture(*panel, std::clamp(pixels, 64, 4096), font());
  const QPolygonF flat(QRectF(board.rect()));
  QTransform hang;
  if (QTransform::quadToQuad(QPolygonF({flat[0], flat[1], flat[2], flat[3]}), seen, hang)) {
    painter.save();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setTransform(hang, true);
    painter.drawImage(0, 0, board);
    painter.restore();
  }

  if (mapTop_ > 0) {  // the scale of the map
    const double left = 22, top = 22, tall = std::min(190.0, h * 0.3);
    painter.setPen(Qt::NoPen);
    QColor back = p.raised;
    back.setAlphaF(0.9f);
    painter.setBrush(back);
    painter.drawRoundedRect(QRectF(left - 10, top - 10, 142, tall + 54), 10, 10);
    painter.setPen(p.ink);
    painter.drawText(QPointF(left, top + 10),
                     map_ == FitMap::Strain ? inWords(say("strain")) : inWords(say("distance to body")));
    QLinearGradient scale(0, top + 22 + tall, 0, top + 22);
    for (int i = 0; i <= 16; ++i) scale.setColorAt(i / 16.0, shown(strainColour(i / 16.0)));
    painter.setPen(Qt::NoPen);
    painter.setBrush(scale);
    painter.drawRoundedRect(QRectF(left, top + 22, 16, tall), 4, 4);
    painter.setPen(p.ink);
    for (int i = 0; i <= 5; ++i) {
      const double v = mapTop_ * i / 5;
      painter.drawText(QPointF(left + 24, top + 22 + tall * (1 - i / 5.0) + 4),
                       map_ == FitMap::Strain ? QString::fromStdString(fixed(100 * v, 1)) + " %"
                                              : QString::fromStdString(fixed(1000 * v, 0)) + " mm");
    }
  }
}

std::optional<QPointF> SpaceView::onScreen(Vec3 place) const {
  const OnPicture on = project(eyeOf(camera_, aspect()), place, width(), height());
  if (on.depth <= 0) return std::nullopt;
  return QPointF(on.x, on.y);
}

PointerSample SpaceView::sampleAt(const QPointF& at, Qt::KeyboardModifiers keys, PointerSample::Phase phase) const {
  PointerSample sample;
  sample.phase = phase;
  sample.seconds = clockwork_.now() / 1000;
  double x = at.x(), y = at.y(), w = width(), h = height();
  if (stereo_ == Stereo::SideBySide) w /= 2, x = std::fmod(x, w);
  if (stereo_ == Stereo::TopBottom) h /= 2, y = std::fmod(y, h);
  sample.ray = rayAt(camera_, x, y, w, h);
  sample.facing = normalized(camera_.eye - camera_.target);
  sample.reach = 11 * camera_.fieldOfView / h;  // eleven pixels
  sample.shift = keys.testFlag(Qt::ShiftModifier);
  sample.control = keys.testFlag(Qt::ControlModifier);
  sample.alt = keys.testFlag(Qt::AltModifier);
  return sample;
}

void SpaceView::mousePressEvent(QMouseEvent* event) {
  last_ = event->position();
  walk_.stop();
  const bool alt = event->modifiers().testFlag(Qt::AltModifier);
  const Qt::MouseButton turn = blender_ ? Qt::MiddleButton : Qt::RightButton;
  if (event->button() == turn && !(blender_ && event->modifiers().testFlag(Qt::ShiftModifier))) {
    held_ = Held::Turn;
  } else if (event->button() == Qt::MiddleButton || (blender_ && event->button() == Qt::MiddleButton)) {
    held_ = Held::Pan;
  } else if (event->button() == Qt::LeftButton && alt && session_.tool() != Command::Move) {
    held_ = Held::Turn;
  } else if (event->button() == Qt::LeftButton) {
    held_ = Held::Tool;
    clockwork_.begin("event to picture");
    session_.feed(sampleAt(last_, event->modifiers(), PointerSample::Phase::Press));
    refresh();
  }
  setFocus();
}

void SpaceView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF step = event->position() - last_;
  last_ = event->position();
  if (tape_ && held_ == Held::Nothing) {
    const PointerSample sample = sampleAt(last_, event->modifiers(), PointerSample::Phase::Hover);
    const FittingPtr fitting = session_.shownPtr();
    const Hit hit = pick(*fitting, session_.table(), sample);
    tapeLine_.clear();
    if (hit.on != Hit::On::Nothing) {
      const Plane level{hit.point, {0, 1, 0}};
      // On cloth the tape goes round the garment, on skin round the body: the loop nearest to the hand.
      std::vector<Vec3> garment;
      double nearest = 1e9;
      const auto consider = [&](const TriangleMesh& mesh, bool gather) {
        for (const SectionLoop& loop : section(mesh, level)) {
          if (gather) {
            garment.insert(garment.end(), loop.points.begin(), loop.points.end());
            continue;
          }
          for (const Vec3 point : loop.points)
            if (const double d = distance(point, hit.point); d < nearest) nearest = d, tapeLine_ = loop.points;
        }
      };
      if (hit.on == Hit::On::Cloth) {
        for (const SceneCloth& cloth : fitting->frame.cloths) consider(cloth.mesh, true);
        if (garment.size() > 2) tapeLine_ = tightTape(garment, level.normal);
      } else if (fitting->body) {
        consider(fitting->body->mesh(), false);
        if (tapeLine_.size() > 2) tapeLine_ = tightTape(tapeLine_, level.normal);
      }
      if (!tapeLine_.empty()) {
        const auto best = std::min_element(tapeLine_.begin(), tapeLine_.end(), [&](Vec3 a, Vec3 b) {
          return distance(a, hit.point) < distance(b, hit.point);
        });
        std::rotate(tapeLine_.begin(), best, tapeLine_.end());
        tapeLength_ = lineLength(tapeLine_, true);
        tapeLine_.push_back(tapeLine_.front());
      }
    }
  }
  switch (held_) {
    case Held::Turn:
      camera_ = turned(camera_, step.x() * 0.0075, step.y() * 0.0075);
      return cameraMoved();
    case Held::Pan:
      camera_ = panned(camera_, step.x(), step.y(), height());
      return cameraMoved();
    default:
      break;
  }
  clockwork_.begin("event to picture");
  if (held_ == Held::Tool) clockwork_.begin("drag to preview");
  session_.feed(sampleAt(last_, event->modifiers(),
                         held_ == Held::Tool ? PointerSample::Phase::Drag : PointerSample::Phase::Hover));
  refresh();
}

void SpaceView::mouseReleaseEvent(QMouseEvent* event) {
  if (held_ == Held::Tool && event->button() == Qt::LeftButton) {
    clockwork_.forget("drag to preview");
    session_.feed(sampleAt(event->position(), event->modifiers(), PointerSample::Phase::Release));
    refresh();
  }
  held_ = Held::Nothing;
}

void SpaceView::wheelEvent(QWheelEvent* event) {
  if (!event->pixelDelta().isNull() && event->modifiers().testFlag(Qt::ShiftModifier)) {  // two fingers on a trackpad
    camera_ = panned(camera_, event->pixelDelta().x(), event->pixelDelta().y(), height());
    return cameraMoved();
  }
  const double turns = event->angleDelta().y() / 120.0;
  camera_ = zoomed(camera_, std::pow(0.88, turns),
                   rayAt(camera_, event->position().x(), event->position().y(), width(), height()));
  cameraMoved();
}

void SpaceView::leaveEvent(QEvent*) {
  tapeLine_.clear();
  refresh();
}

}  // namespace karinui::studio
