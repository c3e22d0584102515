// Topstitching, piping and bindings on the cloth as it stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "design/workroom.h"
#include "karinui/session/export.h"
#include "karinui/session/scene_of.h"

namespace karinui {
namespace {

constexpr const char* kPanel = R"(rectangle name=panel width=20cm height=30cm edges="hem right top left"
topstitch edges=panel.hem offset=20mm rows=2 colour=ff0000
piping edges=panel.top thickness=6mm fabric=silk
binding edges="panel.left panel.right" width=10mm fabric=linen
)";

double volumeOf(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& f : mesh.faces) sum += dot(mesh.points[f[0]], cross(mesh.points[f[1]], mesh.points[f[2]])) / 6;
  return sum;
}

// A seam is stitched once where it is closed; while it stands open both of its edges are.
TEST(ClothSeams, AreStitchedOnceWhenTheyAreClosed) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, R"(rectangle name=front width=20cm height=30cm
rectangle name=back width=20cm height=30cm
sew a=front.side_right b=back.side_left
)");
  ASSERT_TRUE(played) << text(played.error().what);
  const auto stitched = [](const Document& document) {
    std::vector<bool> seams;
    const auto frame = sceneOf(document, nullptr);
    for (const SceneCloth& cloth : frame->cloths) seams.push_back(!cloth.seams.empty());
    return seams;
  };
  Document document = file.document();
  const auto foot = [&](const char* name, const char* edge) {
    const Curve* side = findCurve(*document.pieceNamed(name), edge);
    const Flat from = side->atFraction(0), to = side->atFraction(1);
    return from.v < to.v ? from : to;
  };
  const auto stands = [&](const char* name, Flat at) {  // the place of its paper that is the origin
    auto piece = std::make_shared<Piece>(*document.pieceNamed(name));
    piece->form = nullptr, piece->pose = {.carry = {-at.u, -at.v, 0}};
    document.pattern.pieces[piece->id] = piece;
  };
  const Flat ofFront = foot("front", "side_right"), ofBack = foot("back", "side_left");
  stands("front", ofFront), stands("back", ofBack - Flat{0.5, 0});
  EXPECT_EQ(stitched(document), (std::vector<bool>{true, true})) << "half a metre apart";
  stands("back", ofBack);
  EXPECT_EQ(stitched(document), (std::vector<bool>{true, false})) << "edge to edge";
}

// Both sides of a dart share the node at its tip, which is tied to none.
TEST(ClothSeams, OfADartAreStitchedToItsTip) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, R"(rectangle name=panel width=20cm height=30cm edges="hem right top left"
dart edge=panel.top tip=0,18cm width=3cm
)");
  ASSERT_TRUE(played) << text(played.error().what);
  const auto frame = sceneOf(file.document(), nullptr);
  const SceneCloth& cloth = frame->cloths.front();
  std::uint32_t tip = 0;
  for (std::uint32_t i = 0; i < cloth.flat.size(); ++i)
    if (distance(cloth.flat[i], {0, 0.18}) < distance(cloth.flat[tip], {0, 0.18})) tip = i;
  ASSERT_LT(distance(cloth.flat[tip], {0, 0.18}), 1e-9);
  EXPECT_TRUE(std::any_of(cloth.seams.begin(), cloth.seams.end(), [&](const auto& run) {
    return run.size() > 3 && std::find(run.begin(), run.end(), tip) != run.end();
  }));
}

// They are placed on the mesh, and so go where it goes.
TEST(ClothTrims, LieOnTheClothWhereverItStands) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto played = room.play(file, kPanel);
  ASSERT_TRUE(played) << text(played.error().what);
  auto frame = sceneOf(file.document(), nullptr);
  ASSERT_TRUE(frame) << text(frame.error().what);
  SceneCloth& cloth = frame->cloths.front();
  ASSERT_EQ(cloth.stitches.size(), 2u);
  ASSERT_EQ(cloth.trims.size(), 3u);
  EXPECT_NEAR(cloth.stitches[0].stitchMm + cloth.stitches[0].gapMm, 3, 1e-6);
  EXPECT_FLOAT_EQ(cloth.stitches[0].colour[0], 1);
  EXPECT_FLOAT_EQ(cloth.stitches[0].colour[1], 0);
  const Piece& piece = *file.document().pieceNamed("panel");
  const double low = Stand(piece)({0, 0}).y;
  for (std::size_t k = 0; k < 2; ++k)
    for (const ClothPlace& place : cloth.stitches[k].line)
      EXPECT_NEAR(place.on(cloth.mesh.points).y - low, 0.02 + 0.006 * static_cast<double>(k), 1e-6);
  const double stood = cloth.mesh.points.front().z;
  for (Vec3& p : cloth.mesh.points) p += {0, 0, 1};
  for (const ClothPlace& place : cloth.stitches[0].line) EXPECT_NEAR(place.on(cloth.mesh.points).z, stood + 1, 1e-9);
}

// A cord is a closed round tube beside the edge; a strip lies on both sides of the cloth.
TEST(ClothTrims, CordsAreRoundAndStripsTwoSided) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kPanel));
  const auto frame = sceneOf(file.document(), nullptr);
  ASSERT_TRUE(frame);
  const SceneCloth& cloth = frame->cloths.front();
  const Vec3 corner = Stand(*file.document().pieceNamed("panel"))({0, 0.3});
  const double top = corner.y;
  for (const SceneTrim& trim : cloth.trims) {
    const TriangleMesh mesh = meshOf(trim, cloth.mesh);
    ASSERT_FALSE(mesh.faces.empty());
    double near = 1e9, far = -1e9, low = 1e9, high = -1e9;
    for (const Vec3 p : mesh.points)
      near = std::min(near, p.z - corner.z), far = std::max(far, p.z - corner.z), low = std::min(low, p.y),
      high = std::max(high, p.y);
    if (trim.kind == SceneTrim::Kind::Cord) {
      EXPECT_NEAR(far - near, 0.006, 1e-6);
      EXPECT_NEAR(low, top, 1e-6);
      EXPECT_NEAR(high, top + 0.006, 1e-6);
      const double twelve =
          12 * 0.5 * std::sin(std::numbers::pi / 6) * 0.003 * 0.003;  // area of a twelve-sided section
      EXPECT_NEAR(std::fabs(volumeOf(mesh)), twelve * 0.2, 1e-9);
    } else {
      EXPECT_LT(near, -4e-4);
      EXPECT_GT(far, 4e-4);
    }
  }
  // In a GLB each is an object of its fabric's name.
  const SpatialGarment garment = spatialOf(file.document(), *frame);
  ASSERT_EQ(garment.notions.size(), 4u);
  EXPECT_EQ(garment.notions[0].name, "panel_topstitch");
  EXPECT_EQ(garment.notions[0].mesh.faces.size() % 12, 0u);
  EXPECT_NEAR(static_cast<double>(garment.notions[0].mesh.faces.size()) / 12, 2 * 0.2 / 0.003, 2);  // stitches of 3 mm
  EXPECT_EQ(garment.notions[1].material, "silk");
  EXPECT_EQ(garment.notions[2].material, "linen");
}

// A cord in a seam stands on the cloth.
TEST(ClothTrims, ACordInASeamIsRaised) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, R"(rectangle name=a width=20cm height=30cm edges="hem right top left"
rectangle name=b width=20cm height=30cm edges="hem right top left"
sew a=a.right b=b.left
piping edges=a.right symmetric=no
)"));
  const auto frame = sceneOf(file.document(), nullptr);
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->cloths.front().trims.size(), 1u);
  const double stood = frame->cloths.front().mesh.points.front().z;
  EXPECT_TRUE(frame->cloths.front().trims.front().raised);
  for (const Vec3 p : meshOf(frame->cloths.front().trims.front(), frame->cloths.front().mesh).points)
    EXPECT_GT(p.z, stood - 1e-9);
}

}  // namespace
}  // namespace karinui
