// Recorded hands: each file is a garment that is given, a stream of samples and commands, and what they come to:
// steps as text, and sentences of refusal. With KARINUI_ACCEPT=1 what they come to is written into the files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

struct Recording {
  std::vector<std::string> given, played, expected;
  std::string kept;  // the file without what is expected
};

Recording recordingIn(const fs::path& path) {
  Recording recording;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("expect ")) {
      recording.expected.push_back(line.substr(7));
      continue;
    }
    recording.kept += line + "\n";
    if (line.starts_with("given "))
      recording.given.push_back(line.substr(6));
    else if (!line.empty() && line[0] != '#')
      recording.played.push_back(line);
  }
  return recording;
}

SessionOptions cheap(std::shared_ptr<Bodies> bodies) {
  SessionOptions options;
  options.bodies = std::move(bodies);
  options.drape = [](const Document& d, const DrapePieces& op, Context&) { return fallABit(d, op.live); };
  options.pull = [](const Document& d, const PullCloth& op, Context&) { return fallABit(d, op.live); };
  return options;
}

std::optional<Command> named(std::string_view name) {
  for (const CommandInfo& one : commands())
    if (one.name == name) return one.command;
  return std::nullopt;
}

// A drawn line is told by what does not hang on the very shape of the figure: its name, its corners, whether it is a
// half. Where it runs is compared with the rays that drew it.
std::string told(const Operation& operation) {
  const auto* draw = std::get_if<DrawPiece>(&operation);
  if (!draw) return text(operation);
  const auto smooth = std::count(draw->edges.begin(), draw->edges.end(), "~");
  return "draw name=" + draw->name + " corners=" + std::to_string(static_cast<long>(draw->edges.size()) - smooth) +
         (smooth > 0 ? " curved=yes" : "") + (draw->symmetric ? " symmetric=yes" : "");
}

// "sight ex ey ez tx ty tz": from where to where one looks.
Viewpoint sightIn(std::istringstream& words) {
  Vec3 to;
  Viewpoint sight;
  words >> sight.eye.x >> sight.eye.y >> sight.eye.z >> to.x >> to.y >> to.z;
  sight.distance = distance(sight.eye, to);
  sight.back = normalized(sight.eye - to);
  sight.right = normalized(cross(Vec3{0, 1, 0}, sight.back));
  sight.up = cross(sight.back, sight.right);
  return sight;
}

// "key right 12 space shift": so often.
void strike(Session& session, std::istringstream& words, double seconds) {
  static const std::map<std::string, KeyStroke> strokes{
      {"left", KeyStroke::Left},   {"right", KeyStroke::Right},     {"up", KeyStroke::Up},
      {"down", KeyStroke::Down},   {"next", KeyStroke::Next},       {"previous", KeyStroke::Previous},
      {"press", KeyStroke::Press}, {"shorter", KeyStroke::Shorter}, {"longer", KeyStroke::Longer}};
  std::string name, word;
  int times = 0;
  PointerSample with;
  words >> name >> times >> word;
  with.seconds = seconds;
  with.reach = 0.005;
  with.where = word == "table" ? PointerSample::Where::Table : PointerSample::Where::Space;
  while (words >> word) with.shift |= word == "shift", with.control |= word == "control", with.alt |= word == "alt";
  for (int k = 0; k < times; ++k) session.strike(strokes.at(name), with);
}

double awayFromRays(Vec3 place, const std::vector<Ray>& rays) {
  double nearest = 1e9;
  for (const Ray& ray : rays) {
    const Vec3 to = place - ray.origin;
    nearest = std::min(nearest, length(to - ray.direction * dot(to, ray.direction)));
  }
  return nearest;
}

using Device = std::function<PointerSample(PointerSample, const GarmentSnapshot&)>;

std::vector<std::string> cameTo(const Recording& recording, std::shared_ptr<Bodies> bodies, const Device& device = {}) {
  Session session(cheap(std::move(bodies)));
  for (const std::string& line : recording.given) {
    auto operation = parseOperation(line);
    EXPECT_TRUE(operation) << line;
    if (operation) session.perform(*std::move(operation));
    session.finish();
  }
  const std::size_t before = session.steps().size();
  EXPECT_EQ(before, recording.given.size());
  std::vector<std::string> came;
  std::vector<Ray> rays;
  double seconds = 0;
  const auto note = [&] {
    for (const Notice& notice : session.takeNotices())
      if (notice.kind == Notice::Kind::Refused)
        came.push_back("refused: " + text(notice.what));
      else if (notice.kind == Notice::Kind::Advice)
        came.push_back("advised: " + text(notice.what));
  };
  for (const std::string& line : recording.played) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (first == "tool" || first == "command") {
      const auto command = named(second);
      EXPECT_TRUE(command) << line;
      if (command) session.command(*command);
    } else if (first == "read") {  // what stands beside the hand
      const Preview preview = session.preview();
      for (const SceneWord& word : preview.space.words) came.push_back("reads: " + word.text);
      if (const auto menu = session.dropMenu()) {
        for (const Message& title : menu->title) came.push_back("asks: " + text(title));
        for (std::size_t k = 0; k < menu->items.size(); ++k) {
          const DropMenu::Item& item = menu->items[k];
          const std::string check = !item.checked ? "" : *item.checked ? "[x] " : "[ ] ";
          came.push_back((k == menu->current ? "offers first: " : "offers: ") + check + text(item.label));
        }
      }
    } else if (first == "choose") {  // "choose 0": an item of the drop menu
      session.choose(std::stoul(second));
    } else if (first == "sight" || first == "key") {
      words.seekg(static_cast<std::streamoff>(first.size()));
      if (first == "sight")
        session.setViewpoint(sightIn(words));
      else
        strike(session, words, seconds += 0.1);
      if (const auto tip = session.fingertip()) rays.push_back(tip->ray);
    } else {
      auto sample = parsePointerSample(line);
      EXPECT_TRUE(sample) << line;
      if (sample && device) *sample = device(*sample, session.snapshot());
      if (sample) session.feed(*sample), rays.push_back(sample->ray);
    }
    (void)session.preview();  // what is shown meanwhile is part of the life of a gesture
    (void)session.hint();
  }
  session.finish();
  note();
  for (std::size_t i = before; i < session.steps().size(); ++i) {
    const Operation& operation = session.steps()[i].operation;
    came.push_back(told(operation));
    if (const auto* draw = std::get_if<DrawPiece>(&operation)) {
      const Body& body = *session.snapshot().body;
      for (const BodyPoint& point : draw->line) {
        const auto place = body.find(point);
        EXPECT_TRUE(place) << text(point);
        // As far as a line of the body snaps, or a waver is taken out.
        const double most = point.part == BodyPoint::Part::Line ? 0.0095 : 0.007;
        EXPECT_LT(place ? awayFromRays(at(body.mesh(), *place), rays) : 1, most) << text(point);
      }
    }
  }
  return came;
}

TEST(Recordings, ComeToWhatWasExpected) {
  const fs::path folder = fs::path(KARINUI_SOURCE_DIR) / "tests/session/recordings";
  const auto bodies = std::make_shared<Bodies>();
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  EXPECT_GE(files.size(), 40u);
  for (const fs::path& path : files) {
    SCOPED_TRACE(path.filename().string());
    const Recording recording = recordingIn(path);
    const std::vector<std::string> came = cameTo(recording, bodies);
    if (std::getenv("KARINUI_ACCEPT")) {
      std::ofstream file(path);
      file << recording.kept;
      for (const std::string& line : came) file << "expect " << line << "\n";
    } else {
      EXPECT_THAT(came, testing::ElementsAreArray(recording.expected));
    }
  }
}

// The same by a stylus, whose tip is where the ray meets something, or else the plane of the piece in front. Its own
// ray points elsewhere.
PointerSample byStylus(PointerSample sample, const GarmentSnapshot& fitting) {
  const Hit hit = pick(fitting, TableLayout(), sample);
  Vec3 tip = sample.ray.origin - sample.ray.direction * (sample.ray.origin.z / sample.ray.direction.z);
  if (hit.on != Hit::On::Nothing)
    tip = hit.point;
  else if (hit.edge)
    tip = *spaceOf(fitting, hit.piece, hit.paper);
  sample.tip.emplace().carry = tip;
  sample.ray = {tip, {0, 1, 0}};
  sample.device = PointerSample::Device::Stylus;
  return sample;
}

TEST(Recordings, AStylusComesToTheSame) {
  const fs::path folder = fs::path(KARINUI_SOURCE_DIR) / "tests/session/recordings";
  const auto bodies = std::make_shared<Bodies>();
  for (const char* name : {"move", "move_refused", "sew", "sew_part", "sew_to_nothing", "cut_slit", "cut_in_two",
                           "cut_leaves", "cut_nothing", "pull", "pull_held", "pull_click", "reshape", "line", "pin",
                           "draw_clicks", "draw_ring", "draw_half"}) {
    SCOPED_TRACE(name);
    const Recording recording = recordingIn(folder / (std::string(name) + ".txt"));
    EXPECT_THAT(cameTo(recording, bodies, byStylus), testing::ElementsAreArray(recording.expected));
  }
}

// Where the ray of a mouse is blind: towards the eye and away from it, and turning.
TEST(Recordings, AStylusHasSixDegreesOfFreedom) {
  const auto bodies = std::make_shared<Bodies>();
  const Recording given = recordingIn(fs::path(KARINUI_SOURCE_DIR) / "tests/session/recordings/pull.txt");
  const auto played = [&](std::string tool, Vec3 to, const Rigid& turn) {
    Recording recording{given.given, {"tool " + tool}, {}, {}};
    PointerSample sample;
    sample.alt = true;  // nothing snaps
    sample.ray.origin = {0.2, 0.45, 1};
    sample.tip = Rigid{1, 0, 0, 0, {0.2, 0.45, 0.004}};
    sample.phase = PointerSample::Phase::Press;
    recording.played.push_back(text(sample));
    sample.seconds = 1;
    sample.phase = PointerSample::Phase::Drag;
    sample.tip = turn;
    sample.tip->carry = Vec3{0.2, 0.45, 0.004} + to;
    recording.played.push_back(text(sample));
    sample.phase = PointerSample::Phase::Release;
    recording.played.push_back(text(sample));
    return cameTo(recording, bodies);
  };
  EXPECT_THAT(played("move", {0.03, 0, 0.2}, {}), testing::ElementsAre("move piece=p1 by=30mm,0,200mm"));
  EXPECT_THAT(played("pull", {0, 0, 0.08}, {}),
              testing::ElementsAre(testing::StartsWith("pull piece=p1 at=200mm,450mm by=0,0,80mm")));
  EXPECT_THAT(played("reshape", {0, -0.02, 0.015}, {}),
              testing::ElementsAre(testing::StartsWith("reshape piece=p1 at=200mm,450mm by=0,-20mm,15mm")));
  // The tip turns by 90 degrees about its own place, 20 cm above the middle of the piece.
  EXPECT_THAT(
      played("move", {}, turnAbout({0, 0, 1}, std::numbers::pi / 2)),
      testing::ElementsAre(testing::StartsWith("move piece=p1 by=200mm,200mm,0 turn=\"z 1.5707963267948966\"")));
}

TEST(Recordings, WhatTheTipDoesNotReachIsNotTouched) {
  const auto bodies = std::make_shared<Bodies>();
  Recording recording = recordingIn(fs::path(KARINUI_SOURCE_DIR) / "tests/session/recordings/move.txt");
  const auto away = [](PointerSample sample, const GarmentSnapshot& fitting) {
    sample = byStylus(std::move(sample), fitting);
    sample.tip->carry.z = 0.006;  // metres; touching is 5 mm
    return sample;
  };
  EXPECT_THAT(cameTo(recording, bodies, away), testing::ElementsAre("refused: Take hold of a piece to move it."));
}

}  // namespace
}  // namespace karinui
