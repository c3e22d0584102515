#pragma once
// Facings and linings of a garment that was never draped. Sewn up together with what they lie in, two layers hinder
// each other: a lined shirt takes three times as long. So the rest is draped first, and they are laid into it.
#include <optional>
#include <set>

#include "design/operations/operations.h"

namespace karinui {

// `draped`, in which all but `inside` was draped since `before`, with those where they lie in it: each of their places
// goes along with the nearest place of what they are sewn to. Nothing where one stands too far from that.
std::optional<Document> laidInto(Document draped, const Document& before, const std::set<PieceId>& inside);

}  // namespace karinui
