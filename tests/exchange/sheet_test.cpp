#include "karinui/exchange/sheet.h"

#include <gtest/gtest.h>
#include <cstdio>
#include <regex>

#include "exchange/sheet.h"
#include "exchange/xml.h"
#include "karinui/base/file.h"
#include "karinui/body/sizes.h"
#include "karinui/design/glossary.h"
#include "karinui/exchange/drawing.h"
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/pattern/label_room.h"
#include "patterns.h"
#include "pdf_page.h"

namespace karinui {
namespace {

Pattern shirt() {
  const auto path = test::shared("patterns/garmentcode/shirt_mean_specification.json");
  if (!exists(path)) return {};
  return *readGarmentCode(test::content(path));
}

Pattern renamed(Pattern pattern, const std::string& name) {
  Piece piece = *pattern.pieces.begin()->second;
  piece.name = name;
  pattern.pieces.begin()->second = std::make_shared<const Piece>(piece);
  return pattern;
}

TEST(Svg, ReadsBackWhatItWrites) {
  for (unsigned seed = 1; seed <= 25; ++seed)
    for (const double allowance : {0.0, 0.010}) {
      SheetSettings settings;
      settings.allowance = allowance;
      const Pattern once = test::random(seed);
      const auto svg = writeSvg(once, settings);
      ASSERT_TRUE(svg) << seed << text(svg.error().what);
      EXPECT_EQ(*svg, *writeSvg(once, settings));
      const auto again = readSvg(*svg);
      ASSERT_TRUE(again) << seed << text(again.error().what);
      EXPECT_EQ(test::difference(once, *again, 1e-8), "") << seed;  // 0.05 mm are asked for
      EXPECT_EQ(once.seams, again->seams);
      for (const auto& [id, piece] : once.pieces) {
        const Piece& other = *again->pieces.at(id);
        EXPECT_EQ(piece->marks, other.marks);
        EXPECT_EQ(piece->grain, other.grain);
        EXPECT_EQ(piece->fabric, other.fabric);
        ASSERT_EQ(piece->holes.size(), other.holes.size());
        EXPECT_NEAR(piece->holes[0].length(), other.holes[0].length(), 1e-8);
        ASSERT_EQ(piece->lines.size(), other.lines.size());
        EXPECT_EQ(piece->lines[0].curves.size(), other.lines[0].curves.size());
      }
    }
}

TEST(Svg, IsTrueToSize) {
  const auto svg = writeSvg(test::random(4));
  ASSERT_TRUE(svg);
  const auto elements = parseXml(*svg);
  ASSERT_TRUE(elements);
  const XmlElement& root = elements->front();
  EXPECT_EQ(*root.find("viewBox"), "0 0 " + root.find("width")->substr(0, root.find("width")->size() - 2) + " " +
                                       root.find("height")->substr(0, root.find("height")->size() - 2));
  EXPECT_TRUE(root.find("width")->ends_with("mm"));
  bool square = false;
  for (const XmlElement& element : *elements)
    square |= element.name == "rect" && *element.find("width") == "100" && *element.find("height") == "100";
  EXPECT_TRUE(square);
  // White paper under all of it, drawn first.
  const auto paper =
      std::find_if(elements->begin(), elements->end(), [](const XmlElement& e) { return e.name == "rect"; });
  ASSERT_NE(paper, elements->end());
  EXPECT_EQ(*paper->find("width") + "mm", *root.find("width"));
  EXPECT_EQ(*paper->find("height") + "mm", *root.find("height"));
  EXPECT_NE(paper->find("style")->find("fill:#fff"), std::string::npos);
}

TEST(Svg, AllowancesComeBack) {
  const Pattern once = test::random(3);
  const PieceId first = once.pieces.begin()->first;
  SheetSettings settings;
  settings.allowances.edges[{first, "side_0"}] = 0.0253;
  settings.allowances.edges[{first, "hole_a"}] = 0.003;
  const auto svg = writeSvg(once, settings);
  ASSERT_TRUE(svg);
  const auto read = readDrawing(*svg);
  ASSERT_TRUE(read) << text(read.error().what);
  ASSERT_EQ(read->cutting.allowances.edges.size(), 1u);  // no step says that of a hole
  EXPECT_NEAR(read->cutting.allowances.edges.at({first, "side_0"}), 0.0253, 1e-9);
  ASSERT_EQ(read->notes.size(), 1u);
  EXPECT_NE(text(read->notes[0]).find("of holes"), std::string::npos);
  const auto usual = writeSvg(once);
  ASSERT_TRUE(usual);
  EXPECT_TRUE(readDrawing(*usual)->cutting.allowances.empty());
  for (const char* wrong : {"200", "-1", "wide"}) {
    std::string broken = *svg;
    broken.replace(broken.find("data-allowance=\"25.3\"") + 16, 4, wrong);
    EXPECT_FALSE(readDrawing(broken)) << wrong;
  }
}

TEST(Svg, HostileNamesAreHarmless) {
  for (const std::string name : {"<script>&\"'</g>", "../../etc/passwd", "前身頃", "a]]>b", "--><x>"}) {
    const Pattern pattern = renamed(test::random(2), name);
    const auto svg = writeSvg(pattern);
    ASSERT_TRUE(svg);
    EXPECT_EQ(svg->find("<script"), std::string::npos);
    const auto again = readSvg(*svg);
    ASSERT_TRUE(again) << text(again.error().what);
    EXPECT_EQ(again->pieces.begin()->second->name, name);
  }
  const auto broken = writeSvg(renamed(test::random(2), "a\nb\x01\xff"));
  ASSERT_TRUE(broken);
  EXPECT_EQ(readSvg(*broken)->pieces.begin()->second->name, "a b \xEF\xBF\xBD");
}

TEST(Svg, DraftedPatterns) {
  if (!exists(test::shared("patterns"))) GTEST_SKIP() << "the shared patterns are not here";
  for (const std::string name :
       {"shirt_m_eu50", "bodice_block_f_eu38", "trouser_block_m_eu50", "tshirt_f_eu38", "face_mask"}) {
    const Pattern once = test::drafted(test::shared("patterns/" + name + ".json"));
    ASSERT_FALSE(once.pieces.empty()) << name;
    const auto svg = writeSvg(once);
    ASSERT_TRUE(svg) << name;
    const auto again = readSvg(*svg);
    ASSERT_TRUE(again) << name << text(again.error().what);
    EXPECT_EQ(test::difference(once, *again, 5e-5), "") << name;
  }
}

TEST(Svg, RefusesStrangers) {
  const auto sentence = [](const std::string& svg) {
    const auto result = readSvg(svg);
    return result ? std::string("accepted") : text(result.error().what);
  };
  EXPECT_NE(sentence(""), "accepted");
  EXPECT_NE(sentence("<svg xmlns='http://www.w3.org/2000/svg'/>").find("not written by Karinui"), std::string::npos);
  EXPECT_NE(sentence("<!DOCTYPE x [<!ENTITY a SYSTEM 'b'>]><svg/>").find("DOCTYPE"), std::string::npos);
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  EXPECT_NE(sentence(deep).find("levels deep"), std::string::npos);
  const std::string good = *writeSvg(test::random(1));
  for (std::size_t cut = 0; cut + 8 < good.size(); cut += 61) EXPECT_FALSE(readSvg(good.substr(0, cut))) << cut;
  std::string nan = good;
  nan.replace(nan.find("d=\"M ", nan.find("class=\"seam\"")) + 5, 3, "nan");
  EXPECT_NE(sentence(nan), "accepted");
}

TEST(Svg, RefusesEveryBadDrawingHandedToTheTests) {
  if (!exists(test::shared("badinput/resvg"))) GTEST_SKIP() << "the shared bad input is not here";
  for (const auto& file : std::filesystem::recursive_directory_iterator(test::shared("badinput/resvg")))
    if (file.path().extension() == ".svg") {
      EXPECT_FALSE(readSvg(test::content(file.path()))) << file.path();
    }
}

TEST(Sheet, PiecesDoNotOverlap) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Pattern pattern = test::random(seed);
    const auto sheet = layOut(pattern, {});
    ASSERT_TRUE(sheet);
    for (std::size_t i = 0; i < sheet->pieces.size(); ++i) {
      const SheetPiece& a = sheet->pieces[i];
      EXPECT_GE(a.low.x, 0);
      EXPECT_GE(a.low.y, sheet->square.y + kSquare);
      EXPECT_LE(a.high.x, sheet->width);
      EXPECT_LE(a.high.y, sheet->height);
      for (std::size_t k = 0; k < i; ++k) {
        const SheetPiece& b = sheet->pieces[k];
        EXPECT_TRUE(a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y) << seed;
      }
    }
  }
}

// Hems of 9 cm, and sizes far larger than the one that stands, lie in no neighbour.
TEST(Sheet, CutLinesAndSizesKeepClearOfNeighbours) {
  Pattern pattern = test::random(3);
  SheetSettings settings;
  settings.grading.sizes = {"S", "M", "L"};
  for (const auto& [id, piece] : pattern.pieces) {
    settings.allowances.edges[{id, "side_0"}] = 0.09;
    for (const Edge& edge : piece->outline.edges)
      settings.grading.pieces[id].push_back({edge.name, 0, {{}, 0.2 * edge.curve.start, 0.4 * edge.curve.start}});
  }
  for (const bool nest : {true, false}) {
    settings.nest = nest;
    const auto sheet = layOut(pattern, settings);
    ASSERT_TRUE(sheet) << text(sheet.error().what);
    std::vector<std::array<Mm, 2>> boxes;
    for (const SheetPiece& piece : sheet->pieces) {
      Mm low{1e9, 1e9}, high{-1e9, -1e9};
      const auto hold = [&](const std::vector<Mm>& line) {
        for (const Mm p : line)
          low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      };
      for (const auto& cut : piece.cutLines) hold(cut);
      EXPECT_EQ(piece.nest.size(), nest ? 2u : 0u);
      for (const SheetSize& size : piece.nest) hold(size.line);
      for (const auto& [l, h] : boxes)
        EXPECT_TRUE(high.x < l.x || h.x < low.x || high.y < l.y || h.y < low.y) << piece.piece->name;
      boxes.push_back({low, high});
    }
  }
}

TEST(Sheet, LetteringAndGrainLieWithinTheirPiece) {
  const Pattern pattern = shirt();
  if (pattern.pieces.empty()) GTEST_SKIP() << "the shared patterns are not here";
  const auto sheet = layOut(pattern, {});
  ASSERT_TRUE(sheet);
  for (const SheetPiece& piece : sheet->pieces) {
    Ring ring;
    for (const Flat p : piece.piece->outline.flattened()) ring.push_back({piece.at(p).x, piece.at(p).y});
    for (std::size_t i = 0; i < 2; ++i) {
      const SheetText& words = piece.texts[i];
      const double half = wordsWidth(words.words, words.size) / 2;
      for (const double side : {-half, half}) {
        const Mm end = words.place + (words.upright ? Mm{side, 0} : Mm{0, side});
        EXPECT_TRUE(contains(ring, {end.x, end.y})) << piece.piece->name;
      }
    }
    ASSERT_TRUE(piece.grain);
    const Flat along =
        normalized(Flat{piece.grain->to.x - piece.grain->from.x, piece.grain->from.y - piece.grain->to.y});
    EXPECT_NEAR(dot(along, piece.piece->grain), 1, 1e-9);
  }
}

// Every line of lettering, as a box about its place, stays clear of the lines of its piece.
TEST(Sheet, LetteringCrossesNoLine) {
  if (!exists(test::shared("patterns"))) GTEST_SKIP() << "the shared patterns are not here";
  std::vector<Pattern> patterns{shirt()};
  for (const std::string name :
       {"shirt_m_eu50", "bodice_block_f_eu38", "trouser_block_m_eu50", "tshirt_f_eu38", "face_mask"})
    patterns.push_back(test::drafted(test::shared("patterns/" + name + ".json")));
  SheetSettings settings;
  settings.size = *termSaid(Term::Size, "jis9ar"), settings.date = "2026-01-31";
  for (const Pattern& pattern : patterns) {
    const auto sheet = layOut(pattern, settings);
    ASSERT_TRUE(sheet);
    for (const SheetPiece& piece : sheet->pieces) {
      EXPECT_EQ(piece.labels, 3u);
      std::vector<std::vector<Flat>> lines;
      const auto add = [&](const Curve& curve) {
        lines.emplace_back();
        for (const Flat p : curve.flattened(1e-4)) lines.back().push_back({piece.at(p).x, piece.at(p).y});
      };
      for (const Edge& edge : piece.piece->outline.edges) add(edge.curve);
      for (const InternalLine& line : piece.piece->lines)
        for (const Curve& curve : line.curves) add(curve);
      for (const SheetText& words : piece.texts) {
        const double half = 0.42 * wordsWidth(words.words, words.size), up = 0.36 * words.size;  // what is inked
        const Flat low{words.place.x - (words.upright ? half : up), words.place.y - (words.upright ? up : half)},
            high{words.place.x + (words.upright ? half : up), words.place.y + (words.upright ? up : half)};
        for (const auto& line : lines)
          for (std::size_t i = 0; i + 1 < line.size(); ++i)
            for (int k = 0; k <= 20; ++k) {
              const Flat p = lerp(line[i], line[i + 1], k / 20.0);
              EXPECT_FALSE(p.u > low.u && p.u < high.u && p.v > low.v && p.v < high.v)
                  << piece.piece->name << " " << words.words;
            }
      }
    }
  }
}

TEST(Sheet, PartnersGetTheSameNotches) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Pattern pattern = test::random(seed);
    std::map<std::string, std::vector<NotchPlace>> bySeam;
    for (const NotchPlace& notch : notchPlaces(pattern)) bySeam[notch.seam].push_back(notch);
    for (const auto& [id, seam] : pattern.seams) {
      const auto& notches = bySeam[seam.name];
      ASSERT_EQ(notches.size() % 2, 0u);
      for (std::size_t i = 0; i < notches.size(); i += 2) {
        EXPECT_EQ(notches[i].piece, seam.a[0].piece);
        EXPECT_EQ(notches[i + 1].piece, seam.b[0].piece);
      }
    }
    EXPECT_GE(bySeam["seam 1"].size(), 4u) << "a seam that begins within an edge";
    EXPECT_GE(bySeam["seam 2"].size(), 2u) << "a break within a side";
    const auto sheet = layOut(pattern, {});
    for (const SheetPiece& piece : sheet->pieces)  // perpendicular strokes from the seam line, as long as the allowance
      for (const SheetNotch& notch : piece.notches) {
        EXPECT_NEAR(std::hypot(notch.stroke.to.x - notch.stroke.from.x, notch.stroke.to.y - notch.stroke.from.y), 10,
                    1e-6);
        Ring ring;
        for (const Flat p : piece.piece->outline.flattened(1e-6)) ring.push_back({piece.at(p).x, piece.at(p).y});
        EXPECT_LT(distanceToRing(ring, {notch.stroke.from.x, notch.stroke.from.y}), 0.01);
        EXPECT_GT(distanceToRing(ring, {notch.stroke.to.x, notch.stroke.to.y}), 1) << seed;
      }
  }
}

TEST(Sheet, TheCutLineKeepsItsDistance) {
  const Pattern pattern = test::random(6);
  const auto sheet = layOut(pattern, {});
  ASSERT_TRUE(sheet);
  for (const SheetPiece& piece : sheet->pieces) {
    ASSERT_EQ(piece.cutLines.size(), 1u);
    Ring ring, cut;
    for (const Flat p : piece.piece->outline.flattened(1e-6)) ring.push_back({piece.at(p).x, piece.at(p).y});
    for (const Mm p : piece.cutLines[0]) cut.push_back({p.x, p.y});
    for (const Flat p : ring) EXPECT_GE(distanceToRing(cut, p), 9.95);
    for (const Flat p : cut)
      EXPECT_LE(distanceToRing(ring, p), 35.05) << "no mitre is longer than three and a half times";
  }
}

// A rectangle of 30 by 20 cm, its hem 4 cm and its fold without an allowance, the rest as usual or as asked for.
Pattern skirtPanel() {
  Piece piece;
  piece.id = {1};
  piece.name = "panel";
  const Flat corner[] = {{0, 0}, {0.3, 0}, {0.3, 0.2}, {0, 0.2}};
  const char* names[] = {"hem", "side", "waist", "fold"};
  for (std::size_t k = 0; k < 4; ++k)
    piece.outline.edges.push_back({names[k], Curve::line(corner[k], corner[(k + 1) % 4])});
  Pattern pattern;
  pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  return pattern;
}

TEST(Sheet, EachEdgeHasItsOwnAllowance) {
  const Pattern pattern = skirtPanel();
  SheetSettings settings;
  settings.allowances.edges[{{1}, "hem"}] = 0.04;
  for (const auto& [asked, seam] : {std::pair<std::optional<double>, double>{{}, 10}, {0.015, 15}}) {
    settings.allowance = asked;
    const auto sheet = layOut(pattern, settings);
    ASSERT_TRUE(sheet);
    const SheetPiece& piece = sheet->pieces[0];
    ASSERT_EQ(piece.cutLines.size(), 1u);
    Ring cut;
    for (const Mm p : piece.cutLines[0]) cut.push_back({p.x, p.y});
    EXPECT_NEAR(std::abs(signedArea(cut)), (300 + seam) * (200 + 40 + seam), 1e-6);
    EXPECT_NE(
        sheet->headings[3].words.find("Seam allowance " + std::to_string(static_cast<int>(seam)) + " mm, hems 30"),
        std::string::npos)
        << sheet->headings[3].words;
    EXPECT_NE(sheet->headings[3].words.find("as drawn"), std::string::npos);
    const auto svg = writeSvg(pattern, settings);
    ASSERT_TRUE(svg);
    for (const std::string edge : {"hem\" data-allowance=\"40", "fold\" data-allowance=\"0"})
      EXPECT_NE(svg->find("data-edge=\"" + edge + "\""), std::string::npos) << edge;
    EXPECT_TRUE(readSvg(*svg));
    // In the cutting room's file the boundary is the cut line and layer 14 the seam line.
    const auto dxf = writeDxf(pattern, DxfDialect::Aama, settings);
    ASSERT_TRUE(dxf);
    const auto ringOn = [&](const std::string& layer) {
      Ring ring;
      std::smatch line;
      const std::regex whole("POLYLINE\r\n8\r\n" + layer + "\r\n([\\s\\S]*?)SEQEND");
      if (!std::regex_search(*dxf, line, whole)) return ring;
      const std::string points = line[1];
      const std::regex place("10\r\n(-?[0-9.]+)\r\n20\r\n(-?[0-9.]+)");
      for (std::sregex_iterator at(points.begin(), points.end(), place), end; at != end; ++at)
        ring.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
      return ring;
    };
    EXPECT_NEAR(signedArea(ringOn("1")), (300 + seam) * (240 + seam), 0.1);
    EXPECT_NEAR(signedArea(ringOn("14")), 300 * 200, 0.1);
  }
  settings.allowance = 0;
  EXPECT_TRUE(layOut(pattern, settings)->pieces[0].cutLines.empty()) << "seam lines only";
}

TEST(Sheet, TellsHowOftenAPieceIsCutAndWhatLiesOnTheFold) {
  SheetSettings settings;
  settings.cutting[{1}] = {2, true};
  settings.size = *termSaid(Term::Size, "jis9ar"), settings.date = "2026-01-31";
  const auto sheet = layOut(skirtPanel(), settings);
  ASSERT_TRUE(sheet);
  const SheetPiece& piece = sheet->pieces[0];
  ASSERT_EQ(piece.labels, 3u);
  EXPECT_EQ(piece.texts[1].words, "Cut 2 (1 pair) on fold · Cotton");
  EXPECT_EQ(piece.texts[2].words, "JIS 9AR (women) · 2026-01-31");
  // The bracket's ends are on the fold, its back 10 mm within the cloth.
  ASSERT_EQ(piece.folds.size(), 1u);
  ASSERT_EQ(piece.folds[0].size(), 4u);
  const double at = piece.at({0, 0}).x;
  EXPECT_NEAR(piece.folds[0][0].x, at, 1e-9);
  EXPECT_NEAR(piece.folds[0][1].x, at + 10, 1e-9);
  EXPECT_NEAR(piece.folds[0][2].x, at + 10, 1e-9);
  EXPECT_NEAR(piece.folds[0][3].x, at, 1e-9);
  EXPECT_EQ(piece.texts.back().words, "place on the fold");
  EXPECT_FALSE(piece.texts.back().upright);
  EXPECT_EQ(layOut(skirtPanel(), {})->pieces[0].texts[1].words, "Cut 1 on fold · Cotton");
}

Outline outlineOf(const Ring& corners) {
  Outline outline;
  for (std::size_t k = 0; k < corners.size(); ++k)
    outline.edges.push_back({"e" + std::to_string(k + 1), Curve::line(corners[k], corners[(k + 1) % corners.size()])});
  return outline;
}

// A left and a right front, sewn to the two sides of a back; what is drawn on one of them is drawn on the other.
Pattern leftAndRight() {
  Pattern pattern;
  const auto add = [&](std::uint64_t id, const std::string& name, const Ring& corners, std::uint64_t mirrorOf) {
    Piece piece;
    piece.id = {id}, piece.name = name, piece.mirrorOf = {mirrorOf};
    piece.outline = outlineOf(corners);
    pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  };
  add(1, "left", {{0, 0}, {0.3, 0}, {0.25, 0.5}, {0, 0.4}}, 0);
  add(2, "right", {{0, 0}, {0, 0.4}, {-0.25, 0.5}, {-0.3, 0}}, 1);
  add(3, "back", {{0, 0}, {0.4, 0}, {0.4, 0.5}, {0, 0.5}}, 0);
  const auto sew = [&](std::uint64_t id, PieceId piece, const std::string& edge, const std::string& back) {
    Seam seam;
    seam.id = {id};
    seam.a = {{piece, edge}}, seam.b = {{{3}, back}};
    pattern.seams[seam.id] = seam;
  };
  sew(1, {1}, "e2", "e2"), sew(2, {2}, "e3", "e4");
  return pattern;
}

TEST(Sheet, WhatIsCutInPairsIsDrawnOnce) {
  Pattern pattern = leftAndRight();
  SheetSettings settings;
  EXPECT_EQ(layOut(pattern, settings)->pieces.size(), 3u);
  settings.pairsOnce = true;
  const auto sheet = layOut(pattern, settings);
  ASSERT_TRUE(sheet);
  ASSERT_EQ(sheet->pieces.size(), 2u);
  const SheetPiece& front = sheet->pieces[0];
  EXPECT_EQ(front.texts[0].words, "left, right");
  EXPECT_EQ(front.texts[1].words, "Cut 2 (1 pair) · Cotton");
  const auto says = [](const SheetPiece& piece, const std::string& words) {
    return std::any_of(piece.texts.begin(), piece.texts.end(),
                       [&](const SheetText& text) { return text.words == words; });
  };
  EXPECT_TRUE(says(front, "1/2")) << "of both seams";
  EXPECT_TRUE(says(sheet->pieces[1], "1") && says(sheet->pieces[1], "2"));
  EXPECT_TRUE(std::any_of(sheet->headings.begin(), sheet->headings.end(), [](const SheetText& text) {
    return text.words.find("one turned over") != std::string::npos;
  }));
  // What differs in anything is drawn by itself: a notch on one, another cloth, another width of an allowance.
  const auto drawn = [&] { return layOut(pattern, settings)->pieces.size(); };
  const auto changed = [&](const auto& change) {
    pattern = leftAndRight();
    Piece piece = *pattern.pieces.at({2});
    change(piece);
    pattern.pieces[{2}] = std::make_shared<const Piece>(piece);
    return drawn();
  };
  EXPECT_EQ(changed([](Piece& piece) { piece.marks.push_back({"n", "e1", 0.3, {}}); }), 3u);
  EXPECT_EQ(changed([](Piece& piece) { piece.fabric = "denim"; }), 3u);
  EXPECT_EQ(changed([](Piece& piece) { piece.mirrorOf = {}; }), 3u);
  EXPECT_EQ(changed([](Piece& piece) { piece.grain = {0.6, 0.8}; }), 3u);
  EXPECT_EQ(changed([](Piece& piece) {
              piece.outline = outlineOf({{0, 0}, {0, 0.4}, {-0.25, 0.5}, {-0.302, 0}});
            }),
            3u);
  EXPECT_EQ(changed([](Piece&) {}), 2u);
  // A third that is alike is no part of the pair.
  Piece third = *pattern.pieces.at({2});
  third.id = {4}, third.name = "spare";
  pattern.pieces[third.id] = std::make_shared<const Piece>(third);
  pattern.seams.clear();
  EXPECT_EQ(drawn(), 3u) << "the pair, the back, the third";
  pattern = leftAndRight();
  settings.allowances.edges[{{2}, "e2"}] = 0.02;
  EXPECT_EQ(drawn(), 3u);
}

// A size of which a measure was changed is not that size.
TEST(Sheet, TellsWhetherAFigureIsOfItsSize) {
  Document document;
  document.pattern = skirtPanel();
  document.body.size = "eu38", document.body.measurements = *builtInSize("eu38");
  const auto told = [&] {
    SheetSettings settings;
    tellGarment(document, {}, settings);
    return layOut(document.pattern, settings)->pieces[0].texts[2].words;
  };
  EXPECT_EQ(told(), "EU 38 (women)");
  document.body.measurements.value["hip_girth"] = 1.35;
  EXPECT_EQ(told(), "made to measure");
  document.body.size.clear();  // stated anew, without a size
  EXPECT_EQ(told(), "made to measure");
  document.grading.sizes = {"S", "M"};
  EXPECT_EQ(told(), "S");
}

// The bars at which a print matches, and what they are, where there are any.
TEST(Sheet, BarsOfThePrintStandOnBothPieces) {
  const Pattern pattern = test::random(3);
  ASSERT_GE(pattern.pieces.size(), 2u);
  const auto counted = [](const std::string& svg, const std::string& what) {
    std::size_t times = 0;
    for (auto at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++times;
    return times;
  };
  SheetSettings settings;
  const std::string plain = *writeSvg(pattern, settings);
  EXPECT_EQ(counted(plain, "(#)"), 0u);
  const auto one = pattern.pieces.begin(), other = std::next(one);
  for (const auto& at : {one, other}) {
    const Flat from = at->second->outline.edges[0].curve.at(0.5);
    settings.matches.push_back({at->first, from, from + Flat{0, 0.01}, 7});
  }
  const std::string barred = *writeSvg(pattern, settings);
  EXPECT_EQ(counted(barred, "#7"), 2u);
  EXPECT_EQ(counted(barred, "(#)"), 1u);
  EXPECT_EQ(counted(barred, "class=\"notch") - counted(plain, "class=\"notch"), 2u);
}

TEST(Sheet, RefusesNonsense) {
  EXPECT_FALSE(writeSvg({}));
  EXPECT_FALSE(writePdf({}));
  for (const double allowance : {-0.01, 0.5, std::nan("")}) {
    SheetSettings settings;
    settings.allowance = allowance;
    EXPECT_FALSE(writeSvg(test::random(1), settings));
  }
}

using test::Picture;
using test::rendered;

TEST(Pdf, TheSquareMeasuresAHundredMillimetres) {
  if (!test::drawsPdf()) GTEST_SKIP() << "pdftoppm is not installed";
  struct Place {
    PaperKind paper;
    int page, top;  // mm from the page's top: a strip that shows both upright sides
  };
  // On A4 the overview has the square at the foot of the page, the first tile where the sheet has it.
  for (const auto& [paper, page, top] :
       {Place{PaperKind::OneSheet, 1, 70}, Place{PaperKind::A4, 1, 237}, Place{PaperKind::A4, 2, 80}}) {
    const auto pdf = writePdf(test::random(5), paper);
    ASSERT_TRUE(pdf);
    // 2540 dpi: a hundred pixels a millimetre.
    const Picture strip = rendered(*pdf, page, 2540, "-x 0 -y " + std::to_string(top * 100) + " -W 20000 -H 1");
    ASSERT_GE(strip.grey.size(), 14000u);
    std::vector<double> lines;
    for (std::size_t i = 1; i < 14500; ++i) {
      const bool dark = static_cast<unsigned char>(strip.grey[i]) < 100;
      const bool before = static_cast<unsigned char>(strip.grey[i - 1]) < 100;
      if (dark && !before) lines.push_back(static_cast<double>(i));
      if (!dark && before && !lines.empty()) lines.back() = (lines.back() + static_cast<double>(i)) / 2;
    }
    ASSERT_GE(lines.size(), 2u);
    double nearest = 1e9;
    for (const double a : lines)
      for (const double b : lines) nearest = std::min(nearest, std::abs(std::abs(b - a) / 100 - 100));
    EXPECT_LT(nearest, 0.05);
  }
}

TEST(Pdf, IsItselfAndAsksNotToBeScaled) {
  const Pattern pattern = renamed(test::random(5), "前身頃 <&\"'");
  for (const PaperKind paper : {PaperKind::OneSheet, PaperKind::A4}) {
    const auto pdf = writePdf(pattern, paper);
    ASSERT_TRUE(pdf);
    EXPECT_EQ(*pdf, *writePdf(pattern, paper)) << "no date, no chance";
    EXPECT_TRUE(pdf->starts_with("%PDF-1.4"));
    EXPECT_NE(pdf->find("/PrintScaling /None"), std::string::npos);
    EXPECT_EQ(pdf->find("CreationDate"), std::string::npos);
    EXPECT_EQ(pdf->find("/Author"), std::string::npos);
    // The last table of contents stands where the file's end says, and its one entry where the catalogue begins.
    const std::size_t table = std::stoul(pdf->substr(pdf->rfind("startxref") + 9));
    EXPECT_EQ(pdf->substr(table, 4), "xref");
    std::smatch entry;
    const std::string rest = pdf->substr(table);
    ASSERT_TRUE(std::regex_search(rest, entry, std::regex("xref\n(\\d+) 1\n(\\d{10}) 00000 n")));
    EXPECT_EQ(pdf->find(entry[1].str() + " 0 obj", std::stoul(entry[2])), std::stoul(entry[2]));
  }
}

TEST(Pdf, OneSheetIsAsLargeAsTheDrawing) {
  const auto sheet = layOut(test::random(5), {});
  const auto pdf = writePdf(test::random(5));
  std::smatch box;
  ASSERT_TRUE(std::regex_search(*pdf, box, std::regex("MediaBox \\[ 0 0 ([0-9.]+) ([0-9.]+) \\]")));
  EXPECT_NEAR(std::stod(box[1]) * 25.4 / 72, sheet->width, 0.01);
  EXPECT_NEAR(std::stod(box[2]) * 25.4 / 72, sheet->height, 0.01);
}

}  // namespace
}  // namespace karinui
