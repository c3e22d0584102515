// Cloth carried along with its paper, before a drape says where it hangs.
#include "session/carried_shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace karinui {
namespace {

// A quarter of a tube of radius 0.2, 0.3 high, of paper as wide as its skin.
Document quarterTube() {
  auto form = std::make_shared<Form>();
  constexpr std::uint32_t kSide = 8;
  for (std::uint32_t j = 0; j <= kSide; ++j)
    for (std::uint32_t i = 0; i <= kSide; ++i) {
      const double turn = 1.5707963 * i / kSide, v = 0.3 * j / kSide;
      form->flat.push_back({0.2 * turn, v});
      form->space.push_back({0.2 * std::sin(turn), v, 0.2 * std::cos(turn)});
    }
  for (std::uint32_t j = 0; j < kSide; ++j)
    for (std::uint32_t i = 0; i < kSide; ++i) {
      const std::uint32_t a = j * (kSide + 1) + i, b = a + kSide + 1;
      form->faces.push_back({a, a + 1, b + 1});
      form->faces.push_back({a, b + 1, b});
    }
  Piece piece;
  piece.id = PieceId{1};
  piece.name = "tube";
  piece.form = form;
  Document document;
  document.pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  return document;
}

// The places with v below `under` moved on the paper.
Document cut(const Document& before, double under, Flat by) {
  Document after = before;
  Piece piece = *before.find(PieceId{1});
  auto form = std::make_shared<Form>(*piece.form);
  for (Flat& flat : form->flat)
    if (flat.v < under) flat += by;
  piece.form = form;
  after.pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  return after;
}

TEST(CarriedShape, GoesAsFarAlongTheClothAsOnThePaper) {
  const Document before = quarterTube();
  const Form& was = *before.find(PieceId{1})->form;
  const Document longer = carriedAlong(before, cut(before, 0.01, {0, -0.02}));
  const Form& hem = *longer.find(PieceId{1})->form;
  const Document turned = carriedAlong(before, cut(before, 0.01, {0.01, 0}));
  const Form& round = *turned.find(PieceId{1})->form;
  for (std::size_t i = 0; i < was.space.size(); ++i) {
    const bool moved = was.flat[i].v < 0.01;
    const Vec3 by = hem.space[i] - was.space[i], along = round.space[i] - was.space[i];
    EXPECT_NEAR(distance(by, moved ? Vec3{0, -0.02, 0} : Vec3{}), 0, 1e-9) << i;
    EXPECT_NEAR(length(along), moved ? 0.01 : 0, 2e-4) << i;
    const Vec3 off = normalized({was.space[i].x, 0, was.space[i].z});
    EXPECT_NEAR(dot(along, off), 0, 0.0011) << "not off the skin";
  }
}

TEST(CarriedShape, WhatWasNotCutStaysTheSame) {
  const Document before = quarterTube();
  const Document after = carriedAlong(before, before);
  EXPECT_EQ(after.find(PieceId{1}), before.find(PieceId{1}));
  Document flat = before;  // never draped
  Piece piece = *before.find(PieceId{1});
  piece.form = nullptr;
  flat.pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  EXPECT_EQ(carriedAlong(flat, flat).find(PieceId{1})->form, nullptr);
}

}  // namespace
}  // namespace karinui
