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

// The definition that it names is not opened, and what it declares is not put in.
TEST(Drawing, ADoctypeIsPassedOver) {
  const std::string head = "<?xml version='1.0'?>\n";
  const std::string box =
      " width='200mm' height='100mm' viewBox='0 0 200 100'><rect id='front' width='100' height='60'/></svg>";
  const CadPattern corel = svgDrawing(
      head +
      "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\n<svg" +
      box);
  EXPECT_NEAR(onlyDrawn(corel).outline.area(), 0.006, 1e-9);
  const CadPattern entities = svgDrawing(head +
                                         "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\" [\n\t<!ENTITY "
                                         "ns_extend \"http://ns.adobe.com/Extensibility/1.0/\">\n]>\n"
                                         "<svg xmlns:x='&ns_extend;'" +
                                         box);
  EXPECT_NEAR(onlyDrawn(entities).outline.area(), 0.006, 1e-9);
  EXPECT_THAT(refusal("<svg xmlns:x='&ns_extend;'" + box), HasSubstr("damaged"));
}

TEST(Drawing, LettersOfAnyEncoding) {
  const auto named = [](const std::string& declared, const std::string& name) {
    return onlyDrawn(svgDrawing("<?xml version='1.0'" + (declared.empty() ? "" : " encoding='" + declared + "'") +
                                "?><svg width='200mm' height='100mm' viewBox='0 0 200 100'><g id='" + name +
                                "'><rect width='100' height='60'/></g></svg>"))
        .name;
  };
  EXPECT_EQ(named("Shift_JIS", "\x91\x4F\x90\x67\x8D\xA0"), "前身頃");
  EXPECT_EQ(named("", "\x91\x4F\x90\x67\x8D\xA0"), "前身頃");
  EXPECT_EQ(named("ISO-8859-1",
                  "R\xFC"
                  "cken"),
            "Rücken");
  EXPECT_EQ(named("UTF-8",
                  "R\xFC"
                  "cken"),
            "Rücken")
      << "which it is not";
  EXPECT_EQ(named("UTF-8", "前身頃"), "前身頃");
  EXPECT_EQ(named("../../made_up", "Rücken"), "Rücken");
  std::string wide = "\xFF\xFE";
  for (const char c : svg("width='200mm' height='100mm' viewBox='0 0 200 100'", "<rect width='100' height='60'/>"))
    wide += {c, '\0'};
  EXPECT_NEAR(onlyDrawn(svgDrawing(wide)).outline.area(), 0.006, 1e-9);
}

// 283.4646 points are 100 mm, 170.0787 are 60.
TEST(Drawing, Illustrator) {
  const std::string mark =
      "<!-- Generator: Adobe Illustrator 27.5.0, SVG Export Plug-In . SVG Version: 6.00 Build 0)  -->\n";
  const std::string box = "<g id='_x524D__x8EAB__1_'><rect width='283.4646' height='170.0787'/></g>";
  for (const std::string& drawn : {mark + svg("x='0px' y='0px' viewBox='0 0 900 900'", box),
                                   mark + svg("width='900px' height='900px' viewBox='0 0 900 900'", box),
                                   svg("id='Layer_1' data-name='Layer 1' viewBox='0 0 900 900'", box)}) {
    const CadPattern drawing = svgDrawing(drawn);
    EXPECT_NEAR(onlyDrawn(drawing).outline.area(), 0.006, 1e-7) << drawn;
    EXPECT_EQ(onlyDrawn(drawing).name, "前身");
    ASSERT_EQ(drawing.notes.size(), 1u);
    EXPECT_THAT(text(drawing.notes[0]), HasSubstr("72 to the inch"));
  }
  const CadPattern told = svgDrawing(mark + svg("width='900pt' height='900pt' viewBox='0 0 900 900'", box));
  EXPECT_NEAR(onlyDrawn(told).outline.area(), 0.006, 1e-7);
  EXPECT_TRUE(told.notes.empty());
  // Old Inkscape: 354.3307 and 212.5984 of 90 to the inch.
  const std::string old = "<rect width='354.3307' height='212.5984'/>";
  EXPECT_NEAR(
      onlyDrawn(svgDrawing(svg("inkscape:version='0.48.4 r9939' width='900' height='900'", old))).outline.area(), 0.006,
      1e-7);
  EXPECT_NEAR(onlyDrawn(svgDrawing(svg("inkscape:version='1.2' width='900' height='900'",
                                       "<rect width='377.9528' height='226.7717'/>")))
                  .outline.area(),
              0.006, 1e-7);
}

TEST(Drawing, AUnitThatIsSaidGoesBeforeWhatTheDrawingTells) {
  const std::string box = "<rect width='100' height='60'/>";
  for (const std::string head : {"viewBox='0 0 500 700'", "width='100%' height='100%' viewBox='0 0 500 700'", "",
                                 "width='1mm' height='1mm' viewBox='0 0 5 7'"}) {
    const auto drawing = readDrawing(svg(head, box), {}, 0.001);
    ASSERT_TRUE(drawing);
    EXPECT_NEAR(onlyDrawn(*drawing).outline.area(), 0.006, 1e-9) << head;
    EXPECT_TRUE(drawing->notes.empty()) << head;
  }
}

TEST(Drawing, HiddenByARuleOfStyle) {
  const std::string style =
      "<style type='text/css'>/* .a{display:none} */ @media print{.a{display:none}} .st0, .st1 { fill:none; display : "
      "none !important }</style>";
  const CadPattern drawing = svgDrawing(svg(
      "width='500mm' height='500mm' viewBox='0 0 500 500'",
      style +
          "<g class='st0'><rect id='old' width='300' height='300'/></g><rect class='a st1' width='200' height='200'/>"
          "<rect id='front' class='a' width='100' height='60'/><rect id='back' y='100' class='st1' "
          "style='display:inline' width='100' height='60'/>"));
  EXPECT_EQ(drawing.pattern.pieces.size(), 2u);
  const CadPattern data = svgDrawing(svg("width='500mm' height='500mm' viewBox='0 0 500 500'",
                                         "<style><![CDATA[.st0{display:none;}]]></style><rect class='st0' width='300' "
                                         "height='300'/><rect id='front' width='100' height='60'/>"));
  EXPECT_EQ(onlyDrawn(data).name, "front");
}

TEST(Drawing, ClonesAreDrawn) {
  const std::string head = "width='500mm' height='500mm' viewBox='0 0 500 500'";
  const CadPattern twice = svgDrawing(svg(
      head, "<path id='front' d='M0 0h100v60h-60z'/><use xlink:href='#front' transform='matrix(-1 0 0 1 300 0)'/>"));
  ASSERT_EQ(twice.pattern.pieces.size(), 2u);
  const Outline &own = twice.pattern.pieces.begin()->second->outline,
                &image = twice.pattern.pieces.rbegin()->second->outline;
  EXPECT_NEAR(own.area(), image.area(), 1e-12);
  // A symbol, fitted into the size that is asked for; within another drawing.
  const std::string symbol = "<symbol id='pocket' viewBox='0 0 10 10'><rect width='10' height='6'/></symbol>";
  const CadPattern placed = svgDrawing(svg(head, symbol + "<use href='#pocket' x='20' width='100' height='100'/>"));
  EXPECT_NEAR(onlyDrawn(placed).outline.area(), 0.006, 1e-9);
  EXPECT_EQ(onlyDrawn(placed).name, "pocket");
  EXPECT_NEAR(
      onlyDrawn(
          svgDrawing(
              svg(head,
                  "<svg x='5' y='5' width='200' height='300' viewBox='0 0 20 30'><rect width='10' height='6'/></svg>")))
          .outline.area(),
      0.006, 1e-9);
  const CadPattern missing =
      svgDrawing(svg(head, "<rect width='100' height='60'/><use href='#gone'/><use href='other.svg#front'/>"));
  EXPECT_EQ(missing.pattern.pieces.size(), 1u);
  ASSERT_EQ(missing.notes.size(), 2u);
  EXPECT_THAT(text(missing.notes[0]), HasSubstr("“#gone”"));
  // Clones of clones end.
  EXPECT_EQ(
      svgDrawing(
          svg(head, "<rect width='100' height='60'/><g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>"))
          .pattern.pieces.size(),
      1u);
  std::string many = "<rect id='c0' width='100' height='60'/>";
  for (int k = 1; k < 40; ++k) {
    const std::string before = std::to_string(k - 1);
    many += "<g id='c" + std::to_string(k) + "'><use href='#c" + before + "'/><use href='#c" + before + "'/></g>";
  }
  EXPECT_FALSE(readDrawing(svg(head, many)));
}

// As our own sheets are after a program that drops what it does not know.
TEST(Drawing, ASeamLineDrawnEdgeByEdgeWithinItsCutLine) {
  const CadPattern drawing = svgDrawing(
      svg("width='500mm' height='700mm' viewBox='0 0 500 700'",
          "<g id='front'><path class='cut' d='M0 0H320V420H0z'/><path class='seam' d='M10 10H310'/><path class='seam' "
          "d='M310 10V410'/>"
          "<path class='seam' d='M10 410H310'/><path class='seam' d='M10 410V10'/><path d='M50 50V300'/></g>"));
  EXPECT_NEAR(onlyDrawn(drawing).outline.area(), 0.3 * 0.4, 1e-9);
  EXPECT_EQ(onlyDrawn(drawing).lines.size(), 1u);
  EXPECT_TRUE(drawing.notes.empty());
}

TEST(Drawing, SlipsOfTheHandAreClosedAndTold) {
  const std::string head = "width='500mm' height='700mm' viewBox='0 0 500 700'";
  // Drawn past each other and short of each other by 2 mm.
  const CadPattern lines = svgDrawing(
      svg(head,
          "<g id='bag'><path d='M8 10H410'/><path d='M410 12V612'/><path d='M410 610H10'/><path d='M10 608V10'/></g>"));
  EXPECT_NEAR(onlyDrawn(lines).outline.area(), 0.24, 1e-9);
  EXPECT_EQ(onlyDrawn(lines).outline.edges.size(), 4u);
  ASSERT_EQ(lines.notes.size(), 1u);
  EXPECT_THAT(text(lines.notes[0]), HasSubstr("1 outline was open by up to 2.0 mm"));
  const CadPattern path = svgDrawing(svg(head, "<path id='bag' d='M10 10H410V610H10V13'/>"));
  EXPECT_NEAR(onlyDrawn(path).outline.area(), 0.24, 1e-9);
  EXPECT_THAT(text(path.notes.at(0)), HasSubstr("3.0 mm"));
  // What is open by more is named, beside pieces and alone.
  const std::string open = "<path id='back' d='M10 10H210V310H10'/>";
  EXPECT_THAT(refusal(svg(head, open)), HasSubstr("“back” (the first by 300.0 mm)"));
  const CadPattern beside = svgDrawing(svg(head, open + "<rect id='front' x='250' width='200' height='300'/>"));
  EXPECT_EQ(onlyDrawn(beside).name, "front");
  ASSERT_EQ(beside.notes.size(), 1u);
  EXPECT_THAT(text(beside.notes[0]), HasSubstr("“back”"));
  // A line within a piece is one of its lines.
  const CadPattern within =
      svgDrawing(svg(head, "<rect id='front' width='300' height='400'/><path d='M50 50H250V250H50'/>"));
  EXPECT_TRUE(within.notes.empty());
  EXPECT_EQ(onlyDrawn(within).lines.size(), 1u);
  EXPECT_THAT(refusal(svg(head, "<path id='front' d='M10 10h400vfoo h-400z'/>")),
              HasSubstr("cannot be read and was left out: front"));
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
  const std::string line = "<svg><path d='M0 0h99v99z'/></svg>";
  EXPECT_THAT(refusal("<!DOCTYPE svg [<!ENTITY a SYSTEM 'file:///etc/hostname'>]>" + line), HasSubstr("DOCTYPE"));
  EXPECT_THAT(refusal("<!DOCTYPE svg [<!ENTITY % a 'b'>]>" + line), HasSubstr("DOCTYPE"));
  EXPECT_THAT(refusal("<!DOCTYPE svg [<!ENTITY a 'b'><!ENTITY c '&a;&a;'>]>" + line), HasSubstr("DOCTYPE"));
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
