// The statistical description (data/body_sections.json) against what it says of itself and the bodies it describes.
#include "body/section_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tuple>

#include "geometry/shapes.h"
#include "karinui/body/body.h"
#include "karinui/geometry/section.h"

namespace karinui {
namespace {

using nlohmann::json;

const json& table() {
  static const json all = [] {
    std::ifstream in(std::string(KARINUI_SOURCE_DIR) + "/data/body_sections.json");
    return json::parse(in);
  }();
  return all;
}

TEST(SectionModel, EveryShapeIsAsLargeAsItsTapeSays) {  // shapes are stated in shares of their own girth
  for (const auto& [sex, own] : table().at("sexes").items())
    for (const auto& [part, station] : table().at("stations").items()) {
      const Harmonics harmonics{station.at("harmonics"), station.at("symmetric")};
      std::size_t index = 0;
      for (const json& row : own.at(part).at("shape")) {
        Coefficients c{};
        for (std::size_t k = 0; k < row.size(); ++k) c[k] = row[k].get<double>() / 10000;
        EXPECT_NEAR(hullGirth(c, harmonics), 1, 0.02) << sex << " " << part << " " << index++;
      }
    }
}

TEST(SectionModel, TheSpreadOfTheGirthsIsThatOfTheirCovariance) {
  for (const auto& [sex, own] : table().at("sexes").items()) {
    const auto rows = own.at("inverse_covariance").get<std::vector<std::vector<double>>>();
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd inverse(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) inverse(i, j) = rows[i][j];
    EXPECT_TRUE(inverse.isApprox(inverse.transpose())) << sex;
    const Eigen::MatrixXd covariance = inverse.inverse();
    for (Eigen::Index i = 0; i < n; ++i)
      EXPECT_NEAR(std::sqrt(covariance(i, i)) / own.at("sd")[i].get<double>(), 1, 0.01) << sex << " " << i;
  }
}

// More of one girth, all else as it was: more of it in the drawing, where it is taken and everywhere near.
TEST(SectionModel, AGirthGrowsWithWhatIsAskedFor) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Numbers numbers(seed);
    const Sex sex = seed % 2 ? Sex::Male : Sex::Female;
    const bool female = sex == Sex::Female;
    const SectionModel model = SectionModel::of(sex);
    const double height = numbers.between(1.5, 1.95), wide = numbers.between(0, 1);
    const Measurements usual = model.completed({sex,
                                                {{"height", height},
                                                 {"bust_girth", height * ((female ? 0.51 : 0.54) + 0.10 * wide)},
                                                 {"waist_girth", height * ((female ? 0.40 : 0.43) + 0.10 * wide)},
                                                 {"hip_girth", height * ((female ? 0.56 : 0.54) + 0.08 * wide)}}});
    const auto girthAt = [&](const Figure& figure, const char* region, double fraction) {
      const Limb& torso = figure.torso;
      for (std::size_t i = 0; i < torso.station.size(); ++i)
        if (torso.region[i] == region && torso.fraction[i] == fraction)
          return hullGirth(torso.station[i].shape, torso.harmonics);
      return 0.0;
    };
    const Figure drawn = model.draw(usual);
    const std::tuple<const char*, const char*, double> places[] = {
        {"hip_girth", "pelvis", 0.22}, {"waist_girth", "pelvis", 1.0}, {"bust_girth", "trunk", 1.0}};
    for (const auto& [key, region, fraction] : places) {
      Measurements more = usual;
      more.value[key] += 0.02;
      const double grown = girthAt(model.draw(more), region, fraction) - girthAt(drawn, region, fraction);
      EXPECT_GT(grown, 0.008) << key;
      EXPECT_LT(grown, 0.032) << key;
    }
    Measurements taller = usual;  // the same proportions, five per cent larger
    for (auto& [key, value] : taller.value) value *= 1.05;
    const Figure larger = model.draw(taller);
    EXPECT_DOUBLE_EQ(larger.at.crown, 1.05 * height);
    EXPECT_GT(larger.at.waist, drawn.at.waist);
    EXPECT_GT(larger.at.crotch, drawn.at.crotch);
    EXPECT_GT(girthAt(larger, "pelvis", 1.0), girthAt(drawn, "pelvis", 1.0));
  }
}

class DescribedBodies : public testing::TestWithParam<const char*> {};

// What the model draws from five tapes alone, against the joints and the girths of the body itself. The figure is not
// altered yet, so girths between the tapes differ by what people differ.
TEST_P(DescribedBodies, AreDrawnFromTheirTapes) {
  const std::string base = std::string(KARINUI_SHARED_DIR) + "/bodies/" + GetParam();
  if (!std::filesystem::exists(base + ".json")) GTEST_SKIP() << "the shared bodies are not here";
  std::ifstream in(base + ".json");
  const json known = json::parse(in);
  const TriangleMesh mesh = test::readPlainObj(base + ".obj");
  Measurements stated{known.at("sex") == "male" ? Sex::Male : Sex::Female, {}};
  for (const auto& [name, centimetres] : known.at("measured_cm").items())
    if (name == "height" || name == "bust" || name == "underbust" || name == "waist" || name == "hips")
      stated.value[measurementKey(name).value()] = centimetres.get<double>() / 100;
  const SectionModel model = SectionModel::of(stated.sex);
  const Figure figure = model.draw(model.completed(stated));

  const Joints& at = figure.at;
  const std::pair<const char*, Vec3> joints[] = {{"l-shoulder", at.shoulder}, {"l-elbow", at.elbow},
                                                 {"l-hand", at.wrist},        {"l-upper-leg", at.hip},
                                                 {"l-knee", at.knee},         {"l-ankle", at.ankle}};
  for (const auto& [name, drawn] : joints) {
    const auto its = known.at("landmarks_m").at(name).get<std::array<double, 3>>();
    EXPECT_LT(distance(drawn, {its[0], its[1], its[2]}), 0.025) << name;
  }

  // The longest contour of a level section whose middle lies in [least, most].
  const auto girthAt = [&](double y, double least, double most) {
    double girth = 0;
    for (const SectionLoop& contour : section(mesh, {{0, y, 0}, {0, 1, 0}})) {
      const auto [low, high] = std::minmax_element(contour.points.begin(), contour.points.end(),
                                                   [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
      const double middle = (low->x + high->x) / 2;
      if (middle >= least && middle <= most) girth = std::max(girth, tightTapeLength(contour.points, {0, 1, 0}));
    }
    return girth;
  };
  double squares = 0;
  int count = 0;
  const auto compare = [&](const Section& drawn, Harmonics harmonics, double girth, const std::string& where) {
    const double off = hullGirth(drawn.shape, harmonics) / girth - 1;
    EXPECT_LT(std::abs(off), 0.085) << where << " at " << drawn.centre.y << " m";
    squares += off * off, ++count;
  };
  const auto torso = torsoSections(figure);
  for (std::size_t i = 1; i < torso.size(); ++i)  // the first may lie between the legs
    if (const std::string& region = figure.torso.region[i]; region == "pelvis" || region == "trunk")
      compare(torso[i], figure.torso.harmonics, girthAt(torso[i].centre.y, -0.05, 0.05), region);
  const auto legs = legSections(figure);
  for (std::size_t i = 0; i < legs.size(); ++i)
    if (const std::string& region = figure.leg.region[i]; region == "thigh" || region == "knee")
      compare(legs[i], figure.leg.harmonics, girthAt(legs[i].centre.y, 0.05, 0.25), region);
  EXPECT_EQ(count, 27);
  EXPECT_LT(std::sqrt(squares / count), 0.04);
}

INSTANTIATE_TEST_SUITE_P(Body, DescribedBodies, testing::Values("f_eu38", "f_jis9ar", "f_plus", "m_eu50", "m_tall"));

}  // namespace
}  // namespace karinui
