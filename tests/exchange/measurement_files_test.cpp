// Files of measures: each format read, written and read back; strangers' files refused in a sentence.
#include "karinui/exchange/measurement_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <random>

#include "exchange/measure_names.h"
#include "karinui/exchange/formats.h"

namespace karinui {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

Measurements someone() {
  Measurements m;
  m.value = {{"bust_girth", 0.88},    {"waist_girth", 0.7015},   {"hip_girth", 0.97},          {"height", 1.68},
             {"high_hip_girth", 0.9}, {"neck_girth", 0.35},      {"shoulder_width", 0.38},     {"arm_length", 0.585},
             {"crotch_height", 0.78}, {"upper_arm_girth", 0.28}, {"shoulder_slope", 0.3665191}};
  return m;
}

double of(const Result<MeasuresRead>& read, const char* key) {
  if (!read) return ADD_FAILURE() << text(read.error().what), 0;
  const auto at = read->measures.value.find(key);
  return at == read->measures.value.end() ? 0 : at->second;
}

TEST(MeasurementFiles, WhatIsWrittenIsReadBack) {
  const Measurements m = someone();
  for (const FileFormat& format : fileFormats()) {
    if (!format.writeMeasures) continue;
    SCOPED_TRACE(format.id);
    const auto read = format.readMeasures(format.writeMeasures(m));
    ASSERT_TRUE(read) << text(read.error().what);
    EXPECT_TRUE(read->unknown.empty());
    std::size_t held = 0;
    for (const auto& [key, value] : m.value) {
      if (!read->measures.value.contains(key)) continue;
      ++held;
      EXPECT_NEAR(read->measures.value.at(key), value, 2e-6) << key;
    }
    EXPECT_GE(held, format.id == "freesewing" ? 9u : 11u);
    EXPECT_EQ(read->measures.value.size(), held);
  }
  Measurements man = m;
  man.sex = Sex::Male;
  EXPECT_EQ(readMeasuresText(writeMeasuresText(man))->measures.sex, Sex::Male);
  EXPECT_EQ(readValentina(writeVit(man))->measures.sex, Sex::Male);
  man.sex = Sex::Child;
  EXPECT_EQ(readMeasuresText(writeMeasuresText(man))->measures.sex, Sex::Child);
}

TEST(MeasurementFiles, InchesInFractions) {
  const auto read = readMeasuresText("waist = 27 1/2in\nhip = 38-3/4\"\nbust=35 in\nheight = 5'6 1/2\"\n");
  EXPECT_DOUBLE_EQ(of(read, "waist_girth"), 27.5 * 0.0254);
  EXPECT_DOUBLE_EQ(of(read, "hip_girth"), 38.75 * 0.0254);
  EXPECT_DOUBLE_EQ(of(read, "bust_girth"), 35 * 0.0254);
  EXPECT_DOUBLE_EQ(of(read, "height"), 66.5 * 0.0254);
}

TEST(MeasurementFiles, ValentinaWithFormulasAndUnits) {
  const auto read = readValentina(
      "<?xml version=\"1.0\"?><!-- a comment --><vit><unit>inch</unit><body-measurements>"
      "<m name=\"bust_circ\" value=\"36\"/><m name=\"waist_circ\" value=\"bust_circ - 8.5\"/>"
      "<m name=\"neck_circ\" value=\"15\"/><m name=\"hip_circ\" value=\"(waist_circ + bust_circ)/2 + @mine\"/>"
      "<m name=\"height\" value=\"\"/><m name=\"rise\" value=\"4\"/></body-measurements></vit>");
  EXPECT_NEAR(of(read, "bust_girth"), 36 * 0.0254, 1e-12);
  EXPECT_NEAR(of(read, "waist_girth"), 27.5 * 0.0254, 1e-12);
  EXPECT_NEAR(of(read, "neck_base_girth"), 15 * 0.0254, 1e-12);  // their neck_circ lies at its base
  ASSERT_EQ(read->unread.size(), 1u);                            // a name of its own in the formula
  EXPECT_THAT(text(read->unread[0].why), HasSubstr("“hip_circ” is left out, since its value"));
  EXPECT_THAT(read->unknown, Contains("height"));
  EXPECT_THAT(read->unknown, Contains("rise"));
  const auto sizes = readValentina(
      "<vst><unit>mm</unit><size base=\"500\"/><body-measurements><m name=\"bust_circ\" base=\"1000\" "
      "size_increase=\"40\"/>"
      "</body-measurements></vst>");
  EXPECT_NEAR(of(sizes, "bust_girth"), 1.0, 1e-12);
  const auto circle = readValentina(
      "<smis><unit>cm</unit><m name=\"bust_circ\" value=\"waist_circ\"/><m name=\"waist_circ\" value=\"bust_circ\"/>"
      "<m name=\"hip_circ\" value=\"97\"/></smis>");
  EXPECT_NEAR(of(circle, "hip_girth"), 0.97, 1e-12);
  EXPECT_EQ(circle->unread.size(), 2u);
}

// A measure that is known and cannot be read is not called one that is not known.
TEST(MeasurementFiles, ValuesThatCannotBeReadAreToldWhy) {
  const auto read = readValentina(
      "<vit><unit>cm</unit><m name=\"bust_circ\" value=\"88,5\"/><m name=\"waist_circ\" value=\"27 1/2\"/>"
      "<m name=\"hip_circ\" value=\"max(90,5)\"/></vit>");
  EXPECT_NEAR(of(read, "bust_girth"), 0.885, 1e-12) << "a comma for the point";
  EXPECT_TRUE(read->unknown.empty());
  ASSERT_EQ(read->unread.size(), 1u);
  EXPECT_THAT(text(read->unread[0].why), HasSubstr("“waist_circ” is left out, since its value “27 1/2” cannot"));
  EXPECT_NEAR(of(read, "hip_girth"), 0.9, 1e-12);
}

// Notepad and PowerShell write UTF-16.
TEST(MeasurementFiles, Utf16) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "karinui_utf16.measures";
  std::string bytes = "\xFF\xFE";
  for (const char c : std::string("bust_girth = 88cm\r\n")) bytes += {c, '\0'};
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_NEAR(of(readMeasures(file), "bust_girth"), 0.88, 1e-12);
  std::filesystem::remove(file);
}

TEST(MeasurementFiles, FreeSewingAndGarmentCode) {
  const std::string yaml =
      "name: her\nunits: metric  # of the form\nmeasurements:\n  chest: 880\n  hips: 900\n  \"seat\": 970\n"
      "  shoulderSlope: 13\nnotes:\n  - chest: 5\n";
  const auto read = readMeasuresYaml(yaml);
  EXPECT_NEAR(of(read, "bust_girth"), 0.88, 1e-12);
  EXPECT_NEAR(of(read, "hip_girth"), 0.97, 1e-12);
  EXPECT_NEAR(of(read, "high_hip_girth"), 0.9, 1e-12);  // FreeSewing's hips are not its seat
  EXPECT_NEAR(of(read, "shoulder_slope"), 13 * std::numbers::pi / 180, 1e-12);
  const auto json = readMeasuresJson("{\"measurements\": {\"chest\": 880, \"seat\": 970, \"heel\": 330}}");
  EXPECT_NEAR(of(json, "hip_girth"), 0.97, 1e-12);
  EXPECT_THAT(json->unknown, Contains("heel"));
  const auto body = readMeasuresYaml("body:\n  height: 171.99\n  hips: 103.48\n  shoulder_incl: 21.6\n  head_l: 26\n");
  EXPECT_NEAR(of(body, "hip_girth"), 1.0348, 1e-12);
  EXPECT_NEAR(of(body, "height"), 1.7199, 1e-12);
  EXPECT_NEAR(of(body, "shoulder_slope"), 21.6 * std::numbers::pi / 180, 1e-12);
}

TEST(MeasurementFiles, EveryNameOfTheTableIsOurs) {
  for (const MeasureNames& row : kMeasureNames) {
    const auto key = measurementKey(row.key);
    ASSERT_TRUE(key) << row.key;
    EXPECT_EQ(*key, row.key);
  }
}

std::string refusal(const Result<MeasuresRead>& read) { return read ? "read" : text(read.error().what); }

TEST(MeasurementFiles, StrangersFilesAreRefused) {
  EXPECT_THAT(refusal(readValentina("<!DOCTYPE x [<!ENTITY a SYSTEM \"b\">]><vit/>")), HasSubstr("DOCTYPE"));
  EXPECT_THAT(refusal(readValentina("<svg></svg>")), HasSubstr("no measures"));
  EXPECT_THAT(refusal(readValentina("<vit><unit>ell</unit></vit>")), HasSubstr("“ell” is no unit"));
  EXPECT_THAT(refusal(readValentina("<vit><unit>cm</unit>")), HasSubstr("ends too early"));
  const auto apart = readMeasuresText("height = 168 cm\nbust_girth = 34.5 in  # with a blank, as people write it\n");
  ASSERT_TRUE(apart) << text(apart.error().what);
  EXPECT_DOUBLE_EQ(apart->measures.value.at("height"), 1.68);
  EXPECT_DOUBLE_EQ(apart->measures.value.at("bust_girth"), 34.5 * 0.0254);
  for (const char* none : {"height = cm\n", "height = 168 c m\n", "height = 1 68\n", "height = 168 ells\n"})
    EXPECT_THAT(refusal(readMeasuresText(none)), HasSubstr("Line 1: ")) << none;
  EXPECT_THAT(refusal(readMeasuresText("bust_girth = 88cm\nwast = 70cm\n")), HasSubstr("Line 2: "));
  EXPECT_THAT(refusal(readMeasuresText("bust = 88cm\nbust_girth = 80cm\n")), HasSubstr("given twice"));
  EXPECT_THAT(refusal(readMeasuresText("bust_girth 88\n")), HasSubstr("write it like"));
  EXPECT_THAT(refusal(readMeasuresText("height = 1.6\nbust_girth = 88\n")), HasSubstr("Line 2: “88” has no unit"));
  EXPECT_THAT(refusal(readMeasuresYaml("a: b\n")), HasSubstr("no measures"));
  EXPECT_THAT(refusal(readMeasuresJson("{\"chest\": 88")), HasSubstr(""));
  EXPECT_THAT(refusal(readMeasuresYaml(std::string(5 << 20, 'a'))), HasSubstr("too large"));
  EXPECT_THAT(refusal(readMeasures("nowhere/her.obj")), HasSubstr("measures (.measures, .vit, .smis"));
  EXPECT_THAT(text(writtenMeasures("her.vst", someone()).error().what), HasSubstr(".measures, .vit, .smis, .yaml"));
}

// Bytes of the real formats cut, doubled and exchanged: read or refused, never anything else.
TEST(MeasurementFiles, DamagedFilesAreReadOrRefused) {
  std::mt19937 dice(3);
  for (const FileFormat& format : fileFormats()) {
    if (!format.writeMeasures) continue;
    const std::string whole = format.writeMeasures(someone());
    for (int i = 0; i < 400; ++i) {
      std::string bytes = whole;
      for (int hits = 1 + static_cast<int>(dice() % 6); hits > 0; --hits) {
        const std::size_t at = dice() % bytes.size();
        if (dice() % 3 == 0)
          bytes.erase(at, dice() % 40);
        else if (dice() % 2 == 0)
          bytes.insert(at, bytes.substr(dice() % bytes.size(), 30));
        else
          bytes[at] = static_cast<char>(dice());
        if (bytes.empty()) bytes = "x";
      }
      const auto read = format.readMeasures(bytes);
      EXPECT_TRUE(!read || !read->measures.value.empty());
    }
  }
}

}  // namespace
}  // namespace karinui
