// karinui-studio [FILE]            opens a document, a body or a pattern; without one, the start page
//   --new SIZE        begins a garment on a built-in size, in FILE or as a draft
//   --self-check      works FILE (a document or a script; without one a sample) by itself, prints how long things take,
//                     and ends
//   --picture FILE    opens, waits until all is at rest, keeps a picture of the window, and ends
//   --language en|ja  --dark  --threads N
#include <QApplication>
#include <QFileInfo>
#include <QLocale>
#include <QMessageBox>
#include <QSettings>
#include <QSurfaceFormat>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "drafts.h"
#include "karinui/base/memory.h"
#include "karinui/base/number.h"
#include "karinui/base/threads.h"
#include "karinui/exchange/formats.h"
#include "main_window.h"
#include "self_check.h"
#include "theme.h"

using namespace karinui;
using namespace karinui::studio;

namespace {

struct Wish {
  QString file, picture, fresh;
  bool selfCheck = false, dark = false, help = false;
  std::optional<Language> language;
  int threads = 0;
};

// Why there can be no window; Qt would only abort.
bool displayIsThere() {
  const char* platform = std::getenv("QT_QPA_PLATFORM");
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  // A display of this machine has a socket; one that is named but not there would make Qt abort.
  const std::string display = set("DISPLAY") ? std::getenv("DISPLAY") : "";
  if (display.starts_with(":") && !set("WAYLAND_DISPLAY") && !(platform && *platform)) {
    const std::string number = display.substr(1, display.find('.') - 1);
    std::error_code trouble;
    return std::filesystem::exists("/tmp/.X11-unix/X" + number, trouble);
  }
  return set("DISPLAY") || set("WAYLAND_DISPLAY") || (platform && *platform && std::strcmp(platform, "xcb") != 0);
}

}  // namespace

int main(int argc, char** argv) {
  keepFreedMemory();
  Wish wish;
  const Language spoken = spokenHere();
  const auto refuse = [&](const Message& why) {
    std::fprintf(stderr, "%s\n", text(why, wish.language.value_or(spoken)).c_str());
    return 2;
  };
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool more = i + 1 < argc;
    if (word == "--self-check")
      wish.selfCheck = true;
    else if (word == "--dark")
      wish.dark = true;
    else if (word == "--help" || word == "-h")
      wish.help = true;
    else if (word == "--picture" && more)
      wish.picture = QString::fromLocal8Bit(argv[++i]);
    else if (word == "--new" && more)
      wish.fresh = QString::fromLocal8Bit(argv[++i]);
    else if (word == "--threads" && more)
      wish.threads = std::atoi(argv[++i]);
    else if (word == "--language" && more)
      wish.language = std::string(argv[++i]) == "ja" ? Language::Japanese : Language::English;
    else if (word.starts_with("-"))
      return refuse(say("karinui-studio does not know “{0}”; try karinui-studio --help.", word));
    else
      wish.file = QString::fromLocal8Bit(argv[i]);
  }
  if (wish.help) {
    std::puts(text(say("karinui-studio [FILE] [--new SIZE] [--language en|ja] [--dark] [--threads N] [--self-check] "
                       "[--picture FILE]: "
                       "the window in which garments are designed. FILE is one of: {0}.",
                       listRead()),
                   wish.language.value_or(spoken))
                  .c_str());
    return 0;
  }
  if (!displayIsThere())
    return refuse(say("There is no display to open a window on; on a machine without one use the command karinui."));

  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  QSurfaceFormat::setDefaultFormat(format);
  QApplication app(argc, argv);
  QApplication::setOrganizationName("karinui");
  QApplication::setApplicationName("karinui-studio");
  QApplication::setDesktopFileName("karinui-studio");
  const QSettings settings;
  Theme& look = Theme::here();
  const QString kept = settings.value("language").toString();
  look.setLanguage(wish.language  ? *wish.language
                   : kept == "ja" ? Language::Japanese
                   : kept == "en" ? Language::English
                                  : spoken);
  look.setInches(settings.value("inches").toBool());
  look.setDark(wish.dark || settings.value("dark").toBool());
  look.apply(app);

  if (const auto why = drawingTrouble()) {
    if (!wish.selfCheck && wish.picture.isEmpty()) QMessageBox::critical(nullptr, "Karinui", inWords(*why));
    return refuse(*why);
  }
  const auto unreadable = look.language() == Language::Japanese ? japaneseTrouble() : std::nullopt;
  if (unreadable) look.setLanguage(Language::English);

  SessionOptions options;
  if (!wish.selfCheck) options.drafts = draftsFolder();
  options.threads = wish.threads > 0 ? wish.threads : usualThreads();
  if (wish.selfCheck) return selfCheck(app, options, wish.file);
  MainWindow window(options);
  window.show();
  if (unreadable) window.session().refuse(notFound(*unreadable));
  if (!wish.fresh.isEmpty())
    window.newGarment(wish.fresh.toLower().toStdString(), wish.file);
  else if (!wish.file.isEmpty())
    window.openPath(QFileInfo(wish.file).absoluteFilePath());
  else
    window.showStart();
  if (!wish.picture.isEmpty()) return keepPicture(app, window, wish.picture);
  return QApplication::exec();
}
