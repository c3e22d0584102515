// A garment whose figure takes a pose: carried along, never through the body, and back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "design/quick_folder.h"
#include "design/workroom.h"
#include "karinui/design/drape.h"
#include "karinui/design/dump.h"

namespace karinui {
namespace {

// The tunic of examples/first_tunic.ops on a coarse lattice, not draped yet.
std::string tunic() {
  std::ifstream file(std::string(KARINUI_SOURCE_DIR) + "/examples/first_tunic.ops");
  std::stringstream all;
  all << file.rdbuf();
  std::string script = all.str();
  return "set spacing=25mm\n" + script.substr(0, script.rfind("drape"));
}

// A workroom whose cloth is really draped.
struct Tailor {
  explicit Tailor(int threads = 1) : workers(threads) {}
  Workers workers;
  Token token;
  MemoryBlobs blobs;
  static Bodies& bodies() {  // figures are built once for all tests
    static Bodies all;
    return all;
  }
  Context context{workers, token, blobs, bodies(), {}, {}};

  Document after(Document document, const std::string& script) {
    const auto lines = parseScript(script);
    EXPECT_TRUE(lines) << text(lines.error().what);
    for (const ScriptLine& line : *lines) {
      auto next = apply(document, line.operation, context);
      EXPECT_TRUE(next) << text(line.operation) << ": " << text(next.error().what);
      if (next) document = *std::move(next);
    }
    return document;
  }
  const Document& rested() {
    static std::optional<Document> once;
    if (!once) once = after({}, tunic() + "drape\n");
    return *once;
  }
};

std::vector<Vec3> places(const Document& document) {
  std::vector<Vec3> all;
  for (const auto& [id, piece] : document.pattern.pieces)
    for (const Vec3& p : piece->form->space) all.push_back(piece->pose(p));
  return all;
}

double farthest(const Document& a, const Document& b) {
  const auto x = places(a), y = places(b);
  EXPECT_EQ(x.size(), y.size());
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, distance(x[i], y[i]));
  return most;
}

class GarmentInPose : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Each, GarmentInPose, testing::Values("T", "overhead", "seated", "bent"));

TEST_P(GarmentInPose, IsCarriedAlongOutsideTheBodyAndComesToRest) {
  Tailor tailor(2);
  const Document& start = tailor.rested();
  const Document carried = tailor.after(start, std::string("pose name=") + GetParam());
  EXPECT_EQ(carried.drape.dirty.size(), start.pattern.pieces.size());
  ClothCheck stands = examined(carried, tailor.context).value();
  EXPECT_TRUE(stands.finite);
  EXPECT_LT(stands.penetration, 0.0001);
  EXPECT_EQ(stands.clothBodyCrossings, 0u);
  EXPECT_LT(stands.seamGap, 0.001);
  EXPECT_LT(stands.strain.mean, 0.03);  // it was not dragged
  const Document draped = tailor.after(carried, "drape");
  EXPECT_TRUE(draped.drape.last->settled) << text(draped.drape.last->why);
  stands = examined(draped, tailor.context).value();
  EXPECT_LT(stands.penetration, 0.0001);
  EXPECT_EQ(stands.clothBodyCrossings, 0u);
  EXPECT_EQ(stands.clothClothCrossings, 0u);
  // It was near where it came to rest.
  EXPECT_LT(farthest(carried, draped), 0.08);
}

// What is told of a way, gathered.
struct Seen {
  std::vector<double> shares;
  std::vector<BodyPose> poses;
  double longest = 0;  // metres that a node has gone from one picture to the next
  double deepest = 0;  // metres of a node under the skin, looked at in some pictures
};
PoseOnlooker gathering(Seen& seen, const Document& start, const Skeleton& skeleton) {
  return [&seen, &skeleton, before = places(start)](const PoseUnderWay& way) mutable {
    std::vector<Vec3> here;
    for (const auto& [id, form] : way.forms()) here.insert(here.end(), form->space.begin(), form->space.end());
    ASSERT_EQ(here.size(), before.size());
    for (std::size_t i = 0; i < here.size(); ++i) seen.longest = std::max(seen.longest, distance(here[i], before[i]));
    before = here;
    ASSERT_EQ(way.skin, skeleton.points(skeleton.placements(way.pose)));
    if (seen.shares.size() < 4 || seen.shares.size() % 8 == 0) {
      const Bvh skin(TriangleMesh{way.skin, skeleton.body()->mesh().faces});
      for (const Vec3& p : here) seen.deepest = std::max(seen.deepest, -skin.signedDistance(p));
    }
    seen.shares.push_back(way.share);
    seen.poses.push_back(way.pose);
  };
}

TEST(PosedGarment, IsSeenOnTheWayOutsideTheBody) {
  Tailor tailor(2);
  const Document& start = tailor.rested();
  const auto skeleton = tailor.bodies().skeleton(start.body, tailor.blobs, tailor.workers, tailor.token).value();
  for (const char* name : {"overhead", "seated"}) {
    SCOPED_TRACE(name);
    const std::string line = std::string("pose name=") + name;
    const Document unseen = tailor.after(start, line);
    Seen seen;
    tailor.context.onPose = gathering(seen, start, *skeleton);
    const Document arrived = tailor.after(start, line);
    tailor.context.onPose = {};
    // Looking changes nothing.
    EXPECT_EQ(hash(arrived), hash(unseen));
    EXPECT_EQ(drapeHash(arrived), drapeHash(unseen));

    ASSERT_GT(seen.shares.size(), 40u);
    EXPECT_LT(seen.shares.front(), 0.05) << "it begins at once";
    EXPECT_TRUE(std::is_sorted(seen.shares.begin(), seen.shares.end(), std::less_equal<>())) << "and never goes back";
    EXPECT_EQ(seen.shares.back(), 1);
    const BodyPose from = skeleton->whole({}), to = skeleton->whole(arrived.body.pose);
    EXPECT_EQ(seen.poses.back(), to);
    for (const BodyPose& pose : seen.poses)
      for (const auto& [joint, angles] : pose) {
        const double low = std::min(from.at(joint).abduct, to.at(joint).abduct),
                     high = std::max(from.at(joint).abduct, to.at(joint).abduct);
        EXPECT_TRUE(angles.abduct >= low - 1e-9 && angles.abduct <= high + 1e-9);
      }
    // No part of the way moves cloth farther than the body moves in it and a step of the solver: nothing jumps.
    EXPECT_LT(seen.longest, 0.03);
    EXPECT_LT(seen.deepest, 0.001) << "not even where a thigh is folded against the belly";
  }
}

TEST(PosedGarment, AFigureWithoutClothIsSeenOnTheWayToo) {
  Tailor tailor;
  const Document bare = tailor.after({}, "body size=jis9ar");
  std::vector<double> shares;
  tailor.context.onPose = [&](const PoseUnderWay& way) {
    EXPECT_TRUE(way.forms().empty());
    shares.push_back(way.share);
  };
  (void)tailor.after(bare, "pose name=T");
  EXPECT_EQ(shares, (std::vector{0.25, 0.5, 0.75}));
}

TEST(PosedGarment, StoppedOnTheWayNothingIsChanged) {
  Tailor tailor(2);
  auto file = DocumentFile::inMemory();
  const auto lines = parseScript(tunic() + "drape\n").value();
  for (const ScriptLine& line : lines) ASSERT_TRUE(file.perform(line.operation, tailor.context));
  const std::string before = hash(file.document()) + drapeHash(file.document());
  const std::size_t steps = file.steps().size();
  for (const int stopAt : {1, 3, 20}) {
    Token token;
    Context context{tailor.workers, token, file.blobs(), Tailor::bodies(), {}, {}};
    int pictures = 0;
    context.onPose = [&](const PoseUnderWay&) {
      if (++pictures == stopAt) token.cancel();
    };
    PoseBody op;
    op.name = "overhead";
    const auto step = file.perform(op, context);
    ASSERT_FALSE(step);
    EXPECT_EQ(step.error().kind, Error::Kind::Cancelled);
    EXPECT_EQ(file.steps().size(), steps);
    EXPECT_EQ(hash(file.document()) + drapeHash(file.document()), before);
    EXPECT_LE(pictures, stopAt + 1);
  }
}

TEST(PosedGarment, IsTheSameForAnyNumberOfThreads) {
  Tailor one(1), three(3);
  const Document& start = one.rested();
  const Document a = one.after(start, "pose joint=shoulder abduct=75deg"),
                 b = three.after(start, "pose joint=shoulder abduct=75deg");
  EXPECT_EQ(drapeHash(a), drapeHash(b));
  EXPECT_EQ(hash(a), hash(b));
  EXPECT_NE(hash(a), hash(start));
}

TEST(PosedGarment, TakesUpTheDrapeItHadInAPose) {
  Tailor tailor(2);
  const Document& start = tailor.rested();
  const Document raised = tailor.after(start, "pose name=T\ndrape");
  const Document back = tailor.after(raised, "pose name=A");
  EXPECT_EQ(hash(back), hash(start));
  EXPECT_EQ(drapeHash(back), drapeHash(start));
  EXPECT_TRUE(back.drape.dirty.empty());
  EXPECT_TRUE(back.drape.last->settled);
  // And so in T.
  EXPECT_EQ(drapeHash(tailor.after(back, "pose name=T")), drapeHash(raised));
  // Neither colours nor names nor counts are felt by the cloth.
  const Document dyed =
      tailor.after(raised,
                   "look fabric=cotton colour=7a1f2b print=stripe repeat=3cm\nrename piece=front to=bodice\n"
                   "quantity piece=back count=2\nease seam=" +
                       text(raised.pattern.seams.begin()->first) + " by=3mm");
  const Document dyedBack = tailor.after(dyed, "pose name=A");
  EXPECT_EQ(drapeHash(dyedBack), drapeHash(start));
  EXPECT_TRUE(dyedBack.drape.dirty.empty());
  EXPECT_EQ(dyedBack.looks, dyed.looks);
  // As kept long ago, by the hash of the whole document.
  Document kept = raised;
  kept.drape.rested.at(0).garment = hash(start);
  EXPECT_EQ(drapeHash(tailor.after(kept, "pose name=A")), drapeHash(start));
  // A garment that was changed meanwhile is carried back.
  const Document altered = tailor.after(raised, "notch edge=front.side_left at=0.5");
  EXPECT_FALSE(tailor.after(altered, "pose name=A").drape.dirty.empty());
}

TEST(PosedGarment, ThatWasNeverDrapedIsCarriedAsRigidPieces) {
  Tailor tailor;
  const Document flat = tailor.after({},
                                     "body size=eu38\npiece name=sleeve outline=\"M 0 0; wrist L 200 0; under L 200 "
                                     "300; cap L 0 300; over L 0 0\"\nplace piece=sleeve "
                                     "at=\"left_arm:elbow+0.5@0\" ease=1cm");
  const Document carried = tailor.after(flat, "pose joint=left_shoulder abduct=90deg");
  const auto stands = [](const Document& document, Flat place) {
    return Stand(*document.pattern.pieces.begin()->second)(place);
  };
  const Flat a{0.02, 0.02}, b{0.18, 0.28}, c{0.1, 0.15};
  EXPECT_NEAR(distance(stands(carried, a), stands(carried, b)), distance(stands(flat, a), stands(flat, b)), 1e-6);
  EXPECT_NEAR(distance(stands(carried, a), stands(carried, c)), distance(stands(flat, a), stands(flat, c)), 1e-6);
  EXPECT_GT(distance(stands(carried, a), stands(flat, a)), 0.05);
  // It is as far from the arm as before.
  const auto off = [&](const Document& document) {
    return bodyOf(document, tailor.context).value()->bvh().nearest(stands(document, c))->distance;
  };
  EXPECT_NEAR(off(carried), off(flat), 0.005);
}

TEST(PosedGarment, StandsOnNoDressForm) {
  Tailor tailor;
  const Document form = tailor.after({}, "body size=jis9ar form=yes"),
                 raised = tailor.after({}, "body size=jis9ar\npose name=T");
  const auto refusal = [&](const Document& document, const char* line) {
    const auto next = apply(document, parseScript(line).value().front().operation, tailor.context);
    return next ? std::string() : text(next.error().what);
  };
  EXPECT_THAT(refusal(form, "pose name=T"), testing::HasSubstr("takes no pose"));
  EXPECT_THAT(refusal(raised, "body size=jis9ar form=yes"),
              testing::AllOf(testing::HasSubstr("takes no pose"), testing::HasSubstr("pose name=A")));
}

TEST(PosedGarment, IsKeptWithItsPoseAndItsDrapes) {
  const auto folder = quickFolder();
  const auto path = folder / "tunic.karinui";
  Tailor tailor(2);
  const auto play = [&](DocumentFile& file, const std::string& script) {
    const auto lines = parseScript(script);
    ASSERT_TRUE(lines) << text(lines.error().what);
    for (const ScriptLine& line : *lines) {
      const auto step = file.perform(line.operation, tailor.context);
      ASSERT_TRUE(step) << text(step.error().what);
    }
  };
  std::string posed, back;
  {
    auto file = DocumentFile::create(path).value();
    play(file, tunic() + "drape\npose name=T\ndrape\npose joint=left_elbow flex=60deg\n");
    posed = hash(file.document()) + drapeHash(file.document());
    EXPECT_EQ(file.document().drape.rested.size(), 2u);
  }
  {
    auto file = DocumentFile::open(path).value();
    EXPECT_EQ(hash(file.document()) + drapeHash(file.document()), posed);
    EXPECT_EQ(file.document().drape.rested.size(), 2u);
    ASSERT_TRUE(file.undo(tailor.context));
    ASSERT_TRUE(file.undo(tailor.context));
    ASSERT_TRUE(file.undo(tailor.context));
    const std::string first = drapeHash(file.document());
    ASSERT_TRUE(file.redo(tailor.context));
    ASSERT_TRUE(file.redo(tailor.context));
    ASSERT_TRUE(file.redo(tailor.context));
    play(file, "pose name=A\n");
    EXPECT_EQ(drapeHash(file.document()), first);
    back = hash(file.document()) + drapeHash(file.document());
  }
  const auto dump = dumped(path);
  ASSERT_TRUE(dump) << text(dump.error().what);
  const auto again = folder / "again.karinui";
  ASSERT_TRUE(loadDump(*dump, again));
  const auto file = DocumentFile::open(again).value();
  EXPECT_EQ(hash(file.document()) + drapeHash(file.document()), back);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace karinui
