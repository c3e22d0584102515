#include "karinui/cloth/fabric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace karinui::test {
namespace {

TEST(Fabrics, AreSoundAndFoundByName) {
  ASSERT_GE(presets().size(), 5u);
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
                                                             {&Fabric::toe, "toe"},
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
    // Not stiffer in shear than the stiffest denim measured; never as stiff in shear as in stretch.
    EXPECT_LT(f.shear, 123) << f.name;
    EXPECT_LT(f.shear, 0.5 * std::fmin(f.stretchWarp, f.stretchWeft)) << f.name;
    EXPECT_TRUE(f.thickness >= 0.0001 && f.thickness <= 0.0012) << f.name;
  }
  for (const auto& sample : measured.at("fabrics")) {  // as thick and heavy as the one measured sample of its kind
    const std::string id = sample.at("id");
    if (id != "penava2014/cotton" && id != "penava2014/wool") continue;
    const Fabric f = *preset(id == "penava2014/cotton" ? "cotton" : "wool suiting");
    EXPECT_NEAR(f.thickness, sample.at("thickness_m"), 0.2 * f.thickness);
    EXPECT_NEAR(f.weight, sample.at("areal_density_kg_m2"), 0.2 * f.weight);
  }
}

}  // namespace
}  // namespace karinui::test
