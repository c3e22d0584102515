// docs/develop/howto.md, A format: a table of the built-in rows and one more, for polygons as lines of "u v" in metres.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "karinui/base/number.h"
#include "karinui/exchange/read_pattern.h"

namespace karinui {
namespace {

Result<Pattern> readCorners(std::string_view bytes) {
  std::istringstream in{std::string(bytes)};
  std::vector<Flat> corners;
  for (Flat at; in >> at.u >> at.v;) corners.push_back(at);
  if (!in.eof() || corners.size() < 3) return badInput(say("Write three corners or more, one \"u v\" a line."));
  auto piece = std::make_shared<Piece>();
  piece->id = PieceId{1};
  piece->name = "piece";
  for (std::size_t k = 0; k < corners.size(); ++k)
    piece->outline.edges.push_back(
        {"edge_" + std::to_string(k), Curve::line(corners[k], corners[(k + 1) % corners.size()])});
  Pattern pattern;
  pattern.pieces[piece->id] = piece;
  return pattern;
}

Result<std::string> writeCorners(const ExportSource& source) {
  std::string bytes;
  for (const auto& [id, piece] : source.pattern.pieces)
    for (const Edge& edge : piece->outline.edges)
      bytes += shortest(edge.curve.start.u) + " " + shortest(edge.curve.start.v) + "\n";
  return bytes;
}

std::vector<FileFormat> tableWithCorners() {
  const FormatTable builtIn = fileFormats();
  std::vector<FileFormat> table(builtIn.begin(), builtIn.end());
  table.push_back({.id = "corners",
                   .endings = {"corners"},
                   .in = FileContent::Pattern,
                   .out = FileContent::Pattern,
                   .label = say("Corners"),
                   .about = say("The corners of each piece, one a line."),
                   .readPattern = readCorners,
                   .write = writeCorners});
  return table;
}

TEST(HowToAddAFormat, ARowIsReadWrittenListedAndRefusedLikeAnyOther) {
  const std::vector<FileFormat> table = tableWithCorners();
  const auto file = std::filesystem::temp_directory_path() / ("karinui_" + std::to_string(getpid()) + ".CORNERS");
  std::ofstream(file) << "0 0\n0.3 0\n0 0.4\n";
  const auto pattern = readPattern(file, table);
  ASSERT_TRUE(pattern) << text(pattern.error().what);
  EXPECT_NEAR(pattern->pieces.at(PieceId{1})->outline.area(), 0.06, 1e-12);

  const auto formats = formatsWriting("front.corners", table);
  ASSERT_EQ(formats.size(), 1u);
  EXPECT_EQ(exportFormats(table).back(), formats.front()) << "the dialog offers it";
  EXPECT_EQ(*formats.front()->write({*pattern, {}, {}, {}}), "0 0\n0.3 0\n0 0.4\n");

  EXPECT_NE(text(unreadable("front.hpgl", kAllRead, table).what).find("patterns (.svg, .json, .dxf, .corners)"),
            std::string::npos);
  std::ofstream(file) << "0 0\n0.3 zero\n";
  const auto wrong = readPattern(file, table);
  ASSERT_FALSE(wrong);
  EXPECT_NE(text(wrong.error().what).find("Write three corners or more"), std::string::npos);
  EXPECT_FALSE(readPattern(file)) << "without the row it is unknown";
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace karinui
