#include "karinui/geometry/flatten.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <map>
#include <random>

#include "geometry/membrane.h"
#include "geometry/shapes.h"
#include "geometry/surfaces.h"
#include "karinui/geometry/patch.h"

namespace karinui {
namespace {

std::vector<std::uint32_t> borderOf(const TriangleMesh& mesh) {
  std::map<std::uint32_t, std::uint32_t> next;
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> runs;
  for (const Triangle& t : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) runs[{t[k], t[(k + 1) % 3]}] = true;
  for (const auto& [edge, yes] : runs)
    if (!runs.count({edge.second, edge.first})) next[edge.first] = edge.second;
  std::vector<std::uint32_t> border{next.begin()->first};
  while (next[border.back()] != border.front()) border.push_back(next[border.back()]);
  return border;
}

TriangleMesh partOfCylinder(double radius, double turn, double height) {
  return surfaces::grid(40, 50, false, [&](double s, double t) {
    const double a = (s - 0.5) * turn;
    return Vec3{radius * std::sin(a), height * t, radius * std::cos(a)};
  });
}
TriangleMesh partOfBall(double radius, double reach) {
  return surfaces::grid(30, 30, false, [&](double s, double t) {
    const double x = (s - 0.5) * reach, y = (t - 0.5) * reach;
    return normalized(Vec3{std::tan(x), std::tan(y), 1}) * radius;
  });
}

void expectIsometric(const TriangleMesh& mesh, const std::vector<Flat>& flat, double within) {
  for (const Triangle& t : mesh.faces) {
    EXPECT_GT(cross(flat[t[1]] - flat[t[0]], flat[t[2]] - flat[t[0]]), 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const double l = distance(mesh.points[t[k]], mesh.points[t[(k + 1) % 3]]);
      EXPECT_NEAR(distance(flat[t[k]], flat[t[(k + 1) % 3]]) / l, 1, within);
    }
  }
}

TEST(Flatten, ACylinderUnrolls) {
  const TriangleMesh mesh = partOfCylinder(0.15, 4.0, 0.5);
  const auto made = flatten(mesh, borderOf(mesh), {}, Token());
  ASSERT_TRUE(made);
  expectIsometric(mesh, made->flat, 1e-3);
  EXPECT_EQ(made->distortion.gate, Distortion::Gate::Green);
  // The grain is upright: points above each other have the same u.
  EXPECT_NEAR(made->flat[0].u, made->flat[41 * 50].u, 1e-6);
  EXPECT_NEAR(made->flat[41 * 50].v - made->flat[0].v, 0.5, 5e-4);
}

TEST(Flatten, AConeUnrolls) {
  const TriangleMesh mesh = surfaces::grid(50, 40, false, [](double s, double t) {
    const double a = (s - 0.5) * 5, r = 0.2 - 0.12 * t;
    return Vec3{r * std::sin(a), 0.3 * t, r * std::cos(a)};
  });
  const auto made = flatten(mesh, borderOf(mesh), {}, Token());
  ASSERT_TRUE(made);
  expectIsometric(mesh, made->flat, 1e-3);
}

TEST(Flatten, ABallIsStrainedButNeverFolded) {
  const TriangleMesh mesh = partOfBall(0.15, 1.2);
  const auto made = flatten(mesh, borderOf(mesh), {}, Token());
  ASSERT_TRUE(made);
  for (const Triangle& t : mesh.faces)
    EXPECT_GT(cross(made->flat[t[1]] - made->flat[t[0]], made->flat[t[2]] - made->flat[t[0]]), 0);
  EXPECT_NE(made->distortion.gate, Distortion::Gate::Green);
  EXPECT_GT(made->distortion.warp.max, 0.01);
  EXPECT_LT(std::fabs(made->distortion.border), 0.01);
  // Cloth gives way in shear before it stretches.
  FlattenSettings stiff;
  stiff.shear = 1000;
  const auto sheet = flatten(mesh, borderOf(mesh), stiff, Token());
  ASSERT_TRUE(sheet);
  EXPECT_GT(made->distortion.shear.mean, sheet->distortion.shear.mean);
  EXPECT_LT(made->distortion.warp.mean + made->distortion.weft.mean,
            sheet->distortion.warp.mean + sheet->distortion.weft.mean);
}

TEST(Flatten, AFoldIsLaidStraight) {
  const TriangleMesh mesh = surfaces::grid(20, 40, false, [](double s, double t) {
    const double a = s * 1.1, b = (t - 0.5) * 1.1;
    return Vec3{0.2 * std::sin(a) * std::cos(b), 0.2 * std::sin(b), 0.2 * std::cos(a) * std::cos(b)};
  });
  FlattenSettings settings;
  for (std::uint32_t j = 0; j <= 40; ++j) settings.fold.push_back(j * 21);
  const auto made = flatten(mesh, borderOf(mesh), settings, Token());
  ASSERT_TRUE(made);
  for (std::uint32_t p : settings.fold) EXPECT_EQ(made->flat[p].u, 0);
  EXPECT_GT(made->flat[20].u, 0.1);
  EXPECT_GT(made->flat[21 * 40].v, made->flat[0].v);
}

TEST(Flatten, IsTheSameEveryTime) {
  const TriangleMesh mesh = partOfBall(0.15, 1.0);
  const auto one = flatten(mesh, borderOf(mesh), {}, Token()), two = flatten(mesh, borderOf(mesh), {}, Token());
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->flat, two->flat);
}

TEST(Flatten, StopsWhenTold) {
  const TriangleMesh mesh = partOfBall(0.15, 1.0);
  Token token;
  token.cancel();
  const auto made = flatten(mesh, borderOf(mesh), {}, token);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, Error::Kind::Cancelled);
}

TEST(Flatten, RefusesPointsThatAreNoNumbers) {
  TriangleMesh mesh = surfaces::plane(4, 1);
  mesh.points[3].x = std::nan("");
  EXPECT_FALSE(flatten(mesh, borderOf(mesh), {}, Token()));
}

TEST(Membrane, ItsStiffnessIsTheSecondDerivativeWithoutWhatGoesDownhill) {
  std::mt19937 lot(7);
  std::uniform_real_distribution<double> any(-2, 2);
  int raised = 0;
  for (int n = 0; n < 2000; ++n) {
    const Gradient f(any(lot), any(lot), any(lot), any(lot));
    if (determinant(f) < 0.05) continue;
    const MembraneTerm term = symmetricDirichlet(f, true);
    Eigen::Vector4d slope;
    Eigen::Matrix4d second;
    for (int k = 0; k < 4; ++k) {
      const double h = 1e-6;
      const Gradient step = h * Gradient::Unit(k);
      slope[k] = (symmetricDirichlet(f + step, false).value - symmetricDirichlet(f - step, false).value) / (2 * h);
      second.col(k) = (symmetricDirichlet(f + step, true).slope - symmetricDirichlet(f - step, true).slope) / (2 * h);
    }
    EXPECT_LT((slope - term.slope).norm(), 1e-6 * (1 + term.slope.norm()));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> parts(0.5 * (second + second.transpose()));
    raised += parts.eigenvalues().minCoeff() < -1e-3 ? 1 : 0;
    const Eigen::Matrix4d nearest =
        parts.eigenvectors() * parts.eigenvalues().cwiseMax(0.0).asDiagonal() * parts.eigenvectors().transpose();
    EXPECT_LT((nearest - term.stiffness).norm(), 1e-5 * (1 + second.norm())) << f.transpose();
  }
  EXPECT_GT(raised, 100);
}

TEST(Reflatten, NothingMovedIsTheOldPaper) {
  // Paper strained by 3 % in the drape: the strain must not come into the paper.
  const TriangleMesh mesh = partOfCylinder(0.15, 2.0, 0.5);
  const auto made = flatten(mesh, borderOf(mesh), {}, Token());
  ASSERT_TRUE(made);
  std::vector<Vec3> draped = mesh.points;
  for (Vec3& p : draped) p.y *= 1.03;
  const auto again = reflatten(made->flat, mesh.faces, draped, draped, Token());
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, made->flat);
}

TEST(Reflatten, APulledHemGrowsByWhatWasPulled) {
  const TriangleMesh mesh = partOfCylinder(0.15, 2.0, 0.5);
  const auto made = flatten(mesh, borderOf(mesh), {}, Token());
  ASSERT_TRUE(made);
  std::vector<Vec3> pulled = mesh.points;  // the lower 20 cm stretched by a quarter, evenly all round
  for (Vec3& p : pulled)
    if (p.y < 0.2) p.y = 0.2 - (0.2 - p.y) * 1.25;
  const auto again = reflatten(made->flat, mesh.faces, mesh.points, pulled, Token());
  ASSERT_TRUE(again);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double y = mesh.points[i].y, down = y < 0.2 ? (0.2 - y) * 0.25 : 0;
    EXPECT_NEAR((*again)[i].u, made->flat[i].u, 5e-4);
    EXPECT_NEAR((*again)[i].v, made->flat[i].v - down, 5e-4);
  }
}

// Cylinders over any smooth profile are developable; so is what a rigid motion makes of them.
TEST(Flatten, AnyDevelopableSheetUnrollsWithoutStrain) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Numbers numbers(seed);
    const double bend = numbers.between(0.5, 2.2), wave = numbers.between(2, 5), lean = numbers.between(-1, 1),
                 height = numbers.between(0.2, 0.6);
    std::vector<Vec3> profile{{}};  // turning to and fro, in steps of equal length
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
      const double way = lean + bend * std::sin(wave * i / kSteps);
      profile.push_back(profile.back() + Vec3{std::cos(way), 0, std::sin(way)} * 0.006);
    }
    TriangleMesh mesh = surfaces::grid(kSteps, 30, false, [&](double s, double t) {
      return profile[static_cast<std::size_t>(std::lround(s * kSteps))] + Vec3{0, height * t, 0};
    });
    const Rigid turned = turnAbout({numbers.between(-1, 1), 0, numbers.between(-1, 1)}, numbers.between(-0.5, 0.5));
    for (Vec3& p : mesh.points) p = turned(p);
    FlattenSettings settings;
    settings.grain = turned(Vec3{0, 1, 0});
    const auto made = flatten(mesh, borderOf(mesh), settings, Token());
    ASSERT_TRUE(made);
    expectIsometric(mesh, made->flat, 1e-3);
    double flat = 0;
    for (const Triangle& t : mesh.faces)
      flat += cross(made->flat[t[1]] - made->flat[t[0]], made->flat[t[2]] - made->flat[t[0]]) / 2;
    EXPECT_NEAR(flat / area(mesh), 1, 1e-3);
    EXPECT_EQ(made->distortion.gate, Distortion::Gate::Green);
    EXPECT_LT(made->distortion.shear.max, 2e-3);
    const auto up = static_cast<std::size_t>(kSteps + 1) * 30;
    EXPECT_NEAR(made->flat[up].u, made->flat[0].u, 1e-3) << "the grain is upright";
    EXPECT_NEAR(made->flat[up].v - made->flat[0].v, height, 1e-3);
  }
}

}  // namespace
}  // namespace karinui
