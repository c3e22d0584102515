// Buttons as they are exported: plates where they lie.
#include <gtest/gtest.h>

#include <map>

#include "design/workroom.h"
#include "karinui/session/export.h"
#include "karinui/session/scene_of.h"

namespace karinui {
namespace {

TEST(Export, ShowsButtonsAsPlates) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, R"(rectangle name=right width=20cm height=40cm edges="hem centre top side"
rectangle name=left width=20cm height=40cm edges="hem side top centre"
fasten a=right.centre b=left.centre reversed=yes count=3 first=5cm last=5cm size=20mm inset=2cm closed=2
)");
  ASSERT_TRUE(played) << text(played.error().what);
  const Document& document = file.document();
  const auto frame = sceneOf(document, nullptr);
  ASSERT_TRUE(frame) << text(frame.error().what);
  const SpatialGarment garment = spatialOf(document, *frame);
  ASSERT_EQ(garment.notions.size(), 1u);
  EXPECT_EQ(garment.notions[0].name, "buttons");
  const TriangleMesh& mesh = garment.notions[0].mesh;
  // Two are closed and lie on the right piece, the lowest is open and stays on the left one.
  const auto places = placesOf(document.pattern, document.allowances.fastenings.at("buttons"));
  ASSERT_EQ(mesh.points.size() % places.size(), 0u);
  const std::size_t each = mesh.points.size() / places.size();
  std::size_t closed = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const FasteningPlace& at = places[k].closed ? places[k].a : places[k].b;
    closed += places[k].closed;
    const Vec3 place = Stand(*document.find(at.piece))(at.place);
    double widest = 0;
    for (std::size_t i = k * each; i < (k + 1) * each; ++i) widest = std::max(widest, distance(mesh.points[i], place));
    EXPECT_NEAR(widest, std::hypot(0.010, 0.002), 1e-6);
  }
  EXPECT_EQ(closed, 2u);
  // A solid: its volume, by the divergence theorem, is that of a plate of 24 corners 2 mm thick.
  double volume = 0;
  for (const Triangle& f : mesh.faces)
    volume += dot(mesh.points[f[0]], cross(mesh.points[f[1]], mesh.points[f[2]])) / 6;
  const double area = 12 * 0.010 * 0.010 * std::sin(2 * std::numbers::pi / 24);
  EXPECT_NEAR(volume, 3 * area * 0.002, 1e-12);
}

// An apron before a buttoned front hides its buttons, a lining behind does not.
TEST(Fastenings, OfWhatIsCoveredAreNotSeen) {
  const std::string front = R"(rectangle name=right width=20cm height=40cm edges="hem centre top side"
rectangle name=left width=20cm height=40cm edges="hem side top centre"
fasten a=right.centre b=left.centre reversed=yes count=3 first=5cm last=5cm inset=2cm closed=2
)";
  const auto seen = [&](const std::string& more) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const auto played = room.play(file, front + more);
    EXPECT_TRUE(played) << text(played.error().what);
    const auto frame = sceneOf(file.document(), nullptr);
    EXPECT_TRUE(frame) << text(frame.error().what);
    return frame->lines.size();
  };
  EXPECT_EQ(seen(""), 3u);
  EXPECT_EQ(seen("duplicate piece=right name=apron by=0,0,1cm\n"), 1u);
  EXPECT_EQ(seen("duplicate piece=right name=lining by=0,0,-1cm\n"), 3u);
}

}  // namespace
}  // namespace karinui
