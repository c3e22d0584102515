// karinui-room [FILE]: the fitting in a headset. See printHelp() for its words.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>

#include "documents_folder.h"
#include "karinui/base/file.h"
#include "karinui/base/memory.h"
#include "karinui/base/threads.h"
#include "karinui/body/sizes.h"
#include "karinui/design/values.h"
#include "room_program.h"

using namespace karinui;
using namespace karinui::room;

namespace {

void printHelp(Language language) {
  const struct {
    const char* words;
    Message what;
  } lines[] = {
      {"karinui-room [FILE]", say("fits a garment in a headset (OpenXR). FILE is a .karinui document; without one, a "
                                  "draft begins.")},
      {"  --new SIZE", say("begins a garment on a built-in size, in FILE or as a draft")},
      {"  --scale one|table", say("life size, or on a desk")},
      {"  --left", say("the left hand holds the tool")},
      {"  --seated", say("the floor is lowered for someone who sits")},
      {"  --language en|ja", say("the language of all words")},
      {"  --threads N", say("threads for drapes")},
      {"  --headless-test DIR", say("runs without a person and a window; leaves eye pictures and report.json in DIR")},
      {"  --script FILE", say("plays recorded poses instead of a person's")},
      {"  --share window|windowless", say("how pictures are shared with the headset's runtime: GLX or EGL")},
      {"  --json", say("prints at the end how long things took, and what was made")},
      {"", say("Ends with 0; 2 a wrong call, 3 no headset runtime, 4 no headset, 5 no OpenGL, 6 the runtime "
               "refuses.")}};
  for (const auto& line : lines) std::printf("%-27s %s\n", line.words, text(line.what, language).c_str());
}

struct Call {
  ProgramOptions program;
  std::string file, size;
  int threads = 0;
};

}  // namespace

int main(int argc, char** argv) {
  keepFreedMemory();
  // The loader's own words are for engineers; ours say what to do. Whoever wants both sets it.
  ::setenv("XR_LOADER_DEBUG", "none", 0);
  Call call;
  call.program.room.language = spokenHere();
  const auto refuse = [&](const Message& why) {
    std::fprintf(stderr, "%s\n", text(why, call.program.room.language).c_str());
    return kWrongCall;
  };
  bool wantsHelp = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string { return i + 1 < argc ? argv[++i] : ""; };
    const auto oneOf = [&](const std::string& said, const char* a, const char* b) { return said == a || said == b; };
    const auto wrong = [&](const std::string& said) {
      return refuse(say("“{0}” cannot be given to {1}; try karinui-room --help.", said, word));
    };
    if (word == "--help" || word == "-h") {
      wantsHelp = true;
    } else if (word == "--left") {
      call.program.room.left = true;
    } else if (word == "--seated") {
      call.program.room.posture.seated = true;
    } else if (word == "--json") {
      call.program.json = true;
    } else if (word == "--scale") {
      const std::string said = value();
      if (!oneOf(said, "one", "table")) return wrong(said);
      call.program.room.scale = said == "table" ? Scale::TableTop : Scale::One;
    } else if (word == "--language") {
      const std::string said = value();
      if (!oneOf(said, "en", "ja")) return wrong(said);
      call.program.room.language = said == "ja" ? Language::Japanese : Language::English;
    } else if (word == "--share") {
      const std::string said = value();
      if (!oneOf(said, "window", "windowless")) return wrong(said);
      call.program.share = said == "window" ? ProgramOptions::Share::Window : ProgramOptions::Share::Windowless;
    } else if (word == "--threads") {
      const std::string said = value();
      call.threads = std::atoi(said.c_str());
      if (call.threads < 1 || call.threads > 1024) return wrong(said);
    } else if (word == "--new") {
      call.size = value();
      const auto sizes = builtInSizes();
      if (std::find(sizes.begin(), sizes.end(), call.size) == sizes.end()) return wrong(call.size);
    } else if (word == "--headless-test") {
      const std::string said = value();
      std::error_code trouble;
      if (said.empty()) return wrong(said);
      std::filesystem::create_directories(said, trouble);
      if (trouble) return wrong(said);
      call.program.headless = said;
    } else if (word == "--script") {
      const std::string said = value();
      const auto bytes = readFile(said, std::size_t{64} << 20);
      if (!bytes) return refuse(inFile(said, bytes.error()).what);
      auto script = parsePoseScript(*bytes);
      if (!script) return refuse(inFile(said, script.error()).what);
      call.program.script = std::move(*script);
    } else if (word.starts_with("-")) {
      return refuse(say("karinui-room does not know “{0}”; try karinui-room --help.", word));
    } else {
      call.file = word;
    }
  }
  if (wantsHelp) {
    printHelp(call.program.room.language);
    return 0;
  }
  if (call.program.headless && !call.program.script) {
    // A look round: hands that point at the fitting, and one picture.
    auto look =
        parsePoseScript("0 right 0.2 1.2 -0.2 1 0 0 0\n0 left -0.2 1.2 -0.2 1 0 0 0\n30 picture look\n36 end\n");
    call.program.script = std::move(*look);
  }

  SessionOptions options;
  options.threads = call.threads > 0 ? call.threads : usualThreads();
  const std::filesystem::path documents = documentsFolder();
  if (!call.program.headless && !documents.empty()) {
    options.drafts = documents / "Drafts";
    call.program.room.documents = documents;
  }
  Session session(options);
  std::error_code none;
  const bool there = !call.file.empty() && std::filesystem::exists(call.file, none);
  if (there && !call.size.empty()) return refuse(say("“{0}” is there already; leave out --new to open it.", call.file));
  if (there) {
    session.open(call.file);
  } else {
    if (!call.file.empty()) session.create(call.file);
    SetBody body;
    body.size = call.size.empty() ? std::string(kUsualSize) : call.size;
    session.perform(body);
  }
  session.finish();
  bool refusedAny = false;
  for (const Notice& notice : session.takeNotices()) {
    if (notice.kind != Notice::Kind::Refused) continue;
    std::fprintf(stderr, "%s\n", text(notice.what, call.program.room.language).c_str());
    refusedAny = true;
  }
  if (refusedAny) return kWrongCall;
  const int code = RoomProgram(session, std::move(call.program)).run();
  // A draft that was begun for nothing, as where there is no headset, is not left behind.
  if (!there && session.draft() && session.steps().size() <= 1 && session.undone().empty() &&
      session.otherBranches().empty())
    std::filesystem::remove(session.path(), none);
  return code;
}
