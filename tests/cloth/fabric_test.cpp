#include "karinui/cloth/fabric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace karinui::test {
namespace {

TEST(Fabrics, AreSoundAndFoundByName) {
  ASSERT_GE(presets().size(), 9u);  // eight of woven law and simcloth at least
  for (const Fabric& fabric : presets()) {
    EXPECT_TRUE(checkFabric(fabric)) << fabric.name;
    const auto found = preset(fabric.name);
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, fabric);
  }
  const auto none = preset("cardboard");
  ASSERT_FALSE(none);
  EXPECT_NE(text(none.error().what).find("cardboard"), std::string::npos);
  EXPECT_NE(text(none.error().what).find("denim"), std::string::npos);  // says what there is
}

TEST(Fabrics, AbsurdValuesAreRefusedByName) {
  const std::pair<double Fabric::*, const char*> fields[] = {{&Fabric::weight, "weight"},
                                                             {&Fabric::stretchWarp, "warp"},
                                                             {&Fabric::stretchWeft, "weft"},
                                                             {&Fabric::shear, "shear"},
                                                             {&Fabric::bendWarp, "bending of the warp"},
                                                             {&Fabric::bendWeft, "bending of the weft"},
                                                             {&Fabric::compression, "compression"},
                                                             {&Fabric::toeWarp, "toe of the warp"},
                                                             {&Fabric::toeWeft, "toe of the weft"},
                                                             {&Fabric::stiffenWarp, "stiffening of the warp"},
                                                             {&Fabric::stiffenWeft, "stiffening of the weft"},
                                                             {&Fabric::shearStiffen, "stiffening of the shear"},
                                                             {&Fabric::thickness, "thickness"},
                                                             {&Fabric::frictionBody, "friction on the body"},
                                                             {&Fabric::frictionCloth, "friction on cloth"}};
  for (const auto& [field, word] : fields)
    for (const double bad : {-1.0, 1e9, std::nan(""), static_cast<double>(INFINITY)}) {
      Fabric fabric = *preset("wool suiting");
      fabric.*field = bad;
      const auto fine = checkFabric(fabric);
      ASSERT_FALSE(fine) << word << " " << bad;
      EXPECT_NE(text(fine.error().what).find(word), std::string::npos) << text(fine.error().what);
      EXPECT_NE(text(fine.error().what).find("wool suiting"), std::string::npos);
    }
}

// Two like plies of thickness t bend as one of 2 t: about the seam between them, K t^2 / 2 more than each by itself.
TEST(Fabrics, FusedBendAsALaminate) {
  for (const Fabric& fabric : presets()) {
    if (fabric.law != Fabric::Law::Woven) continue;
    const Fabric two = fused(fabric, fabric);
    EXPECT_NEAR(two.weight, 2 * fabric.weight, 1e-12);
    EXPECT_NEAR(two.thickness, 2 * fabric.thickness, 1e-12);
    EXPECT_NEAR(two.stretchWarp, 2 * fabric.stretchWarp, 1e-9);
    EXPECT_NEAR(two.toeWeft, fabric.toeWeft, 1e-12);
    EXPECT_NEAR(two.compression, fabric.compression, 1e-12);
    const double t = fabric.thickness;
    EXPECT_NEAR(two.bendWarp, 2 * fabric.bendWarp + fabric.stretchWarp * t * t / 2, 1e-12) << fabric.name;
    EXPECT_NEAR(two.bendWeft, 2 * fabric.bendWeft + fabric.stretchWeft * t * t / 2, 1e-12) << fabric.name;
    EXPECT_EQ(two.frictionBody, fabric.frictionBody);
    EXPECT_TRUE(checkFabric(fused(fabric, *preset("interfacing")))) << fabric.name;
  }
  // A limp one barely stiffens a stiff one, and takes its name.
  const Fabric leather = fused(*preset("leather"), *preset("chiffon"));
  EXPECT_EQ(leather.name, "leather");
  EXPECT_LT(leather.bendWarp, 10 * preset("leather")->bendWarp);
}

TEST(Fabrics, LieWithinWhatWasMeasured) {
  const auto path = std::filesystem::path(KARINUI_SHARED_DIR) / "fabrics/measured.json";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the measured fabrics are not here";
  std::ifstream file(path);
  const auto measured = nlohmann::json::parse(file);
  const auto& all = measured.at("population_statistics").at(0);  // of 618 fabrics, 1st to 99th percentile
  const auto within = [&](const char* key, double value) {
    const auto& p = all.at(key);
    return value >= p.front().get<double>() && value <= p.back().get<double>();
  };
  for (const Fabric& f : presets()) {
    if (f.law != Fabric::Law::Woven) continue;
    EXPECT_TRUE(within("areal_density_kg_m2", f.weight)) << f.name;
    EXPECT_TRUE(within("bending_warp_Nm", f.bendWarp)) << f.name;
    EXPECT_TRUE(within("bending_weft_Nm", f.bendWeft)) << f.name;
    EXPECT_TRUE(within("warp_over_weft", f.bendWarp / f.bendWeft)) << f.name;
    const double bend = 0.5 * (f.bendWarp + f.bendWeft);
    EXPECT_TRUE(within("bending_length_m_cuberoot_of_B_over_w", std::cbrt(bend / (f.weight * 9.81)))) << f.name;
    EXPECT_TRUE(f.thickness >= 0.0001 && f.thickness <= (f.name == "velvet" ? 0.002 : 0.0012)) << f.name;  // its pile
    if (f.name == "leather") continue;  // a sheet: no threads that turn against each other
    // Not stiffer in shear than the stiffest denim measured; never as stiff in shear as in stretch.
    EXPECT_LT(f.shear, 123) << f.name;
    EXPECT_LT(f.shear, 0.5 * std::fmin(f.stretchWarp, f.stretchWeft)) << f.name;
  }
  // Stretched as the measured denims are: the strain at 500 gf/cm and the linearity of the way there.
  const Fabric jeans = *preset("denim");
  double lowest = 1, highest = 0, leastLinear = 1, mostLinear = 0;
  for (const auto& sample : measured.at("fabrics"))
    if (sample.contains("kes_as_printed")) {
      const double strain = sample.at("si").at("tensile_strain_at_490_N_per_m"),
                   line = sample.at("si").at("tensile_linearity");
      lowest = std::fmin(lowest, strain), highest = std::fmax(highest, strain);
      leastLinear = std::fmin(leastLinear, line), mostLinear = std::fmax(mostLinear, line);
    }
  for (const ThreadCurve& threads : {jeans.warpCurve(), jeans.weftCurve()}) {
    EXPECT_GE(threads.strainAt(490.3), 0.99 * lowest);
    EXPECT_LE(threads.strainAt(490.3), 1.01 * highest);
    EXPECT_GE(threads.linearity(490.3), leastLinear);
    EXPECT_LE(threads.linearity(490.3), mostLinear);
  }
  for (const auto& sample : measured.at("fabrics")) {  // as thick and heavy as the one measured sample of its kind
    const std::string id = sample.at("id");
    if (id != "penava2014/cotton" && id != "penava2014/wool") continue;
    const Fabric f = *preset(id == "penava2014/cotton" ? "cotton" : "wool suiting");
    EXPECT_NEAR(f.thickness, sample.at("thickness_m"), 0.2 * f.thickness);
    EXPECT_NEAR(f.weight, sample.at("areal_density_kg_m2"), 0.2 * f.weight);
  }
}

// The published bands of the drape tester (see docs/user/fabrics.md), and the order of limp and stiff.
TEST(Fabrics, HangAsPublished) {
  const auto drape = [](const char* name) { return drapeFigure(*preset(name)).value().coefficient; };
  for (const Fabric& fabric : presets()) EXPECT_EQ(drapeFigure(fabric).has_value(), fabric.law == Fabric::Law::Woven);
  EXPECT_TRUE(drape("silk") >= 20 && drape("silk") <= 40);
  EXPECT_TRUE(drape("cotton") >= 60 && drape("cotton") <= 76);
  EXPECT_TRUE(drape("wool suiting") >= 40 && drape("wool suiting") <= 70);
  EXPECT_TRUE(drape("denim") >= 70 && drape("denim") <= 90);
  EXPECT_TRUE(drape("leather") >= 47 && drape("leather") <= 70);
  Fabric changed = *preset("denim");
  changed.shear *= 1.01;
  EXPECT_FALSE(drapeFigure(changed));  // nobody laid that one on
}

// The table of the guide, in both languages, has the numbers of the shop, and the drape that its board tells.
TEST(Fabrics, AreInTheGuideAsTheyAre) {
  const auto near = [](const std::string& words, double value, double unit) {  // to the last digit that is written
    const double told = std::strtod(words.c_str(), nullptr);
    const std::size_t point = words.find('.'), end = words.find_first_not_of(" 0123456789.");
    const std::size_t digits = point == std::string::npos ? 0 : words.substr(0, end).find_last_of("0123456789") - point;
    EXPECT_NEAR(told, value / unit, 0.51 * std::pow(10.0, -static_cast<double>(digits))) << words;
  };
  for (const std::string page : {"fabrics.md", "fabrics.ja.md"}) {
    std::ifstream file(std::string(KARINUI_SOURCE_DIR) + "/docs/user/" + page);
    std::size_t rows = 0;
    for (std::string line; std::getline(file, line);) {
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
      const Fabric* fabric = nullptr;
      for (const Fabric& one : presets())
        if (cells.size() > 8 && cells[1].starts_with(" " + one.name)) fabric = &one;
      if (!fabric) continue;
      SCOPED_TRACE(page + ": " + fabric->name);
      ++rows;
      const auto second = [&](std::size_t k) { return cells[k].substr(cells[k].find('/') + 1); };
      near(cells[2], fabric->weight, 1e-3);
      near(cells[3], fabric->bendWarp, 1e-6), near(second(3), fabric->bendWeft, 1e-6);
      near(cells[4], fabric->warpCurve().strainAt(490.3), 0.01),
          near(second(4), fabric->weftCurve().strainAt(490.3), 0.01);
      near(cells[5], fabric->warpCurve().linearity(490.3), 1), near(second(5), fabric->weftCurve().linearity(490.3), 1);
      EXPECT_EQ(std::strtod(cells[6].c_str() + cells[6].find_first_of("0123456789"), nullptr),
                drapeFigure(*fabric).value().coefficient);
      EXPECT_EQ(std::stoi(cells[8]), drapeFigure(*fabric).value().folds);
    }
    EXPECT_EQ(rows, 13u) << page;
  }
}

TEST(ThreadCurve, IsOneLawInEnergyForceAndSlope) {
  for (const ThreadCurve& c :
       {ThreadCurve{1000, 50, 0.002, 0}, ThreadCurve{1800, 90, 0.002, 220}, ThreadCurve{120, 12, 0.01, 130},
        ThreadCurve{1000, 1000, 0, 0}, ThreadCurve{500, 25, 0, 1e4}}) {
    double before = -1e300;
    for (double e = -0.2; e < 0.4; e += 0.00137) {
      const double d = 1e-7;
      EXPECT_NEAR((c.energy(e + d) - c.energy(e - d)) / (2 * d), c.force(e), 1e-5 * c.stiffness + 1e-6 * c.force(e));
      if (std::fabs(e) > 2 * d) {
        EXPECT_NEAR((c.force(e + d) - c.force(e - d)) / (2 * d), c.tangent(e), 0.002 * c.tangent(e)) << e;
      }
      EXPECT_GT(c.force(e), before);  // monotone: more stretch, more force
      before = c.force(e);
      EXPECT_LE(c.tangent(e), ThreadCurve::kFirmest * c.stiffness * (1 + 1e-9));
    }
    EXPECT_DOUBLE_EQ(c.energy(0), 0);
    EXPECT_NEAR(c.force(c.strainAt(490)), 490, 1e-6);
  }
  EXPECT_NEAR((ThreadCurve{1000, 1000, 0, 0}).linearity(490), 1, 1e-9);  // a straight line
  // Stiffening alone, closed form: F = K e (1 + s e / 2), W = K e^2 (1 + s e / 3) / 2.
  const ThreadCurve stiffening{1000, 1000, 0, 300};
  EXPECT_NEAR(stiffening.force(0.05), 1000 * 0.05 * (1 + 300 * 0.05 / 2), 1e-9);
  EXPECT_NEAR(stiffening.linearity(stiffening.force(0.05)), (1 + 5.0) / (1 + 7.5), 1e-9);
}

}  // namespace
}  // namespace karinui::test
