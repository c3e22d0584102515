// What a document keeps of its fabrics.
#include <gtest/gtest.h>

#include "design/pack.h"

namespace karinui {
namespace {

TEST(KeptFabric, ComesBackWithItsCurves) {
  Document document;
  for (const char* name : {"denim", "jersey", "simcloth"}) document.fabrics[name] = *preset(name);
  const auto back = unpackRest(packRest(document));
  ASSERT_TRUE(back) << text(back.error().what);
  EXPECT_EQ(back->fabrics, document.fabrics);
}

TEST(KeptFabric, OfBeforeTheCurvesReadsAndHashesAsItDid) {
  Document document;
  Fabric plain;  // the denim of then
  plain.name = "denim";
  plain.weight = 0.36, plain.stretchWarp = 1800, plain.stretchWeft = 1200, plain.shear = 90;
  plain.bendWarp = 3.6e-5, plain.bendWeft = 2.4e-5, plain.thickness = 0.0009;
  plain.frictionBody = 0.4, plain.frictionCloth = 0.45;
  document.fabrics["denim"] = plain;
  // As it was written then: no flag, no four numbers.
  std::string bytes = packRest(document);
  Writer then, now;
  then.add(plain.name).add(std::uint8_t{0});
  now.add(plain.name).add(std::uint8_t{2});
  const std::string mark = now.taken();
  const std::size_t at = bytes.find(mark);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, mark.size(), then.taken());
  bytes.erase(at + mark.size() + 11 * sizeof(double), 4 * sizeof(double));
  const auto back = unpackRest(bytes);
  ASSERT_TRUE(back) << text(back.error().what);
  EXPECT_EQ(back->fabrics.at("denim"), plain);
  EXPECT_EQ(hash(*back), "1b8de442493833e82a72d0e621b79388");
  for (double Fabric::*curve : {&Fabric::toeWeft, &Fabric::stiffenWarp, &Fabric::stiffenWeft, &Fabric::shearStiffen}) {
    Document other = document;
    other.fabrics["denim"].*curve += 0.01;
    EXPECT_NE(hash(other), hash(document));
  }
}

}  // namespace
}  // namespace karinui
