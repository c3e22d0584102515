#include "self_check.h"

#include <QApplication>
#include <QEventLoop>
#include <QMouseEvent>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <cstdio>

#include "karinui/base/number.h"
#include "karinui/design/script.h"
#include "main_window.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// Two panels hung before and behind a figure, sewn at the sides and shoulders.
constexpr const char* kGarment = R"(body size=jis9ar
set spacing=15mm
draw name=front symmetric=yes edges="neck ~ shoulder armhole ~ ~ side ~ hem" line="torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0"
draw name=back symmetric=yes edges="neck ~ shoulder armhole ~ ~ side ~ hem" line="torso:neck_base@0.5; torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; landmark:shoulder_left; torso:armpit+0.5@0.34; torso:armpit@0.31; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0.5"
sew a=front.shoulder_left b=back.shoulder_left
sew a=front.shoulder_right b=back.shoulder_right
sew a=front.side_left b=back.side_left
sew a=front.side_right b=back.side_right
drape
)";

void mouse(QWidget& widget, QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons held) {
  QMouseEvent event(type, at, widget.mapToGlobal(at), type == QEvent::MouseMove ? Qt::NoButton : button, held,
                    Qt::NoModifier);
  QApplication::sendEvent(&widget, &event);
}

void drag(MainWindow& window, QPointF from, QPointF to, Qt::MouseButton button, int steps) {
  QWidget& view = window.space();
  const auto drawn = [&] {
    QEventLoop loop;
    const auto until = QObject::connect(&window.space(), &SpaceView::painted, &loop, &QEventLoop::quit);
    view.update();
    loop.exec();
    QObject::disconnect(until);
  };
  mouse(view, QEvent::MouseMove, from, button, Qt::NoButton);
  mouse(view, QEvent::MouseButtonPress, from, button, button);
  for (int i = 1; i <= steps; ++i) {
    window.latencyLog().begin("event to picture");
    mouse(view, QEvent::MouseMove, from + (to - from) * i / steps, button, button);
    drawn();
  }
  window.latencyLog().begin("release to first drape");
  window.latencyLog().begin("release to settled");
  mouse(view, QEvent::MouseButtonRelease, to, button, Qt::NoButton);
}

}  // namespace

std::optional<Message> drawingTrouble() {
  QOffscreenSurface surface;
  surface.create();
  QOpenGLContext context;
  if (!context.create() || !context.makeCurrent(&surface))
    return say("No OpenGL can be had on this display; Karinui needs 3.3. A graphics driver may be missing.");
  const QSurfaceFormat is = context.format();
  context.doneCurrent();
  if (is.majorVersion() * 10 + is.minorVersion() >= 33) return std::nullopt;
  return say("This machine offers OpenGL {0}; Karinui needs 3.3. A newer graphics driver may help.",
             written(is.majorVersion()) + "." + written(is.minorVersion()));
}

void comeToRest(MainWindow& window) {
  QEventLoop loop;
  const auto check = [&] {
    if (window.still()) loop.quit();
  };
  const auto a = QObject::connect(&window, &MainWindow::refreshed, &loop, check);
  const auto b = QObject::connect(&window.space(), &SpaceView::painted, &loop, check);
  window.space().update();
  if (!(window.atStart() && window.still())) loop.exec();
  QObject::disconnect(a);
  QObject::disconnect(b);
  QApplication::processEvents();
}

int selfCheck(QApplication&, MainWindow& window) {
  const auto lines = parseScript(kGarment);
  for (const ScriptLine& line : *lines) window.session().perform(line.operation), comeToRest(window);
  if (window.space().trouble()) return 1;
  LatencyLog& clock = window.latencyLog();
  const QSize size = window.space().size();
  const QPointF middle(size.width() / 2.0, size.height() / 2.0);
  drag(window, middle, middle + QPointF(120, 20), Qt::RightButton, 12);
  comeToRest(window);
  clock.forget("release to first drape"), clock.forget("release to settled");
  window.space().look(View::Front);
  comeToRest(window);

  const auto seen = [&](const char* piece, Flat paper) {
    const Piece* p = window.session().snapshot().document.pieceNamed(piece);
    return window.space().onScreen(*spaceOf(window.session().snapshot(), p->id, paper)).value_or(middle);
  };
  window.session().command(Command::Pull);
  const QPointF hem = seen("front", {0.02, 0.05});
  drag(window, hem, hem + QPointF(60, 10), Qt::LeftButton, 8);
  comeToRest(window);
  window.session().command(Command::Cut);
  drag(window, seen("front", {-0.03, 0.0}) + QPointF(0, 40), seen("front", {-0.03, 0.12}), Qt::LeftButton, 10);
  comeToRest(window);

  std::printf("%s\n", window.space().driver().toUtf8().constData());
  std::size_t vertices = 0;
  for (const SceneCloth& cloth : window.session().snapshot().frame.cloths) vertices += cloth.mesh.points.size();
  std::printf("%zu points of cloth, %zu steps\n", vertices, window.session().steps().size());
  for (const char* what : {"event to picture", "drag to preview", "release to first drape", "release to settled"})
    std::printf("%-24s median %8.1f ms   worst %8.1f ms   (%zu)\n", what, clock.quantile(what, 0.5),
                clock.quantile(what, 1), clock.count(what));
  return 0;
}

int keepPicture(QApplication&, MainWindow& window, const QString& path) {
  comeToRest(window);
  if (!window.said().isEmpty()) std::printf("%s\n", window.said().toUtf8().constData());
  return window.grab().save(path) ? 0 : 1;
}

}  // namespace karinui::studio
