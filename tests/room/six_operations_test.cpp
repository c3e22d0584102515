// All six operations by controllers, from start to end: worked once in this process, then played to the program through
// OpenXR, then done by script. The three documents are one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "karinui/body/body.h"
#include "karinui/design/history.h"
#include "karinui/design/script.h"
#include "karinui/view/picture.h"
#include "program.h"
#include "recorder.h"

namespace karinui::room {
namespace {

using test::Folder;
using test::Ran;
using test::Recorder;

// The skin in front of the body at a width and a height.
Vec3 skinAt(const Session& session, double x, double y) {
  const auto met = session.snapshot().body->bvh().first({x, y, 2}, {0, 0, -1});
  return met ? met->point : Vec3{x, y, 0};
}

// A place of a piece by its paper, as the session shows it.
Vec3 clothAt(const Session& session, const std::string& piece, double across, double up) {
  const auto& fitting = session.snapshot();
  const Piece* found = fitting.document.pieceNamed(piece);
  const Ring ring = found->outline.flattened(1e-3);
  Flat low = ring.front(), high = low;
  for (const Flat p : ring) {
    low = {std::fmin(low.u, p.u), std::fmin(low.v, p.v)};
    high = {std::fmax(high.u, p.u), std::fmax(high.v, p.v)};
  }
  return *spaceOf(fitting, found->id, {low.u + across * (high.u - low.u), low.v + up * (high.v - low.v)});
}

// The middle of the piece's edge that is highest (lowest) in space.
Vec3 edgeAt(const Session& session, const std::string& piece, bool highest) {
  const auto& fitting = session.snapshot();
  const Piece* found = fitting.document.pieceNamed(piece);
  Vec3 best{0, highest ? -1e9 : 1e9, 0};
  for (const Edge& edge : found->outline.edges) {
    const auto line = edgeInSpace(fitting, {PieceRef(found->id), edge.name});
    const Vec3 middle = line[line.size() / 2];
    if (highest ? middle.y > best.y : middle.y < best.y) best = middle;
  }
  return best;
}

void drawSquare(Recorder& hand, const Session& session, double low, double high) {
  const double x = 0.06;
  for (const auto& [across, up] : {std::pair(x, low), {x, high}, {-x, high}, {-x, low}, {x, low}})
    hand.clickAt(skinAt(session, across, up));
}

struct Played {
  std::string hands, marks, hash, log;
  std::vector<std::string> steps, pictures;
};

// What the person does, in this process.
Played playHere() {
  SessionOptions options;
  options.threads = 1;
  Session session(options);
  session.perform(*parseOperation("body size=jis9ar"));
  session.finish();
  RoomOptions room;
  room.posture.floor = 0;
  FittingRoom fitting(session, room);
  Recorder hand(fitting);
  hand.hold(8);
  hand.tool().tracked = true;
  hand.other() = hand.tool();
  hand.other().aim.carry = {-0.25, 1.1, -0.2};
  hand.pointAt({0, 1.2, 0.1});
  hand.hold(4);

  hand.choose(Command::Draw);
  drawSquare(hand, session, 1.04, 1.16);
  hand.choose(Command::Draw);
  drawSquare(hand, session, 0.86, 0.96);
  const auto pieces = session.snapshot().document.pattern.pieces;
  EXPECT_EQ(pieces.size(), 2u);
  if (pieces.size() != 2) return {};
  const std::string upper = pieces.begin()->second->name, lower = std::next(pieces.begin())->second->name;
  hand.picture("drawn");

  hand.choose(Command::Move);  // by the fingertip, with all its freedom
  const Vec3 held = clothAt(session, lower, 0.5, 0.5);
  hand.drag(held, held + Vec3{0.01, 0.03, 0.02}, true);

  hand.choose(Command::Sew);  // by the ray, from edge to edge
  hand.drag(edgeAt(session, upper, false), edgeAt(session, lower, true), false);
  if (const auto& choice = fitting.choice()) {
    hand.picture("asked");
    hand.clickAt(fitting.placement().standToFitting(test::middleOf(choice->panel, 0)));
  }
  hand.picture("sewn");

  hand.choose(Command::Cut);  // a slit from the hem upwards
  hand.drag(edgeAt(session, lower, false) - Vec3{0, 0.015, 0}, clothAt(session, lower, 0.5, 0.45), false);

  hand.choose(Command::Pull);
  const Vec3 pulled = clothAt(session, upper, 0.5, 0.5);
  hand.touchAt(pulled), hand.hold(3), hand.trigger(1);
  for (int k = 1; k <= 40; ++k) hand.touchAt(pulled + Vec3{0, 0, 0.06} * (k / 40.0)), hand.hold();
  hand.picture("pulled");
  hand.trigger(0);

  hand.choose(Command::Reshape);
  const Vec3 shaped = clothAt(session, upper, 0.08, 0.5);
  hand.drag(shaped, shaped + Vec3{-0.015, 0, 0.004}, false);

  hand.choose(Command::Undo);
  hand.press(&ControllerState::cancel);  // the tool hand's own: Cancel, where nothing is under way
  hand.other().cancel = true, hand.hold(2), hand.other().cancel = false, hand.hold(2);  // the other hand's: Redo
  hand.choose(Command::Settle);
  hand.hold(4);
  hand.picture("settled");

  Played played;
  for (const Step& step : session.steps()) played.steps.push_back(text(step.operation));
  played.hash = hash(session.snapshot().document);
  played.hands = hand.hands(), played.marks = hand.marks(), played.pictures = hand.pictures();
  for (const Notice& notice : session.takeNotices()) played.log += text(notice.what) + "\n";
  for (const Caption& caption : fitting.captions()) played.log += text(caption.notice.what) + "\n";
  return played;
}

TEST(RoomOperations, AllSixByControllerAreThoseByScript) {
  if (const std::string why = test::displayTrouble(); !why.empty()) GTEST_SKIP() << "skipped: " << why;
  const Played here = playHere();
  const auto kinds = [](const std::vector<std::string>& steps) {
    std::set<std::string> all;
    for (const std::string& step : steps) all.insert(step.substr(0, step.find(' ')));
    return all;
  };
  EXPECT_THAT(kinds(here.steps), testing::IsSupersetOf({"draw", "move", "sew", "cut", "pull", "reshape", "drape"}))
      << here.log << testing::PrintToString(here.steps);

  const Folder folder;
  const char* pictures = std::getenv("KARINUI_PICTURES");
  if (pictures && !*pictures) pictures = nullptr;
  const Ran ran = test::run(folder, {.hands = here.hands,
                                     .marks = here.marks,
                                     .with = pictures ? "large" : "seldom",
                                     .words = {"--new", "jis9ar", "--share", "window"}});
  EXPECT_EQ(ran.code, 0) << ran.said;
  EXPECT_EQ(ran.faults, "");
  EXPECT_EQ(ran.validation, "");
  ASSERT_FALSE(ran.report.is_discarded()) << ran.said;
  EXPECT_THAT(ran.report["failed_calls"], testing::IsEmpty());
  EXPECT_EQ(ran.report["document"]["steps"].get<std::vector<std::string>>(), here.steps);

  // By script.
  MemoryBlobs none;
  Workers workers(1);
  Bodies bodies;
  Context context{workers, {}, none, bodies, {}, {}};
  DocumentFile script = DocumentFile::inMemory();
  for (const std::string& line : here.steps) {
    auto operation = parseOperation(line);
    ASSERT_TRUE(operation) << line;
    const auto step = script.perform(*operation, context);
    ASSERT_TRUE(step) << line << "\n" << (step ? "" : text(step.error().what));
  }
  EXPECT_EQ(ran.report["document"]["hash"], hash(script.document()));
  EXPECT_EQ(here.hash, hash(script.document()));
  EXPECT_EQ(ran.report["document"]["drape_hash"], drapeHash(script.document()));

  // The motor ran: on contact with the cloth that was touched, and for its tension.
  EXPECT_THAT(ran.vibration, testing::HasSubstr("/user/hand/right"));
  if (pictures)
    for (const std::string& name : here.pictures)
      for (const char* eye : {"_left.png", "_right.png"})
        test::fs::copy_file(folder / "out" / (name + eye), test::fs::path(pictures) / ("room_" + name + eye),
                            test::fs::copy_options::overwrite_existing);
}

}  // namespace
}  // namespace karinui::room
