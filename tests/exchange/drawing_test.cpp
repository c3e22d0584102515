#include "karinui/exchange/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "patterns.h"

namespace karinui {
namespace {

using testing::HasSubstr;

CadPattern svgDrawing(const std::string& svg) {
  auto drawing = readDrawing(svg);
  EXPECT_TRUE(drawing) << (drawing ? "" : text(drawing.error().what));
  return drawing ? *std::move(drawing) : CadPattern{};
}
std::string refusal(const std::string& svg) {
  const auto drawing = readDrawing(svg);
  return drawing ? "" : text(drawing.error().what);
}
const Piece& onlyDrawn(const CadPattern& drawing) {
  EXPECT_EQ(drawing.pattern.pieces.size(), 1u);
  return *drawing.pattern.pieces.begin()->second;
}
std::string svg(const std::string& head, const std::string& body) { return "<svg " + head + ">" + body + "</svg>"; }
std::string own(const std::string& name) {
  return test::content(std::filesystem::path(KARINUI_SOURCE_DIR) / "tests/fuzz/corpus/svg" / name);
}

TEST(Drawing, ATestSquareIsNoPiece) {
  const std::string box = "<path d='M 0,0 L 100,0 L 100,100 L 0,100 Z'/>";
  for (const char* name : {"scale-square", "test square", "Calibration box"}) {
    const CadPattern drawing =
        svgDrawing(svg("width='400mm' height='400mm' viewBox='0 0 400 400'",
                       "<g id='front'><path d='M 0,200 L 300,200 L 300,400 L 0,400 Z'/></g><g id='" +
                           std::string(name) + "'>" + box + "</g>"));
    EXPECT_EQ(onlyDrawn(drawing).name, "front") << name;
  }
}

// One sentence tells of all pieces that have a cut line alone.
TEST(Drawing, CutLinesWithoutSeamLinesAreToldOnce) {
  std::string body;
  for (int k = 0; k < 10; ++k)
    body += "<g id='part" + std::to_string(k) + "'><path class='cut' d='M " + std::to_string(110 * k) +
            ",0 h 100 v 200 h -100 Z'/></g>";
  const CadPattern drawing = svgDrawing(svg("width='1100mm' height='200mm' viewBox='0 0 1100 200'", body));
  EXPECT_EQ(drawing.pattern.pieces.size(), 10u);
  ASSERT_EQ(drawing.notes.size(), 1u);
  EXPECT_THAT(text(drawing.notes[0]), HasSubstr("10 pieces have no seam line"));
  EXPECT_THAT(text(drawing.notes[0]), HasSubstr("“part0”, “part1”"));
}

// The same rectangle of 100 × 60 mm in every unit a drawing may be in.
TEST(Drawing, UnitsAreTold) {
  const std::string box = "<rect width='100' height='60'/>";
  for (const auto& [head, body] :
       {std::pair<std::string, std::string>{"width='200mm' height='100mm' viewBox='0 0 200 100'", box},
        {"width='20cm' height='10cm' viewBox='0 0 200 100'", box},
        {"width='10in' viewBox='0 0 254 127'", box},
        {"width='756' height='378' viewBox='0 0 200.025 100.0125'", box},
        {"width='756' height='378'", "<g transform='scale(3.7795275590551181)'>" + box + "</g>"},
        {"width='200mm' height='100mm' viewBox='0 0 2000 1000'",
         "<g transform='matrix(10,0,0,10,-7,3)'>" + box + "</g>"}}) {
    const CadPattern drawing = svgDrawing(svg(head, body));
    EXPECT_NEAR(onlyDrawn(drawing).outline.area(), 0.006, 1e-9) << head;
    EXPECT_NEAR(onlyDrawn(drawing).outline.length(), 0.32, 1e-8) << head;
    EXPECT_TRUE(drawing.notes.empty()) << head;
  }
  EXPECT_EQ(svgDrawing(svg("viewBox='0 0 900 900'", "<rect width='377.95275590551181' height='226.77165354330709'/>"))
                .notes.size(),
            1u);
}

TEST(Drawing, TransformsAreCarriedOut) {
  const std::string head = "width='500mm' height='500mm' viewBox='0 0 500 500'";
  // Turned, mirrored and stretched: an L of three 50 mm squares.
  const std::string l = "<path d='M0 0h100v50h-50v50H0z'/>";
  const auto area = [&](const std::string& transform) {
    return onlyDrawn(svgDrawing(svg(
                         head, "<g transform='translate(200,200)'><g transform='" + transform + "'>" + l + "</g></g>")))
        .outline.area();
  };
  EXPECT_NEAR(area("rotate(33)"), 0.0075, 1e-12);
  EXPECT_NEAR(area("scale(-1,1)"), 0.0075, 1e-12);
  EXPECT_NEAR(area("scale(2 .5) skewX(20)"), 0.0075, 1e-12);
  EXPECT_NEAR(area("rotate(90,50,50), translate(3)"), 0.0075, 1e-12);
  EXPECT_THAT(refusal(svg(head, "<g transform='wobble(3)'>" + l + "</g>")), HasSubstr("wobble"));
  // y runs upwards here: a triangle with its point down in the drawing has it down on the paper.
  const Piece point = onlyDrawn(svgDrawing(svg(head, "<polygon points='0,0 100,0 50,80'/>")));
  double lowest = 1;
  Flat at;
  for (const Edge& edge : point.outline.edges)
    if (edge.curve.start.v < lowest) lowest = edge.curve.start.v, at = edge.curve.start;
  EXPECT_NEAR(at.u, 0.05, 1e-12);
}

TEST(Drawing, CurvesAreKeptAsTheyAre) {
  const std::string head = "width='500mm' height='500mm' viewBox='0 0 500 500'";
  // A circle stays two arcs, whole, turned or mirrored; an ellipse becomes cubics to a thousandth of a millimetre.
  for (const std::string transform : {"", "rotate(40)", "scale(1,-1)"}) {
    const Piece round =
        onlyDrawn(svgDrawing(svg(head, "<g transform='" + transform + "'><circle cx='100' cy='100' r='50'/></g>")));
    EXPECT_NEAR(round.outline.area(), std::numbers::pi * 0.0025, 1e-9) << transform;
    for (const Edge& edge : round.outline.edges) EXPECT_EQ(edge.curve.kind, Curve::Kind::Arc);
  }
  EXPECT_NEAR(onlyDrawn(svgDrawing(svg(head, "<ellipse cx='100' cy='100' rx='60' ry='30'/>"))).outline.area(),
              std::numbers::pi * 0.0018, 1e-7);
  EXPECT_NEAR(onlyDrawn(svgDrawing(svg(head, "<path d='M100 50a50 25 30 1 1-1 0z'/>"))).outline.area(),
              std::numbers::pi * 0.00125, 2e-6);
  // A quadratic and its smooth follower, and a cubic: areas by hand.
  const Piece hill = onlyDrawn(svgDrawing(svg(head, "<path d='M0 100Q50 0 100 100T200 100L200 200L0 200z'/>")));
  EXPECT_NEAR(hill.outline.area(), 0.02, 1e-9);
  const Piece wave = onlyDrawn(svgDrawing(svg(head, "<path d='M0 0c0-40 100-40 100 0v100h-100z'/>")));
  EXPECT_NEAR(wave.outline.area(), 0.01 + 0.1 * 0.03 * 2 / 3 * 1.2, 1e-9);
  // Numbers without anything between, and flags without spaces.
  EXPECT_EQ(svgDrawing(svg(head, "<path d='M10-.5.5.5l0 99.5 100-1e0zM300 300a50 50 0 01100 0a50 50 0 01-100 0z'/>"))
                .pattern.pieces.size(),
            2u);
}

TEST(Drawing, FreeSewing) {
  const CadPattern drawing = svgDrawing(own("freesewing.svg"));
  const Piece& front = onlyDrawn(drawing);
  EXPECT_EQ(front.name, "front");
  EXPECT_EQ(front.outline.edges.size(), 6u) << "the seam line, not the allowance";
  EXPECT_NEAR(front.outline.edges[0].curve.length() > 0 ? front.grain.v : 0, 1, 1e-12);
  EXPECT_EQ(front.marks.size(), 2u);
  for (const Mark& mark : front.marks) EXPECT_FALSE(mark.edge.empty());
  double longest = 0;
  for (const Edge& edge : front.outline.edges) longest = std::max(longest, edge.curve.length());
  EXPECT_NEAR(longest, 0.34, 1e-9);
}

TEST(Drawing, Inkscape) {
  const CadPattern drawing = svgDrawing(own("inkscape.svg"));
  ASSERT_EQ(drawing.pattern.pieces.size(), 3u);
  std::set<std::string> names;
  for (const auto& [id, piece] : drawing.pattern.pieces) names.insert(piece->name);
  EXPECT_EQ(names, (std::set<std::string>{"patch", "pocket", "sleeve"}));
  for (const auto& [id, piece] : drawing.pattern.pieces)
    if (piece->name == "sleeve") {
      EXPECT_NEAR(std::atan2(piece->grain.u, piece->grain.v) * 180 / std::numbers::pi, 10, 1e-9);
    }
}

TEST(Drawing, SeamlyWithItsSeamLineWithinTheCutLine) {
  const Piece back = onlyDrawn(svgDrawing(own("seamly.svg")));
  EXPECT_EQ(back.name, "Back");
  EXPECT_NEAR(back.outline.area(), 524 * 724 * std::pow(0.3 / 1133.86, 2), 1e-7);
}

TEST(Drawing, OpenLinesWhoseEndsMeetAreOnePiece) {
  const std::string head = "width='500mm' height='500mm' viewBox='0 0 500 500'";
  const Piece piece =
      onlyDrawn(svgDrawing(svg(head,
                               "<g id='bag'><path d='M0 0H200'/><path d='M0 300L0 0.2'/><path d='M200 0.1V300'/>"
                               "<path d='M0 300.1Q100 330 200 300'/></g>")));
  EXPECT_EQ(piece.name, "bag");
  EXPECT_EQ(piece.outline.edges.size(), 4u);
}

TEST(Drawing, WhatIsNoPatternIsRefusedWithASentence) {
  EXPECT_THAT(refusal(own("doctype.svg")), HasSubstr("DOCTYPE"));
  EXPECT_THAT(refusal(own("open.svg")), HasSubstr("closed"));
  EXPECT_THAT(refusal("<html></html>"), HasSubstr("no SVG"));
  EXPECT_THAT(refusal(""), HasSubstr("not XML"));
  EXPECT_THAT(refusal(svg("viewBox='0 0 0 9'", "<rect width='9' height='9'/>")), HasSubstr("viewBox"));
  EXPECT_THAT(refusal(svg("width='1mm' height='1mm'", "<path d='M0 0 L nan 4z'/>")), HasSubstr("closed"));
  const auto sized = readDrawing(own("inkscape.svg"), "38");
  ASSERT_FALSE(sized);
  EXPECT_THAT(text(sized.error().what), HasSubstr("one size"));
}

}  // namespace
}  // namespace karinui
