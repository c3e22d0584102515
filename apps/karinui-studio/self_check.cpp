#include "self_check.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QMouseEvent>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QTemporaryDir>
#include <cstdio>
#include <ctime>

#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "karinui/exchange/formats.h"
#include "main_window.h"
#include "orbit.h"
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

double processorSeconds() {  // of all threads
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// How often something was waited for, and how long.
class Waits {
 public:
  explicit Waits(const char* what) : what_(what) { again(); }
  void again() { clock_.start(), processor_ = processorSeconds(); }
  void take() {
    taken_.push_back({static_cast<double>(clock_.nsecsElapsed()) * 1e-6, (processorSeconds() - processor_) * 1e3});
    again();
  }
  void print() const {
    if (taken_.empty()) return void(std::printf("%-34s never\n", what_));
    const auto sorted = [&](double Wait::*of) {
      std::vector<double> all;
      for (const Wait& wait : taken_) all.push_back(wait.*of);
      std::sort(all.begin(), all.end());
      return all;
    };
    const std::vector<double> clock = sorted(&Wait::clock), processor = sorted(&Wait::processor);
    std::printf("%-34s median %8.0f ms   worst %8.0f ms   processor %8.0f ms   (%zu)\n", what_, clock[clock.size() / 2],
                clock.back(), processor[clock.size() / 2], taken_.size());
    std::fflush(stdout);
  }

 private:
  struct Wait {
    double clock, processor;  // milliseconds
  };
  const char* what_;
  QElapsedTimer clock_;
  double processor_ = 0;
  std::vector<Wait> taken_;
};

}  // namespace

void until(MainWindow& window, const std::function<bool()>& holds) {
  QEventLoop loop;
  const auto check = [&] {
    if (holds()) loop.quit();
  };
  const auto a = QObject::connect(&window, &MainWindow::refreshed, &loop, check);
  const auto b = QObject::connect(&window.space(), &SpaceView::painted, &loop, check);
  window.space().update();
  loop.exec();
  QObject::disconnect(a);
  QObject::disconnect(b);
}

namespace {

void untilPainted(MainWindow& window) {
  QEventLoop loop;
  const auto a = QObject::connect(&window.space(), &SpaceView::painted, &loop, &QEventLoop::quit);
  window.space().update();
  loop.exec();
  QObject::disconnect(a);
}

void mouse(QWidget& widget, QEvent::Type type, QPointF at, Qt::MouseButton button) {
  const bool move = type == QEvent::MouseMove;
  QMouseEvent event(type, at, widget.mapToGlobal(at), move ? Qt::NoButton : button, button, Qt::NoModifier);
  QApplication::sendEvent(&widget, &event);
}

// A drag that waits for the picture of every move, in which the cloth has followed if it is to.
void drag(MainWindow& window, QWidget& view, QPointF from, QPointF to, Qt::MouseButton button, int steps,
          const char* saidAs, bool follows) {
  Waits pictures(saidAs);
  mouse(view, QEvent::MouseButtonPress, from, button);
  const Session& session = window.session();
  for (int i = 1; i <= steps; ++i) {
    const std::uint64_t before = session.changes().predicted;
    pictures.again();
    mouse(view, QEvent::MouseMove, from + (to - from) * i / steps, button);
    if (follows) until(window, [&] { return session.changes().predicted != before || session.idle(); });
    untilPainted(window);
    pictures.take();
  }
  pictures.print();
}

std::unique_ptr<MainWindow> windowOf(const SessionOptions& options) {
  auto window = std::make_unique<MainWindow>(options);
  window->resize(1600, 1000);
  window->show();
  QApplication::processEvents();
  return window;
}

// Where cloth is seen low in the middle of the view.
struct OnCloth {
  QPointF at;
  PieceId piece;
};
std::optional<OnCloth> clothSeen(MainWindow& window) {
  const SpaceView& view = window.space();
  const double w = view.width(), h = view.height();
  for (double x = 0.4; x < 0.6; x += 0.03)
    for (double y = 0.95; y > 0; y -= 0.01) {
      PointerSample sample;
      sample.ray = rayAt(view.camera(), x * w, y * h, w, h);
      const Hit hit = pick(window.session().snapshot(), window.session().table(), sample);
      if (hit.on == Hit::On::Cloth) return OnCloth{{x * w, (y - 0.04) * h}, hit.piece};
    }
  return std::nullopt;
}

Done play(MainWindow& window, const std::filesystem::path& garment, const std::filesystem::path& path) {
  if (contentOf(garment) == FileContent::Document) {
    const auto bytes = readFile(garment);
    if (!bytes) return bytes.error();
    if (const Done done = writeFile(path, *bytes); !done) return done;
    window.session().open(path);
    comeToRest(window);
    return {};
  }
  Result<std::string> script = garment.empty() ? Result<std::string>(std::string(kGarment)) : readFile(garment);
  if (!script) return script.error();
  const auto lines = parseScript(*script);
  if (!lines) return lines.error();
  window.session().create(path);
  for (const ScriptLine& line : *lines) window.session().perform(line.operation), comeToRest(window);
  return {};
}

// From what is done until it is first seen, and until all is at rest.
void measure(MainWindow& window, const char* seenAs, const char* restAs, const std::function<void()>& act) {
  Waits seen(seenAs), rest(restAs);
  const SessionChanges before = window.session().changes();
  act();
  until(window, [&] {
    const SessionChanges& now = window.session().changes();
    return now.predicted != before.predicted || now.settled != before.settled || now.history != before.history;
  });
  seen.take();
  comeToRest(window);
  rest.take();
  seen.print(), rest.print();
}

// The garment follows the figure into a pose, seen on the way, and comes to rest there.
void pose(MainWindow& window, const char* name) {
  Waits seen("a pose: first seen on the way"), picture("a pose: a picture on the way"), there("a pose: in it"),
      rest("a pose: at rest");
  const SessionChanges before = window.session().changes();
  std::uint64_t shown = before.predicted, painted = before.predicted;
  QEventLoop loop;
  QElapsedTimer clock;
  clock.start();
  int pictures = 0;
  double way = 0;  // seconds
  const auto a = QObject::connect(&window, &MainWindow::refreshed, &loop, [&] {
    const SessionChanges& now = window.session().changes();
    shown = now.predicted;
    if (now.history != before.history) loop.quit();
  });
  const auto b = QObject::connect(&window.space(), &SpaceView::painted, &loop, [&] {
    if (painted == shown) return;
    if (painted == before.predicted) seen.take();
    picture.take();
    painted = shown;
    ++pictures;
    way = static_cast<double>(clock.nsecsElapsed()) * 1e-9;
  });
  PoseBody op;
  op.name = name;
  window.session().perform(op);
  loop.exec();
  QObject::disconnect(a);
  QObject::disconnect(b);
  there.take();
  comeToRest(window);
  rest.take();
  seen.print(), picture.print(), there.print(), rest.print();
  if (pictures > 0) std::printf("%-34s %.1f a second\n", "a pose: pictures", pictures / way);
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
  if (!(window.atStart() && window.still())) until(window, [&] { return window.still(); });
  QApplication::processEvents();
}

int selfCheck(QApplication&, const SessionOptions& options, const QString& garment) {
  const QTemporaryDir folder;
  const QString path = folder.filePath("check.karinui");
  {
    const auto window = windowOf(options);
    if (const Done done = play(*window, garment.toStdString(), path.toStdString()); !done) {
      std::fprintf(stderr, "%s\n", inWords(done.error().what).toUtf8().constData());
      return 1;
    }
    if (window->space().trouble()) return 1;
  }
  const auto opened = [&](const char* seenAs) {
    Waits seen(seenAs);
    auto window = windowOf(options);
    window->openPath(path);
    until(*window, [&] { return !window->session().shown().worn.empty(); });
    untilPainted(*window);
    seen.take();
    seen.print();
    comeToRest(*window);
    return window;
  };
  auto window = opened("opening, to the first picture");
  window->space().look(View::Front);
  comeToRest(*window);
  std::size_t points = 0;
  for (const SceneCloth& cloth : window->session().snapshot().frame.cloths) points += cloth.mesh.points.size();
  std::printf("%s, view %d x %d\n%zu points of cloth, %zu steps\n", window->space().driver().toUtf8().constData(),
              window->space().width(), window->space().height(), points, window->session().steps().size());

  const QPointF middle(window->space().width() / 2.0, window->space().height() / 2.0);
  drag(*window, window->space(), middle, middle + QPointF(120, 20), Qt::RightButton, 24, "turning: a picture", false);
  mouse(window->space(), QEvent::MouseButtonRelease, middle, Qt::RightButton);
  window->space().look(View::Front);
  comeToRest(*window);

  const auto cloth = clothSeen(*window);
  if (!cloth) return 1;
  window->session().command(Command::Pull);
  drag(*window, window->space(), cloth->at, cloth->at + QPointF(60, 10), Qt::LeftButton, 24,
       "a pull: the cloth follows", true);
  measure(*window, "a pull let go: first drape", "a pull let go: at rest",
          [&] { mouse(window->space(), QEvent::MouseButtonRelease, cloth->at + QPointF(60, 10), Qt::LeftButton); });

  window->session().command(Command::Points);
  const Outline& outline = window->session().snapshot().document.find(cloth->piece)->outline;
  Flat corner = outline.edges.front().curve.start;
  for (const Edge& edge : outline.edges)
    if (edge.curve.start.v < corner.v) corner = edge.curve.start;
  const Flat lies = corner + window->session().table().at(cloth->piece);
  const QPointF from = window->table().onScreen(lies), to = window->table().onScreen(lies + Flat{0.01, -0.02});
  drag(*window, window->table(), from, to, Qt::LeftButton, 24, "a point moved: the cloth follows", true);
  measure(*window, "a point let go: first drape", "a point let go: at rest",
          [&] { mouse(window->table(), QEvent::MouseButtonRelease, to, Qt::LeftButton); });

  SetFabric denim;
  denim.name = "denim";
  denim.pieces = {PieceRef(cloth->piece)};
  measure(*window, "a fabric changed: first drape", "a fabric changed: at rest",
          [&] { window->session().perform(denim); });

  pose(*window, "arms_down");
  const SetBody was = *window->session().figure();
  SetBody wider = was;
  std::erase_if(wider.set, [](const Stated& stated) { return stated.key == "bust_girth"; });
  const double bust = window->session().snapshot().body->measured().value.at("bust_girth");
  wider.set.push_back({"bust_girth", {bust + 0.02}});
  measure(*window, "a body typed: seen", "a body typed: at rest", [&] { window->session().applyFigure(wider); });
  measure(*window, "the former body typed: seen", "the former body typed: at rest",
          [&] { window->session().applyFigure(was); });
  if (!window->said().isEmpty()) std::printf("%s\n", window->said().toUtf8().constData());
  window.reset();
  (void)opened("opening again, to the first picture");
  return 0;
}

int keepPicture(QApplication&, MainWindow& window, const QString& path) {
  comeToRest(window);
  if (!window.said().isEmpty()) std::printf("%s\n", window.said().toUtf8().constData());
  return window.grab().save(path) ? 0 : 1;
}

}  // namespace karinui::studio
