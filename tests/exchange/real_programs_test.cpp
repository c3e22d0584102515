// Our files in the programs that people open them with. A program that is not on the machine is skipped by its name;
// none of them is needed to build or to pass.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <set>

#include "exchange/dxf/dxf_shapes.h"
#include "exchange/graded_style.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/exchange/dxf.h"
#include "patterns.h"
#include "pdf_page.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

class Programs : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_NE(::mkdtemp(folder_.data()), nullptr); }
  void TearDown() override { fs::remove_all(folder_); }

  static bool has(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
  }
  std::string write(const std::string& name, const std::string& bytes) const {
    const fs::path file = fs::path(folder_) / name;
    EXPECT_TRUE(writeFile(file, bytes));
    return file.string();
  }
  // What a command says; it has no screen, a home of its own and a minute.
  std::string answer(const std::string& command) const {
    const std::string all =
        "HOME=" + folder_ + " QT_QPA_PLATFORM=offscreen timeout -k 5 60 " + command + " 2>/dev/null";
    FILE* pipe = ::popen(all.c_str(), "r");
    if (!pipe) return {};
    std::string said;
    std::array<char, 4096> part{};
    for (std::size_t got = 0; (got = std::fread(part.data(), 1, part.size(), pipe)) > 0;) said.append(part.data(), got);
    EXPECT_EQ(::pclose(pipe), 0) << command;
    return said;
  }
  std::string folder_ = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
};

// Cut-outs, an inner line, a drill hole and notches, in all sizes.
test::GradedStyle styleWithCutOut() {
  test::GradedStyle made = test::gradedStyle();
  Piece front = *made.pattern.pieces.at({1});
  front.holes = {
      {{{"eyelet_a", Curve::arc({0.03, 0.1}, {0.07, 0.1}, 1)}, {"eyelet_b", Curve::arc({0.07, 0.1}, {0.03, 0.1}, 1)}}}};
  front.lines = {{"pocket", {Curve::line({0.08, 0.2}, {0.16, 0.2})}, {}}};
  front.marks.push_back({"bust", "", 0, {0.12, 0.33}});
  made.pattern.pieces[{1}] = std::make_shared<const Piece>(front);
  return made;
}

constexpr double kMmOfPixel = 25.4 / 96;  // Inkscape's pixels

TEST_F(Programs, InkscapeMeasuresTheSquare) {
  if (!has("inkscape")) GTEST_SKIP() << "inkscape is not installed";
  const auto svg = writeSvg(test::random(5));
  ASSERT_TRUE(svg);
  // "id,x,y,width,height"; in the row after the group's is the square itself, drawn with a line of 0.35 mm.
  const std::string all = answer("inkscape --query-all " + write("sheet.svg", *svg));
  std::smatch row;
  ASSERT_TRUE(std::regex_search(all, row, std::regex("\ntest-square,.*\nrect[^,]*,([^,]*),([^,]*),([^,]*),([^,\n]*)")))
      << all.substr(0, 500);
  EXPECT_NEAR(std::stod(row[3]) * kMmOfPixel - 0.35, 100, 0.05);
  EXPECT_NEAR(std::stod(row[4]) * kMmOfPixel - 0.35, 100, 0.05);
}

TEST_F(Programs, PopplerDrawsTheSquareAt600Dpi) {
  if (!has("pdftoppm")) GTEST_SKIP() << "pdftoppm is not installed";
  constexpr int kDpi = 600;
  for (const auto& [paper, page] : {std::pair{PaperKind::OneSheet, 1}, {PaperKind::A4, 2}, {PaperKind::A0, 1}}) {
    const auto pdf = writePdf(test::random(5), paper);
    ASSERT_TRUE(pdf);
    const int top = 80 * kDpi / 25;
    const test::Picture strip = test::rendered(*pdf, page, kDpi, "-x 0 -y " + std::to_string(top) + " -W 3400 -H 1");
    ASSERT_GT(strip.width, 3000);
    std::vector<double> lines;  // their middles, in pixels
    for (int x = 0, from = -1; x < strip.width; ++x) {
      const bool dark = strip.at(x, 0) < 128;
      if (dark && from < 0) from = x;
      if (!dark && from >= 0) lines.push_back(0.5 * (from + x - 1)), from = -1;
    }
    double nearest = 1e9;
    for (const double a : lines)
      for (const double b : lines)
        if (std::abs((b - a) * 25.4 / kDpi - 100) < std::abs(nearest - 100)) nearest = (b - a) * 25.4 / kDpi;
    EXPECT_NEAR(nearest, 100, 0.05);
  }
}

TEST_F(Programs, EzdxfFindsNothingWrong) {
  if (std::system("/usr/bin/python3 -c 'import ezdxf' 2>/dev/null") != 0) GTEST_SKIP() << "no python3-ezdxf";
  test::GradedStyle made = styleWithCutOut();
  const std::string ask =
      write("ask.py",
            "import sys, ezdxf\n"
            "d = ezdxf.readfile(sys.argv[1])\n"
            "b = [b for b in d.blocks if b.query('POLYLINE[layer==\"1\"]')]\n"
            "def count(kind, layer): return sum(len(x.query('%s[layer==\"%s\"]' % (kind, layer))) for x in b)\n"
            "print(len(d.audit().errors), len(b), count('POLYLINE', 1), count('POLYLINE', 11), "
            "count('POINT', 4), count('POINT', 13), len(d.modelspace().query('INSERT')))\n");
  for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm})
    for (const double allowance : {0.0, 0.012}) {
      made.sheet.allowance = allowance;
      const auto dxf = writeDxf(made.pattern, dialect, made.sheet);
      ASSERT_TRUE(dxf);
      // Two pieces in four sizes; in each of the front's one cut-out, one notch and one drill hole.
      EXPECT_EQ(answer("/usr/bin/python3 " + ask + " " + write("style.dxf", *dxf)), "0 8 8 4 4 4 8\n");
    }
}

TEST_F(Programs, LibreCadDrawsEveryLine) {
  if (!has("librecad") || !has("pdftocairo")) GTEST_SKIP() << "librecad or pdftocairo is not installed";
  constexpr double kScale = 0.1;  // on a sheet of A4
  test::GradedStyle made = styleWithCutOut();
  made.sheet.allowance = 0.012;
  for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm}) {
    const std::string dxf = *writeDxf(made.pattern, dialect, made.sheet);
    const auto file = parseDxf(dxf);
    ASSERT_TRUE(file);
    std::vector<Flat> wanted;  // of every block, whether or not it is inserted
    for (const DxfBlock& block : file->blocks) {
      const auto shapes = shapesOf(*file, block.entities, {}, {});
      ASSERT_TRUE(shapes);
      for (const DxfShape& shape : *shapes)
        if (shape.kind == DxfShape::Kind::Line) wanted.insert(wanted.end(), shape.points.begin(), shape.points.end());
    }
    ASSERT_GT(wanted.size(), 500u);

    answer("librecad dxf2pdf -c -m -s " + fixed(kScale, 2) + " " + write("style.dxf", dxf));  // to style.pdf
    answer("pdftocairo -svg " + folder_ + "/style.pdf " + folder_ + "/drawn.svg");
    const std::string svg = test::content(folder_ + "/drawn.svg");
    std::vector<Flat> drawn;
    const std::regex path("<path style=\"fill:none[^>]* d=\"([^\"]*)\"[^>]*matrix\\(([0-9.]+),");
    const std::regex place("[ML] (-?[0-9.]+) (-?[0-9.]+)");
    for (std::sregex_iterator p(svg.begin(), svg.end(), path), end; p != end; ++p) {
      const std::string d = (*p)[1];
      const double mm = std::stod((*p)[2]) * 25.4 / 72 / kScale;
      for (std::sregex_iterator q(d.begin(), d.end(), place); q != end; ++q)
        drawn.push_back({std::stod((*q)[1]) * mm, -std::stod((*q)[2]) * mm});
    }
    ASSERT_GT(drawn.size(), 500u);
    // The sheet's middle is the drawing's, wherever that is: the shift that brings most points together. At a tenth the
    // printer's dots are 0.2 mm wide.
    std::set<std::pair<long, long>> cells;  // of half a millimetre
    const auto cell = [](double x) { return std::lround(2 * x); };
    for (const Flat p : drawn) cells.insert({cell(p.u), cell(p.v)});
    const auto missed = [&](Flat shift, std::size_t step) {
      std::size_t count = 0;
      for (std::size_t i = 0; i < wanted.size(); i += step) {
        const Flat p = wanted[i] + shift;
        bool found = false;
        for (const long u : {-1L, 0L, 1L})
          for (const long v : {-1L, 0L, 1L}) found = found || cells.contains({cell(p.u) + u, cell(p.v) + v});
        count += !found;
      }
      return count;
    };
    Flat best;
    std::size_t least = wanted.size();
    for (const Flat p : drawn)
      if (const std::size_t now = missed(p - wanted[0], 1 + wanted.size() / 20); now < least)
        least = now, best = p - wanted[0];
    EXPECT_EQ(missed(best, 1), 0u);
  }
}

}  // namespace
}  // namespace karinui
