// The pages of a PDF: their sizes, layers, fonts, and that they can be put together.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "exchange/page_nest.h"
#include "exchange/sheet.h"
#include "karinui/exchange/sheet.h"
#include "karinui/pattern/label_room.h"
#include "pdf_page.h"

namespace karinui {
namespace {

using test::Picture;
using test::rendered;

// A piece of 500 by 400 mm, on sheets of seam lines only: three by three A4 pages.
Pattern panel(const std::string& name = "panel", double width = 0.5, double height = 0.4) {
  Piece piece;
  piece.id = {1};
  piece.name = name;
  const Flat corner[] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  for (std::size_t k = 0; k < 4; ++k)
    piece.outline.edges.push_back({"e" + std::to_string(k), Curve::line(corner[k], corner[(k + 1) % 4])});
  Pattern pattern;
  pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  return pattern;
}

std::size_t pagesIn(const std::string& pdf) {
  const std::size_t last = pdf.rfind("/Type /Pages");
  return std::stoul(pdf.substr(pdf.find("/Count", pdf.rfind("<<", last)) + 6));
}

TEST(PdfPages, HaveThePapersSize) {
  struct Paper {
    PaperKind kind;
    double width, height;
  };
  SheetSettings settings;
  settings.allowance = 0;
  for (const auto& [kind, width, height] : {Paper{PaperKind::A4, 210, 297},
                                            {PaperKind::Letter, 215.9, 279.4},
                                            {PaperKind::A3, 297, 420},
                                            {PaperKind::A0, 841, 1189},
                                            {PaperKind::Inches36, 914.4, 1219.2}}) {
    const auto pdf = writePdf(panel(), kind, settings);
    ASSERT_TRUE(pdf);
    const std::regex any("MediaBox \\[ 0 0 ([0-9.]+) ([0-9.]+) \\]");
    for (std::sregex_iterator box(pdf->begin(), pdf->end(), any), end; box != end; ++box) {
      EXPECT_NEAR(std::stod((*box)[1]) * 25.4 / 72, width, 0.01);
      EXPECT_NEAR(std::stod((*box)[2]) * 25.4 / 72, height, 0.01);
    }
    const auto pages = PaperPages::of(panel(), kind, settings);
    ASSERT_TRUE(pages);
    EXPECT_EQ(pagesIn(*pdf), pages->count());
    EXPECT_TRUE(width < 500 || pages->count() == 1) << "no cover, and one sheet holds it";
  }
  settings.overlap = 0.05;
  EXPECT_FALSE(writePdf(panel(), PaperKind::A4, settings));
  settings.overlap = 0.03;
  const Pattern wide = panel("wide", 0.52, 0.4);
  EXPECT_EQ(PaperPages::of(wide, PaperKind::A4, settings)->count(), 13u) << "a wider strip needs more pages";
  settings.overlap = 0.01;
  EXPECT_EQ(PaperPages::of(wide, PaperKind::A4, settings)->count(), 10u);
}

// Beside a long piece there is room for many short ones, which shelves leave empty.
TEST(PdfPages, PiecesLieCloseTogether) {
  Pattern pattern = panel("long", 0.12, 1.4);
  for (std::uint32_t k = 2; k < 10; ++k) {
    Piece piece = *panel("short_" + std::to_string(k), 0.26, 0.26).pieces.begin()->second;
    piece.id = {k};
    pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  }
  Sheet sheet = *layOut(pattern, {});
  const TileGrid grid = *gridFor(PaperKind::A4, {});
  const std::size_t shelves = tilesOf(sheet, grid).size();
  nestOnPages(sheet, grid);
  EXPECT_LE(tilesOf(sheet, grid).size() * 4, shelves * 3);
  EXPECT_EQ(PaperPages::of(pattern, PaperKind::A4)->count(), 1 + tilesOf(sheet, grid).size());
  SheetSettings told;
  told.order.assign(60, say("Sew {0} onto {1}: {3|seam|seams} {2}.", "pocket", "a very long name of a piece", "7", 1));
  EXPECT_EQ(PaperPages::of(pattern, PaperKind::A4, told)->count(), 3 + tilesOf(sheet, grid).size())
      << "sixty steps have two pages of their own behind the cover";
  const auto cover = [&](const SheetSettings& settings) {
    return PaperPages::of(pattern, PaperKind::A4, settings)->draw(0, 4000, 0, 0, 840, 250);
  };
  EXPECT_NE(cover(told), cover({})) << "which counts them";
  const Sheet whole = *layOut(pattern, told);
  EXPECT_EQ(PaperPages::of(pattern, PaperKind::OneSheet, told)->count(), 1u);
  for (const SheetText& words : whole.headings)
    EXPECT_LE(words.place.x + wordsWidth(words.words, words.size), whole.width) << words.words;
  for (std::size_t i = 0; i < sheet.pieces.size(); ++i) {
    const SheetPiece& a = sheet.pieces[i];
    EXPECT_GE(a.low.x, 0);
    EXPECT_LE(a.high.x, sheet.width);
    EXPECT_LE(a.high.y, sheet.height);
    EXPECT_GE(a.low.y, sheet.square.y + kSquare);
    EXPECT_LT(std::abs(a.texts.front().place.x - 0.5 * (a.low.x + a.high.x)), 130) << "its name went with it";
    for (std::size_t j = 0; j < i; ++j) {
      const SheetPiece& b = sheet.pieces[j];
      EXPECT_FALSE(a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y);
    }
  }
}

TEST(PdfPages, EmptyOnesAreLeftOut) {
  Pattern pattern = panel("long", 0.05, 1.4);
  Piece wide = *panel("wide", 0.7, 0.05).pieces.begin()->second;
  wide.id = {2};
  pattern.pieces[wide.id] = std::make_shared<const Piece>(wide);
  const auto sheet = layOut(pattern, {});
  ASSERT_TRUE(sheet);
  const double rows = std::ceil((sheet->height - 10) / 267), columns = std::ceil((sheet->width - 10) / 180);
  const auto pages = PaperPages::of(pattern, PaperKind::A4);
  ASSERT_TRUE(pages);
  EXPECT_LT(static_cast<double>(pages->count()), 1 + rows * columns);
  for (std::size_t page = 0; page < pages->count(); ++page) {  // frames and marks are grey, pieces and squares black
    const auto drawn = pages->draw(page, 4000, 0, 0, 840, 1188);
    EXPECT_TRUE(std::any_of(drawn.begin(), drawn.end(), [](std::uint32_t pixel) { return (pixel & 0xff) < 90; }))
        << page;
  }
}

// Where a page has half a diamond: the middle of its base, in pixels. The base of those at the sides is upright.
struct DrawnMark {
  double x = -1, y = -1;
  double length = 0;  // of the run that was found
  bool found() const { return x >= 0; }
};
bool grey(int value) { return value > 60 && value < 200; }
bool black(int value) { return value < 60; }

// The first line from one side of the page on which as long a run of that colour lies as asked for.
template <class Is>
DrawnMark runOn(const Picture& page, bool upright, bool fromEnd, double least, double most, const Is& is) {
  const int lines = upright ? page.width : page.height, length = upright ? page.height : page.width;
  for (int k = 0; k < lines; ++k) {
    const int line = fromEnd ? lines - 1 - k : k;
    for (int from = 0; from < length;) {
      const auto value = [&](int at) { return upright ? page.at(line, at) : page.at(at, line); };
      if (!is(value(from))) {
        ++from;
        continue;
      }
      int to = from;
      while (to < length && is(value(to))) ++to;
      if (to - from >= least && to - from <= most) {
        const double middle = (from + to - 1) / 2.0;
        const double own = line, size = to - from;
        return upright ? DrawnMark{own, middle, size} : DrawnMark{middle, own, size};
      }
      from = to;
    }
  }
  return {};
}

TEST(PdfPages, PutTogetherByTheirMarksTheyMeasureRight) {
  if (!test::drawsPdf()) GTEST_SKIP() << "pdftoppm is not installed";
  constexpr int kDpi = 600;
  constexpr double kPixel = 25.4 / kDpi;  // mm
  SheetSettings settings;
  settings.allowance = 0;
  const auto pdf = writePdf(panel(), PaperKind::A4, settings);
  ASSERT_TRUE(pdf);
  ASSERT_EQ(pagesIn(*pdf), 10u);
  // The middle row and the middle column.
  Picture page[3][3];
  for (int k = 0; k < 3; ++k) {
    page[1][k] = rendered(*pdf, 5 + k, kDpi);
    if (k != 1) page[k][1] = rendered(*pdf, 3 + 3 * k, kDpi);
  }
  const auto mark = [&](const Picture& of, bool upright, bool fromEnd) {
    // Half a diamond is 10 mm wide at its base and 5 mm high, and the base lies on a line: found a little within.
    DrawnMark found = runOn(of, upright, fromEnd, 6 / kPixel, 8.5 / kPixel, grey);
    const double base = (10 / kPixel - found.length) / 2 * (fromEnd ? 1 : -1);
    (upright ? found.x : found.y) += base;
    return found;
  };
  // Pages are laid so that the bases of two half diamonds fall on each other: where a page lies, seen from the one
  // before.
  const auto apart = [&](const Picture& before, const Picture& behind, bool across) {
    const DrawnMark there = mark(before, across, true), here = mark(behind, across, false);
    EXPECT_TRUE(there.found() && here.found());
    return DrawnMark{there.x - here.x, there.y - here.y, 0};
  };
  const DrawnMark second = apart(page[1][0], page[1][1], true), third = apart(page[1][1], page[1][2], true),
                  below = apart(page[0][1], page[1][1], false), last = apart(page[1][1], page[2][1], false);
  EXPECT_NEAR(second.y * kPixel, 0, 0.2);
  EXPECT_NEAR(last.x * kPixel, 0, 0.2);
  const double longer = 110 / kPixel, any = 1e9;  // than the sides of the squares
  const DrawnMark left = runOn(page[1][0], true, false, longer, any, black),
                  right = runOn(page[1][2], true, true, longer, any, black),
                  top = runOn(page[0][1], false, false, longer, any, black),
                  foot = runOn(page[2][1], false, true, longer, any, black);
  ASSERT_TRUE(left.found() && right.found() && top.found() && foot.found());
  const double line = 0.6;  // mm: from the outer side of one line to that of the other
  EXPECT_NEAR((second.x + third.x + right.x - left.x) * kPixel, 500 + line, 0.5);
  EXPECT_NEAR((below.y + last.y + foot.y - top.y) * kPixel, 400 + line, 0.5);
}

TEST(PdfPages, TheDashedSquareMeasuresFourInches) {
  if (!test::drawsPdf()) GTEST_SKIP() << "pdftoppm is not installed";
  const auto pdf = writePdf(panel(), PaperKind::A4);
  ASSERT_TRUE(pdf);
  constexpr int kRows = 800;  // a dash and a gap
  const Picture strip = rendered(*pdf, 1, 2540, "-x 0 -y 20000 -W 13000 -H " + std::to_string(kRows));
  ASSERT_EQ(strip.height, kRows);
  std::vector<double> lines;
  int since = -1;
  for (int x = 0; x < strip.width; ++x) {
    bool dark = false;
    for (int y = 0; y < kRows && !dark; y += 7) dark = strip.at(x, y) < 100;
    if (dark && since < 0) since = x;
    if (!dark && since >= 0) lines.push_back((since + x - 1) / 200.0), since = -1;
  }
  double nearest = 1e9;
  for (const double a : lines)
    for (const double b : lines) nearest = std::min(nearest, std::abs(std::abs(b - a) - 101.6));
  EXPECT_LT(nearest, 0.1);
}

TEST(PdfPages, KindsOfLinesAreLayers) {
  SheetSettings settings;
  settings.language = Language::Japanese;
  for (const PaperKind paper : {PaperKind::OneSheet, PaperKind::A4}) {
    const auto pdf = writePdf(panel(), paper, settings);
    ASSERT_TRUE(pdf);
    std::size_t layers = 0;
    for (std::size_t at = 0; (at = pdf->find("/Type /OCG /Name <FEFF", at)) != std::string::npos; ++at) ++layers;
    EXPECT_EQ(layers, 7u);
    EXPECT_NE(pdf->find("<FEFF88C130617DDA>"), std::string::npos) << "cut lines";
    EXPECT_NE(pdf->find("/Version /1.5"), std::string::npos);
    if (!test::drawsPdf()) continue;
    // All of them switched off, the frames and squares stay and the piece is gone.
    std::string hidden = *pdf;
    const std::size_t on = hidden.rfind("/ON [");
    ASSERT_NE(on, std::string::npos);
    hidden.replace(on, 5, "/OFF[");
    const int page = paper == PaperKind::A4 ? 6 : 1;  // B2, all within the piece's box and its lettering
    const auto inked = [&](const std::string& file) {
      const Picture drawn = rendered(file, page, 60);
      return std::count_if(drawn.grey.begin(), drawn.grey.end(),
                           [](char value) { return black(static_cast<unsigned char>(value)); });
    };
    EXPECT_GT(inked(*pdf), inked(hidden) + 100);
    EXPECT_TRUE(paper == PaperKind::A4 || inked(hidden) > 500) << "the squares";
  }
}

// Who has the sheets before him and not the program reads on the cover what the layers are for.
TEST(PdfPages, TheCoverSaysWhatLayersAreFor) {
  if (std::system("pdftotext -v >/dev/null 2>&1") != 0) GTEST_SKIP() << "pdftotext is not installed";
  const auto pdf = writePdf(panel(), PaperKind::A4, {});
  ASSERT_TRUE(pdf);
  std::string folder = (std::filesystem::temp_directory_path() / "karinui-pdf-XXXXXX").string();
  ASSERT_TRUE(::mkdtemp(folder.data()));
  ASSERT_TRUE(writeFile(folder + "/a.pdf", *pdf));
  ASSERT_EQ(std::system(("pdftotext -l 1 -layout " + folder + "/a.pdf " + folder + "/a.txt").c_str()), 0);
  const std::string words = test::content(folder + "/a.txt");
  std::filesystem::remove_all(folder);
  EXPECT_NE(words.find("can be hidden first"), std::string::npos) << words;
  EXPECT_NE(words.find("in the list of layers of the program that shows this PDF"), std::string::npos) << words;
}

TEST(PdfPages, FontsAreEmbeddedAlsoJapaneseOnes) {
  if (std::system("pdffonts -v >/dev/null 2>&1") != 0) GTEST_SKIP() << "pdffonts is not installed";
  SheetSettings settings;
  settings.language = Language::Japanese;
  const auto pdf = writePdf(panel("前身頃"), PaperKind::A4, settings);
  ASSERT_TRUE(pdf);
  std::string folder = (std::filesystem::temp_directory_path() / "karinui-pdf-XXXXXX").string();
  ASSERT_TRUE(::mkdtemp(folder.data()));
  ASSERT_TRUE(writeFile(folder + "/a.pdf", *pdf));
  ASSERT_EQ(std::system(("pdffonts " + folder + "/a.pdf > " + folder + "/fonts").c_str()), 0);
  std::istringstream fonts(test::content(folder + "/fonts"));
  std::filesystem::remove_all(folder);
  std::string line;
  std::getline(fonts, line), std::getline(fonts, line);  // the table's head
  int count = 0;
  while (std::getline(fonts, line)) {
    EXPECT_TRUE(std::regex_search(line, std::regex(" yes yes ")) || std::regex_search(line, std::regex(" yes no ")))
        << line;
    ++count;
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace karinui
