// A piece wrapped round a limb stands off that limb alone, not off the trunk beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "design/standing.h"
#include "design/workroom.h"
#include "karinui/pattern/truing.h"

namespace karinui {
namespace {

class Placed : public ::testing::Test {
 protected:
  static Workroom& room() {
    static Workroom shared;  // the figure is built once
    return shared;
  }
  // A rectangle of this width and length (millimetres), placed with a centimetre of ease: how far its points are from
  // the skin, ordered.
  std::vector<double> gaps(const std::string& width, const std::string& tall, const std::string& at) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(file, "body size=jis9ar\npiece name=tube outline=\"M 0 0; hem L " + width +
                                            " 0; a L " + width + " " + tall + "; top L 0 " + tall +
                                            "; b L 0 0\"\nplace piece=tube at=\"" + at + "\" ease=12mm\n");
    EXPECT_TRUE(done) << text(done.error().what);
    std::vector<double> out;
    if (!done) return out;
    const auto body = bodyOf(file.document(), room().context);
    const Piece& piece = *file.document().pieceNamed("tube");
    for (const Vec3 p : piece.form->space) out.push_back((*body)->bvh().signedDistance(p));
    std::sort(out.begin(), out.end());
    return out;
  }
};

TEST_F(Placed, ASleeveStandsOffTheUpperArm) {
  for (const char* at : {"left_arm:elbow-0.4@0.25", "right_arm:elbow-0.4@0.75"}) {
    const auto off = gaps("300", "150", at);
    ASSERT_FALSE(off.empty());
    EXPECT_GT(off.front(), 0.003) << at;          // nothing touches
    EXPECT_LT(off[off.size() / 2], 0.020) << at;  // most of it is near: the trunk has not widened it
    EXPECT_LT(off.back(), 0.040) << at;
  }
}

TEST_F(Placed, ASleeveUpToTheShoulderIsNotWidenedByTheTrunk) {
  for (const char* at : {"left_arm:armpit-0.2@0.25", "right_arm:armpit-0.4@0.75"}) {
    const auto off = gaps("340", "240", at);
    ASSERT_FALSE(off.empty());
    EXPECT_LT(off[off.size() / 2], 0.025) << at;
    EXPECT_LT(off.back(), 0.06) << at;
  }
}

TEST_F(Placed, ALegOfTrousersStandsOffTheThighAndOffTheCalf) {
  for (const auto& [at, width] : {std::pair{"left_leg:knee-0.5@0.25", "520"}, {"right_leg:knee+0.4@0.5", "380"}}) {
    const auto off = gaps(width, "120", at);
    ASSERT_FALSE(off.empty());
    EXPECT_GT(off.front(), 0.004) << at;
    EXPECT_LT(off[off.size() / 2], 0.020) << at;
  }
}

TEST_F(Placed, ABandGoesRoundTheWaist) {
  const auto off = gaps("700", "40", "torso:waist@0.1");
  ASSERT_FALSE(off.empty());
  EXPECT_GT(off.front(), 0.004);
  EXPECT_LT(off[off.size() / 2], 0.025);
}

// A sector of a ring stands as a cone: the cloth is bent, not stretched, off the body, and its two sides do not meet.
TEST_F(Placed, ASectorOfARingGoesRoundTheWaistAsACone) {
  auto file = DocumentFile::inMemory();
  const Done done =
      room().play(file,
                  "body size=jis9ar\nring name=skirt inner=70cm depth=40cm angle=100deg\nplace piece=skirt "
                  "at=\"torso:waist@0\" point=0,-41cm ease=1cm\n");
  ASSERT_TRUE(done) << text(done.error().what);
  const auto body = bodyOf(file.document(), room().context);
  const Piece& piece = *file.document().pieceNamed("skirt");
  const Form& form = *piece.form;
  double least = 1, worst = 0;
  for (const Vec3 p : form.space) least = std::min(least, (*body)->bvh().signedDistance(p));
  EXPECT_GT(least, 0.002);
  for (const Triangle& face : form.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = face[i], b = face[(i + 1) % 3];
      const double paper = distance(form.flat[a], form.flat[b]), space = distance(form.space[a], form.space[b]);
      worst = std::max(worst, std::abs(space / paper - 1));
    }
  EXPECT_LT(worst, 0.02);
  // It goes nearly all round: its sides are near each other behind.
  const auto end = [&](const char* edge) { return Stand(piece)(findEdge(piece, edge)->curve.atFraction(0.5)); };
  EXPECT_LT(end("side_left").z, 0);
  EXPECT_LT(end("side_right").z, 0);
  EXPECT_GT(distance(end("side_left"), end("side_right")), 0.001);
}

// Where the cone would meet the arms, as a half circle does, it stands upright before the place.
TEST_F(Placed, AHalfCircleStandsClearOfTheArms) {
  auto file = DocumentFile::inMemory();
  const Done done =
      room().play(file,
                  "body size=jis9ar\nring name=skirt inner=35cm depth=60cm angle=180deg\nplace piece=skirt "
                  "at=\"torso:waist@0\" point=0,-12cm ease=1cm\n");
  ASSERT_TRUE(done) << text(done.error().what);
  const auto body = bodyOf(file.document(), room().context);
  for (const Vec3 p : file.document().pieceNamed("skirt")->form->space)
    ASSERT_GT((*body)->bvh().signedDistance(p), 0.002);
}

// A cape goes over the arms: each half is a cone round the neck, clear of the body.
TEST_F(Placed, ACapeStandsOverTheArms) {
  auto file = DocumentFile::inMemory();
  const Done done = room().play(file,
                                "body size=eu38\nring name=cape inner=24cm angle=130deg depth=70cm\nplace piece=cape "
                                "at=\"torso:neck_base@0.25\" ease=2cm\n");
  ASSERT_TRUE(done) << text(done.error().what);
  const auto body = bodyOf(file.document(), room().context);
  const Form& form = *file.document().pieceNamed("cape")->form;
  double low = 10, high = 0, front = 0, back = 0;
  for (const Vec3 p : form.space) {
    ASSERT_GT((*body)->bvh().signedDistance(p), 0.002);
    low = std::min(low, p.y), high = std::max(high, p.y);
    front = std::max(front, p.z), back = std::min(back, p.z);
  }
  EXPECT_LT(high - low, 0.5) << "it spreads over the arms and does not hang beside them";
  EXPECT_GT(front, 0.3);
  EXPECT_LT(back, -0.3);
  for (const Triangle& face : form.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const double paper = distance(form.flat[face[i]], form.flat[face[(i + 1) % 3]]);
      ASSERT_NEAR(distance(form.space[face[i]], form.space[face[(i + 1) % 3]]), paper, 0.03 * paper);
    }
}

// A long sleeve that narrows goes round the arm with its two sides beside each other under it, all the way to the
// wrist and its length kept; wrapped as a
// cylinder, its sides are further apart there.
TEST_F(Placed, ATaperedSleeveClosesUnderTheArm) {
  const auto placed = [&](const std::string& taper) {
    auto file = DocumentFile::inMemory();
    const Done done =
        room().play(file,
                    "body size=jis9ar\npiece name=sleeve outline=\"M 60 0; hem L 370 0; front L 430 420; top "
                    "L 0 420; back L 60 0\"\nplace piece=sleeve at=\"left_arm:armpit+0.2@0.25\" "
                    "point=21cm,41cm ease=1cm taper=" +
                        taper + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
    return *file.document().pieceNamed("sleeve");
  };
  const auto apart = [](const Piece& piece, double share) {
    const Stand stand(piece);
    const auto at = [&](const char* edge, double t) { return stand(findEdge(piece, edge)->curve.atFraction(t)); };
    return distance(at("front", share), at("back", 1 - share));
  };
  const Piece piece = placed("yes");
  EXPECT_GT(apart(placed("no"), 0), 0.06);
  for (const double share : {0.0, 0.3, 0.6, 1.0}) EXPECT_LT(apart(piece, share), 0.035) << share;
  const Flat low{0.21, 0.01}, high{0.21, 0.41};
  EXPECT_NEAR(distance(Stand(piece)(low), Stand(piece)(high)), 0.4, 0.03);
}

// A second skirt placed over a first is wider than it.
TEST_F(Placed, OverTheClothThatIsThere) {
  const auto furthest = [](const char* over) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(
        file, std::string("body size=jis9ar\nrectangle name=in width=80cm height=20cm\nrectangle name=out width=40cm "
                          "height=15cm\nplace piece=in at=\"torso:waist@0\" ease=4cm\nplace piece=out "
                          "at=\"torso:waist@0\" ease=1cm ") +
                  over + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
    double most = 0;
    for (const Vec3 p : file.document().pieceNamed("out")->form->space) most = std::max(most, p.z);
    return most;
  };
  EXPECT_GT(furthest("over=yes"), furthest("over=no") + 0.02);
}

// A collar's low edge lies along its neckline, whichever way round the run was listed.
TEST_F(Placed, ABandIsLedToItsRun) {
  for (const char* run : {"front.hem back.hem", "back.hem front.hem"}) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(
        file, std::string("body size=jis9ar\nrectangle name=front width=41cm height=8cm edges=\"hem l top r\"\n"
                          "rectangle name=back width=41cm height=8cm edges=\"hem r top l\"\n"
                          "place piece=front at=\"torso:waist@0\" ease=2cm\nplace piece=back "
                          "at=\"torso:waist@0.5\" ease=2cm\nsew a=front.l b=back.l\nsew a=front.r b=back.r\n"
                          "band name=cuff of=\"") +
                  run + "\" depth=5cm sew=yes\n");
    ASSERT_TRUE(done) << text(done.error().what);
    const Document& document = file.document();
    const Seam& seam = document.pattern.seams.rbegin()->second;
    EXPECT_EQ(document.pattern.seams.size(), 4u);  // the band's ends too: the run goes all round
    EXPECT_EQ(seam.a.front().edge, "end_left");
    const Piece& cuff = *document.pieceNamed("cuff");
    double away = 1;
    const Vec3 low = Stand(cuff)(findEdge(cuff, "low")->curve.atFraction(0.25));
    for (const char* name : {"front", "back"})
      for (const Flat p : findEdge(*document.pieceNamed(name), "hem")->curve.evenly(0, 1, 50))
        away = std::min(away, distance(low, Stand(*document.pieceNamed(name))(p)));
    EXPECT_LT(away, 0.015);
    // It goes on from the cloth: downwards from a hem.
    EXPECT_LT(Stand(cuff)(findEdge(cuff, "top")->curve.atFraction(0.25)).y, low.y - 0.03);
  }
}

// Named in whatever order, a waistband begins where the trousers open.
TEST_F(Placed, ABandBeginsAtTheOpening) {
  for (const char* run : {"leg_front_left.waist* leg_back_left.waist* leg_back_right.waist* leg_front_right.waist*",
                          "leg_back_left.waist* leg_front_right.waist* leg_front_left.waist* leg_back_right.waist*"}) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(
        file, std::string("body size=eu38\nblock kind=trousers ease=8cm\nunsew seam=crotch_front\n"
                          "sew a=leg_front_left.crotch@0.5:1 b=leg_front_right.crotch@0:0.5 name=crotch_front\n"
                          "band name=waistband depth=4cm sew=yes extra=3cm of=\"") +
                  run + "\"\n");
    ASSERT_TRUE(done) << text(done.error().what);
    const Document& document = file.document();
    const Seam& seam = document.pattern.seams.rbegin()->second;
    ASSERT_EQ(seam.b.size(), 8u) << run;
    EXPECT_EQ(document.find(seam.b.front().piece)->name, "leg_front_right") << run;
    EXPECT_EQ(document.find(seam.b.back().piece)->name, "leg_front_left") << run;
  }
}

// Where a run's edges stand apart a band goes round what they go round, not round the arm or leg that is nearest to the
// run's middle.
TEST_F(Placed, ABandGoesRoundWhatItsRunGoesRound) {
  constexpr const char* kGarments[] = {
      "body size=eu38\nblock kind=skirt ease=8cm length=60cm\n"
      "band name=band of=\"skirt_front.hem_left skirt_front.hem_right skirt_back.hem_left skirt_back.hem_right\" "
      "depth=20cm ratio=1.5 sew=yes\n",
      "body size=eu38 set=\"belly_girth=104cm\"\nblock kind=bodice ease=8cm\n"
      "cut piece=front line=\"-40cm,5cm; 40cm,5cm\" name=front_low\n"
      "cut piece=back line=\"-40cm,5cm; 40cm,5cm\" name=back_low\n"
      "band name=band of=\"front.cut front.cut_2 front.cut_3 back.cut back.cut_2 back.cut_3\" depth=48cm ratio=1.4 "
      "sew=yes\n"};
  for (const char* garment : kGarments) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(file, garment);
    ASSERT_TRUE(done) << text(done.error().what);
    const Document& document = file.document();
    const Piece& band = *document.pieceNamed("band");
    Vec3 middle;
    for (const Vec3 p : band.form->space) middle += p * (1.0 / static_cast<double>(band.form->space.size()));
    EXPECT_NEAR(middle.x, 0, 0.03) << garment;
    const auto sewn = std::find_if(document.pattern.seams.begin(), document.pattern.seams.end(), [&](const auto& seam) {
      return seam.second.a.front().piece == band.id && seam.second.a.front().edge == "low";
    });
    ASSERT_NE(sewn, document.pattern.seams.end());
    const EdgeSpan& first = sewn->second.b.front();
    const Piece& hem = *document.find(first.piece);
    EXPECT_NEAR(Stand(band)(findEdge(band, "low")->curve.atFraction(0.5)).y,
                Stand(hem)(findEdge(hem, first.edge)->curve.atFraction(0.5)).y, 0.02)
        << garment;
    // Where it goes is recorded; a record without stands where it stood.
    EXPECT_NE(file.log().find(" round="), std::string::npos) << garment;
  }
}

// Half a cape whose neckline is drawn for the neck goes round it, and not round the neck and two centimetres of ease.
TEST_F(Placed, AConeThatIsTooTightSaysThatEaseIsInTheWay) {
  const auto placed = [&](const char* ease) {
    auto file = DocumentFile::inMemory();
    const Done done =
        room().play(file, std::string("body size=jis9ar\nring name=cape inner=\"neck_base_girth/2 + 2cm\" "
                                      "angle=160deg depth=40cm\n"
                                      "place piece=cape at=torso:neck_base@0.25 ease=") +
                              ease + "\n");
    return done ? std::string() : text(done.error().what);
  };
  EXPECT_NE(placed("3cm").find("less ease"), std::string::npos) << placed("3cm");
  EXPECT_EQ(placed("2mm"), "");
  // So much longer as it says it stands there, and 2 mm less is still refused.
  const auto longer = [&](double mm) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(
        file, "body sex=child set=\"height=120cm\"\nring name=cape inner=\"neck_base_girth/2 + " + std::to_string(mm) +
                  "mm\" angle=130deg depth=45cm\nplace piece=cape at=torso:neck_base@0.25 ease=2cm\n");
    return done ? std::string() : text(done.error().what);
  };
  const std::string refused = longer(0);
  const std::size_t at = refused.find(" mm too short");
  ASSERT_NE(at, std::string::npos) << refused;
  const double missing = std::stod(refused.substr(refused.rfind(' ', at - 1)));
  EXPECT_GT(missing, 5);
  EXPECT_EQ(longer(missing), "");
  EXPECT_NE(longer(missing - 2), "");
}

// What is turned back lies over the body, and no farther down than that lets it: a flounce at the waist over the hips.
TEST_F(Placed, WhatIsTurnedBackStaysOutside) {
  Workroom own;
  auto file = DocumentFile::inMemory();
  const Done done = own.play(file,
                             "body size=eu38\nrectangle name=belt width=68cm height=3cm\n"
                             "place piece=belt at=\"torso:waist@0\" ease=5mm\n"
                             "ring name=flounce of=belt.top depth=18cm angle=150deg edges=\"hem left roll right\"\n"
                             "attach edge=flounce.roll to=belt.top turn=178deg turned=yes\n");
  ASSERT_TRUE(done) << text(done.error().what);
  const auto body = bodyOf(file.document(), own.context);
  const Piece &flounce = *file.document().pieceNamed("flounce"), &belt = *file.document().pieceNamed("belt");
  double nearest = 1, lowest = 10, top = 0;
  for (const Vec3 p : flounce.form->space) {
    nearest = std::min(nearest, (*body)->bvh().signedDistance(flounce.pose(p)));
    lowest = std::min(lowest, flounce.pose(p).y);
  }
  for (const Vec3 p : belt.form->space) top = std::max(top, belt.pose(p).y);
  EXPECT_GT(nearest, 0);
  EXPECT_LT(lowest, top - 0.1);  // it is turned down
}

// A collar is led by the one half of its neckline: the other half goes on beyond its end, as large as it is on paper.
TEST_F(Placed, WhatIsWiderThanItsEdgeIsNotCrushed) {
  Workroom own;
  auto file = DocumentFile::inMemory();
  ASSERT_TRUE(
      own.play(file,
               "piece name=back pose=0,1,0 outline=\"M -200 0; hem L 200 0; side L 200 400; neck_right L 0 400; "
               "neck_left L -200 400; other L -200 0\"\n"
               "polygon name=collar symmetric=yes points=\"0,0; 25cm,0; 25cm,15cm; 10cm,15cm; 0,15cm\" "
               "edges=\"fall end ~ neck fold\"\n"));
  const auto spaceShare = [&](const Document& document) {  // of the cloth that is half as large as on paper, at least
    const Piece& collar = *document.pieceNamed("collar");
    std::size_t kept = 0;
    for (const auto& face : collar.form->faces) {
      const auto flat = [&](std::size_t k) { return collar.form->flat[face[k]]; };
      const auto space = [&](std::size_t k) { return collar.form->space[face[k]]; };
      const double paper = std::fabs(cross(flat(1) - flat(0), flat(2) - flat(0)));
      kept += length(cross(space(1) - space(0), space(2) - space(0))) > 0.5 * paper ? 1 : 0;
    }
    return static_cast<double>(kept) / static_cast<double>(collar.form->faces.size());
  };
  const std::string line = "attach edge=collar.neck_left to=back.neck_left turn=170deg turned=yes";
  const Document before = file.document();
  const auto led = apply(before, op(line), own.context);
  ASSERT_TRUE(led) << text(led.error().what);
  EXPECT_DOUBLE_EQ(spaceShare(*led), 1);
  own.context.recorded = true;
  EXPECT_LT(spaceShare(*apply(before, op(line), own.context)), 0.7) << "a record keeps its meaning";
  EXPECT_DOUBLE_EQ(spaceShare(*apply(before, op(line + " beyond=yes"), own.context)), 1);
  own.context.recorded = false;
  ASSERT_TRUE(
      own.play(file, line + "\nrectangle name=cuff width=40cm height=5cm\nattach edge=cuff.bottom to=back.hem\n"));
  EXPECT_NE(file.log().find("turned=yes clear=yes beyond=yes"), std::string::npos) << file.log();
  EXPECT_EQ(file.log().find("back.hem beyond"), std::string::npos) << "nothing lies beyond";
}

// A curved hem is taken in as it is curved; its ends alone would leave a tongue between them.
TEST_F(Placed, ACurvedHemIsTakenInAsAWhole) {
  Workroom own;
  auto file = DocumentFile::inMemory();
  ASSERT_TRUE(own.play(file, "body size=eu38\nblock kind=shirt\n"));
  const auto hem = [&] { return findEdge(*file.document().pieceNamed("sleeve_left"), "hem")->curve; };
  const Curve before = hem();
  ASSERT_FALSE(before.between.empty());
  ASSERT_TRUE(own.play(file, "takein edges=sleeve_left.hem by=35mm follow=no\n"));
  const Curve after = hem();
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
    EXPECT_LT(distance(after.at(t) - before.at(t), {0, 0.035}), 2e-4) << t;
}

// A pocket whose line runs into a dart cannot be laid as cloth: that is said where it is sewn on.
TEST_F(Placed, APocketOverADartIsRefused) {
  const auto said = [](const std::string& at) {
    Workroom own;
    auto file = DocumentFile::inMemory();
    const Done done = own.play(file,
                               "body size=eu38\nblock kind=skirt\nrectangle name=pocket width=12cm height=14cm\n"
                               "patch piece=pocket on=skirt_front at=10cm," +
                                   at + "\n");
    return done ? std::string() : text(done.error().what);
  };
  EXPECT_NE(said("-17.6cm").find("runs into an edge, a dart or another line of “skirt_front”"), std::string::npos);
  EXPECT_EQ(said("-20cm"), "");
}

// A block is cut as it is drafted: our own examiner finds nothing, and what is eased in is declared.
TEST_F(Placed, BlocksAreTrue) {
  for (const std::string figure :
       {"size=eu38", "size=jis9ar", "size=eu50", "size=eu38 set=\"bust_girth=110cm; hip_girth=118cm\""})
    for (const std::string kind :
         {"shirt", "skirt", "trousers", "leggings", "bodice", "sleeve", "bodice\nblock kind=sleeve"}) {
      Workroom own;
      auto file = DocumentFile::inMemory();
      const Done done = own.play(file, "body " + figure + "\nblock kind=" + kind + "\n");
      ASSERT_TRUE(done) << text(done.error().what);
      const Document& document = file.document();
      const TruingReport found = truing(document.pattern, document.eases);
      for (const SeamTruing& seam : found.seams) EXPECT_TRUE(seam.fits()) << figure << kind << text(seam.seam);
      for (const CornerTruing& corner : found.corners)
        EXPECT_TRUE(corner.smooth()) << figure << kind << text(corner.seam);
    }
}

// A crown that must fill a long armhole stands up like a wing; the ease that is named makes the sleeve wide enough.
TEST_F(Placed, ASleeveTooNarrowForItsArmholeIsToldOf) {
  const auto said = [](int underarm, const std::string& ease) {
    const std::string v = std::to_string(underarm);
    Workroom own;
    std::string told;
    own.context.advise = [&](const Advice& advice) { told += text(advice.what); };
    auto file = DocumentFile::inMemory();
    const Done done =
        own.play(file, "body size=eu38\npolygon name=front symmetric=yes points=\"0,0; 24cm,0; 24cm," + v +
                           "cm; 20cm,42cm; 7cm,46cm; 0,38cm\" edges=\"hem side armhole shoulder neck fold\"\n"
                           "duplicate piece=front name=back\nblock kind=sleeve" +
                           ease + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
    return told;
  };
  EXPECT_EQ(said(22, "").find("its crown is"), std::string::npos);
  const std::string told = said(13, "");
  const std::size_t ease = told.find("state ease=");
  ASSERT_NE(ease, std::string::npos) << told;
  const std::string stated = " " + told.substr(ease + 6, told.find("cm", ease) + 2 - ease - 6);
  EXPECT_EQ(said(13, stated).find("its crown is"), std::string::npos) << stated;
}

// Who raised the arms is not told to raise them.
TEST_F(Placed, WhatMeetsRaisedArmsIsToldWhatHelps) {
  const auto said = [](const std::string& pose) {
    Workroom own;
    std::string told;
    own.context.advise = [&](const Advice& advice) { told += text(advice.what); };
    auto file = DocumentFile::inMemory();
    const Done done = own.play(file, "body size=eu38\n" + pose +
                                         "rectangle name=sheet width=120cm height=60cm\n"
                                         "place piece=sheet at=\"torso:bust@0\"\n");
    EXPECT_TRUE(done) << text(done.error().what);
    return told;
  };
  EXPECT_NE(said("").find("raise the arms first"), std::string::npos) << said("");
  const std::string raised = said("pose name=T\n");
  EXPECT_NE(raised.find("stands through the body"), std::string::npos) << raised;
  EXPECT_EQ(raised.find("raise the arms first"), std::string::npos) << raised;
  EXPECT_NE(raised.find("before or behind the body: flat=yes"), std::string::npos) << raised;
}

TEST_F(Placed, ByAPlaceOfItsOwnPaper) {
  Workroom own;
  auto file = DocumentFile::inMemory();
  ASSERT_TRUE(own.play(file, "body size=eu38\nrectangle name=skirt width=40cm height=60cm\n"));
  const auto step = file.perform(op("place piece=skirt at=\"torso:hip@0\" point=0,156cm"), own.context);
  ASSERT_FALSE(step);
  EXPECT_EQ(
      text(step.error().what),
      "The place 0.0, 1560.0 mm lies beside the paper of “skirt”, which reaches from -200.0, 0.0 to 200.0, 600.0 mm.");
  EXPECT_TRUE(file.perform(op("place piece=skirt at=\"torso:hip@0\" point=0,60cm"), own.context));
}

// Over a belly wider than the hip a shirt is as wide as that, and its hem comes below it.
TEST_F(Placed, AShirtBlockGoesOverABelly) {
  const auto drafted = [](const std::string& figure) {
    Workroom own;
    auto file = DocumentFile::inMemory();
    const Done done = own.play(file, "body " + figure + "\nblock kind=shirt trued=no\n");
    EXPECT_TRUE(done) << text(done.error().what);
    double wide = 0, low = 0;  // from the centre; the hem below the waist
    for (const Edge& edge : file.document().pieceNamed("back")->outline.edges)
      for (double s = 0; s <= 1; s += 0.1)
        wide = std::max(wide, edge.curve.at(s).u), low = std::min(low, edge.curve.at(s).v);
    const auto body = bodyOf(file.document(), own.context);
    return std::array{wide, low, (*body)->measured().value.at("waist_height"),
                      (*body)->measured().value.at("belly_height")};
  };
  const auto usual = drafted("size=eu38"), belly = drafted("size=eu38 set=\"belly=104cm\"");
  EXPECT_NEAR(usual[0], (0.91 + 0.12) / 4, 0.005);
  EXPECT_NEAR(belly[0], (1.04 + 0.12) / 4, 0.005);
  EXPECT_NEAR(usual[1], -0.26, 1e-9);
  EXPECT_NEAR(belly[1], -0.26 - (belly[2] - belly[3]), 1e-6);
}

// Of cloth half as long again as the body is round, the end that is named lies on top of the other.
TEST_F(Placed, ClothGoesRoundMoreThanOnce) {
  for (const bool left : {true, false}) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(
        file,
        std::string(
            "body size=jis9ar\nrectangle name=kilt width=\"hip_girth*1.5\" height=40cm edges=\"hem left waist right\"\n"
            "place piece=kilt at=\"torso:waist@0.5\" point=\"0,39cm\" ease=1cm wrap=") +
            (left ? "left" : "right") + "\n");
    ASSERT_TRUE(done) << text(done.error().what);
    const Document& document = file.document();
    const Piece& kilt = *document.pieceNamed("kilt");
    EXPECT_LT(strained(kilt), 0.01);

    const auto& form = *kilt.form;
    const BodyPtr body = bodyOf(document, room().context).value();
    double least = 1;
    int compared = 0;
    for (std::size_t i = 0; i < form.flat.size(); ++i) {
      std::size_t beside = i;
      double near = 1;
      for (std::size_t j = 0; j < form.flat.size(); ++j)
        if (std::fabs(form.flat[i].u - form.flat[j].u) > 0.3 && distance(form.space[i], form.space[j]) < near)
          near = distance(form.space[i], form.space[j]), beside = j;
      least = std::fmin(least, near);
      EXPECT_GT(body->bvh().signedDistance(form.space[i]), 0.005);
      const bool atLeft = findEdge(kilt, "left")->curve.start.u - form.flat[i].u < 0.02;
      if (near > 0.03 || !atLeft) continue;
      EXPECT_EQ(body->bvh().signedDistance(form.space[i]) > body->bvh().signedDistance(form.space[beside]), left);
      ++compared;
    }
    EXPECT_GT(compared, 20);
    EXPECT_GT(least, 0.005) << "its turns keep clear of each other";
    EXPECT_LT(least, 0.02) << "and lie over each other";
  }
}

// A wrap skirt is cut from a ring: it is wound as a cone, its waist level at the waist and its sides over one another.
TEST_F(Placed, ARingIsWoundAsACone) {
  for (const char* top : {"side_left", "side_right"}) {
    auto file = DocumentFile::inMemory();
    const Done done =
        room().play(file, std::string("body size=eu38\nring name=skirt inner=\"waist_girth*1.35\" angle=150deg "
                                      "depth=60cm\nplace piece=skirt at=\"torso:waist@0.5\" ease=1cm wrap=") +
                              top + "\n");
    ASSERT_TRUE(done) << text(done.error().what);
    EXPECT_NE(file.log().find("cone=yes"), std::string::npos);
    const Document& document = file.document();
    const Piece& skirt = *document.pieceNamed("skirt");
    EXPECT_LT(strained(skirt), 0.02);
    const BodyPtr body = bodyOf(document, room().context).value();
    double low = 10, high = 0;
    for (const Vec3 p : skirt.form->space) EXPECT_GT(body->bvh().signedDistance(p), 0.003);
    const Stand stand(skirt);
    const auto at = [&](const char* edge, double share) {
      return stand(findEdge(skirt, edge)->curve.atFraction(share));
    };
    for (const double share : {0.05, 0.3, 0.5, 0.7, 0.95})
      low = std::fmin(low, at("waist", share).y), high = std::fmax(high, at("waist", share).y);
    EXPECT_LT(high - low, 0.05) << "the waist is level; round a cylinder it rises by 25 cm at its ends";
    EXPECT_GT(at("side_left", 0.5).z, 0) << "it laps in front";
    EXPECT_GT(at("side_right", 0.5).z, 0);
    const auto away = [&](const char* edge) { return body->bvh().signedDistance(at(edge, 0.5)); };
    EXPECT_EQ(away("side_left") > away("side_right"), std::string(top) == "side_left");
    // What an older program recorded stands as it stood.
    Context replay = room().context;
    replay.recorded = true;
    auto before = DocumentFile::inMemory();
    ASSERT_TRUE(room().play(before, "body size=eu38\nring name=skirt inner=90cm angle=150deg depth=60cm\n"));
    const auto kept = apply(before.document(),
                            op(std::string("place piece=skirt at=\"torso:waist@0.5\" ease=1cm wrap=") + top), replay);
    ASSERT_TRUE(kept) << text(kept.error().what);
    const Form& form = *kept->pieceNamed("skirt")->form;
    double tallest = 0;
    for (const Vec3 p : form.space) tallest = std::fmax(tallest, p.y);
    EXPECT_GT(tallest, high + 0.1);
  }
}

// What a belly is wider than the hip goes into the front of skirt, trousers and leggings; without a belly nothing does.
TEST_F(Placed, LowerBlocksGoOverABelly) {
  const auto drafted = [&](const std::string& figure, const std::string& kind) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(file, "body size=eu38" + figure + "\nblock kind=" + kind + " trued=no\n");
    EXPECT_TRUE(done) << text(done.error().what);
    return file.document();
  };
  const auto wide = [](const Document& document, const char* piece) {
    const FlatBox box = boxOf(document.pieceNamed(piece)->outline.flattened(1e-4));
    return box.high.u - box.low.u;
  };
  const std::string belly = " set=\"belly_girth=106cm\"";
  const Document skirt = drafted(belly, "skirt");
  const double hip = bodyOf(skirt, room().context).value()->measured().value.at("hip_girth");
  EXPECT_NEAR(wide(skirt, "skirt_front") - wide(skirt, "skirt_back"), 1.06 - hip, 2e-3);
  for (const char* kind : {"trousers", "leggings"}) {
    const Document with = drafted(belly, kind), without = drafted(belly, std::string(kind) + " belly=no");
    EXPECT_GT(wide(with, "leg_front_left"), wide(without, "leg_front_left") + 0.01) << kind;
    EXPECT_EQ(with.pieceNamed("leg_back_left")->outline, without.pieceNamed("leg_back_left")->outline) << kind;
  }
  for (const char* kind : {"skirt", "trousers", "leggings"}) {
    const Document yes = drafted("", kind), no = drafted("", std::string(kind) + " belly=no");
    for (const auto& [id, piece] : yes.pattern.pieces) EXPECT_EQ(piece->outline, no.find(id)->outline) << kind;
  }
}

// What nothing below the waist would hold up is drafted for the high hip, below the belly; any figure may have
// hipsters. A record from before stays at the waist.
TEST_F(Placed, LowerBlocksAreWornWhereTheyHold) {
  const auto drafted = [&](const std::string& figure, const std::string& block) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(file, "body " + figure + "\nblock trued=no " + block + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
    return file.document();
  };
  const auto said = [&](const Document& document, const char* key) {
    return bodyOf(document, room().context).value()->measured().value.at(key);
  };
  // How long the upper edge of a skirt is, and how high a piece reaches.
  const auto edge = [](const Document& document) {
    double all = 0;
    for (const char* piece : {"skirt_front", "skirt_back"})
      for (const Edge& one : document.pieceNamed(piece)->outline.edges)
        if (one.name.starts_with("waist")) all += one.curve.length();
    return all;
  };
  const auto high = [](const Document& document, const char* piece) {
    const Outline& outline = document.pieceNamed(piece)->outline;
    double top = -1e9;
    for (const Flat p : outline.flattened(1e-3)) top = std::max(top, Stand(*document.pieceNamed(piece))(p).y);
    return top;
  };
  const std::string stout = "sex=male set=\"height=176cm; bust=108cm; waist=112cm; hip=110cm\" ";
  const Document skirt = drafted(stout, "kind=skirt"), atWaist = drafted(stout, "kind=skirt worn=waist");
  EXPECT_NEAR(edge(skirt), said(skirt, "high_hip_girth") + 0.01, 0.015);
  EXPECT_GT(edge(atWaist), edge(skirt) + 0.03);
  const double top = high(drafted(stout, "kind=trousers"), "leg_front_left");
  EXPECT_GT(top, said(skirt, "hip_height") + 0.05);
  EXPECT_LT(top, said(skirt, "waist_height") - 0.03);
  const std::string usual = "size=eu38 ";
  for (const char* kind : {"skirt", "trousers", "leggings"}) {
    const std::string name = std::string("kind=") + kind;
    const Document holds = drafted(usual, name), waist = drafted(usual, name + " worn=waist");
    for (const auto& [id, piece] : holds.pattern.pieces)
      EXPECT_EQ(boxOf(piece->outline.flattened(1e-3)).high.v, boxOf(waist.find(id)->outline.flattened(1e-3)).high.v);
    EXPECT_LT(
        high(drafted(usual, name + " worn=high_hip"), kind == std::string("skirt") ? "skirt_front" : "leg_front_left"),
        high(waist, kind == std::string("skirt") ? "skirt_front" : "leg_front_left") - 0.08);
  }
}

// Whose arm would fill the armhole of the bodice has it deeper; a record from before has what it had.
TEST_F(Placed, AnArmHasRoomInItsArmhole) {
  const auto armhole = [&](const std::string& size, const std::string& more) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(file, "body size=" + size + "\nblock kind=bodice trued=no" + more + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
    const double arm = bodyOf(file.document(), room().context).value()->measured().value.at("upper_arm_girth");
    double all = -arm;
    for (const char* piece : {"front", "back"})
      all += findEdge(*file.document().pieceNamed(piece), "armhole_left")->curve.length();
    return all;
  };
  for (const char* size : {"child146", "eu50"}) {
    EXPECT_LT(armhole(size, " armhole=no"), 0.11) << size;
    EXPECT_NEAR(armhole(size, ""), 0.121, 0.002) << size;
  }
  EXPECT_GE(armhole("eu38", ""), 0.119);
}

// The front and the back of a gathered skirt stand before and behind the body in waves, side to side.
TEST_F(Placed, AWideFrontAndBackStandInWaves) {
  const std::string panels =
      "body size=jis9ar\nrectangle name=front width=\"hip_girth*1.2\" height=50cm edges=\"hem left waist right\"\n"
      "rectangle name=back width=\"hip_girth*1.2\" height=50cm edges=\"hem left waist right\"\n";
  auto file = DocumentFile::inMemory();
  const Done done = room().play(file, panels +
                                          "place piece=front at=\"torso:hip@0\" ease=2cm arc=0.5\n"
                                          "place piece=back at=\"torso:hip@0.5\" ease=2cm arc=0.5\n");
  ASSERT_TRUE(done) << text(done.error().what);
  const Piece &front = *file.document().pieceNamed("front"), &back = *file.document().pieceNamed("back");
  const auto body = bodyOf(file.document(), room().context);
  const auto side = [](const Piece& piece, const char* edge) {
    return Stand(piece)(findEdge(piece, edge)->curve.atFraction(0.5));
  };
  EXPECT_LT(distance(side(front, "left"), side(back, "right")), 0.03);
  EXPECT_LT(distance(side(front, "right"), side(back, "left")), 0.03);
  for (const Piece* piece : {&front, &back}) {
    EXPECT_LT(strained(*piece), 0.12);
    double furthest = 0;
    for (const Vec3 p : piece->form->space) {
      const double off = (*body)->bvh().signedDistance(p);
      EXPECT_GT(off, 0.005);
      furthest = std::fmax(furthest, off);
    }
    EXPECT_GT(furthest, 0.05) << "waves";
    EXPECT_LT(furthest, 0.25);
  }
}

// Each as one ring they stand in each other, which is told with the mend.
TEST_F(Placed, RingsInEachOtherAreTold) {
  Context context = room().context;
  std::vector<Advice> told;
  context.advise = [&](const Advice& advice) { told.push_back(advice); };
  Document document;
  for (const char* line : {"body size=jis9ar", "rectangle name=front width=110cm height=50cm",
                           "rectangle name=back width=110cm height=50cm", "place piece=front at=torso:hip@0 ease=2cm",
                           "place piece=back at=torso:hip@0.5 ease=2cm"}) {
    auto next = apply(document, op(line), context);
    ASSERT_TRUE(next) << text(next.error().what);
    document = *std::move(next);
  }
  ASSERT_EQ(told.size(), 1u);
  ASSERT_TRUE(told[0].mend);
  EXPECT_EQ(std::get<PlacePiece>(*told[0].mend).arc, 0.5);
  told.clear();
  ASSERT_TRUE(apply(document, op("place piece=back at=torso:hip@0.5 ease=2cm arc=0.5"), context));
  EXPECT_TRUE(told.empty());
}

}  // namespace
}  // namespace karinui
