// What a document keeps of allowances, elastics, hems, eases and counts.
#include <gtest/gtest.h>

#include "design/pack.h"

namespace karinui {
namespace {

Document finished() {
  Document document;
  document.variables["ease"] = "4cm";
  document.allowances.kinds[EdgeKind::Hem] = 0.04;
  document.allowances.edges[{{1}, "side"}] = 0.025;
  document.allowances.corners[{{1}, "hem"}] = CornerKind::SquareAfter;
  document.allowances.elastics[{{1}, "waist"}] = {0.6, 14};
  document.allowances.hems[{{1}, "hem"}] = {0.04, 0.01};
  document.allowances.topstitches[{{1}, "hem"}] = {0.02, 2, 0.005, 0.004, 0xc08040};
  document.allowances.topstitches[{{1}, "side"}] = {};
  document.allowances.pipings[{{1}, "side"}] = {0.005, "silk"};
  document.allowances.bindings[{{1}, "neck"}] = {0.01, ""};
  Fastening& buttons = document.allowances.fastenings["front"];
  buttons.a = {{{1}, "centre", 0, 1}}, buttons.b = {{{2}, "centre", 0.25, 1}};
  buttons.at = {0.1, 0.5, 0.9}, buttons.closed = 2, buttons.fromStart = false, buttons.inset = 0.015;
  document.cutting[{1}] = {4, true}, document.cutting[{2}] = {3, false};
  document.eases[{2}] = 0.012;
  return document;
}

TEST(KeptFinishing, ComesBack) {
  const Document document = finished();
  const auto back = unpackRest(packRest(document));
  ASSERT_TRUE(back) << text(back.error().what);
  EXPECT_EQ(back->allowances, document.allowances);
  EXPECT_EQ(back->cutting, document.cutting);
  EXPECT_EQ(back->eases, document.eases);
  EXPECT_EQ(back->variables, document.variables);
  EXPECT_EQ(hash(*back), hash(document));
}

TEST(KeptFinishing, InterfacingComesBackAndCounts) {
  Piece piece;
  piece.id = {1}, piece.name = "collar";
  const auto hashed = [](const Piece& one) {
    Document document;
    document.pattern.pieces[one.id] = std::make_shared<const Piece>(one);
    return hash(document);
  };
  const std::string plain = packPiece(piece), before = hashed(piece);
  piece.interfacing = "linen";
  const auto back = unpackPiece(packPiece(piece));
  ASSERT_TRUE(back) << text(back.error().what);
  EXPECT_EQ(back->interfacing, "linen");
  EXPECT_NE(hashed(piece), before);
  piece.interfacing.clear();  // pieces without are packed as before there was any
  EXPECT_EQ(packPiece(piece), plain);
}

TEST(KeptFinishing, EachPartCounts) {
  const std::string all = hash(finished());
  Document kinds = finished(), edges = finished(), corners = finished(), cutting = finished(), eases = finished(),
           elastics = finished(), hems = finished(), opened = finished(), stitches = finished(), thread = finished(),
           cord = finished(), strip = finished();
  stitches.allowances.topstitches[{{1}, "hem"}].rows = 3, thread.allowances.topstitches[{{1}, "side"}].colour = 0;
  cord.allowances.pipings[{{1}, "side"}].fabric = "linen", strip.allowances.bindings[{{1}, "neck"}].width = 0.011;
  opened.allowances.fastenings["front"].closed = 1;
  kinds.allowances.kinds.clear(), edges.allowances.edges[{{1}, "side"}] = 0.026;
  corners.allowances.corners.clear(), cutting.cutting[{1}].pairs = false, eases.eases.clear();
  elastics.allowances.elastics[{{1}, "waist"}].strength = 15, hems.allowances.hems[{{1}, "hem"}].under = 0;
  for (const Document* other :
       {&kinds, &edges, &corners, &cutting, &eases, &elastics, &hems, &opened, &stitches, &thread, &cord, &strip})
    EXPECT_NE(hash(*other), all);
}

// Documents without are packed as before there were any.
TEST(KeptFinishing, OfBeforeReadsAsItDid) {
  Document plain;
  const std::size_t size = packRest(plain).size();
  plain.allowances.kinds[EdgeKind::Hem] = 0.04;
  EXPECT_GT(packRest(plain).size(), size);
  plain.allowances = {};
  EXPECT_EQ(packRest(plain).size(), size);
  EXPECT_EQ(hash(Document()), "1b2adc6d04fc17b6c60a783f554615e8");
  EXPECT_EQ(size, 95u) << "a file of before ends where it did";
}

TEST(KeptFinishing, NonsenseIsRefused) {
  for (const auto& spoil : {+[](Document& d) { d.allowances.kinds[EdgeKind::Hem] = 0.2; },
                            +[](Document& d) {
                              d.allowances.edges[{{1}, "side"}] = -0.01;
                            },
                            +[](Document& d) {
                              d.allowances.corners[{{1}, "hem"}] = static_cast<CornerKind>(6);
                            },
                            +[](Document& d) {
                              d.allowances.elastics[{{1}, "waist"}].ratio = 0;
                            },
                            +[](Document& d) {
                              d.allowances.hems[{{1}, "hem"}].under = 0.05;
                            },
                            +[](Document& d) {
                              d.allowances.topstitches[{{1}, "hem"}].rows = 0;
                            },
                            +[](Document& d) {
                              d.allowances.pipings[{{1}, "side"}].thickness = 0.1;
                            },
                            +[](Document& d) {
                              d.allowances.bindings[{{1}, "neck"}].width = 0;
                            },
                            +[](Document& d) { d.allowances.fastenings["front"].closed = 4; },
                            +[](Document& d) {
                              d.allowances.fastenings["front"].at = {0.5, 0.4};
                            },
                            +[](Document& d) { d.cutting[{1}].count = 0; }, +[](Document& d) { d.eases[{2}] = -1; }}) {
    Document document = finished();
    spoil(document);
    EXPECT_FALSE(unpackRest(packRest(document)));
  }
}

}  // namespace
}  // namespace karinui
