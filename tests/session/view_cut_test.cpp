#include <gtest/gtest.h>

#include "karinui/body/skeleton.h"
#include "karinui/design/script.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

TEST(ViewCut, HiddenPartsAreCutOffCleanlyAndNotPicked) {
  Session session;
  session.perform(*parseOperation("body size=jis9ar"));
  session.finish();
  const BodyPtr body = session.snapshot().body;
  ASSERT_TRUE(body);
  const double whole = volume(body->mesh());
  const auto left = [&](const ViewCut& cut) {
    SceneFrame frame;
    frame.bodies.push_back({body->mesh(), {}});
    VisibleParts(cut, body).cut(frame);
    return volume(frame.bodies[0].mesh) / whole;
  };
  ViewCut arms, hands, head, level;
  arms.arms = hands.hands = head.head = true;
  level.section = SectionPlane{SectionPlane::Across::Level, 1.0};
  EXPECT_LT(left(arms), 0.95);
  EXPECT_GT(left(arms), 0.85);
  EXPECT_LT(left(hands), 0.995);
  EXPECT_GT(left(hands), 0.97);
  EXPECT_LT(left(head), 0.96);
  EXPECT_GT(left(head), 0.88);
  EXPECT_LT(left(level), 0.7);
  EXPECT_GT(left(level), 0.4);

  // On the way to another pose the same is left of it, where it has come to.
  const auto skeleton = *Skeleton::of(body);
  TriangleMesh raised{skeleton->points(skeleton->placements(namedPose("T")->pose)), body->mesh().faces};
  const auto leftRaised = [&](const ViewCut& cut) {
    SceneFrame frame;
    frame.bodies.push_back({raised, {}});
    VisibleParts(cut, body).cut(frame, true);
    double widest = 0;
    for (const Triangle& f : frame.bodies[0].mesh.faces)
      for (const std::uint32_t p : f) widest = std::max(widest, frame.bodies[0].mesh.points[p].x);
    return std::pair(volume(frame.bodies[0].mesh) / volume(raised), widest);
  };
  EXPECT_NEAR(leftRaised(arms).first, left(arms), 0.02);
  EXPECT_NEAR(leftRaised(hands).first, left(hands), 0.005);
  EXPECT_NEAR(leftRaised(head).first, left(head), 0.01);
  EXPECT_LT(leftRaised(arms).second, 0.3);
  EXPECT_GT(leftRaised({}).second, 0.6);
  ViewCut side;
  side.section = SectionPlane{SectionPlane::Across::Side, 0.5};
  EXPECT_NEAR(leftRaised(side).second, 0.5, 1e-6);

  // A ray from in front meets the skin there; not where it is hidden, nor where the cut end comes first.
  const auto met = [&](const char* place) {
    const auto skin = body->find(*parseBodyPoint(place));
    EXPECT_TRUE(skin) << place;
    PointerSample sample;
    const Vec3 there = at(body->mesh(), *skin);
    sample.ray = {there + Vec3{0, 0, 2}, {0, 0, -1}};
    GarmentSnapshot shown = session.snapshot();
    if (session.viewCut().any()) shown.visible = std::make_shared<const VisibleParts>(session.viewCut(), body);
    return pickBody(shown, sample).on == Hit::On::Body;
  };
  EXPECT_TRUE(met("left_arm:wrist@0") && met("torso:bust@0"));
  session.setViewCut(arms);
  EXPECT_FALSE(met("left_arm:wrist@0"));
  EXPECT_TRUE(met("torso:bust@0"));
  ViewCut front;
  front.section = SectionPlane{SectionPlane::Across::Front, 0};
  session.setViewCut(front);
  EXPECT_FALSE(met("torso:bust@0")) << "the cut end is no skin";
  session.setViewCut({});
  EXPECT_TRUE(met("torso:bust@0"));

  // The hand in the session is told the same.
  const auto drawn = [&] {
    PointerSample press;
    press.phase = PointerSample::Phase::Hover;
    const Vec3 there = at(body->mesh(), *body->find(*parseBodyPoint("torso:bust@0")));
    press.ray = {there + Vec3{0, 0, 2}, {0, 0, -1}};
    session.feed(press);
    press.phase = PointerSample::Phase::Press;
    session.feed(press);
    const bool begun = session.begun();
    session.command(Command::Cancel);
    return begun;
  };
  session.command(Command::Draw);
  EXPECT_TRUE(drawn());
  session.command(Command::Draw);
  session.setViewCut(front);
  EXPECT_FALSE(drawn());
  EXPECT_FALSE(sectionNamed("slanted@5cm"));
  EXPECT_NE(text(sectionNamed("front@5").error().what).find("has no unit"), std::string::npos);
  EXPECT_EQ(sectionNamed("level@1.2m")->at, 1.2);
  EXPECT_FALSE(hiddenNamed("feet"));
}

}  // namespace
}  // namespace karinui
