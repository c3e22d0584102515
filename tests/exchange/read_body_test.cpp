#include "karinui/exchange/read_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <numbers>
#include <random>

#include "geometry/shapes.h"
#include "karinui/base/number.h"
#include "karinui/body/body.h"
#include "karinui/body/pose.h"
#include "karinui/body/sizes.h"
#include "karinui/body/skeleton.h"
#include "karinui/exchange/read_print.h"
#include "karinui/geometry/bvh.h"
#include "soak.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ReadBody : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("karinui_read_body_" + std::to_string(::getpid()));
    fs::create_directories(folder_ / "inner");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, std::string_view bytes) {
    const fs::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  Result<ImportedBody> read(const fs::path& path, const BodyReadOptions& options = {}) {
    return readBody(path, options, workers_, Token{});
  }
  std::string refusal(const fs::path& path, const BodyReadOptions& options = {}) {
    const auto body = read(path, options);
    return body ? "it was taken" : text(body.error().what);
  }

  fs::path folder_;
  Workers workers_{1};
};

// A figure 1.7 m high, taller than wide, wider than deep, in units of `unit` metres.
TriangleMesh figure(double unit = 1) {
  TriangleMesh m = test::ball({}, 1, 4);
  for (Vec3& p : m.points) p = Vec3{p.x * 0.3, 0.85 + p.y * 0.85, p.z * 0.15} * (1 / unit);
  return m;
}

std::string asObj(const TriangleMesh& m) {
  std::string s;
  for (Vec3 p : m.points) s += "v " + shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
  for (const Triangle& f : m.faces)
    s += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " + std::to_string(f[2] + 1) + "\n";
  return s;
}

std::string asPly(const TriangleMesh& m) {
  std::string s = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(m.points.size()) +
                  "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                  std::to_string(m.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Vec3 p : m.points) s += shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
  for (const Triangle& f : m.faces)
    s += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  return s;
}

std::string bufferOf(const TriangleMesh& m) {
  std::string s;
  for (Vec3 p : m.points)
    for (double x : {p.x, p.y, p.z}) {
      const auto f = static_cast<float>(x);
      s.append(reinterpret_cast<const char*>(&f), 4);
    }
  for (const Triangle& f : m.faces) s.append(reinterpret_cast<const char*>(f.data()), 12);
  return s;
}

// uri: where the buffer is; empty for a GLB.
std::string gltfJson(const TriangleMesh& m, const std::string& uri, const std::string& nodes = R"([{"mesh":0}])") {
  const std::string points = std::to_string(m.points.size()), pointBytes = std::to_string(m.points.size() * 12);
  const std::string faceBytes = std::to_string(m.faces.size() * 12);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":)" +
         points + R"(,"type":"VEC3","min":[-9,-9,-9],"max":[9,9,9]},{"bufferView":1,"componentType":5125,"count":)" +
         std::to_string(m.faces.size() * 3) + R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":)" +
         pointBytes + R"(},{"buffer":0,"byteOffset":)" + pointBytes + R"(,"byteLength":)" + faceBytes +
         R"(}],"buffers":[{)" + (uri.empty() ? "" : R"("uri":")" + uri + R"(",)") + R"("byteLength":)" +
         std::to_string(m.points.size() * 12 + m.faces.size() * 12) + "}]}";
}

std::string asGlb(const TriangleMesh& m) {
  std::string json = gltfJson(m, "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string buffer = bufferOf(m);
  const auto number = [](std::uint32_t n) { return std::string(reinterpret_cast<const char*>(&n), 4); };
  return "glTF" + number(2) + number(static_cast<std::uint32_t>(28 + json.size() + buffer.size())) +
         number(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
         number(static_cast<std::uint32_t>(buffer.size())) + std::string("BIN\0", 4) + buffer;
}

TEST_F(ReadBody, TakesTheSameFigureFromEveryFormat) {
  const TriangleMesh m = figure();
  file("b.bin", bufferOf(m));
  for (const fs::path& path : {file("b.obj", asObj(m)), file("b.PLY", asPly(m)), file("b.glb", asGlb(m)),
                               file("b.gltf", gltfJson(m, "b.bin"))}) {
    const auto body = read(path);
    ASSERT_TRUE(body) << path << " " << refusal(path);
    EXPECT_EQ(body->report.triangles, m.faces.size());
    EXPECT_EQ(body->report.points, m.points.size()) << path;
    EXPECT_TRUE(body->report.closed());
    EXPECT_NEAR(volume(body->mesh), volume(m), 1e-6);
    EXPECT_EQ(body->unit, LengthUnit::Metre);
    EXPECT_EQ(body->up, UpAxis::Y);
  }
}

TEST_F(ReadBody, GuessesUnitsAndSaysSo) {
  for (const auto& [unit, metres, name] :
       {std::tuple{LengthUnit::Centimetre, 0.01, "centimetres"},
        std::tuple{LengthUnit::Millimetre, 0.001, "millimetres"}, std::tuple{LengthUnit::Inch, 0.0254, "inches"},
        std::tuple{LengthUnit::Decimetre, 0.1, "decimetres"}, std::tuple{LengthUnit::Foot, 0.3048, "feet"}}) {
    const auto body = read(file("b.obj", asObj(figure(metres))));
    ASSERT_TRUE(body);
    EXPECT_EQ(body->unit, unit);
    EXPECT_NEAR(boxOf(body->mesh.points).high.y, 1.7, 1e-4);
    EXPECT_THAT(text(body->notes.at(1)), HasSubstr(name));
  }
  EXPECT_THAT(refusal(file("b.obj", asObj(figure(1e-5)))), HasSubstr("say which unit"));
  BodyReadOptions doll;
  doll.unit = LengthUnit::Centimetre;
  const auto small = read(file("b.obj", asObj(figure())), doll);
  EXPECT_FALSE(small) << "17 mm is no body";
}

TEST_F(ReadBody, StandsUpWhatLies) {
  TriangleMesh m = figure();
  for (Vec3& p : m.points) p = Vec3{p.x + 20, -p.z, p.y};
  const auto body = read(file("b.obj", asObj(m)));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->up, UpAxis::Z);
  const Box box = boxOf(body->mesh.points);
  EXPECT_NEAR(box.low.y, 0, 1e-9);
  EXPECT_NEAR(box.high.y, 1.7, 1e-5);
  EXPECT_NEAR(box.high.z, 0.15, 1e-5);
  EXPECT_NEAR(box.centre().x, 0, 1e-5);
  EXPECT_TRUE(body->report.outward);
}

bool says(const ImportedBody& body, const std::string& words) {
  return std::any_of(body.notes.begin(), body.notes.end(),
                     [&](const Message& note) { return text(note).find(words) != std::string::npos; });
}

// A person is known by legs, head and feet, whichever way a program wrote it.
TEST_F(ReadBody, StandsAPersonUprightFacingForwards) {
  const auto made = makeMannequin(*builtInSize("eu38"), workers_, Token{});
  ASSERT_TRUE(made);
  const TriangleMesh& m = (*made)->mesh();
  struct Turned {
    const char* name;
    Vec3 (*turn)(Vec3);
    UpAxis up;
    const char* note;
  };
  const Turned all[] = {{"as ours", [](Vec3 p) { return p; }, UpAxis::Y, "Taken as standing along its y axis"},
                        {"backwards",
                         [](Vec3 p) -> Vec3 {
                           return {-p.x, p.y, -p.z};
                         },
                         UpAxis::Y, "along -z: it was turned"},
                        {"sideways",
                         [](Vec3 p) -> Vec3 {
                           return {p.z, p.y, -p.x};
                         },
                         UpAxis::Y, "along x: it was turned"},
                        {"the other side",
                         [](Vec3 p) -> Vec3 {
                           return {-p.z, p.y, p.x};
                         },
                         UpAxis::Y, "along -x: it was turned"},
                        {"lying",
                         [](Vec3 p) -> Vec3 {
                           return {p.x, -p.z, p.y};
                         },
                         UpAxis::Z, "along its z axis"},
                        {"along x",
                         [](Vec3 p) -> Vec3 {
                           return {p.y, p.z, p.x};
                         },
                         UpAxis::X, "along its x axis"},
                        {"on its head",
                         [](Vec3 p) -> Vec3 {
                           return {p.x, -p.y, -p.z};
                         },
                         UpAxis::Y, "stood on its head along its y"},
                        {"head down along z",
                         [](Vec3 p) -> Vec3 {
                           return {-p.x, -p.z, -p.y};
                         },
                         UpAxis::Z, "on its head along its z"}};
  for (const Turned& one : all) {
    TriangleMesh turned = m;
    for (Vec3& p : turned.points) p = one.turn(p);
    const auto body = read(file("b.obj", asObj(turned)));
    ASSERT_TRUE(body) << one.name << text(body.error().what);
    EXPECT_EQ(body->up, one.up) << one.name;
    EXPECT_TRUE(says(*body, one.note)) << one.name;
    EXPECT_FALSE(says(*body, "not recognised")) << one.name;
    ASSERT_EQ(body->mesh.points.size(), m.points.size());
    double most = 0;  // the points may come in another order
    const Bvh own(m);
    for (const Vec3 p : body->mesh.points) most = std::max(most, own.nearest(p)->distance);
    EXPECT_LT(most, 2e-3) << one.name;
  }
  EXPECT_TRUE(says(*read(file("egg.obj", asObj(figure()))), "front is was not recognised"));
}

// However askew it was scanned. The feet do not decide: in a step they stand one behind the other.
TEST_F(ReadBody, FacesTheTrunkForwards) {
  for (const char* size : {"eu38", "eu50"}) {
    const auto made = makeMannequin(*builtInSize(size), workers_, Token{});
    ASSERT_TRUE(made);
    const TriangleMesh& m = (*made)->mesh();
    const Bvh own(m);
    for (const double degrees : {-33.0, -12.0, -5.0, 0.0, 2.0, 8.0, 17.0, 100.0, 171.0}) {
      // Of the stout one two of these are enough: one that is turned back and one that is left.
      if (std::string_view(size) == "eu50" && degrees != -12 && degrees != 2 && !atLength()) continue;
      const double turn = degrees * std::numbers::pi / 180, s = std::sin(turn), c = std::cos(turn);
      TriangleMesh turned = m;
      for (Vec3& p : turned.points) p = {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
      const auto body = read(file("b.obj", asObj(turned)));
      ASSERT_TRUE(body) << text(body.error().what);
      const double aside = std::abs(degrees - 90 * std::round(degrees / 90));
      EXPECT_EQ(says(*body, "stood askew by"), aside > 3) << degrees;
      double most = 0;
      for (const Vec3 p : body->mesh.points) most = std::max(most, own.nearest(p)->distance);
      EXPECT_LT(most, aside > 3 || aside == 0 ? 4e-3 : 4e-2) << size << " by " << degrees;
    }
    const auto bones = Skeleton::of(*made);
    ASSERT_TRUE(bones);
    const auto step = posed(**bones, (*bones)->named(*namedPose("step")).value());
    ASSERT_TRUE(step);
    const auto inAStep = read(file("b.obj", asObj((*step)->mesh())));
    ASSERT_TRUE(inAStep);
    EXPECT_FALSE(says(*inAStep, "aside")) << size;
    EXPECT_FALSE(says(*inAStep, "askew")) << size;
  }
}

TEST_F(ReadBody, WarnsOfAGrownUpMadeSmall) {
  const auto made = makeMannequin(*builtInSize("eu38"), workers_, Token{});
  ASSERT_TRUE(made);
  TriangleMesh half = (*made)->mesh();
  EXPECT_FALSE(says(*read(file("b.obj", asObj(half))), "made smaller"));
  for (Vec3& p : half.points) p *= 0.5;
  const auto body = read(file("b.obj", asObj(half)));
  ASSERT_TRUE(body);
  EXPECT_TRUE(says(*body, "only 84"));
  TriangleMesh wide = (*made)->mesh();
  EXPECT_FALSE(says(*read(file("b.obj", asObj(wide))), "no person has"));
  for (Vec3& p : wide.points) p = {p.x * 1.6, p.y, p.z * 1.6};
  EXPECT_TRUE(says(*read(file("b.obj", asObj(wide))), "what no person has"));
}

// In a file for a person to mend, the line is told.
TEST_F(ReadBody, TellsTheLineOfAnObjThatIsWrong) {
  const std::string obj = asObj(figure());
  const auto lines = std::count(obj.begin(), obj.end(), '\n');
  EXPECT_THAT(refusal(file("b.obj", obj + "f 1 2 99999\n")),
              HasSubstr("In line " + std::to_string(lines + 1) + " a face names a point"));
  EXPECT_THAT(refusal(file("b.obj", "# a\nv 0 0 0\nf 1 -2 1\n")), HasSubstr("In line 3 a face names a point"));
  EXPECT_THAT(refusal(file("b.obj", obj + "f 1 2")), HasSubstr("breaks off in line " + std::to_string(lines + 1)));
  EXPECT_THAT(refusal(file("b.obj", obj.substr(0, obj.rfind("v ") + 4))), HasSubstr("breaks off in line"));
  EXPECT_THAT(refusal(file("b.obj", obj.substr(0, obj.find("f ")))),
              HasSubstr("ends with line " + std::to_string(figure().points.size()) + " and holds no face"));
  // A last line without an end is no fault.
  EXPECT_EQ(refusal(file("b.obj", obj.substr(0, obj.size() - 1))), "it was taken");
}

TEST_F(ReadBody, TurnsWhatFacesInward) {
  TriangleMesh m = figure();
  for (Triangle& f : m.faces) std::swap(f[0], f[1]);
  const auto body = read(file("b.ply", asPly(m)));
  ASSERT_TRUE(body);
  EXPECT_TRUE(body->turnedOutward);
  EXPECT_GT(volume(body->mesh), 0);
}

TEST_F(ReadBody, WrapsAScanOnlyWhenAsked) {
  TriangleMesh m = figure();
  std::erase_if(m.faces, [&](const Triangle& f) { return m.points[f[0]].y > 1.6; });
  const fs::path path = file("scan.obj", asObj(m));
  EXPECT_THAT(refusal(path), testing::AllOf(HasSubstr("not closed"), HasSubstr("wrapped in a watertight skin")));
  BodyReadOptions options;
  options.wrap = true;
  options.wrapCell = 0.02;
  const auto body = read(path, options);
  ASSERT_TRUE(body);
  EXPECT_TRUE(body->wrapped);
  EXPECT_TRUE(body->report.closed());
  EXPECT_EQ(body->report.selfCrossings, 0u);
  EXPECT_GT(body->found.openEdges, 0u);
}

TEST_F(ReadBody, RefusesHostileFiles) {
  const TriangleMesh m = figure();
  const auto takes = [&](const std::string& name, std::string_view bytes) { return refusal(file(name, bytes)); };
  std::string nan = asObj(m);
  nan.replace(0, nan.find('\n'), "v nan 0 0");
  EXPECT_THAT(takes("nan.obj", nan), HasSubstr("not numbers"));
  EXPECT_EQ(takes("empty.obj", ""), "empty.obj is empty.");
  EXPECT_NE(
      takes("range.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99\n"),
      "it was taken");
  EXPECT_NE(
      takes("huge.ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
            "property float z\nelement face 2000000000\nproperty list uchar int vertex_indices\nend_header\n"),
      "it was taken");
  for (const char* cut : {"ply\nformat ascii 1", "ply\nformat ascii 1.0\nend_headers\n"})
    EXPECT_THAT(takes("cut.ply", cut), HasSubstr("damaged"));  // at once: not “took longer than”
  const std::string glb = asGlb(m);
  for (std::size_t size : {1u, 11u, 20u, 60u, 900u, 20000u})
    EXPECT_NE(takes("cut.glb", glb.substr(0, size)), "it was taken");
  const std::string obj = asObj(m);
  EXPECT_NE(takes("cut.obj", obj.substr(0, obj.size() / 2)), "it was taken");
  test::Numbers numbers(1);
  for (const char* name : {"random.obj", "random.ply", "random.glb", "random.gltf"}) {
    std::string bytes;
    for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(numbers.below(256));
    EXPECT_NE(takes(name, bytes), "it was taken");
  }
  EXPECT_THAT(takes("body.stl", "solid"),
              HasSubstr("none of the endings that are read here: bodies (.glb, .obj, .gltf, .ply)."));
  EXPECT_THAT(refusal(folder_ / "nowhere.obj"), HasSubstr("There is no file"));
  EXPECT_THAT(refusal(folder_ / "inner/../inner"),
              HasSubstr("none of the endings that are read here: bodies (.glb, .obj, .gltf, .ply)."));
  fs::create_directory(folder_ / "dir.obj");
  EXPECT_THAT(refusal(folder_ / "dir.obj"), HasSubstr("is not a file"));
}

TEST_F(ReadBody, ReadsNoFileButThoseBesideIt) {
  const TriangleMesh m = figure();
  file("secret.bin", bufferOf(m));
  const std::string plain = "does not lie beside it under a plain name";
  for (const char* uri : {"../secret.bin", "/etc/passwd", "inner/../../secret.bin", "%2e%2e%2fsecret.bin", ".."})
    EXPECT_NE(refusal(file("inner/b.gltf", gltfJson(m, uri))), "it was taken") << uri;
  EXPECT_THAT(refusal(file("inner/b.gltf", gltfJson(m, "../secret.bin"))), HasSubstr(plain));
  EXPECT_THAT(refusal(file("inner/b.gltf", gltfJson(m, "missing.bin"))), HasSubstr("There is no file missing.bin"));
  fs::create_symlink(folder_ / "secret.bin", folder_ / "inner/link.bin");
  EXPECT_NE(refusal(file("inner/b.gltf", gltfJson(m, "link.bin"))), "it was taken");
  // A material library is never looked for, so it does no harm.
  EXPECT_TRUE(read(file("inner/b.obj", "mtllib ../../../etc/passwd\nusemtl x\n" + asObj(m))));
}

TEST_F(ReadBody, RefusesNodesThatNestWithoutEnd) {
  const TriangleMesh m = figure();
  file("b.bin", bufferOf(m));
  std::string chain = "[";
  for (int i = 0; i < 20000; ++i) chain += R"({"children":[)" + std::to_string(i + 1) + "]},";
  chain += R"({"mesh":0}])";
  EXPECT_THAT(refusal(file("chain.gltf", gltfJson(m, "b.bin", chain))), HasSubstr("nested"));
  EXPECT_THAT(refusal(file("loop.gltf", gltfJson(m, "b.bin", R"([{"children":[1]},{"children":[0],"mesh":0}])"))),
              HasSubstr("nested"));
  std::string fan = "[";  // each of 60 nodes twice the next: 2^60 ways down
  for (int i = 0; i < 60; ++i) fan += R"({"children":[)" + std::to_string(i + 1) + "," + std::to_string(i + 1) + "]},";
  fan += R"({"mesh":0}])";
  EXPECT_NE(refusal(file("fan.gltf", gltfJson(m, "b.bin", fan))), "it was taken");
}

TEST_F(ReadBody, KeepsToItsLimits) {
  const fs::path path = file("b.obj", asObj(figure()));
  BodyReadOptions options;
  options.limits.triangles = 100;
  EXPECT_THAT(refusal(path, options), HasSubstr("more than"));
  options = {};
  options.limits.fileBytes = 1000;
  EXPECT_THAT(refusal(path, options), HasSubstr("larger than"));
  options = {};
  options.helper = folder_ / "not_there";
  EXPECT_THAT(refusal(path, options), HasSubstr("could not be started"));
  Token token;
  token.cancel();
  const auto stopped = readBody(path, {}, workers_, token);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, Error::Kind::Cancelled);
}

// A column 1.7 m high on `ring`, whose floor and ceiling are one polygon each, as programs write that join what lies in
// one plane. `open`: without a ceiling.
std::string columnObj(const std::vector<Flat>& ring, bool open = false) {
  const std::size_t n = ring.size();
  std::string obj, floor = "f", ceiling = "f";
  for (const double y : {0.0, 1.7})
    for (const Flat p : ring) obj += "v " + shortest(p.u) + " " + shortest(y) + " " + shortest(p.v) + "\n";
  for (std::size_t k = 0; k < n; ++k) {
    floor += " " + std::to_string(k + 1);
    ceiling += " " + std::to_string(2 * n - k);
    const std::size_t a = k + 1, b = (k + 1) % n + 1;
    obj += "f " + std::to_string(b) + " " + std::to_string(a) + " " + std::to_string(a + n) + " " +
           std::to_string(b + n) + "\n";
  }
  return obj + floor + "\n" + (open ? "" : ceiling + "\n");
}

// Ten thousand corners 20 cm from the middle, every other one at `inner` metres.
constexpr std::size_t kCorners = 10'000;
std::vector<Flat> gear(double inner) {
  std::vector<Flat> ring;
  for (std::size_t k = 0; k < kCorners; ++k) {
    const double angle = 2 * M_PI * static_cast<double>(k) / kCorners;
    ring.push_back(Flat{std::cos(angle), std::sin(angle)} * (k % 2 == 0 ? 0.2 : inner));
  }
  return ring;
}
double gearVolume(double inner) { return 1.7 * 0.5 * kCorners * 0.2 * inner * std::sin(2 * M_PI / kCorners); }

TEST_F(ReadBody, TakesPolygonsOfTenThousandCorners) {
  BodyReadOptions patient;
  patient.limits.seconds = 60;              // for a busy machine
  for (const double inner : {0.18, 0.2}) {  // a gear, and a round column
    if (inner == 0.2 && !atLength()) continue;
    const auto body = read(file("column.obj", columnObj(gear(inner))), patient);
    ASSERT_TRUE(body) << text(body.error().what);
    EXPECT_EQ(body->mesh.faces.size(), 2 * kCorners + 2 * (kCorners - 2));
    EXPECT_TRUE(body->report.closed());
    EXPECT_NEAR(volume(body->mesh), gearVolume(inner), 1e-5);
  }
  patient.limits.triangles = 30'000;
  EXPECT_THAT(refusal(folder_ / "column.obj", patient), HasSubstr("more than 5000000 points or 30000 triangles"));
}

// A spiral has two ears at a time, which the reader looks for among all corners: it ends with the triangles, or stops
// in time.
TEST_F(ReadBody, EndsOnASpiralOfTenThousandCorners) {
  std::vector<Flat> ring;
  for (std::size_t k = 0; k < kCorners; ++k) {
    const bool back = k >= kCorners / 2;
    const double along = static_cast<double>(back ? kCorners - 1 - k : k) / (kCorners / 2), angle = 40 * M_PI * along;
    ring.push_back(Flat{std::cos(angle), std::sin(angle)} * (0.05 + 0.15 * along + (back ? 0 : 0.003)));
  }
  BodyReadOptions hasty;
  hasty.limits.seconds = 1;
  const auto body = read(file("spiral.obj", columnObj(ring)), hasty);
  if (body)
    EXPECT_EQ(body->mesh.faces.size(), 2 * kCorners + 2 * (kCorners - 2));
  else
    EXPECT_THAT(text(body.error().what), HasSubstr("took longer than 1 second and was stopped"));
}

TEST_F(ReadBody, WrapsAnOpenColumnOfTenThousandCorners) {
  BodyReadOptions wrap;
  wrap.limits.seconds = 60;
  wrap.wrap = true;
  wrap.wrapCell = 0.06;
  const auto body = read(file("open.obj", columnObj(gear(0.2), true)), wrap);
  ASSERT_TRUE(body) << text(body.error().what);
  EXPECT_TRUE(body->wrapped);
  EXPECT_TRUE(body->report.closed());
  EXPECT_NEAR(volume(body->mesh), gearVolume(0.2), 0.3 * gearVolume(0.2));
}

TEST_F(ReadBody, AHelperThatHangsDiesOrLiesIsOnlyASentence) {
  const fs::path path = file("b.obj", asObj(figure()));
  BodyReadOptions options;
  const auto script = [&](const std::string& body) {
    const fs::path helper = file("helper", "#!/bin/sh\n" + body + "\n");
    fs::permissions(helper, fs::perms::owner_all);
    options.helper = helper;
    return refusal(path, options);
  };
  EXPECT_THAT(script("kill -SEGV $$"), HasSubstr("made the reader fail"));
  EXPECT_THAT(script("echo hello"), HasSubstr("damaged"));
  options.limits.points = options.limits.triangles = 1000;
  options.limits.seconds = 10;
  EXPECT_THAT(script("/bin/cat /dev/zero"), HasSubstr("more than"));
  options.limits.seconds = 1;
  EXPECT_THAT(script("exec /bin/sleep 60"), HasSubstr("longer than 1 second and"));
}

std::string bytesOf(std::string_view hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hexadecimal.substr(i, 2)), nullptr, 16));
  return bytes;
}
// Red, green; blue, (16, 32, 48).
const std::string kPng = bytesOf(
    "89504e470d0a1a0a0000000d4948445200000002000000020802000000fdd49a730000001349444154789c63f8cfc0c0"
    "00c20cff05140c001a94035edc92dbe90000000049454e44ae426082");
// 60,000 x 60,000 pixels, it says, in 74 bytes.
const std::string kHugePng = bytesOf(
    "89504e470d0a1a0a0000000d494844520000ea600000ea6008020000000fb0e2150000001149444154789c63601805a3"
    "60140c77000003e80001b3a6d3460000000049454e44ae426082");
// 8 x 8 of (200, 40, 60), and a little black.
const std::string kJpeg = bytesOf(
    "ffd8ffe000104a46494600010100000100010000ffdb0043000302020302020303030304030304050805050404050a07"
    "0706080c0a0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f171816141812141514ffdb0043010304"
    "0405040509050509140d0b0d141414141414141414141414141414141414141414141414141414141414141414141414"
    "1414141414141414141414141414ffc00011080008000803012200021101031101ffc400150001010000000000000000"
    "0000000000000007ffc40014100100000000000000000000000000000000ffc400150101010000000000000000000000"
    "0000000608ffc40014110100000000000000000000000000000000ffda000c03010002110311003f008d0024b41fffd9");

TEST_F(ReadBody, PhotographsForPrintsAreReadInTheCell) {
  const auto png = readPrint(file("p.png", kPng), Token());
  ASSERT_TRUE(png) << text(png.error().what);
  EXPECT_EQ(png->width, 2);
  EXPECT_EQ(png->rgb, (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 16, 32, 48}));
  const auto jpeg = readPrint(file("p.jpg", kJpeg), Token());
  ASSERT_TRUE(jpeg) << text(jpeg.error().what);
  EXPECT_EQ(jpeg->width * jpeg->height, 64);
  const auto why = [&](const std::string& name, const std::string& bytes) {
    const auto image = readPrint(file(name, bytes), Token());
    return image ? std::string("taken") : text(image.error().what);
  };
  EXPECT_THAT(why("huge.png", kHugePng), HasSubstr("more than 40 million pixels"));
  for (const auto& [name, whole] : {std::pair("a.png", kPng), std::pair("a.jpg", kJpeg)}) {
    EXPECT_THAT(why(name, whole.substr(0, 30)), HasSubstr("no photograph"));
    std::mt19937 lot(5);
    for (int k = 0; k < 24; ++k) {  // never more than a sentence, whatever was changed
      std::string bad = whole;
      bad[lot() % bad.size()] = static_cast<char>(lot());
      (void)why(name, bad);
    }
  }
  EXPECT_THAT(why("p.gif", "GIF89a"), HasSubstr("no photograph"));
  EXPECT_THAT(why("empty.png", ""), HasSubstr("no photograph"));
  EXPECT_FALSE(readPrint(folder_ / "not_there.png", Token()));
  // One that is larger than a print needs is made smaller by whole pixels.
  PrintPixels large{3000, 10, {}};
  large.rgb.resize(std::size_t{3} * 3000 * 10, 100);
  EXPECT_EQ(fitted(large, kMostPrintSide).width, 1000);
  EXPECT_EQ(fitted(large, kMostPrintSide).rgb.front(), 100);
}

TEST_F(ReadBody, TakesEveryBodyHandedToTheTests) {
  const fs::path bodies = KARINUI_SHARED_DIR "/bodies";
  if (!fs::exists(bodies)) GTEST_SKIP() << "the shared bodies are not here";
  for (const auto& entry : fs::directory_iterator(bodies)) {
    if (entry.path().extension() != ".obj") continue;
    const auto body = read(entry.path());
    ASSERT_TRUE(body) << entry.path();
    EXPECT_EQ(body->report.triangles, 26756u);
    EXPECT_EQ(body->report.points, 13380u);
    EXPECT_TRUE(body->report.closed());
    EXPECT_FALSE(body->turnedOutward);
    EXPECT_EQ(body->report.shells, 1u);
    EXPECT_EQ(body->unit, LengthUnit::Metre);
    EXPECT_LE(body->report.selfCrossings, 54u);
  }
}

TEST_F(ReadBody, StandsEveryBadFileHandedToTheTests) {
  const fs::path bad = KARINUI_SHARED_DIR "/badinput";
  if (!fs::exists(bad)) GTEST_SKIP() << "the shared bad files are not here";
  const bool all = atLength();  // each is a process; a third of them otherwise
  std::size_t tried = 0;
  for (const auto& entry : fs::recursive_directory_iterator(bad)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".obj" && ending != ".ply" && ending != ".gltf" && ending != ".glb") continue;
    if (tried++ % 3 > 0 && !all) continue;
    for (bool wrap : {false, true}) {
      BodyReadOptions options;
      options.wrap = wrap;
      const auto body = read(entry.path(), options);
      if (body) {
        EXPECT_TRUE(body->report.closed()) << entry.path();
        break;
      }
      const std::string said = text(body.error().what);
      EXPECT_FALSE(said.empty());
      if (said.find("wrapped") == said.npos) break;  // not what a skin over it would mend
    }
  }
  EXPECT_GT(tried, 100u);
}

}  // namespace
}  // namespace karinui
