// Eye pictures: what hangs where, and that it is drawn. With KARINUI_PICTURES=DIR the pictures are left there, and the
// strip of docs/user/room.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "eye_pictures.h"
#include "karinui/body/body.h"
#include "karinui/design/script.h"
#include "karinui/view/picture.h"
#include "recorder.h"

namespace karinui::room {
namespace {

using test::Person;
using test::Recorder;

std::string example(const std::string& name) {
  std::ifstream file(std::string(KARINUI_SOURCE_DIR) + "/examples/" + name);
  std::stringstream all;
  all << file.rdbuf();
  return all.str();
}

class RoomPictures : public test::EyePictures {
 protected:
  // The first tunic, sewn and draped: made once.
  static Session& tunic() {
    static Session* session = [] {
      SessionOptions options;
      options.threads = 1;
      auto* made = new Session(options);
      const auto lines = parseScript(example("first_tunic.ops"));
      for (const ScriptLine& line : *lines) made->perform(line.operation), made->finish();
      made->takeNotices();
      return made;
    }();
    session->command(Command::Select);
    session->setLanguage(Language::English);
    return *session;
  }
  static Pixel at(const Image& image, const OnPicture& on) {
    const int x = static_cast<int>(on.x), y = static_cast<int>(on.y);
    if (on.depth <= 0 || x < 0 || y < 0 || x >= image.width || y >= image.height) return {1, 2, 3, 4};
    return image.at(x, y);
  }
  static OnPicture seen(const FittingRoom& room, const Rigid& eye, const FieldOfView& fov, Vec3 fitting) {
    const Rigid inverse{eye.w, -eye.x, -eye.y, -eye.z, {}};
    return onEyePicture(fov, inverse.turned(room.placement().fittingToRoom(fitting) - eye.carry), kWide, kHigh);
  }
  static bool isBoard(Pixel p) { return p[0] > 235 && p[1] > 230 && p[2] > 215; }
};

TEST_F(RoomPictures, MenuWordsAndTableHangWhereTheyCanBeReached) {
  for (const bool left : {false, true})
    for (const Scale scale : {Scale::One, Scale::TableTop}) {
      RoomOptions options;
      options.left = left, options.scale = scale;
      options.posture.floor = 0;
      FittingRoom room(tunic(), options);
      Person person;
      person.step(room), person.step(room);
      take(room, person);
      const Rigid eye = test::eyeOf(person.head, left);
      const FieldOfView fov = left ? test::kRightFov : test::kLeftFov;
      const Image picture = eyePicture(eye, fov);
      for (const SceneMenu& panel : {*room.menu(), room.strip()}) {
        // Between two buttons there is nothing but the board.
        const SceneMenu::Button& first = panel.buttons.front();
        const Vec3 rim = panel.corner + normalized(panel.across) * (first.left * 0.5) + panel.upward * 0.5;
        EXPECT_TRUE(isBoard(at(picture, seen(room, eye, fov, rim)))) << left;
        // Within an arm's reach, on the side of the tool hand, as high as the eyes or a little lower.
        const Vec3 middle = room.placement().fittingToRoom(panel.corner + panel.across * 0.5 + panel.upward * 0.5);
        EXPECT_LT(distance(middle, person.head.carry), 0.8);
        EXPECT_GT(left ? -middle.x : middle.x, 0.1);
        EXPECT_NEAR(middle.y, person.head.carry.y - 0.1, 0.06);
      }
      // The table is beside the body, on the other side, and lower than the eyes.
      const Vec3 board = room.placement().standToRoom(room.table().at({0.5, -0.3}));
      EXPECT_GT(left ? board.x : -board.x, 0.3 * room.placement().scale);
      EXPECT_LT(board.y, person.head.carry.y - 0.2);
    }
}

TEST_F(RoomPictures, TheVignetteDarkensTheRimOnlyWhileTheRoomMoves) {
  RoomOptions options;
  options.posture.floor = 0;
  FittingRoom room(tunic(), options);
  Person person;
  for (int k = 0; k < 3; ++k) person.step(room);
  const Rigid eye = test::eyeOf(person.head, false);
  take(room, person);
  const Image still = eyePicture(eye, test::kLeftFov);
  person.hands[FittingRoom::kRight].tracked = true;
  person.hands[FittingRoom::kRight].hold = 1;
  for (int k = 0; k < 20; ++k) person.hands[FittingRoom::kRight].grip.carry.x += 1e-4, person.step(room);
  EXPECT_GT(room.vignette(), 0.9);
  take(room, person);
  const Image moving = eyePicture(eye, test::kLeftFov);
  EXPECT_LT(moving.at(5, 5)[0], still.at(5, 5)[0] / 3);
  const OnPicture middle = onEyePicture(test::kLeftFov, {0, 0.05, -1}, kWide, kHigh);
  EXPECT_NEAR(at(moving, middle)[0], at(still, middle)[0], 6);
  person.hands[FittingRoom::kRight].hold = 0;
  for (int k = 0; k < 40; ++k) person.step(room);
  EXPECT_EQ(room.vignette(), 0);
}

TEST_F(RoomPictures, WhatIsHiddenIsNeitherDrawnNorMet) {
  Session session;
  session.perform(*parseOperation("body size=jis9ar"));
  session.finish();
  RoomOptions options;
  options.posture.floor = 0;
  FittingRoom room(session, options);
  Person person;
  person.step(room), person.step(room);
  const Rigid eye = test::eyeOf(person.head, false);
  const auto skin = session.snapshot().body->bvh().first({0, 1.53, 1}, {0, 0, -1});
  ASSERT_TRUE(skin);
  const Vec3 face = skin->point;
  const auto colour = [&] {
    person.pointAt(room.placement().fittingToRoom(face));
    person.step(room), person.step(room);
    take(room, person);
    return at(eyePicture(eye, test::kLeftFov), seen(room, eye, test::kLeftFov, face - Vec3{0.02, 0, 0}));
  };
  const auto met = [&] { return room.hands()[FittingRoom::kRight].along; };
  const Pixel there = colour();
  EXPECT_LT(met(), 1.5);
  session.command(Command::HideHead), session.finish();
  const Pixel hidden = colour();
  EXPECT_GT((there[0] - there[2]) - (hidden[0] - hidden[2]), 8) << "the wall behind it is less red";
  EXPECT_GT(met(), 1.5);
}

TEST_F(RoomPictures, WordsAreBrokenAndWrittenInBothLanguages) {
  BoardImages images;
  const auto english =
      images.sentences({{"Take hold of the cloth and pull: it drapes while you pull.", Tone::Plain}}, 400, 30);
  const auto japanese =
      images.sentences({{"布をつかんで引きます。引いているあいだドレープします。", Tone::Plain}}, 400, 30);
  for (const ImagePtr& image : {english, japanese}) {
    EXPECT_GT(image->height, 2 * 30);  // more than one line
    int ink = 0, outside = 0;
    for (int y = 0; y < image->height; ++y)
      for (int x = 0; x < image->width; ++x)
        if (image->at(x, y)[0] < 100 && image->at(x, y)[3] > 200) ++ink, outside += x < 12 || x >= image->width - 12;
    EXPECT_GT(ink, 500);
    EXPECT_EQ(outside, 0);  // no word runs over the rim
  }
  EXPECT_THAT(images.takeNotes(), testing::IsEmpty());
  Lettering lettering;
  for (const std::string& line : broken(lettering, "one two three four five six", 120, 20))
    EXPECT_LE(lettering.width(line, 20), 120) << line;
  EXPECT_EQ(images.word("12.3 cm"), images.word("12.3 cm"));  // kept, not made again
}

// The strip of the manual, and more to look at.
TEST_F(RoomPictures, ShowTheRoom) {
  const char* folder = std::getenv("KARINUI_PICTURES");
  if (!folder || !*folder) GTEST_SKIP() << "skipped: no pictures are wanted";
  std::vector<SheetItem> strip;
  const FieldOfView one{-0.74, 0.74, 0.40, -0.66};
  const DrawArea area{.x = 0, .y = 0, .width = 800, .height = 527};  // square pixels
  const auto keep = [&](const FittingRoom& room, Person& person, const std::string& name, const std::string& caption) {
    show(room, person, "room_" + name);
    const Image image = tile(test::eyeOf(person.head, true), one, area);
    EXPECT_TRUE(writePng((std::filesystem::path(folder) / ("room_strip_" + name + ".png")).string(), image));
    strip.push_back({image, caption});
  };
  RoomOptions options;
  options.posture.floor = 0;
  {
    FittingRoom room(tunic(), options);
    Recorder hand(room);
    hand.hold(4);
    hand.tool().tracked = hand.other().tracked = true;
    hand.other().aim = test::aimed({-0.22, 1.15, -0.25}, {-0.2, 1.1, -1});
    hand.choose(Command::Pull);
    Session& session = room.session();
    const auto front = session.shownPtr()->worn.front();
    Flat low = front.ring.front(), high = low;
    for (const Flat p : front.ring) {
      low = {std::fmin(low.u, p.u), std::fmin(low.v, p.v)};
      high = {std::fmax(high.u, p.u), std::fmax(high.v, p.v)};
    }
    const Vec3 hem = *spaceOf(session.snapshot(), front.id, {(low.u + high.u) / 2 + 0.05, low.v + 0.08});
    hand.person.shoulder = {0.25, 1.2, -0.3};
    hand.touchAt(hem), hand.hold(3), hand.trigger(1);
    for (int k = 1; k <= 20; ++k) hand.touchAt(hem + Vec3{0, 0.01, 0.10} * (k / 20.0)), hand.hold();
    keep(room, hand.person, "pull", "Pull: the cloth drapes while the hand pulls");
    hand.tool().cancel = true, hand.hold(2), hand.tool().cancel = false, hand.hold(2);
    hand.trigger(0);

    hand.choose(Command::Sew);
    hand.person.head = after(turnAbout({0, 1, 0}, 0.62), turnAbout({1, 0, 0}, -0.42));
    hand.person.head.carry = {0, 1.55, 0};
    hand.person.pointAt(room.placement().standToRoom(room.table().at({0.3, -0.1})));
    for (const auto& piece : session.shownPtr()->worn) {
      const Flat corner = piece.ring[piece.ring.size() / 3] + session.table().at(piece.id);
      hand.person.pointAt(room.placement().standToRoom(room.table().at(corner)));
    }
    hand.hold(60);
    keep(room, hand.person, "table", "The flat pattern on its table, pointed at alike");
    hand.hold(2);
  }
  {
    options.scale = Scale::TableTop;
    options.language = Language::Japanese;
    FittingRoom room(tunic(), options);
    Recorder hand(room);
    hand.hold(4);
    hand.tool().tracked = true;
    hand.choose(Command::Draw);
    hand.pointAt({0.05, 1.2, 0.13}), hand.hold(20);
    keep(room, hand.person, "desk", "On a desk, in Japanese");
  }
  {
    options.scale = Scale::One;
    options.language = Language::English;
    options.left = true;
    FittingRoom room(tunic(), options);
    Person person;
    person.hands[FittingRoom::kLeft].tracked = true;
    person.hands[FittingRoom::kLeft].aim = test::aimed({-0.22, 1.15, -0.18}, {-0.05, 1.25, -1});
    room.session().command(Command::Reshape);
    person.step(room);
    person.seconds += 1;
    person.step(room);
    keep(room, person, "left", "For a left hand");
  }
  const auto sheet = contactSheet(strip, {.columns = 2});
  ASSERT_TRUE(sheet);
  EXPECT_TRUE(writePng((std::filesystem::path(folder) / "room.png").string(), *sheet));
}

}  // namespace
}  // namespace karinui::room
