// A drape that is stopped stays where it is, and is played again to the same bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/check/check.h"
#include "karinui/design/drape.h"

namespace karinui {
namespace {

constexpr const char* kTunic =
    "body size=jis9ar\nset spacing=30mm ease=12mm\n"
    "draw name=front symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
    "line=\"torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
    "torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0\"\n"
    "draw name=back symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" "
    "line=\"torso:neck_base@0.5; torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; landmark:shoulder_left; "
    "torso:armpit+0.5@0.34; torso:armpit@0.31; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; "
    "torso:hip@0.5\"\n"
    "sew a=front.shoulder_left b=back.shoulder_left\nsew a=front.shoulder_right b=back.shoulder_right\n"
    "sew a=front.side_left b=back.side_left\nsew a=front.side_right b=back.side_right\n";

TEST(StoppedDrape, IsKeptNotAtRestAndPlayedAgainToTheSameBits) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kTunic));
  const Document hung = file.document();
  int stopAt = 0;
  StopRequest* stop = nullptr;
  // Stops as a person does, from beside, when the solver has made so many steps.
  room.context.drape = [&](const Document& d, const DrapePieces& drape, Context& own) {
    int steps = 0;
    return drapeOnBody(d, drape, own, [&](const FormsNow&) {
      if (++steps == stopAt && stop) stop->ask();
    });
  };
  std::set<std::string> stands{drapeHash(hung)};
  DocumentFile other = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(other, std::string(kTunic) + "drape\n"));
  const int last = static_cast<int>(other.document().drape.last->steps);
  // While the seams are drawn together, while the coarse cloth drapes, on the finest level.
  for (const int at : {4, last / 2, last - 2}) {
    stopAt = at;
    StopRequest request;
    room.context.stop = stop = &request;
    const auto step = file.perform(DrapePieces{}, room.context);
    room.context.stop = stop = nullptr;
    ASSERT_TRUE(step) << text(step.error().what);
    EXPECT_EQ(std::get<DrapePieces>(step->operation).stop, at);
    const Document& document = file.document();
    EXPECT_EQ(document.drape.dirty.size(), 2u) << "both pieces are not at rest";
    EXPECT_FALSE(document.drape.last->settled);
    EXPECT_THAT(text(document.drape.last->why), testing::StartsWith("Stopped after"));
    EXPECT_TRUE(stands.insert(step->stand).second) << "the cloth went on to " << at;
    const auto standing = standingCloth(document, livePieces(document, {}));
    ASSERT_TRUE(standing);
    const ClothCheck found = check(standing->cloth, standing->state, nullptr);
    EXPECT_LT(found.strain.mean, 0.6) << "the finest cloth lies as the coarse one did";

    Workers three(3);
    Context own{three, room.token, room.blobs, room.bodies, {}, {}};
    const auto again = apply(hung, *parseOperation(text(step->operation)), own);
    ASSERT_TRUE(again) << text(again.error().what);
    EXPECT_EQ(drapeHash(*again), step->stand);
    EXPECT_EQ(hash(*again), step->after);
    ASSERT_TRUE(file.undo(room.context));
    EXPECT_EQ(drapeHash(file.document()), drapeHash(hung));
  }
}

TEST(StoppedDrape, GoesOnFromWhereItWas) {
  Workroom room;
  room.context.drape = {};
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, std::string(kTunic) + "drape stop=30\ndrape\n"));
  EXPECT_TRUE(file.document().drape.last->settled) << text(file.document().drape.last->why);
  EXPECT_TRUE(file.document().drape.dirty.empty());
  EXPECT_EQ(text(file.steps().back().operation).find("stop"), std::string::npos) << "nothing new where none was";
}

TEST(StoppedDrape, RefusesANegativeNumber) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kTwoPieces));
  EXPECT_FALSE(file.perform(*parseOperation("drape stop=-3"), room.context));
}

// What is frozen never drapes, so the garment rests without it: labels and pieces nobody recognised beside the figure.
TEST(StoppedDrape, WhatIsFrozenIsNotWaitedFor) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file,
                        "body size=jis9ar\nrectangle name=worn width=30cm height=20cm\n"
                        "rectangle name=label width=5cm height=3cm\nfreeze piece=label\n"));
  room.context.drape = [](const Document& document, const DrapePieces& drape, Context&) {
    return fallABit(document, drape.live);
  };
  ASSERT_TRUE(room.play(file, "drape\n"));
  EXPECT_TRUE(file.document().atRest());
  EXPECT_FALSE(file.document().drape.dirty.empty());
  ASSERT_TRUE(room.play(file, "freeze piece=label frozen=no\n"));
  EXPECT_FALSE(file.document().atRest());
  ASSERT_EQ(file.document().unrested().size(), 1u);
  EXPECT_EQ(file.document().find(file.document().unrested().front())->name, "label");
}

}  // namespace
}  // namespace karinui
