// Sizes through the trade's files and back: DXF with a block for every size, and RUL beside a DXF of one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "exchange/graded_style.h"
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/read_pattern.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Style = test::GradedStyle;

constexpr double kTrue = 5e-5;  // metres

double missOf(const Outline& a, const Outline& b) {
  const Ring line = b.flattened(1e-6);
  double most = 0;
  for (const Flat p : a.flattened(1e-6)) most = std::max(most, distanceToRing(line, p));
  return most;
}

// Every size of what was read against the very outlines.
void expectSizes(const Pattern& wanted, const Grading& asked, const CadPattern& read) {
  ASSERT_EQ(read.grading.sizes.size(), asked.sizes.size());
  EXPECT_EQ(read.grading.sizes[read.grading.base], asked.sizes[asked.base]);
  for (std::size_t size = 0; size < asked.sizes.size(); ++size)
    for (const auto& [id, piece] : wanted.pieces) {
      const auto want = inSize(*piece, asked, size), have = inSize(*read.pattern.pieces.at(id), read.grading, size);
      ASSERT_TRUE(want && have);
      EXPECT_LT(missOf(want->outline, have->outline), kTrue) << asked.sizes[size] << " " << piece->name;
      EXPECT_LT(missOf(have->outline, want->outline), kTrue) << asked.sizes[size] << " " << piece->name;
    }
}

// The file without the blocks of other sizes than M.
std::string sampleOnly(std::string text) {
  for (;;) {
    std::size_t at = std::string::npos;
    for (const char* size : {"_S\r\n", "_L\r\n", "_XL\r\n"}) {
      const std::size_t named = text.find(size);
      if (named != std::string::npos && named < text.find("ENTITIES")) at = std::min(at, named);
    }
    if (at == std::string::npos) return text;
    const std::size_t from = text.rfind("0\r\nBLOCK\r\n", at), to = text.find("ENDBLK\r\n8\r\n0\r\n", at) + 14;
    text.erase(from, to - from);
  }
}

TEST(GradeRules, SizesComeBackThroughDxf) {
  for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm})
    for (const double allowance : {0.0, 0.012}) {
      Style made = test::gradedStyle();
      made.sheet.allowance = allowance;
      const auto text = writeDxf(made.pattern, dialect, made.sheet);
      ASSERT_TRUE(text);
      const auto read = readCadPattern(*text);
      ASSERT_TRUE(read);
      EXPECT_TRUE(read->notes.empty());
      EXPECT_THAT(read->sizes, ElementsAre("S", "M", "L", "XL"));
      expectSizes(made.pattern, made.sheet.grading, *read);
      // Another size that stands is the same style.
      const auto large = readCadPattern(*text, "XL");
      ASSERT_TRUE(large);
      EXPECT_EQ(large->grading.base, 3u);
      const auto want = inSize(*made.pattern.pieces.at({1}), made.sheet.grading, 0),
                 have = inSize(*large->pattern.pieces.at({1}), large->grading, 0);
      EXPECT_LT(missOf(want->outline, have->outline), kTrue);
    }
}

TEST(GradeRules, TheRulesOfOneSizeGiveTheOthers) {
  for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm})
    for (const double allowance : {0.0, 0.012}) {
      Style made = test::gradedStyle();
      made.sheet.allowance = allowance;
      const auto table = writeGradeRules(made.pattern, made.sheet);
      ASSERT_TRUE(table);
      auto read = readCadPattern(sampleOnly(*writeDxf(made.pattern, dialect, made.sheet)));
      ASSERT_TRUE(read);
      EXPECT_THAT(read->sizes, ElementsAre("M"));
      const auto rules = readGradeRules(*table);
      ASSERT_TRUE(rules) << text(rules.error().what);
      const Done done = takeGradeRules(*read, *rules);
      ASSERT_TRUE(done) << text(done.error().what);
      expectSizes(made.pattern, made.sheet.grading, *read);
    }
}

TEST(GradeRules, TheTableIsWrittenAsTheTradeDoes) {
  const Style made = test::gradedStyle();
  const std::string table = *writeGradeRules(made.pattern, made.sheet);
  EXPECT_THAT(table, HasSubstr("NUMBER OF SIZES: 4\r\nSIZE LIST: S M L XL\r\nSAMPLE SIZE: M\r\n"));
  EXPECT_THAT(table, HasSubstr("RULE: DELTA 2\r\n    -10.00,     0.00       0.00,     0.00      10.00,     0.00      "
                               "20.00,     0.00\r\n"));
  EXPECT_FALSE(writeGradeRules(made.pattern, {}));
}

TEST(GradeRules, MakersDifferInWhatTheirRulesBeginFrom) {
  const std::string_view table =
      "ANSI/AAMA VERSION: 1.0.0\nunits: ENGLISH\nSIZE LIST: 36 38 40 42\nSAMPLE SIZE: 38\nRULE: DELTA 7\n"
      "-1,0 0,0 1,0.5\n2,0.5\n";
  const auto from = readGradeRules(table), steps = readGradeRules(table, true);
  ASSERT_TRUE(from && steps);
  EXPECT_THAT(from->rules.at(7), ElementsAre(Flat{-.0254, 0}, Flat{}, Flat{.0254, .0127}, Flat{.0508, .0127}));
  EXPECT_THAT(steps->rules.at(7), ElementsAre(Flat{-.0254, 0}, Flat{}, Flat{.0254, .0127}, Flat{3 * .0254, .0254}));
}

TEST(GradeRules, WhatCannotBeIsRefused) {
  const auto refusal = [](std::string_view table) { return text(readGradeRules(table).error().what); };
  EXPECT_THAT(refusal("nothing"), HasSubstr("This is no table of grade rules"));
  EXPECT_THAT(refusal("SIZE LIST: S M\nSAMPLE SIZE: L\nRULE: DELTA 1\n0,0 1,1"), HasSubstr("none of its sizes"));
  EXPECT_THAT(refusal("SIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA 1\n0,0 1"),
              HasSubstr("has 3 numbers; 2 sizes need 4"));
  EXPECT_THAT(refusal("SIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA x\n0,0 1,0"), HasSubstr("no rule’s number"));
  EXPECT_THAT(refusal("SIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA 1\n1,0 1,0"), HasSubstr("leads away"));
  EXPECT_THAT(refusal("SIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA 1\n0,0 2000,0"), HasSubstr("farther than 1 m"));
  Style made = test::gradedStyle();
  auto read = readCadPattern(sampleOnly(*writeDxf(made.pattern, DxfDialect::Aama, made.sheet)));
  const auto other = readGradeRules("SIZE LIST: S M\nSAMPLE SIZE: M\nRULE: DELTA 1\n-1,0 0,0");
  EXPECT_THAT(text(takeGradeRules(*read, *other).error().what), HasSubstr("which the table does not have"));
  const auto wrong = readGradeRules("SIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA 1\n0,0 1,0");
  EXPECT_THAT(text(takeGradeRules(*read, *wrong).error().what), HasSubstr("The rules begin from size S"));
  EXPECT_TRUE(read->grading.empty());
}

TEST(GradeRules, ATableBesideTheFileIsRead) {
  std::string folder = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const Style made = test::gradedStyle();
  const fs::path file = fs::path(folder) / "style.dxf", table = fs::path(folder) / "rules.txt";
  std::ofstream(file, std::ios::binary) << sampleOnly(*writeDxf(made.pattern, DxfDialect::Astm, made.sheet));
  EXPECT_TRUE(readPatternSize(file, {})->grading.empty());
  std::ofstream(table, std::ios::binary) << *writeGradeRules(made.pattern, made.sheet);
  EXPECT_EQ(readPatternSize(file, {}, fileFormats(), {table, false})->grading.sizes.size(), 4u);
  fs::copy_file(table, fs::path(folder) / "style.rul");
  EXPECT_EQ(readPatternSize(file, {})->grading.pieces.size(), 2u);
  fs::remove_all(folder);
}

// Each size by the differences is what it is when it is read by itself.
TEST(GradeRules, SizesOfFilesFromIndustryAreKept) {
  const fs::path shared = fs::path(KARINUI_SHARED_DIR) / "patterns/dxf";
  if (!fs::exists(shared / "README.md")) GTEST_SKIP() << "no shared patterns beside the project";
  for (const char* name : {"tank_14_sizes_aama.dxf", "polo_drill_holes.dxf", "shorts_aama.dxf",
                           "trousers_waistband_aama.dxf", "trousers_waistband_astm.dxf"}) {
    SCOPED_TRACE(name);
    const auto read = readPatternSize(shared / name, {});
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->notes.empty());
    const Grading& grading = read->grading;
    ASSERT_EQ(grading.sizes.size(), read->sizes.size());
    for (const std::size_t size : {std::size_t{0}, grading.sizes.size() - 1}) {
      const auto alone = readPatternSize(shared / name, read->sizes[size]);
      ASSERT_TRUE(alone && alone->notes.empty());
      for (const auto& [id, piece] : read->pattern.pieces) {
        const auto made = inSize(*piece, grading, size);
        ASSERT_TRUE(made);
        EXPECT_LT(missOf(made->outline, alone->pattern.pieces.at(id)->outline), kTrue)
            << piece->name << " " << read->sizes[size];
      }
    }
  }
}

}  // namespace
}  // namespace karinui
