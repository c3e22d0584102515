// Tables of measures of many people.
#include "karinui/exchange/measurement_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace karinui {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

double of(const MeasuredPerson& person, const char* key) { return person.measures.value.at(key); }

TEST(MeasurementTable, ReadsNamesUnitsAndSexes) {
  const auto table = readMeasurementTable(
      "\xEF\xBB\xBFname,sex,height_cm,Bust (mm),waist_girth,hip_girth_in,shoe\r\n"
      "\"Sato, Hana\",f,158,880,\"66cm\",36,37\r\n"
      "\r\n"
      "\"the \"\"tall\"\" one\",male,190,,0.84,40,45\n"
      ",,170,900,70cm,38,\n"
      "\"Sato, Hana\",female,160,890,67cm,37,38");
  ASSERT_TRUE(table) << text(table.error().what);
  ASSERT_EQ(table->people.size(), 4u);
  EXPECT_THAT(table->unknown, ElementsAre("shoe"));
  const auto& people = table->people;
  EXPECT_EQ(people[0].name, "Sato, Hana");
  EXPECT_EQ(people[1].name, "the \"tall\" one");
  EXPECT_EQ(people[2].name, "row 5");
  EXPECT_EQ(people[3].name, "Sato, Hana_2");
  EXPECT_NEAR(of(people[0], "height"), 1.58, 1e-12);
  EXPECT_NEAR(of(people[0], "bust_girth"), 0.88, 1e-12);
  EXPECT_NEAR(of(people[0], "waist_girth"), 0.66, 1e-12);
  EXPECT_NEAR(of(people[0], "hip_girth"), 0.9144, 1e-12);
  EXPECT_EQ(people[1].measures.sex, Sex::Male);
  const auto child = readMeasurementTable("name,sex,height_cm\nKo,child,116\n");
  ASSERT_TRUE(child);
  EXPECT_EQ(child->people.front().measures.sex, Sex::Child);
  EXPECT_EQ(people[2].measures.sex, Sex::Female);
  EXPECT_FALSE(people[1].measures.value.contains("bust_girth"));
}

TEST(MeasurementTable, TakesSemicolonsAndTabs) {
  const auto apart = readMeasurementTable("height;bust_girth\n158 cm;88,5 cm\n");
  ASSERT_TRUE(apart) << text(apart.error().what);
  EXPECT_DOUBLE_EQ(apart->people.front().measures.value.at("bust_girth"), 0.885);
  const auto semicolons = readMeasurementTable("height;bust_girth\n1.58;88cm\n"),
             tabs = readMeasurementTable("height\tbust_girth\n1.58\t88cm\n");
  ASSERT_TRUE(semicolons && tabs);
  EXPECT_EQ(semicolons->people[0].measures, tabs->people[0].measures);
}

TEST(MeasurementTable, TakesDecimalCommasWhereOtherSignsSeparateTheCells) {
  for (const std::string cut : {";", "\t"}) {
    const auto table =
        readMeasurementTable("name" + cut + "bust_girth_cm" + cut + "height" + cut + "waist_girth\nÅsa" + cut + "88,5" +
                             cut + "1,62" + cut + "70,25cm\nBo" + cut + "90.5" + cut + "1.7" + cut + "71cm\n");
    ASSERT_TRUE(table) << text(table.error().what);
    EXPECT_DOUBLE_EQ(of(table->people[0], "bust_girth"), 0.885);
    EXPECT_DOUBLE_EQ(of(table->people[0], "height"), 1.62);
    EXPECT_DOUBLE_EQ(of(table->people[1], "bust_girth"), 0.905);
  }
  const auto refusal = [](const std::string& bytes) {
    const auto table = readMeasurementTable(bytes);
    return table ? std::string("read") : text(table.error().what);
  };
  for (const char* cell : {"1.580,5", "1,580.5", "1,2,3", ",5", "88,", "88,cm"})
    EXPECT_THAT(refusal(std::string("name;bust_girth_cm\nA;") + cell + "\n"), HasSubstr("is no measure")) << cell;
  EXPECT_THAT(refusal("name,bust_girth_cm\nA,\"88,5\"\n"),
              HasSubstr("Row 2 of the table, column “bust_girth_cm”: “88,5” has a decimal comma"));
  EXPECT_THAT(refusal("name,bust_girth_cm\nA,88,5\n"), HasSubstr("need semicolons between the cells"));
}

TEST(MeasurementTable, InchesInFractions) {
  const auto table = readMeasurementTable("name,waist_in,hip\nA,27 1/2,38 3/4in\nB,27.5,38.75in\n");
  ASSERT_TRUE(table) << text(table.error().what);
  for (const auto& person : table->people) {
    EXPECT_DOUBLE_EQ(of(person, "waist_girth"), 27.5 * 0.0254);
    EXPECT_DOUBLE_EQ(of(person, "hip_girth"), 38.75 * 0.0254);
  }
}

TEST(MeasurementTable, RefusesALengthThatLacksItsUnit) {
  const auto refusal = [](const std::string& bytes) {
    const auto table = readMeasurementTable(bytes);
    return table ? std::string("read") : text(table.error().what);
  };
  EXPECT_EQ(refusal("name,bust_girth\nA,88\n"),
            "Row 2 of the table, column “bust_girth”: “88” has no unit and would be 88 metres; write 88cm or 88mm, or "
            "88m if it is meant. Or the column's name says it: bust_girth_cm.");
  EXPECT_THAT(refusal("name;Bust\nA;88,5\n"), HasSubstr("Or the column's name says it: bust_girth_cm."));
  EXPECT_EQ(refusal("name,bust_girth,height_m\nA,0.88,1.6\n"), "read");
}

TEST(MeasurementTable, SaysWhatIsWrongAndWhere) {
  const auto refusal = [](const std::string& bytes) {
    const auto table = readMeasurementTable(bytes);
    return table ? std::string("read") : text(table.error().what);
  };
  EXPECT_THAT(refusal(""), HasSubstr("no row"));
  EXPECT_THAT(refusal("name,shoe\nA,1\n"), HasSubstr("names no measure"));
  EXPECT_THAT(refusal("height\n"), HasSubstr("no row"));
  EXPECT_THAT(refusal("height_cm\n158\nlong\n"), HasSubstr("Row 3 of the table, column “height_cm”: “long”"));
  EXPECT_THAT(refusal("height_cm\nnan\n"), HasSubstr("“nan” is no measure"));
  EXPECT_THAT(refusal("height,sex\n1.6,x\n"), HasSubstr("column “sex”: “x” is no figure; write female, male or child"));
  EXPECT_THAT(refusal("height\n1.6,2\n"), HasSubstr("more cells"));
  EXPECT_THAT(refusal("bust,bust_girth\n1,1\n"), HasSubstr("Two columns"));
  EXPECT_THAT(refusal("height\n\"1.6\n"), HasSubstr("never closed"));
  EXPECT_THAT(refusal("height\n" + std::string(1000, '1') + "\n"), HasSubstr("too long"));
  EXPECT_THAT(refusal(std::string("height\n1.6\0\n", 12)), HasSubstr("not text"));
}

TEST(MeasurementTable, AnyBytesAreRefusedInASentenceOrRead) {
  const std::string good = "name,sex,height_cm,Bust (mm)\n\"A, B\",f,158,880\nC,m,170,\n";
  std::mt19937_64 dice(5);
  for (int i = 0; i < 3000; ++i) {
    std::string bad = good;
    for (std::size_t k = 0, n = 1 + dice() % 5; k < n; ++k) bad[dice() % bad.size()] = static_cast<char>(dice());
    const auto table = readMeasurementTable(bad);
    if (!table) {
      EXPECT_FALSE(text(table.error().what).empty());
    } else {
      for (const auto& person : table->people) EXPECT_FALSE(person.name.empty());
    }
  }
}

}  // namespace
}  // namespace karinui
