// Drawing on the body as a hand does it from one side: shaking, beside the silhouette, from the back, round the body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "design/workroom.h"
#include "karinui/body/lines.h"
#include "karinui/design/drawing.h"
#include "karinui/design/script.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

using Phase = PointerSample::Phase;

SessionOptions cheap() {
  static const auto bodies = std::make_shared<Bodies>();
  SessionOptions options;
  options.bodies = bodies;
  options.autoSettle = false;
  options.drape = [](const Document& d, const DrapePieces& op, Context&) { return fallABit(d, op.live); };
  return options;
}

constexpr const char* kFront =
    "draw name=front ease=12mm symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
    "line=\"torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
    "torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0\"";

struct Pixel {
  double x = 0, y = 0;
};

// A window of 860 by 540 pixels in which the whole figure is seen, as the studio shows it, and a hand in it.
class Hand {
 public:
  explicit Hand(Session& session, Vec3 from = {0, 0, 1}) : session_(session) { look(from); }
  void look(Vec3 from) {
    back_ = normalized(from);
    eye_ = Vec3{0, 0.83, 0} + back_ * 4.9;
    right_ = normalized(cross(Vec3{0, 1, 0}, back_));
    up_ = cross(back_, right_);
  }
  Pixel of(Vec3 place) const {
    const Vec3 way = place - eye_;
    const double deep = -dot(way, back_);
    return {dot(way, right_) / deep / pixel_, dot(way, up_) / deep / pixel_};
  }
  PointerSample sample(Pixel at, Phase phase) const {
    PointerSample s;
    s.phase = phase;
    s.ray = {eye_, normalized(right_ * (at.x * pixel_) + up_ * (at.y * pixel_) - back_)};
    s.facing = back_;
    s.reach = 11 * pixel_;
    return s;
  }
  bool onBody(Pixel at) const { return pickBody(session_.snapshot(), sample(at, Phase::Hover)).on == Hit::On::Body; }
  // The silhouette beside a place, to the right or left of it in the picture.
  Pixel rim(Vec3 place, double way) const {
    Pixel at = of(place);
    at.x -= 12 * way;
    while (onBody(at)) at.x += 0.25 * way;
    return at;
  }
  void feed(Pixel at, Phase phase) { session_.feed(sample(at, phase)); }
  void click(Pixel at) {
    for (const Phase phase : {Phase::Hover, Phase::Press, Phase::Release}) feed(at, phase);
  }
  // Presses, goes from pixel to pixel wavering by up to so many, and lets go.
  void stroke(const std::vector<Pixel>& path, double waver, bool press = true, bool release = true) {
    if (press) feed(path.front(), Phase::Hover), feed(path.front(), Phase::Press);
    std::uniform_real_distribution<double> off(-waver, waver);
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double dx = path[i].x - path[i - 1].x, dy = path[i].y - path[i - 1].y;
      const int steps = std::max(1, static_cast<int>(std::hypot(dx, dy) / 2));
      for (int k = 1; k <= steps; ++k)
        feed({path[i - 1].x + dx * k / steps + off(chance_), path[i - 1].y + dy * k / steps + off(chance_)},
             Phase::Drag);
    }
    if (release) feed(path.back(), Phase::Release);
  }

 private:
  Session& session_;
  Vec3 eye_, right_, up_, back_;
  double pixel_ = 0.42 / 540;
  std::mt19937 chance_{7};
};

// The sharpest turn of an edge on paper over 4 cm, in degrees.
double sharpest(const Curve& edge) {
  const int steps = std::max(8, static_cast<int>(edge.length() / 0.005));
  const std::vector<Flat> p = edge.evenly(0, 1, steps);
  double most = 0;
  for (std::size_t i = 4; i + 4 < p.size(); ++i) {
    const Flat in = p[i] - p[i - 4], out = p[i + 4] - p[i];
    most = std::max(most, std::fabs(std::atan2(cross(in, out), dot(in, out))) * 180 / std::numbers::pi);
  }
  return most;
}

class Drawing : public testing::Test {
 protected:
  Drawing() : session(cheap()) {
    session.perform(op("body size=jis9ar"));
    session.finish();
  }
  const Body& body() { return *session.snapshot().body; }
  Vec3 on(const char* place) { return at(body().mesh(), *body().find(*parseBodyPoint(place))); }
  std::string refused() {
    std::string all;
    for (const Notice& n : session.takeNotices())
      if (n.kind == Notice::Kind::Refused) all += text(n.what);
    return all;
  }
  const DrawPiece& drawn() {
    session.finish();
    const auto* draw = std::get_if<DrawPiece>(&session.steps().back().operation);
    EXPECT_TRUE(draw) << refused();
    static const DrawPiece none;
    return draw ? *draw : none;
  }
  Session session;
};

// A newcomer's front: neck, shoulder, armhole, down the rim of the figure, hem, in one stroke that shakes by 2 pixels.
TEST_F(Drawing, AShakySideDrawnFromTheFrontIsAFairEdge) {
  Hand hand(session);
  session.command(Command::Draw);
  std::vector<Pixel> path{hand.of(on("torso:shoulder+0.45@0")), hand.of(on("torso:shoulder+0.55@0.1")),
                          hand.of(on("landmark:neck_left")),    hand.of(on("landmark:shoulder_left")),
                          hand.of(on("torso:armpit+0.5@0.17")), hand.of(on("torso:armpit@0.2"))};
  for (double share = 0.005; share < 0.37; share += 0.01)
    path.push_back(hand.rim(bodyLine(body(), "side_left")->at(share), 1));
  const double hem = bodyLine(body(), "side_left")->at(0.37).y;
  Vec3 middle = on("torso:hip@0");
  middle.y = hem;
  path.push_back(hand.of({0.08, hem, middle.z}));
  path.push_back(hand.of(middle));
  hand.stroke(path, 2);
  session.finish();
  ASSERT_EQ(session.steps().size(), 2u) << refused();
  const DrawPiece& draw = drawn();
  EXPECT_TRUE(draw.symmetric);
  const Piece& piece = *session.snapshot().document.pieceNamed(draw.name);
  const Edge* side = findEdge(piece, "side_left");
  ASSERT_TRUE(side) << text(session.steps().back().operation);
  EXPECT_EQ(wavers(side->curve), 0);
  EXPECT_LT(sharpest(side->curve), 16);
  double along = side->curve.length();
  for (const char* more : {"side_left_2", "side_left_3"})
    if (const Edge* next = findEdge(piece, more)) {
      along += next->curve.length();
      EXPECT_LT(sharpest(next->curve), 16);
    }
  const double length = bodyLine(body(), "side_left")->length * 0.37;
  EXPECT_NEAR(along, length, 0.04 * length) << "as long as the figure's side";
  EXPECT_LE(draw.edges.size() - std::count(draw.edges.begin(), draw.edges.end(), "~"), 6u)
      << text(session.steps().back().operation) << "corners where the hand turned, and no others";
  for (const Edge& edge : piece.outline.edges) EXPECT_EQ(wavers(edge.curve), 0) << edge.name;
}

TEST_F(Drawing, AWaverInTheMiddleOfTheBodyIsTakenOutWithinTheHandsTolerance) {
  Hand hand(session);
  session.command(Command::Draw);
  std::vector<Pixel> bow;  // a curve that no line of the body follows
  for (int k = 0; k <= 12; ++k) {
    const double t = k / 12.0;
    bow.push_back(hand.of(on("torso:under_bust@0.94")));
    const Pixel to = hand.of(on("torso:under_bust@0.06"));
    bow.back().x += (to.x - bow.back().x) * t, bow.back().y += 30 * std::sin(std::numbers::pi * t);
  }
  hand.stroke(bow, 2);
  hand.click(hand.of(on("torso:waist+0.3@0.05")));
  hand.click(hand.of(on("torso:waist+0.3@0.95")));
  session.command(Command::Confirm);
  session.finish();
  ASSERT_EQ(session.steps().size(), 2u) << refused();
  const DrawPiece& draw = drawn();
  const Edge& edge = session.snapshot().document.pieceNamed(draw.name)->outline.edges.front();
  EXPECT_EQ(wavers(edge.curve), 0);
  for (const BodyPoint& point : draw.line) {
    const Vec3 p = at(body().mesh(), *body().find(point));
    const Pixel seen = hand.of(p);
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < bow.size(); ++i)
      for (double t = 0; t <= 1; t += 0.05)
        nearest = std::min(nearest, std::hypot(seen.x - (bow[i].x + (bow[i + 1].x - bow[i].x) * t),
                                               seen.y - (bow[i].y + (bow[i + 1].y - bow[i].y) * t)));
    if (seen.y > hand.of(on("torso:waist+0.6@0")).y) {
      EXPECT_LT(nearest, 3.5) << text(point);
    }
  }
}

TEST_F(Drawing, ARunAlongALineOfTheBodyIsNamedByItAndFoundOnAnotherFigure) {
  Hand hand(session);
  session.command(Command::Draw);
  const auto ring = [&](const char* name, double from, double to) {
    std::vector<Pixel> path;
    for (int k = 0; k <= 20; ++k) {
      const double share = from + (to - from) * k / 20;
      path.push_back(hand.of(bodyLine(body(), name)->at(share - std::floor(share))));
    }
    return path;
  };
  hand.stroke(ring("waist", -0.12, 0.12), 1);
  hand.stroke(ring("hip", 0.12, -0.12), 1);
  session.command(Command::Confirm);
  const DrawPiece& draw = drawn();
  const std::string said = text(session.steps().back().operation);
  EXPECT_THAT(said, testing::HasSubstr("line:waist@"));
  EXPECT_THAT(said, testing::HasSubstr("line:hip@"));
  EXPECT_THAT(draw.edges, testing::IsSupersetOf({"waist", "hem"}));
  session.applyFigure({.size = "eu50", .sex = {}, .set = {}, .mesh = {}});
  session.finish();
  const Vec3 moved = on("line:waist@0");
  EXPECT_NEAR(moved.y, session.snapshot().body->landmarks().at("waist_front").y, 0.004);
  EXPECT_EQ(session.steps().size(), 2u) << refused();
}

// What a tailor sees of the front from behind lies beside the skin.
TEST_F(Drawing, TheBackMeetsTheVisibleCornerOfTheFront) {
  std::string wide = kFront;
  wide.replace(wide.find("12mm"), 4, "30mm");
  session.perform(op(wide));
  session.finish();
  session.takeNotices();
  const Piece& front = *session.snapshot().document.pieceNamed("front");
  const Curve& hem = findEdge(front, "hem_left")->curve;
  const Flat side = std::fabs(hem.start.u) > std::fabs(hem.end.u) ? hem.start : hem.end;
  const Vec3 corner = *spaceOf(session.snapshot(), front.id, side);
  Hand hand(session, {0, 0, -1});
  session.command(Command::Draw);
  hand.click(hand.of(on("torso:hip+0.4@0.5")));
  ASSERT_FALSE(hand.onBody(hand.of(corner))) << "beside the figure";
  hand.click(hand.of(corner));
  hand.click(hand.of(on("torso:waist@0.4")));
  EXPECT_EQ(refused(), "");
  session.command(Command::Confirm);
  const DrawPiece& back = drawn();
  ASSERT_EQ(back.line.size(), 3u);
  const Vec3 met = at(body().mesh(), *body().find(back.line[1]));
  EXPECT_LT(distance(met, body().bvh().nearest(corner)->point), 0.002);
}

TEST_F(Drawing, AStrokeGoesOnOverATurnOfTheView) {
  Hand hand(session);
  session.command(Command::Draw);
  hand.stroke({hand.of(on("torso:waist+0.5@0.95")), hand.of(on("torso:waist+0.5@0.1"))}, 0, true, false);
  hand.look({1, 0, 0.3});  // with the button held
  hand.stroke({hand.of(on("torso:waist+0.5@0.12")), hand.of(on("torso:waist+0.5@0.3"))}, 0, false, true);
  hand.look({0, 0, 1});
  hand.click(hand.of(on("torso:hip@0.1")));
  hand.click(hand.of(on("torso:hip@0.9")));
  session.command(Command::Confirm);
  const DrawPiece& draw = drawn();
  EXPECT_EQ(refused(), "");
  const auto corners = std::count_if(draw.edges.begin(), draw.edges.end(), [](const auto& e) { return e != "~"; });
  EXPECT_EQ(corners, 4) << text(session.steps().back().operation);
  double least = 1;
  for (const BodyPoint& p : draw.line)
    least = std::min(least, distance(at(body().mesh(), *body().find(p)), on("torso:waist+0.5@0.3")));
  EXPECT_LT(least, 0.01) << "as far as the second view led it";
}

TEST_F(Drawing, WhatIsAdvisedIsMarkedAndMendedAndUndone) {
  session.perform(op(kFront));
  session.finish();
  ASSERT_FALSE(session.advice().empty());
  const Advice advice = session.advice().front();
  const Piece* piece = session.snapshot().document.find(advice.piece);
  ASSERT_TRUE(piece);
  EXPECT_TRUE(findEdge(*piece, advice.edge)) << advice.edge;
  session.command(Command::Select);
  const Preview shown = session.preview();
  EXPECT_FALSE(shown.space.lines.empty());
  EXPECT_FALSE(shown.table.lines.empty());
  EXPECT_TRUE(session.can(Command::Mend));
  session.command(Command::Mend);
  session.finish();
  ASSERT_EQ(session.steps().size(), 3u) << refused();
  EXPECT_TRUE(session.advice().empty()) << "the piece has changed";
  EXPECT_FALSE(session.can(Command::Mend));
  session.command(Command::Undo);
  session.finish();
  EXPECT_EQ(session.steps().size(), 2u);
}

// Steps in a sleeve's cap, over two edges, which arrives level at both underarms.
TEST(FairEdge, IsOneLineOverItsEdgesAndKeepsTheDirectionOfItsEnds) {
  const std::vector<Curve> back{Curve::cubic({0, 0}, {0.05, 0}, {0.06, 0.05}, {0.09, 0.05}),
                                Curve::line({0.09, 0.05}, {0.12, 0.05}),
                                Curve::cubic({0.12, 0.05}, {0.15, 0.05}, {0.17, 0.13}, {0.22, 0.13})};
  const std::vector<Curve> cap{Curve::joined(back), Curve::cubic({0.22, 0.13}, {0.3, 0.13}, {0.32, 0}, {0.4, 0})};
  const std::vector<Curve> fair = fairLine(cap, {true, true});
  ASSERT_EQ(fair.size(), 2u);
  EXPECT_EQ(fair[0].end, fair[1].start);
  EXPECT_LT(std::fabs(cross(normalized(fair[0].tangent(1)), normalized(fair[1].tangent(0)))), 1e-6);
  EXPECT_LT(std::fabs(fair[0].tangent(0).v), 1e-9);
  EXPECT_LT(std::fabs(fair[1].tangent(1).v), 1e-9);
  for (double f = 0.02; f < 0.98; f += 0.02)
    EXPECT_GT(fair[0].tangent(fair[0].parameterAt(f * fair[0].length())).v, 0) << f;
  EXPECT_GT(std::fabs(fairLine(cap)[1].tangent(1).v), 1e-3) << "where nothing is said of them, ends swing free";
}

TEST(FairEdge, TakesAHandsScallopsOutAndLeavesATailorsCurveAlone) {
  std::vector<Curve> waves;
  for (int k = 0; k < 6; ++k) {
    const double v = 0.06 * k, out = k % 2 ? 0.02 : -0.02;
    waves.push_back(Curve::cubic({0, v}, {out, v + 0.02}, {out, v + 0.04}, {0, v + 0.06}));
  }
  const Curve scalloped = Curve::joined(waves);
  EXPECT_GT(wavers(scalloped), 0);
  const Curve fair = fairLine({&scalloped, 1}).front();
  EXPECT_EQ(wavers(fair), 0);
  EXPECT_EQ(fair.start, scalloped.start);
  EXPECT_EQ(fair.end, scalloped.end);
  EXPECT_NEAR(fair.length(), 0.36, 0.01);
  const Curve armhole = Curve::cubic({0, 0}, {0.02, 0.08}, {0.08, 0.12}, {0.15, 0.12});
  EXPECT_EQ(wavers(armhole), 0);
  for (double f = 0; f <= 1; f += 0.1)
    EXPECT_LT(distance(fairLine({&armhole, 1}).front().atFraction(f), armhole.atFraction(f)), 0.004) << f;
}

}  // namespace
}  // namespace karinui
