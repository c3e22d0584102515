// karinui-room [FILE]: the fitting in a headset. See printHelp() for its words.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <vector>

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
  bool wantsHelp = false;
};

// The language first: what is wrong with the rest is said in it.
Language languageOf(std::span<const std::string> words) {
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "--language" && (words[i + 1] == "en" || words[i + 1] == "ja"))
      return words[i + 1] == "ja" ? Language::Japanese : Language::English;
  return spokenHere();
}

Result<PoseScript> scriptFrom(const std::string& file) {
  const auto bytes = readFile(file, std::size_t{64} << 20);
  if (!bytes) return inFile(file, bytes.error());
  auto script = parsePoseScript(*bytes);
  if (!script) return inFile(file, script.error());
  return script;
}

// Takes the option with its value; false: the value cannot be given to it.
Result<bool> takeOption(Call& call, const std::string& option, const std::string& value) {
  const auto oneOf = [&](const char* a, const char* b) { return value == a || value == b; };
  if (option == "--scale") {
    call.program.room.scale = value == "table" ? Scale::TableTop : Scale::One;
    return oneOf("one", "table");
  }
  if (option == "--language") return oneOf("en", "ja");
  if (option == "--share") {
    call.program.share = value == "window" ? ProgramOptions::Share::Window : ProgramOptions::Share::Windowless;
    return oneOf("window", "windowless");
  }
  if (option == "--threads") {
    call.threads = std::atoi(value.c_str());
    return call.threads >= 1 && call.threads <= 1024;
  }
  if (option == "--new") {
    call.size = value;
    const auto sizes = builtInSizes();
    return std::find(sizes.begin(), sizes.end(), value) != sizes.end();
  }
  if (option == "--headless-test") {
    std::error_code trouble;
    if (!value.empty()) std::filesystem::create_directories(value, trouble);
    call.program.headless = value;
    return !value.empty() && !trouble;
  }
  if (option == "--script") {
    auto script = scriptFrom(value);
    if (!script) return script.error();
    call.program.script = *std::move(script);
    return true;
  }
  return refused(say("karinui-room does not know “{0}”; try karinui-room --help.", option));
}

Result<Call> parse(std::span<const std::string> words) {
  Call call;
  call.program.room.language = languageOf(words);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--help" || word == "-h") {
      call.wantsHelp = true;
    } else if (word == "--left") {
      call.program.room.left = true;
    } else if (word == "--seated") {
      call.program.room.posture.seated = true;
    } else if (word == "--json") {
      call.program.json = true;
    } else if (word.starts_with("-")) {
      const std::string value = i + 1 < words.size() ? words[++i] : "";
      const auto taken = takeOption(call, word, value);
      if (!taken) return taken.error();
      if (!*taken) return refused(say("“{0}” cannot be given to {1}; try karinui-room --help.", value, word));
    } else {
      call.file = word;
    }
  }
  if (call.program.headless && !call.program.script)  // a look round: hands that point at the fitting, and one picture
    call.program.script =
        *parsePoseScript("0 right 0.2 1.2 -0.2 1 0 0 0\n0 left -0.2 1.2 -0.2 1 0 0 0\n30 picture look\n36 end\n");
  return call;
}

// The document of the call, or a new garment in it or in a draft.
Done openGarment(Session& session, const Call& call, bool there) {
  if (there && !call.size.empty())
    return refused(say("“{0}” is there already; leave out --new to open it.", call.file));
  if (there) {
    session.open(call.file);
  } else {
    if (!call.file.empty()) session.create(call.file);
    SetBody body;
    body.size = call.size.empty() ? std::string(kUsualSize) : call.size;
    session.perform(body);
  }
  session.finish();
  for (const Notice& notice : session.takeNotices())
    if (notice.kind == Notice::Kind::Refused) return refused(notice.what);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  keepFreedMemory();
  // The loader's own words are for engineers; ours say what to do. Whoever wants both sets it.
  ::setenv("XR_LOADER_DEBUG", "none", 0);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const Language language = languageOf(words);
  const auto refuse = [&](const Error& why) {
    std::fprintf(stderr, "%s\n", text(why.what, language).c_str());
    return kWrongCall;
  };
  Result<Call> parsed = parse(words);
  if (!parsed) return refuse(parsed.error());
  Call call = *std::move(parsed);
  if (call.wantsHelp) {
    printHelp(language);
    return 0;
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
  if (const Done opened = openGarment(session, call, there); !opened) return refuse(opened.error());
  const int code = RoomProgram(session, std::move(call.program)).run();
  // A draft that was begun for nothing, as where there is no headset, is not left behind.
  if (!there && session.draft() && session.steps().size() <= 1 && session.undone().empty() &&
      session.otherBranches().empty())
    std::filesystem::remove(session.path(), none);
  return code;
}
