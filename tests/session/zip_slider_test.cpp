// A zip is closed by its slider: drawn along it in space and on the table, by mouse and by keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/design/sewing.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

using Phase = PointerSample::Phase;
using ::testing::HasSubstr;

// Two panels beside each other, the zip upright between them at x = 0.2, from y = 1 to y = 1.3; it opens at the top.
const char* const kZipped =
    "piece name=over outline=\"M 0 0; hem L 200 0; centre L 200 300; neck L 0 300; side L 0 0\" pose=\"0,1,0.3\"\n"
    "piece name=under outline=\"M 0 0; hem L 200 0; side L 200 300; neck L 0 300; centre L 0 0\" pose=\"0.2,1,0.3\"\n"
    "fasten name=opening kind=zip a=over.centre b=under.centre reversed=yes from=top closed_length=10cm\n";

class ZipSlider : public ::testing::Test {
 protected:
  ZipSlider()
      : session([this] {
          SessionOptions options;
          options.autoSettle = false;
          options.drape = room.context.drape;
          return options;
        }()) {
    const auto lines = parseScript(kZipped);
    for (const ScriptLine& line : *lines) session.perform(line.operation);
    session.finish();
    session.setViewpoint(front());
  }
  static Viewpoint front() {
    Viewpoint from;
    from.eye = {0.2, 1.15, 2.3}, from.right = {1, 0, 0}, from.up = {0, 1, 0}, from.back = {0, 0, 1};
    from.distance = 2;
    return from;
  }
  static PointerSample towards(Phase phase, double x, double y) {
    PointerSample sample;
    sample.phase = phase;
    sample.ray.origin = front().eye;
    sample.ray.direction = normalized(Vec3{x, y, 0.3} - front().eye);
    sample.reach = 0.008;
    return sample;
  }
  double closed() {
    session.finish();
    const Document& now = session.snapshot().document;
    const Fastening& zip = now.allowances.fastenings.at("opening");
    return zip.zipped * lengthOf(now.pattern, zip);
  }
  Workroom room;
  Session session;
};

TEST_F(ZipSlider, IsDrawnAlongInSpace) {
  EXPECT_NEAR(closed(), 0.1, 1e-12);
  session.feed(towards(Phase::Hover, 0.2, 1.1));
  EXPECT_THAT(text(session.hint()), HasSubstr("Drag the slider"));
  ASSERT_EQ(session.preview().space.words.size(), 1u);
  const std::size_t had = session.steps().size();
  session.feed(towards(Phase::Press, 0.2, 1.1));
  session.feed(towards(Phase::Drag, 0.21, 1.152));
  session.feed(towards(Phase::Drag, 0.23, 1.207));
  EXPECT_THAT(session.preview().space.words.at(0).text, HasSubstr("20.5 cm"));
  EXPECT_EQ(session.steps().size(), had) << "nothing is done until it is let go";
  session.feed(towards(Phase::Release, 0.23, 1.207));
  EXPECT_NEAR(closed(), 0.205, 1e-9);
  EXPECT_EQ(session.steps().size(), had + 1);
  // Beyond its ends it is all closed, or all open.
  for (const auto& [y, is] : {std::pair(1.4, 0.3), std::pair(0.9, 0.0)}) {
    const double from = 1 + closed();
    session.feed(towards(Phase::Press, 0.2, from));
    session.feed(towards(Phase::Drag, 0.2, y));
    session.feed(towards(Phase::Release, 0.2, y));
    EXPECT_NEAR(closed(), is, 1e-9);
  }
  // Elsewhere on the edge, or not moved, the edge is chosen and nothing is done.
  const std::size_t steps = session.steps().size();
  for (const double y : {1.2, 1.0}) {
    session.feed(towards(Phase::Press, 0.2, y));
    session.feed(towards(Phase::Release, 0.2, y));
    ASSERT_TRUE(session.selection().edge);
    EXPECT_EQ(session.selection().edge->edge, "centre");
  }
  session.finish();
  EXPECT_EQ(session.steps().size(), steps);
}

TEST_F(ZipSlider, IsDrawnAlongOnTheTable) {
  const auto on = [&](Phase phase, double v) {
    PointerSample sample;
    sample.phase = phase, sample.where = PointerSample::Where::Table, sample.reach = 0.005;
    const Piece& over = *session.snapshot().document.pieceNamed("over");
    sample.place = Flat{0.2, v} + session.table().at(over.id);
    return sample;
  };
  session.feed(on(Phase::Press, 0.1));
  session.feed(on(Phase::Drag, 0.25));
  session.feed(on(Phase::Release, 0.25));
  EXPECT_NEAR(closed(), 0.25, 1e-9);
}

TEST_F(ZipSlider, IsDrawnAlongByKeys) {
  PointerSample with;
  with.reach = 0.008;
  int tabs = 0;
  session.strike(KeyStroke::Next, with);
  while (text(session.hint()).find("Drag the slider") == std::string::npos && ++tabs < 20)
    session.strike(KeyStroke::Next, with);
  ASSERT_LT(tabs, 20) << "Tab goes to the slider";
  session.strike(KeyStroke::Press, with);
  for (int k = 0; k < 5; ++k) session.strike(KeyStroke::Up, with);
  session.strike(KeyStroke::Press, with);
  EXPECT_NEAR(closed(), 0.15, 0.0051);
}

// What a zip leaves open of two edges is sewn to its very end, however the hand begins the stroke; a seam that ran a
// millimetre into the zip would draw the cloth to pieces.
TEST_F(ZipSlider, ASeamEndsWhereTheZipBegins) {
  session.perform(op("fasten name=opening none=yes"));
  session.perform(
      op("fasten name=opening kind=zip a=over.centre b=under.centre reversed=yes from=top length=20cm "
         "closed_length=0"));
  session.finish();
  session.command(Command::Sew);
  const std::size_t steps = session.steps().size();
  const auto on = [&](const char* piece, Phase phase, double u, double v) {
    PointerSample sample;
    sample.phase = phase, sample.where = PointerSample::Where::Table, sample.reach = 0.005;
    sample.place = Flat{u, v} + session.table().at(session.snapshot().document.pieceNamed(piece)->id);
    session.feed(sample);
  };
  for (const auto& [piece, u, from] : {std::tuple("over", 0.2, 0.106), std::tuple("under", 0.0, 0.096)}) {
    on(piece, Phase::Press, u, from);
    for (double v = from; v > 0.002; v -= 0.01) on(piece, Phase::Drag, u, v);
    on(piece, Phase::Release, u, 0.002);
  }
  session.finish();
  ASSERT_EQ(session.steps().size(), steps + 1);
  const auto* sewn = std::get_if<SewEdges>(&session.steps().back().operation);
  ASSERT_TRUE(sewn);
  EXPECT_NEAR(lengthOf(session.snapshot().document, sewn->a), 0.1, 1e-6);
  EXPECT_NEAR(lengthOf(session.snapshot().document, sewn->b), 0.1, 1e-6);
}

// The slider is seen: a plate across both sides, and its tab on what is closed.
TEST_F(ZipSlider, IsDrawn) {
  const auto& lines = session.snapshot().frame.lines;
  const auto plate = std::find_if(lines.begin(), lines.end(), [](const SceneLine& line) { return line.widthMm == 8; });
  ASSERT_NE(plate, lines.end());
  EXPECT_NEAR((plate->points.front().y + plate->points.back().y) / 2, 1.1, 0.0021);
  const auto tab = std::next(plate);
  ASSERT_NE(tab, lines.end());
  EXPECT_LT(tab->points.back().y, 1.09);
}

}  // namespace
}  // namespace karinui
