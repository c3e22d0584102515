#include "studio/window.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QLineEdit>
#include <QSettings>
#include <QSlider>
#include <QStyleOptionSlider>
#include <csignal>
#include <cstdlib>

#include "drafts.h"
#include "karinui/base/file.h"
#include "karinui/design/script.h"

namespace karinui::studio {

namespace {

pid_t display = 0;

void endDisplay() {
  if (display > 0) kill(display, SIGTERM), waitpid(display, nullptr, 0);
}

std::string startDisplay() {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe for a display";
  display = fork();
  if (display == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(ends[0]);
    const int quiet = ::open("/dev/null", O_WRONLY);
    dup2(quiet, 1), dup2(quiet, 2);
    const std::string number = std::to_string(ends[1]);
    const char* size = std::getenv("KARINUI_SCREEN");
    const std::string screen = std::string(size ? size : "1600x1000") + "x24";
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", screen.c_str(), "-nolisten", "tcp", nullptr);
    _exit(127);
  }
  close(ends[1]);
  std::string said;
  for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) said += c;
  close(ends[0]);
  if (said.empty()) {
    waitpid(display, nullptr, 0);
    display = 0;
    return "no display and no Xvfb to make one (Debian package xvfb)";
  }
  setenv("DISPLAY", (":" + said).c_str(), 1);
  std::atexit(endDisplay);
  return {};
}

}  // namespace

std::string displayTrouble() {
  static const std::string trouble = startDisplay();  // never the person's own screen
  return trouble;
}

QApplication& application() {
  static int argc = 1;
  static char name[] = "karinui-studio-test";
  static char* argv[] = {name, nullptr};
  static QApplication* app = [] {
    static Folder home;  // settings and documents of the tests' own
    setenv("HOME", home.path.c_str(), 1);
    setenv("XDG_CONFIG_HOME", home.path.c_str(), 1);
    setenv("XDG_RUNTIME_DIR", home.path.c_str(), 1);
    fs::permissions(home.path, fs::perms::owner_all);
    unsetenv("WAYLAND_DISPLAY");
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24);
    format.setStencilBufferSize(8);
    QSurfaceFormat::setDefaultFormat(format);
    auto* made = new QApplication(argc, argv);
    QApplication::setOrganizationName("karinui-tests");
    Theme::here().apply(*made);
    QSettings().setValue("fine", std::getenv("KARINUI_PICTURES") != nullptr);  // quicker, and only pictures need it
    return made;
  }();
  return *app;
}

QPointF knobOf(const QSlider& slider) {
  QStyleOptionSlider option;
  option.initFrom(&slider);
  option.orientation = Qt::Horizontal;
  option.minimum = slider.minimum(), option.maximum = slider.maximum();
  option.sliderPosition = option.sliderValue = slider.value();
  return slider.style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, &slider).center();
}

// Figures and the space around them are built once for all windows of this program.
SessionOptions options() {
  SessionOptions options;
  static const auto figures = std::make_shared<Bodies>();
  options.bodies = figures;
  options.drafts = draftsFolder();
  return options;
}

Window::Window(Pictures pictures) {
  application();
  Theme::here().setLanguage(Language::English);
  main_ = std::make_unique<MainWindow>(options());
  main_->resize(std::getenv("KARINUI_PICTURES") ? QSize(1400, 860) : QSize(860, 540));
  if (!std::getenv("KARINUI_PICTURES") && pictures == Pictures::Rough) space().setQuick(0.2);
  main_->show();
  QApplication::processEvents();
}

void Window::openTunic() {
  static Folder kept;
  const fs::path made = kept.path / "tunic.karinui";
  if (!fs::exists(made)) {
    Session maker(options());
    maker.create(made);
    const std::string script =
        std::string("body size=jis9ar\nset spacing=30mm ease=12mm\n") +
        "draw name=front symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
        "line=\"torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; "
        "landmark:shoulder_left; torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; "
        "torso:waist@0.25; torso:hip@0.25; torso:hip@0\"\n"
        "draw name=back symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
        "line=\"torso:neck_base@0.5; torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; "
        "landmark:shoulder_left; torso:armpit+0.5@0.34; torso:armpit@0.31; torso:armpit-0.3@0.25; "
        "torso:waist@0.25; torso:hip@0.25; torso:hip@0.5\"\n"
        "sew a=front.shoulder_left b=back.shoulder_left\nsew a=front.shoulder_right b=back.shoulder_right\n"
        "sew a=front.side_left b=back.side_left\nsew a=front.side_right b=back.side_right\ndrape\n";
    const auto lines = parseScript(script);
    for (const ScriptLine& line : *lines) maker.perform(line.operation), maker.finish();
    ASSERT_EQ(maker.snapshot().document.pattern.seams.size(), 4u);
    ASSERT_TRUE(maker.snapshot().document.drape.last) << "draped";
  }
  const fs::path mine = folder_.path / "tunic.karinui";
  fs::copy_file(made, mine);
  open(mine);
  view(View::Front);
}

void Window::openExample(const std::string& name) {
  const fs::path mine = folder_.path / (name + ".karinui");
  {
    Session maker(options());
    maker.create(mine);
    const auto lines = parseScript(*readFile(KARINUI_SOURCE_DIR "/examples/" + name + ".ops"));
    ASSERT_TRUE(lines);
    for (const ScriptLine& line : *lines) maker.perform(line.operation), maker.finish();
  }
  open(mine);
  view(View::Front);
}

QPointF Window::inSpace(const char* piece, Flat paper) {
  const Piece* p = session().snapshot().document.pieceNamed(piece);
  EXPECT_TRUE(p) << piece;
  return space().onScreen(*spaceOf(session().snapshot(), p->id, paper)).value_or(QPointF());
}
QPointF Window::onTable(const char* piece, Flat paper) {
  const Piece* p = session().snapshot().document.pieceNamed(piece);
  EXPECT_TRUE(p) << piece;
  return table().onScreen(paper + session().table().at(p->id));
}
QPointF Window::onSkin(const char* place) {
  const Body& body = *session().snapshot().body;
  const auto point = parseBodyPoint(place);
  EXPECT_TRUE(point) << place;
  const auto there = body.find(*point);
  EXPECT_TRUE(there) << place;
  return space().onScreen(at(body.mesh(), *there)).value_or(QPointF());
}

void Window::drag(QWidget& widget, std::vector<QPointF> path, Qt::KeyboardModifiers keys, std::function<void()> before,
                  Qt::MouseButton button, bool release) {
  const auto send = [&](QEvent::Type type, QPointF at, Qt::MouseButtons held) {
    QMouseEvent event(type, at, widget.mapToGlobal(at), type == QEvent::MouseMove ? Qt::NoButton : button, held, keys);
    QApplication::sendEvent(&widget, &event);
  };
  send(QEvent::MouseMove, path.front(), Qt::NoButton);
  send(QEvent::MouseButtonPress, path.front(), button);
  for (std::size_t i = 1; i < path.size(); ++i) {
    constexpr int kSteps = 5;
    for (int k = 1; k <= kSteps; ++k)
      send(QEvent::MouseMove, path[i - 1] + (path[i] - path[i - 1]) * k / kSteps, button);
    QApplication::processEvents();  // painted once a segment: where the processor draws, a picture costs more than a
                                    // move
  }
  if (before) before();
  if (release) send(QEvent::MouseButtonRelease, path.back(), Qt::NoButton);
  QApplication::processEvents();
}

void Window::hover(QWidget& widget, QPointF at) {
  QMouseEvent event(QEvent::MouseMove, at, widget.mapToGlobal(at), Qt::NoButton, Qt::NoButton, {});
  QApplication::sendEvent(&widget, &event);
  QApplication::processEvents();
}

void Window::type(QWidget& widget, int key, Qt::KeyboardModifiers keys) {
  QKeyEvent down(QEvent::KeyPress, key, keys), up(QEvent::KeyRelease, key, keys);
  QApplication::sendEvent(&widget, &down);
  QApplication::sendEvent(&widget, &up);
  QApplication::processEvents();
}

LengthBox& Window::box(const char* name) {
  for (LengthBox* one : main_->findChildren<LengthBox*>())
    if (one->accessibleName() == name) return *one;
  ADD_FAILURE() << "no box is called " << name;
  std::abort();
}
void Window::type(LengthBox& box, const QString& text) {
  QLineEdit* line = box.findChild<QLineEdit*>();
  line->selectAll();
  line->insert(text);
  type(box, Qt::Key_Return);
}
QPushButton& Window::button(const char* words) {
  for (QPushButton* one : main_->findChildren<QPushButton*>())
    if (one->text() == words) return *one;
  ADD_FAILURE() << "no button says " << words;
  std::abort();
}

std::string Window::last() const {
  const auto& steps = main_->session().steps();
  return steps.empty() ? std::string() : text(steps.back().operation);
}

void Window::keepDialog(QWidget& dialog, const std::string& name) {
  const char* folder = std::getenv("KARINUI_PICTURES");
  if (!folder) return;
  dialog.show();
  QApplication::processEvents();
  EXPECT_TRUE(dialog.grab().save(QString::fromStdString((fs::path(folder) / (name + ".png")).string())));
}

void Window::keep(const std::string& name) {
  const char* folder = std::getenv("KARINUI_PICTURES");
  if (!folder) return;
  rest();
  fs::create_directories(folder);
  EXPECT_TRUE(main_->grab()
                  .scaledToWidth(1000, Qt::SmoothTransformation)
                  .save(QString::fromStdString((fs::path(folder) / (name + ".png")).string())));
}

}  // namespace karinui::studio
