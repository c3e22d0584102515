// A scan of a pattern whose measures are known, scaled by its printed square and traced with the hand's own tools.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "design/workroom.h"
#include "karinui/design/print_image.h"
#include "karinui/design/share.h"
#include "karinui/session/session.h"
#include "karinui/session/table_frame_of.h"

namespace karinui {
namespace {

using Phase = PointerSample::Phase;

// A sheet of paper as a scanner sees it: strokes of a pen, of paper measured in metres from its lower left corner. The
// scanner lies at an angle, and says nothing of its resolution.
class Sheet {
 public:
  static constexpr double kDots = 300 / 0.0254;  // to the metre
  Sheet(double wide, double high, double turn) : turn_(turn), middle_{0.5 * wide, 0.5 * high} {
    image_.width = static_cast<int>(wide * kDots), image_.height = static_cast<int>(high * kDots);
    image_.rgb.assign(std::size_t{3} * static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height),
                      250);
  }
  // Where a place of the paper is seen, in pixels from the upper left corner.
  Flat seen(Flat paper) const {
    const Flat from = paper - middle_;
    const double c = std::cos(turn_), s = std::sin(turn_);
    return {0.5 * image_.width + (c * from.u - s * from.v) * kDots,
            0.5 * image_.height - (s * from.u + c * from.v) * kDots};
  }
  void stroke(Flat from, Flat to) {
    const Flat a = seen(from), b = seen(to);
    const int steps = static_cast<int>(2 * distance(a, b));
    for (int k = 0; k <= steps; ++k) {
      const Flat p = lerp(a, b, static_cast<double>(k) / steps);
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) ink(static_cast<int>(p.u) + dx, static_cast<int>(p.v) + dy);
    }
  }
  void ring(const std::vector<Flat>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) stroke(corners[i], corners[(i + 1) % corners.size()]);
  }
  const PrintPixels& image() const { return image_; }

 private:
  void ink(int x, int y) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x));
    for (std::size_t c = 0; c < 3; ++c) image_.rgb[at + c] = 20;
  }
  double turn_;
  Flat middle_;
  PrintPixels image_;
};

const std::vector<Flat> kPiece{{0.05, 0.03}, {0.24, 0.03}, {0.26, 0.13}, {0.20, 0.24}, {0.05, 0.22}};
const std::vector<Flat> kSquare{{0.16, 0.26}, {0.26, 0.26}, {0.26, 0.36}, {0.16, 0.36}};

// The hand on the table. It hits a pixel, not the middle of a line.
struct Tracing {
  Sheet sheet{0.30, 0.40, 3 * std::numbers::pi / 180};
  Session session;

  Tracing() {
    sheet.ring(kPiece);
    sheet.ring(kSquare);
    DocumentFile file = DocumentFile::inMemory();
    LayUnderlay lay;
    lay.photo = *file.blobs().put(packPrint(fitted(sheet.image(), kMostScanSide)));
    Workroom room;
    Context own{room.workers, room.token, file.blobs(), room.bodies, {}, {}};
    EXPECT_TRUE(file.perform(lay, own));
    session.begin(std::move(file));
    session.finish();
  }
  const Document& document() const { return session.snapshot().document; }
  const Underlay& scan() const { return document().underlays.begin()->second; }
  // Where the pixel of a place of the paper lies on the table now.
  Flat there(Flat paper) const {
    const Flat shown = sheet.seen(paper) * (static_cast<double>(scan().wide) / sheet.image().width);
    return scan().onTable({std::round(shown.u), std::round(shown.v)});
  }
  void feed(Flat place, Phase phase, bool control = false) {
    PointerSample sample;
    sample.where = PointerSample::Where::Table;
    sample.place = place, sample.reach = 0.0005, sample.phase = phase, sample.control = control;
    session.feed(sample);
  }
  void click(Flat place) {
    for (const Phase phase : {Phase::Hover, Phase::Press, Phase::Release}) feed(place, phase);
    session.finish();
  }
  std::string said() {
    std::string all;
    for (const Notice& notice : session.takeNotices()) all += text(notice.what) + "\n";
    return all;
  }
};

TEST(Trace, APieceTracedFromAScanHasTheLengthsOfThePaper) {
  Tracing t;
  t.session.command(Command::Trace);
  t.click(t.there(kSquare[0]));
  EXPECT_FALSE(t.session.dropMenu());
  t.click(t.there(kSquare[1]));
  ASSERT_TRUE(t.session.dropMenu()) << t.said();
  t.session.chooseNumber(10);
  t.session.finish();
  EXPECT_EQ(t.session.steps().size(), 2u) << t.said();
  EXPECT_NEAR(t.scan().pixel() * t.scan().wide, 0.30, 0.0005);
  // Stood upright along the piece's left side.
  t.click(t.there(kPiece[4]));
  t.click(t.there(kPiece[0]));
  t.session.choose(2);
  t.session.finish();
  EXPECT_NEAR(t.scan().turn, -3 * std::numbers::pi / 180, 0.002) << t.said();

  t.session.command(Command::Polygon);
  for (const Flat corner : kPiece) t.click(t.there(corner));
  t.session.command(Command::Confirm);
  t.session.finish();
  const Piece* piece = t.document().pieceNamed("polygon");
  ASSERT_TRUE(piece) << t.said();
  ASSERT_EQ(piece->outline.edges.size(), kPiece.size());
  for (std::size_t i = 0; i < kPiece.size(); ++i)
    EXPECT_NEAR(piece->outline.edges[i].curve.length(), distance(kPiece[i], kPiece[(i + 1) % kPiece.size()]), 0.0005)
        << i;
  // It lies on the scan, upright as it was traced.
  const Flat lies = t.session.table().at(piece->id);
  EXPECT_LT(distance(piece->outline.edges[0].curve.start + lies, t.there(kPiece[0])), 0.0002);
  TableLayout anew;
  anew.arrange(t.session.snapshot());
  EXPECT_EQ(anew.at(piece->id), lies) << "also when the document is opened again";
  EXPECT_LT(std::fabs(piece->outline.edges[4].curve.start.u - piece->outline.edges[4].curve.end.u), 0.0005);
}

TEST(Trace, AScanIsDraggedTurnedHiddenAndTakenOut) {
  Tracing t;
  t.session.command(Command::Trace);
  const Flat was = t.scan().at, hold = t.there(kPiece[0]);
  t.feed(hold, Phase::Press);
  t.feed(hold + Flat{0.07, 0.02}, Phase::Drag);
  const Preview preview = t.session.preview();
  EXPECT_NEAR(preview.underlays.at("scan").at.u, was.u + 0.07, 1e-4);
  EXPECT_EQ(tableFrameOf(t.session.snapshot(), t.session.table(), {}, {.underlays = preview.underlays}).scans[0].at,
            preview.underlays.at("scan").at);
  t.feed(hold + Flat{0.07, 0.02}, Phase::Release);
  t.session.finish();
  EXPECT_LT(distance(t.scan().at, was + Flat{0.07, 0.02}), 1e-5);
  const Flat middle = t.scan().at;
  t.feed(middle + Flat{0.1, 0}, Phase::Press, true);
  t.feed(middle + Flat{0, 0.1}, Phase::Drag, true);
  t.feed(middle + Flat{0, 0.1}, Phase::Release, true);
  t.session.finish();
  EXPECT_NEAR(t.scan().turn, std::numbers::pi / 2, 1e-4);
  EXPECT_EQ(t.scan().at, middle);
  t.session.perform(*parseOperation("underlay hidden=yes"));
  t.session.finish();
  EXPECT_TRUE(tableFrameOf(t.session.snapshot(), t.session.table()).scans.empty());
  t.click(middle);
  EXPECT_THAT(t.said(), testing::HasSubstr("There is no scan here"));
  t.session.perform(*parseOperation("underlay none=yes"));
  t.session.finish();
  EXPECT_TRUE(t.document().underlays.empty());
  EXPECT_FALSE(t.session.can(Command::Trace));
  t.session.command(Command::Undo);
  t.session.finish();
  EXPECT_EQ(t.document().underlays.size(), 1u);
}

// Told that it is twice as large, the scan would come to lie under a piece beside it: it goes aside.
TEST(Trace, AScanThatGrowsLiesUnderNoPiece) {
  Tracing t;
  const Underlay was = t.scan();
  const double right = was.at.u + was.width / 2;
  char line[200];
  std::snprintf(line, sizeof line, "rectangle name=beside width=20cm height=30cm");
  t.session.perform(*parseOperation(line));
  t.session.finish();
  const PieceId beside = t.document().pieceNamed("beside")->id;
  const auto low = [&] {
    FlatBox box;
    for (const auto& worn : t.session.snapshot().worn)
      for (const Flat p : worn.ring) box.include(p + t.session.table().at(worn.id));
    return box;
  };
  // Laid just right of the scan, by the hand.
  t.session.command(Command::Move);
  const Flat hold = lerp(low().low, low().high, 0.5);
  const Flat there{right + 0.12, was.at.v};
  t.feed(hold, Phase::Press);
  t.feed(there, Phase::Drag);
  t.feed(there, Phase::Release);
  t.session.finish();
  ASSERT_GT(low().low.u, right) << t.said() << text(beside);
  t.session.command(Command::Trace);
  t.click(t.there(kSquare[0]));
  t.click(t.there(kSquare[1]));
  t.session.chooseNumber(3 * 100 * distance(t.there(kSquare[0]), t.there(kSquare[1])));
  t.session.finish();
  EXPECT_NEAR(t.scan().width, 3 * was.width, 1e-4) << t.said();
  EXPECT_LT(t.scan().at.u + t.scan().width / 2, low().low.u) << "left of the piece";
  EXPECT_EQ(t.session.steps().size(), 3u) << "one step";
}

TEST(Trace, FourCornersAreTypedAsARectangle) {
  Tracing t;
  t.session.command(Command::Trace);
  t.click(t.there(kSquare[0]));
  t.click(t.there(kSquare[1]));
  t.session.choose(3);
  t.click(t.there(kSquare[2]));
  t.click(t.there(kSquare[3]));
  auto asked = t.session.takeAsked();
  ASSERT_TRUE(asked) << t.said();
  auto lay = std::get<LayUnderlay>(*asked);
  ASSERT_EQ(lay.corners.size(), 4u);
  EXPECT_EQ(lay.rectangle, (Flat{0.21, 0.297}));
  lay.rectangle = Flat{0.1, 0.1};
  t.session.perform(lay);
  t.session.finish();
  EXPECT_EQ(t.session.steps().size(), 2u) << t.said();
  // As large as it is, and no longer at an angle.
  EXPECT_EQ(t.scan().turn, 0);
  EXPECT_NEAR(t.scan().width, 0.30, 0.04);
  EXPECT_NEAR(t.scan().height(), 0.40, 0.04);
}

// A sheet that lies across is offered so.
TEST(Trace, TheSidesOfASheetAreOfferedAsItLies) {
  Tracing t;
  t.session.command(Command::Trace);
  t.click(t.there({0.02, 0.02}));
  t.click(t.there({0.28, 0.02}));
  t.session.choose(3);
  t.click(t.there({0.28, 0.20}));
  t.click(t.there({0.02, 0.20}));
  const auto asked = t.session.takeAsked();
  ASSERT_TRUE(asked) << t.said();
  EXPECT_EQ(std::get<LayUnderlay>(*asked).rectangle, (Flat{0.297, 0.21}));
}

// Opened anew, what was traced lies on its scan, and what is drafted at the same place beside it.
TEST(Trace, NoPieceLiesOverAnotherOnAScan) {
  Tracing t;
  for (const char* line :
       {"underlay at=0,-10cm", "polygon name=one points=\"-5cm,-15cm; 5cm,-15cm; 5cm,-5cm; -5cm,-5cm\"",
        "polygon name=two points=\"-5cm,-15cm; 5cm,-15cm; 5cm,-5cm; -5cm,-5cm\""})
    t.session.perform(*parseOperation(line)), t.session.finish();
  ASSERT_EQ(t.document().pattern.pieces.size(), 2u) << t.said();
  TableLayout anew;
  anew.arrange(t.session.snapshot());
  const Flat one = anew.at(t.document().pieceNamed("one")->id), two = anew.at(t.document().pieceNamed("two")->id);
  EXPECT_EQ(one, Flat{}) << "on the scan";
  EXPECT_GT(std::max(std::fabs(two.u - one.u), std::fabs(two.v - one.v)), 0.1) << "clear of it";
}

TEST(Trace, ScansStayOutOfWhatIsGivenAway) {
  Tracing t;
  t.session.perform(*parseOperation("rectangle name=front width=30cm height=40cm"));
  t.session.finish();
  for (const Operation& step : sharedSteps(t.document())) EXPECT_NE(nameOf(step), "underlay");
  EXPECT_EQ(tableFrameOf(t.session.snapshot(), t.session.table()).scans.size(), 1u);
  EXPECT_TRUE(tableFrameOf(t.session.snapshot(), t.session.table(), {}, {.scans = false}).scans.empty());
}

}  // namespace
}  // namespace karinui
