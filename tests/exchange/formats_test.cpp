// The table of formats: what a file's name means, in any letter case, and what a person is told.
#include "karinui/exchange/formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "exchange/patterns.h"
#include "karinui/exchange/read_pattern.h"

namespace karinui {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// "obj", "OBJ" and "oBj".
std::vector<std::string> anyLetterCase(std::string_view ending) {
  std::string upper(ending), mixed(ending);
  for (std::size_t k = 0; k < ending.size(); ++k) {
    upper[k] = static_cast<char>(std::toupper(static_cast<unsigned char>(ending[k])));
    if (k % 2 == 1) mixed[k] = upper[k];
  }
  return {std::string(ending), upper, mixed};
}

TEST(Formats, AreFoundByTheirEndingInAnyLetterCase) {
  for (const FileFormat& format : fileFormats())
    for (const std::string_view lower : format.endings)
      for (const std::string& ending : anyLetterCase(lower)) {
        const std::filesystem::path file = "a.folder/front.new." + ending;
        SCOPED_TRACE(file.string());
        EXPECT_TRUE(hasEnding(file, format));
        EXPECT_EQ(withEnding(file, format), file);
        EXPECT_EQ(contentOf(file), contentOf("a." + std::string(lower)));
        if (format.in != FileContent::None) {
          EXPECT_EQ(contentOf(file), format.in);
          EXPECT_THAT(formatsReading(file), Contains(&format));
        }
        if (format.write) {
          EXPECT_THAT(formatsWriting(file), Contains(&format));
        }
      }
}

TEST(Formats, EachRowIsWhole) {
  std::set<std::string_view> ids;
  for (const FileFormat& format : fileFormats()) {
    SCOPED_TRACE(format.id);
    EXPECT_TRUE(ids.insert(format.id).second);
    EXPECT_EQ(&fileFormat(format.id), &format);
    EXPECT_FALSE(format.endings.empty());
    EXPECT_TRUE(format.in != FileContent::None || format.out != FileContent::None);
    EXPECT_EQ(format.in == FileContent::Pattern, format.readPattern || format.readSize);
    const bool here = format.out != FileContent::None && format.out != FileContent::Document &&
                      format.out != FileContent::Picture && format.out != FileContent::Measures;
    EXPECT_EQ(format.in == FileContent::Measures, format.readMeasures != nullptr);
    EXPECT_EQ(format.out == FileContent::Measures, format.writeMeasures != nullptr);
    EXPECT_EQ(here, format.write != nullptr);
    EXPECT_EQ(here, !format.label.empty());
    EXPECT_EQ(here, !format.about.empty());
    // Rows that share an ending are read as the same thing.
    for (const std::string_view ending : format.endings)
      for (const FileFormat* other : formatsReading("a." + std::string(ending))) {
        EXPECT_EQ(other->in, contentOf("a." + std::string(ending)));
      }
  }
}

TEST(Formats, AreAllInTheManual) {
  const std::string manual = test::content(std::string(KARINUI_SOURCE_DIR) + "/docs/format/exchange.md");
  for (const FileFormat& format : fileFormats())
    for (const std::string_view ending : format.endings) {
      EXPECT_THAT(manual, HasSubstr("`." + std::string(ending) + "`"));
    }
}

TEST(Formats, AnUnknownEndingIsToldWhatCanBeRead) {
  for (const char* name : {"body.stl", "front", "front.", ".obj", "front.obj.zip"}) {
    EXPECT_EQ(contentOf(name), FileContent::None) << name;
  }
  const Error all = unreadable("a.folder/body.stl");
  EXPECT_EQ(all.kind, Error::Kind::BadInput);
  EXPECT_EQ(text(all.what),
            "“body.stl” has none of the endings that are read here: documents (.karinui), bodies (.glb, .obj, .gltf, "
            ".ply), patterns (.svg, .json, .dxf), scripts of operations (.ops).");
  EXPECT_THAT(text(all.what, Language::Japanese), HasSubstr("体（.glb, .obj, .gltf, .ply）、"));
  const auto pattern = readPattern("nowhere/front.hpgl");
  ASSERT_FALSE(pattern);
  EXPECT_THAT(text(pattern.error().what),
              HasSubstr("“front.hpgl” has none of the endings that are read here: patterns"));
  EXPECT_THAT(text(unwritable("x.xyz").what), HasSubstr(".pdf, .svg, .plt, .glb, .obj, .json, .dxf, .rul, .ops."));
}

TEST(Formats, AFileThatIsWrittenGetsTheEndingOnce) {
  const FileFormat& svg = fileFormat("svg");
  EXPECT_EQ(withEnding("front", svg), "front.svg");
  EXPECT_EQ(withEnding("front.v2", svg), "front.v2.svg");
  EXPECT_EQ(withEnding("front.SVG", svg), "front.SVG");
}

TEST(Formats, APatternIsReadBackByTheRowThatWroteIt) {
  const auto folder = std::filesystem::temp_directory_path() / ("karinui_formats_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  auto piece = std::make_shared<Piece>();
  piece->id = PieceId{1};
  piece->name = "front";
  piece->outline.edges = {{"hem", Curve::line({0, 0}, {0.3, 0})},
                          {"side", Curve::line({0.3, 0}, {0.3, 0.4})},
                          {"bias", Curve::line({0.3, 0.4}, {0, 0})}};
  Pattern pattern;
  pattern.pieces[piece->id] = piece;
  int tried = 0;
  for (const FileFormat* format : exportFormats()) {
    if (format->in != FileContent::Pattern) continue;
    for (const std::string& ending : anyLetterCase(format->endings.front())) {
      SCOPED_TRACE(std::string(format->id) + " ." + ending);
      const auto bytes = format->write({pattern, {}, {}, {}});
      ASSERT_TRUE(bytes);
      const auto file = folder / ("front." + ending);
      std::ofstream(file, std::ios::binary) << *bytes;
      const auto back = readPattern(file);
      ASSERT_TRUE(back) << text(back.error().what);
      ASSERT_EQ(back->pieces.size(), 1u);
      EXPECT_NEAR(back->pieces.begin()->second->outline.area(), 0.06, 1e-9);
      ++tried;
    }
  }
  EXPECT_EQ(tried, 12);  // svg, karinui, garmentcode, dxf-aama
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace karinui
