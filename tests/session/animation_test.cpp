// A garment on its way through poses: what is collected, and that the garment itself stays as it is.
#include "karinui/session/animation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "karinui/design/drape.h"
#include "karinui/design/script.h"
#include "karinui/geometry/bvh.h"

namespace karinui {
namespace {

struct Dressed {
  Workers workers{1};
  Token token;
  MemoryBlobs blobs;
  static Bodies& bodies() {
    static Bodies all;
    return all;
  }
  Context context{workers, token, blobs, bodies(), {}, {}};

  Document made(const std::string& script) {
    Document document;
    const auto lines = parseScript(script);
    EXPECT_TRUE(lines);
    for (const ScriptLine& line : *lines) {
      auto next = apply(document, line.operation, context);
      EXPECT_TRUE(next) << text(next.error().what);
      if (next) document = *std::move(next);
    }
    return document;
  }
  const Document& shirt() {
    static const Document all = made(
        "body size=jis9ar\nset spacing=35mm\nblock kind=shirt\n"
        "topstitch edges=\"front_left.hem front_right.hem\" offset=1cm\ndrape\n");
    return all;
  }
};

// How deep the middle of a face lies in the skin at most, metres.
double deepest(const SpatialGarment& garment, const SpatialKeyframe& key) {
  const TriangleMesh skin{key.body, garment.body->faces};
  const Bvh bvh(skin);
  double deep = 0;
  for (std::size_t k = 0; k < key.pieces.size(); ++k)
    for (const auto& [a, b, c] : garment.pieces[k].mesh.faces) {
      const Vec3 middle = (key.pieces[k][a] + key.pieces[k][b] + key.pieces[k][c]) * (1.0 / 3);
      if (const auto near = bvh.nearest(middle, 0.02))
        deep = std::max(deep, -dot(middle - near->point, faceNormal(skin, near->place.face)));
    }
  return deep;
}

double farthestFrom(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double far = 0;
  for (std::size_t k = 0; k < a.size(); ++k) far = std::max(far, distance(a[k], b[k]));
  return far;
}

TEST(Animation, FollowsTheFigureFromPoseToPose) {
  Dressed dressed;
  const Document& shirt = dressed.shirt();
  const std::string before = hash(shirt) + drapeHash(shirt);
  const auto moving = animationOf(shirt, {"T", "arms_down"}, dressed.context);
  ASSERT_TRUE(moving) << text(moving.error().what);
  EXPECT_EQ(hash(shirt) + drapeHash(shirt), before);
  ASSERT_GT(moving->motion.size(), 20u);
  ASSERT_TRUE(moving->body);
  ASSERT_FALSE(moving->notions.empty());
  std::vector<std::string> rests;
  double now = 0;
  const SpatialKeyframe* last = nullptr;
  for (const SpatialKeyframe& key : moving->motion) {
    EXPECT_GE(key.seconds - now, 0.039) << "twenty-five in a second";
    const auto& from = last ? last->body : moving->body->points;
    EXPECT_LT(farthestFrom(key.body, from), 0.09) << "no skin leaps";
    if (!key.name.empty()) {
      rests.push_back(key.name);
      EXPECT_EQ(farthestFrom(key.body, from), 0) << "the figure waits for its cloth";
    }
    EXPECT_LT(deepest(*moving, key), 0.001) << key.seconds;
    now = key.seconds + key.held;
    last = &key;
  }
  EXPECT_EQ(rests, (std::vector<std::string>{"T", "arms_down"}));
  // Stitches are as long as they were, and as far from their cloth.
  for (std::size_t n = 0; n < moving->notions.size(); ++n) {
    const TriangleMesh& mesh = moving->notions[n].mesh;
    for (const SpatialKeyframe& key : moving->motion)
      for (std::size_t f = 0; f < mesh.faces.size(); f += 7)
        for (std::size_t c = 0; c < 3; ++c) {
          const auto a = mesh.faces[f][c], b = mesh.faces[f][(c + 1) % 3];
          EXPECT_NEAR(distance(key.notions[n][a], key.notions[n][b]), distance(mesh.points[a], mesh.points[b]), 1e-4);
        }
  }
}

TEST(Animation, EndsWhereThePoseItselfLeads) {
  Dressed dressed;
  const Document& shirt = dressed.shirt();
  const auto moving = animationOf(shirt, {"T"}, dressed.context);
  ASSERT_TRUE(moving);
  PoseBody pose;
  pose.name = "T";
  const auto posed = apply(shirt, pose, dressed.context);
  ASSERT_TRUE(posed);
  const auto rested = apply(*posed, DrapePieces{}, dressed.context);
  ASSERT_TRUE(rested);
  std::size_t k = 0;
  for (const auto& [id, piece] : rested->pattern.pieces)
    EXPECT_EQ(farthestFrom(piece->form->space, moving->motion.back().pieces[k++]), 0) << piece->name;
}

TEST(Animation, RefusesBeforeTheLongWork) {
  Dressed dressed;
  dressed.context.drape = [](const Document&, const DrapePieces&, Context&) -> Result<DrapeOutcome> {
    ADD_FAILURE() << "nothing is to be draped";
    return refused(say("never"));
  };
  const auto refusal = [&](const Document& document, const std::vector<std::string>& poses) {
    const auto moving = animationOf(document, poses, dressed.context);
    return moving ? std::string("not refused") : text(moving.error().what);
  };
  EXPECT_NE(refusal(dressed.shirt(), {"T", "cartwheel"}).find("cartwheel"), std::string::npos);
  EXPECT_NE(refusal(dressed.shirt(), {}).find("which poses"), std::string::npos);
  EXPECT_NE(refusal(Document(), {"T"}).find("no piece yet"), std::string::npos);
  Document bodiless = dressed.shirt();
  bodiless.body = {};
  EXPECT_NE(refusal(bodiless, {"T"}).find("no body yet"), std::string::npos);
}

}  // namespace
}  // namespace karinui
