// karinui serve, driven by another program over its pipes.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "apps/command.h"

namespace karinui::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
namespace fs = std::filesystem;

// The command as a child whose stdin and stdout are ours.
class Serving {
 public:
  Serving() {
    int to[2], from[2];
    if (::pipe2(to, O_CLOEXEC) != 0 || ::pipe2(from, O_CLOEXEC) != 0) std::abort();
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(to[0], STDIN_FILENO);
      ::dup2(from[1], STDOUT_FILENO);
      ::setenv("LC_ALL", "C", 1);
      ::execl(KARINUI_COMMAND, "karinui", "serve", nullptr);
      ::_exit(127);
    }
    ::close(to[0]);
    ::close(from[1]);
    to_ = ::fdopen(to[1], "w");
    from_ = ::fdopen(from[0], "r");
  }
  ~Serving() {
    if (to_) end();
    std::fclose(from_);
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

  void send(const std::string& line) {
    std::fputs((line + "\n").c_str(), to_);
    std::fflush(to_);
  }
  void send(const Json& request) { send(request.dump()); }
  // The next line; null where it ended.
  Json line() {
    char* bytes = nullptr;
    std::size_t room = 0;
    const ssize_t size = ::getline(&bytes, &room, from_);
    Json read = size > 0 ? Json::parse(std::string(bytes, static_cast<std::size_t>(size)), nullptr, false) : Json();
    std::free(bytes);
    return read;
  }
  // The answer to the request, past lines of progress, which are counted.
  Json ask(const Json& request) {
    send(request);
    return answer();
  }
  Json answer() {
    for (;;) {
      Json read = line();
      if (!read.contains("progress")) return read;
      ++progress;
    }
  }
  // Closes its input and waits; gives the exit status, or 128 where a signal ended it.
  int end() {
    std::fclose(to_);
    to_ = nullptr;
    while (!line().is_null()) {
    }
    int status = 0;
    ::waitpid(child_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }
  int progress = 0;

 private:
  pid_t child_;
  std::FILE *to_, *from_;
};

const char* const kPanel = "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; top L 0 500; centre L 0 0\"";

TEST(Serve, WorksOnADocument) {
  Folder folder;
  Serving serving;
  const std::string path = folder / "coat.karinui";
  Json said = serving.ask({{"id", 1}, {"do", "create"}, {"file", path}});
  EXPECT_EQ(said["id"], 1);
  EXPECT_EQ(said["operations"], 0);
  const Json empty = said["hash"];
  said = serving.ask({{"id", "second"}, {"do", "perform"}, {"operation", kPanel}});
  EXPECT_EQ(said["id"], "second");
  EXPECT_EQ(said["operations"], 1);
  const Json hash = said["hash"];
  EXPECT_NE(hash, empty);
  EXPECT_EQ(serving.ask({{"do", "undo"}})["hash"], empty);
  said = serving.ask({{"do", "redo"}});
  EXPECT_EQ(said["hash"], hash);
  EXPECT_EQ(said["undone"], 0);
  EXPECT_TRUE(said["id"].is_null());
  said = serving.ask({{"do", "info"}});
  EXPECT_EQ(said["pieces"][0]["name"], "front");
  EXPECT_THAT(serving.ask({{"do", "log"}})["log"].get<std::string>(), HasSubstr("piece name=front"));
  said = serving.ask({{"do", "export"}, {"file", folder / "coat.pdf"}, {"paper", "a4"}});
  EXPECT_EQ(said["bytes"], fs::file_size(folder / "coat.pdf")) << said;
  said = serving.ask({{"do", "picture"}, {"file", folder / "coat.png"}, {"table", true}, {"size", "200x150"}});
  EXPECT_EQ(said["width"], 200) << said;
  EXPECT_EQ(contents(folder / "coat.png").substr(1, 3), "PNG");
  EXPECT_TRUE(serving.ask({{"do", "check"}})["finite"].get<bool>());
  EXPECT_EQ(serving.ask({{"do", "truing"}})["faults"], 0);
  EXPECT_TRUE(serving.ask({{"do", "close"}})["closed"].get<bool>());
  said = serving.ask({{"do", "open"}, {"file", path}, {"reading", true}});
  EXPECT_EQ(said["hash"], hash) << said;
  EXPECT_THAT(serving.ask({{"do", "undo"}})["error"].get<std::string>(), HasSubstr("reading only"));
  EXPECT_EQ(serving.end(), 0);
}

// Seated, the level of the hip goes through the thighs, and no leg hangs below the crotch.
TEST(Serve, MeasuresAFigureInItsOwnPose) {
  Serving serving;
  serving.ask({{"do", "create"}});
  ASSERT_EQ(serving.ask({{"do", "perform"}, {"operation", "body size=eu38"}})["operations"], 1);
  const Json standing = serving.ask({{"do", "measure"}})["measurements"];
  EXPECT_NEAR(standing["hip_girth"].get<double>(), 0.97, 0.003);
  EXPECT_NEAR(standing["waist_girth"].get<double>(), 0.72, 0.003);
  ASSERT_EQ(serving.ask({{"do", "perform"}, {"operation", "pose name=seated"}})["operations"], 2);
  EXPECT_EQ(serving.ask({{"do", "measure"}})["measurements"], standing);
  EXPECT_EQ(serving.end(), 0);
}

TEST(Serve, SaysWhatIsWrongInASentenceAndGoesOn) {
  Serving serving;
  const auto refusal = [&](const Json& said) { return said.value("error", std::string("none: ") + said.dump()); };
  for (const char* line : {"knit", "[1, 2]", "{\"do\": ", "7", "{\"id\": 1, \"do\": \"create\"} x"}) {
    serving.send(std::string(line));
    EXPECT_THAT(refusal(serving.answer()), HasSubstr("one JSON object")) << line;
  }
  serving.send(std::string(100'000, '['));
  EXPECT_THAT(refusal(serving.answer()), HasSubstr("one JSON object"));
  // Deep enough for a stack to run out where such a value is copied.
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  for (const std::string& line : {"{\"id\": " + deep + ", \"do\": \"create\"}", "{\"do\": " + deep + "}", deep}) {
    serving.send(line);
    EXPECT_THAT(refusal(serving.answer()), HasSubstr("more than 64 levels"));
  }
  serving.send("{\"do\": \"create\", \"file\": \"" + std::string(17 << 20, 'x') + "\"}");
  EXPECT_THAT(refusal(serving.answer()), HasSubstr("one JSON object"));
  EXPECT_THAT(refusal(serving.ask({{"id", 4}})), HasSubstr("needs “do”"));
  EXPECT_THAT(refusal(serving.ask({{"do", 4}})), HasSubstr("must be text"));
  EXPECT_THAT(refusal(serving.ask({{"do", "knit"}})), HasSubstr("no request “knit”; there are: open"));
  EXPECT_THAT(refusal(serving.ask({{"do", "settle"}})), HasSubstr("No document is open"));
  EXPECT_THAT(refusal(serving.ask({{"do", "open"}, {"file", "/nowhere/x.karinui"}})), HasSubstr("There is no file"));
  EXPECT_EQ(serving.ask({{"do", "open"}, {"file", "/nowhere/x.karinui"}})["kind"], "not_found");
  EXPECT_EQ(serving.ask({{"do", "stop"}})["stopping"], false);
  EXPECT_EQ(serving.ask({{"do", "create"}})["operations"], 0) << "kept in memory";
  EXPECT_THAT(refusal(serving.ask({{"do", "perform"}, {"operation", "knit piece=front"}})), HasSubstr("knit"));
  EXPECT_THAT(refusal(serving.ask({{"do", "perform"}, {"operations", kPanel}})), HasSubstr("needs “operation”"));
  EXPECT_THAT(refusal(serving.ask({{"do", "undo"}, {"steps", 2}})), HasSubstr("no field “steps”"));
  EXPECT_THAT(refusal(serving.ask({{"do", "measure"}})), HasSubstr("body"));
  ASSERT_EQ(serving.ask({{"do", "perform"}, {"operation", kPanel}})["operations"], 1);
  for (const char* gone : {"open", "create"})  // what is open, and kept nowhere else, stays
    EXPECT_EQ(serving.ask({{"do", gone}, {"file", "/nowhere/x.karinui"}}).contains("error"), true);
  EXPECT_EQ(serving.ask({{"do", "info"}})["pieces"].size(), 1u);
  EXPECT_THAT(refusal(serving.ask({{"do", "export"}, {"file", "/nowhere/coat.pdf"}})), HasSubstr("cannot be written"));
  EXPECT_THAT(refusal(serving.ask({{"do", "export"}, {"file", "x.pdf"}, {"allowance_mm", 900}})),
              HasSubstr("0 to 100"));
  EXPECT_THAT(refusal(serving.ask({{"do", "export"}, {"file", "x.obj"}, {"poses", "T"}})), HasSubstr("--poses"));
  EXPECT_THAT(refusal(serving.ask({{"do", "picture"}, {"file", "x.png"}, {"view", "inside"}})), HasSubstr("inside"));
  EXPECT_EQ(serving.end(), 0);
}

TEST(Serve, TellsProgressAndStopsWhereTheClothIs) {
  Serving serving;
  ASSERT_EQ(serving.ask({{"do", "create"}})["operations"], 0);
  for (const char* operation :
       {"body size=jis9ar", "set spacing=4mm",
        "piece name=cloth outline=\"M 0 0; low L 900 0; right L 900 900; top L 0 900; left L 0 0\" pose=0,0.5,0.6",
        "pin piece=cloth at=\"0,90cm; 90cm,90cm\""})
    ASSERT_FALSE(serving.ask({{"do", "perform"}, {"operation", operation}}).contains("error")) << operation;
  serving.send(Json{{"id", 7}, {"do", "settle"}});
  Json said = serving.line();
  ASSERT_TRUE(said.contains("progress")) << said;
  EXPECT_EQ(said["id"], 7);
  EXPECT_FALSE(said["doing"].get<std::string>().empty());
  serving.send(Json{{"id", 8}, {"do", "stop"}});
  Json stop, settle;  // answered in either order
  while (stop.is_null() || settle.is_null()) {
    said = serving.answer();
    ASSERT_FALSE(said.is_null());
    (said["id"] == 8 ? stop : settle) = said;
  }
  EXPECT_EQ(stop["stopping"], true);
  // Stopped before its first step there is an error, later a drape that is not at rest.
  EXPECT_TRUE(settle.value("kind", "") == "stopped" || settle.value("settled", true) == false) << settle;
  EXPECT_EQ(serving.ask({{"do", "info"}})["pieces"][0]["name"], "cloth");
  // One that comes while its request still waits is no less meant.
  const Json waits{{"id", 9}, {"do", "settle"}, {"again", true}}, ends{{"id", 10}, {"do", "stop"}};
  serving.send(waits.dump() + "\n" + ends.dump());
  stop = settle = Json();
  while (stop.is_null() || settle.is_null()) {
    said = serving.answer();
    ASSERT_FALSE(said.is_null());
    (said["id"] == 10 ? stop : settle) = said;
  }
  EXPECT_EQ(stop["stopping"], true);
  EXPECT_TRUE(settle.value("kind", "") == "stopped" || settle.value("settled", true) == false) << settle;
}

}  // namespace
}  // namespace karinui::test
