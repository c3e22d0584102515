// A stranger's file may ask for any number of anything. Beyond what a garment can have it is refused in a sentence that
// says what there is too much of, before it is kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <functional>

#include "karinui/exchange/drawing.h"
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/exchange/measurement_files.h"
#include "karinui/exchange/measurement_table.h"
#include "karinui/exchange/pattern_json.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

template <class T>
std::string said(const Result<T>& read) {
  return read ? "it was taken" : text(read.error().what);
}

// The same words `count` times, {} replaced by the number.
std::string times(std::size_t count, const std::function<std::string(std::size_t)>& one) {
  std::string all;
  for (std::size_t k = 0; k < count; ++k) all += one(k);
  return all;
}
std::string times(std::size_t count, const std::string& one) {
  return times(count, [&](std::size_t) { return one; });
}

TEST(Limits, OfPieces) {
  EXPECT_THAT(
      said(readPatternJson(R"({"format":"karinui-pattern-1","seams":[],"pieces":[0)" + times(2000, ",0") + "]}")),
      HasSubstr("more than 2000 panels"));
  EXPECT_THAT(
      said(readGarmentCode(R"({"pattern":{"panels":{"a":0)" +
                           times(2000, [](std::size_t k) { return ",\"p" + std::to_string(k) + "\":0"; }) + "}}}")),
      HasSubstr("more than 2000 panels"));
  const auto rectangles = [](std::size_t count) {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9000mm\" height=\"90000mm\" viewBox=\"0 0 9000 90000\">" +
           times(count,
                 [](std::size_t k) {
                   return "<rect x=\"" + std::to_string(k % 40 * 200) + "\" y=\"" + std::to_string(k / 40 * 200) +
                          "\" width=\"150\" height=\"150\"/>";
                 }) +
           "</svg>";
  };
  EXPECT_THAT(said(readDrawing(rectangles(2001))), HasSubstr("more than 2000 closed lines"));
  EXPECT_EQ(said(readDrawing(rectangles(20))), "it was taken");
  EXPECT_THAT(said(readCadPattern(
                  "0\nSECTION\n2\nBLOCKS\n" +
                  times(5001, [](std::size_t k) { return "0\nBLOCK\n2\nB" + std::to_string(k) + "\n0\nENDBLK\n"; }) +
                  "0\nENDSEC\n0\nEOF\n")),
              HasSubstr("more than 5000 pieces"));
}

TEST(Limits, OfLinesAndPoints) {
  EXPECT_THAT(
      said(readDrawing("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90mm\" height=\"90mm\"><path d=\"M0 0" +
                       times(400'001, "l1 1") + "z\"/></svg>")),
      HasSubstr("more than 400000 curves"));
  EXPECT_THAT(said(readDrawing("<svg xmlns=\"http://www.w3.org/2000/svg\">" + times(500'001, "<g/>") + "</svg>")),
              HasSubstr("500000"));
  EXPECT_THAT(
      said(readCadPattern("0\nSECTION\n2\nENTITIES\n" + times(2'000'001, "0\nPOINT\n") + "0\nENDSEC\n0\nEOF\n")),
      HasSubstr("more than 2000000 entities"));
  // Panels with more corners than any has, and edges that all have the same name.
  const auto panel = [](std::size_t vertices, std::size_t edges) {
    return R"({"pattern":{"panels":{"a":{"vertices":[[0,0])" + times(vertices - 1, ",[1,1]") +
           R"(],"edges":[{"endpoints":[0,1],"label":"x"})" +
           times(edges - 1,
                 [](std::size_t k) {
                   return R"(,{"endpoints":[)" + std::to_string((k + 1) % 2) + "," + std::to_string(k % 2) +
                          R"(],"label":"x"})";
                 }) +
           "]}}}}";
  };
  EXPECT_THAT(said(readGarmentCode(panel(60'001, 2))), HasSubstr("more than 60000 vertices"));
  EXPECT_THAT(said(readGarmentCode(panel(2, 60'001))), HasSubstr("more than 60000 edges"));
  EXPECT_THAT(said(readGarmentCode(panel(2, 60'000))), HasSubstr("of 60000 edges is more than Karinui takes (20000)"));
  // A round outline of so many corners.
  Outline outline;
  const auto at = [](int k) {
    const double angle = 2 * M_PI * k / 20001;
    return Flat{std::cos(angle), std::sin(angle)} * 40;
  };
  for (int k = 0; k < 20001; ++k)
    outline.edges.push_back({"e" + std::to_string(k), Curve::line(at(k), at((k + 1) % 20001))});
  EXPECT_THAT(said(checked(outline)), HasSubstr("An outline of 20001 edges is more than Karinui takes (20000)"));
}

// All of the same name, which costs no more than a hundred thousand names.
TEST(Limits, OfPeople) {
  EXPECT_THAT(said(readMeasurementTable("name,bust_girth_cm\n" + times(kMostPeople + 1, "a,91\n"))),
              HasSubstr("more than 100000 people"));
  const auto table = readMeasurementTable("name,bust_girth_cm\n" + times(kMostPeople, "a,91\n"));
  ASSERT_TRUE(table) << text(table.error().what);
  EXPECT_EQ(table->people.back().name, "a_100000");
}

TEST(Limits, OfMeasures) {
  const auto named = [](const char* line) {
    return [line](std::size_t k) {
      std::string one = line;
      return one.replace(one.find('#'), 1, std::to_string(k));
    };
  };
  EXPECT_THAT(said(readMeasuresYaml(times(5001, named("m#: 1\n")))), HasSubstr("more than 5000 measures"));
  EXPECT_THAT(said(readMeasuresJson("{\"a\":1" + times(5000, named(",\"m#\":1")) + "}")),
              HasSubstr("more than 5000 measures"));
  EXPECT_THAT(said(readValentina("<vit><unit>cm</unit><body-measurements>" +
                                 times(5001, named("<m name=\"m#\" value=\"1\"/>")) + "</body-measurements></vit>")),
              HasSubstr("more than 5000 measures"));
  EXPECT_THAT(said(readMeasuresText(times(1 << 20, "#\n\n\n") + "#\n")), HasSubstr("too large"));
}

// Each measure is kept by its path: sixteen long names above five thousand short ones are no gigabyte.
TEST(Limits, OfNamesOfMeasures) {
  std::string yaml;
  for (std::size_t depth = 0; depth < 16; ++depth) yaml += std::string(depth, ' ') + std::string(20'000, 'n') + ":\n";
  yaml += times(5000, [](std::size_t k) { return std::string(16, ' ') + "m" + std::to_string(k) + ": 1\n"; });
  rusage before{}, after{};
  ASSERT_EQ(getrusage(RUSAGE_SELF, &before), 0);
  EXPECT_THAT(said(readMeasuresYaml(yaml)), HasSubstr("no measures"));
  ASSERT_EQ(getrusage(RUSAGE_SELF, &after), 0);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 256 << 10) << "kilobytes";
}

}  // namespace
}  // namespace karinui
