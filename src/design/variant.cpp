#include "karinui/design/variant.h"

#include <set>

namespace karinui {

std::vector<std::string> fabricNames(const Document& document) {
  std::vector<std::string> names;
  for (const auto& [name, fabric] : document.fabrics) names.push_back(name);
  std::set<std::string> used;
  for (const auto& [id, piece] : document.pattern.pieces) used.insert(piece->fabric);
  // The cloth of the first tests is for old documents only.
  for (const Fabric& fabric : presets())
    if (!document.fabrics.contains(fabric.name) && (fabric.law != Fabric::Law::Simcloth || used.contains(fabric.name)))
      names.push_back(fabric.name);
  return names;
}

SetFabric cutFrom(const Document& document, const std::string& fabric) {
  SetFabric cut;
  cut.name = fabric;
  for (const auto& [id, piece] : document.pattern.pieces) cut.pieces.emplace_back(id);
  return cut;
}

Result<Document> variantOf(const Document& document, const Operation& change, Context& context) {
  const auto* size = std::get_if<ChooseSize>(&change);
  const Grading& grading = document.grading;
  const bool stands = size && !grading.empty() && grading.sizes[grading.standing] == size->name;
  Result<Document> after = stands ? Result<Document>(document) : apply(document, change, context);
  if (!after || !document.drape.last || after->drape.dirty.empty()) return after;
  return apply(*after, DrapePieces{}, context);
}

std::optional<Message> unrestSaid(const Document& document) {
  if (document.pattern.pieces.empty()) return std::nullopt;
  if (!document.drape.last) return say("not draped yet");
  if (!document.unrested().empty()) return say("changed since it was draped");
  if (!document.drape.last->settled) return say("did not come to rest");
  return std::nullopt;
}

}  // namespace karinui
