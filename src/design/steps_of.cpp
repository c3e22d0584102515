#include "karinui/design/steps_of.h"

#include <map>
#include <set>

#include "design/pack.h"
#include "karinui/design/glossary.h"

namespace karinui {

SetFabric stepOf(const Fabric& fabric) {
  SetFabric step;
  step.name = fabric.name;
  step.law = fabric.law;
  step.weight = fabric.weight, step.thickness = Length{fabric.thickness};
  step.stretchWarp = fabric.stretchWarp, step.stretchWeft = fabric.stretchWeft;
  step.toeWarp = fabric.toeWarp, step.toeWeft = fabric.toeWeft;
  step.stiffenWarp = fabric.stiffenWarp, step.stiffenWeft = fabric.stiffenWeft;
  step.compression = fabric.compression;
  step.shear = fabric.shear, step.shearStiffen = fabric.shearStiffen;
  step.bendWarp = fabric.bendWarp, step.bendWeft = fabric.bendWeft;
  step.frictionBody = fabric.frictionBody, step.frictionCloth = fabric.frictionCloth;
  return step;
}

std::vector<std::string> unknownFabrics(const Pattern& pattern, const Document& into) {
  std::set<std::string> names;
  for (const auto& [id, piece] : pattern.pieces)
    if (!fabricNamed(into, piece->fabric) && checkName(piece->fabric)) names.insert(piece->fabric);
  return {names.begin(), names.end()};
}

namespace {

// The fabrics of the pieces whose values are told and differ from what is known under their names.
std::vector<Fabric> toldFabrics(const Pattern& pattern, const Document& into,
                                const std::map<std::string, Fabric>& told) {
  std::set<std::string> names;
  for (const auto& [id, piece] : pattern.pieces) names.insert(piece->fabric);
  std::vector<Fabric> all;
  for (const std::string& name : names) {
    const auto at = told.find(name);
    if (at == told.end() || !checkName(name)) continue;
    const auto known = fabricNamed(into, name);
    if (!known || !(*known == at->second)) all.push_back(at->second);
  }
  return all;
}

SetFabric describing(const Fabric& fabric, const Document& into) {
  SetFabric step = stepOf(fabric);
  if (!fabricNamed(into, fabric.name)) step.like = Piece().fabric;
  return step;
}

}  // namespace

std::vector<Message> unknownFabricsSaid(const Pattern& pattern, const Document& into,
                                        const std::map<std::string, Fabric>& told) {
  std::vector<Message> said;
  for (const Fabric& fabric : toldFabrics(pattern, into, told))
    if (into.fabrics.contains(fabric.name))
      said.push_back(
          say("The garment has a fabric “{0}” of its own; what is read is cut from that.", nameSaid(fabric.name)));
  for (const std::string& name : unknownFabrics(pattern, into))
    if (!told.contains(name))
      said.push_back(
          say("The pattern tells of the fabric “{0}” only its name; it is like {1} until its values are given.",
              nameSaid(name), nameSaid(Piece().fabric)));
  return said;
}

std::vector<Operation> stepsOf(const Pattern& pattern, const Document& into, const Grading& grading,
                               const CuttingNotes& told, Blobs* bent, const std::map<std::string, Fabric>& fabrics) {
  std::vector<Operation> steps;
  std::map<PieceId, std::string> names;
  for (const Fabric& fabric : toldFabrics(pattern, into, fabrics))
    if (!into.fabrics.contains(fabric.name)) steps.push_back(describing(fabric, into));
  for (const std::string& name : unknownFabrics(pattern, into)) {
    if (fabrics.contains(name)) continue;
    SetFabric fabric;
    fabric.name = name, fabric.like = Piece().fabric;
    steps.push_back(std::move(fabric));
  }
  Document named = into;  // knows the names given so far; its pieces are never looked at
  for (const auto& [id, piece] : pattern.pieces) {
    AddPiece add;
    add.name = names[id] = usableName(named, piece->name);
    add.outline = piece->outline;
    add.holes = piece->holes;
    add.lines = piece->lines;
    add.marks = piece->marks;
    add.grain = piece->grain;
    if (fabricNamed(into, piece->fabric) || checkName(piece->fabric)) add.fabric = piece->fabric;
    add.pose = piece->pose;
    if (bent && piece->form && !piece->form->faces.empty()) {
      std::string bytes = packForm(*piece->form);
      add.bent = blobName(bytes);
      (void)bent->put(std::move(bytes));  // where it cannot be kept, the step says that it is not there
    }
    add.layer = piece->layer;
    auto held = std::make_shared<Piece>();
    held->name = add.name;
    const auto& taken = named.pattern.pieces;
    named.pattern.pieces[PieceId{taken.empty() ? 1 : taken.rbegin()->first.value + 1}] = std::move(held);
    steps.push_back(std::move(add));
  }
  if (!grading.empty() && into.grading.empty()) {
    GradePieces sizes;
    sizes.sizes = grading.sizes, sizes.base = grading.sizes[grading.base];
    steps.push_back(std::move(sizes));
    for (const auto& [id, points] : grading.pieces) {
      GradePieces grade;
      grade.piece = PieceRef(names.at(id)), grade.points = points;
      steps.push_back(std::move(grade));
    }
  }
  FreezePieces stay;
  for (const auto& [id, piece] : pattern.pieces)
    if (piece->frozen) stay.pieces.push_back(PieceRef(names.at(id)));
  if (!stay.pieces.empty()) steps.push_back(std::move(stay));
  const auto refs = [&](const std::vector<EdgeSpan>& side) {
    std::vector<EdgeRef> all;
    for (const EdgeSpan& span : side) all.push_back({PieceRef(names.at(span.piece)), span.edge, span.from, span.to});
    return all;
  };
  for (const auto& [id, seam] : pattern.seams) {
    SewEdges sew;
    sew.a = refs(seam.a);
    sew.b = refs(seam.b);
    sew.name = seam.name;
    sew.reversed = seam.reversed ? Choice::Yes : Choice::No;
    sew.tie = seam.tie == Seam::Tie::TwoToOne ? SewEdges::Tie::TwoToOne
              : seam.tie == Seam::Tie::Pleat  ? SewEdges::Tie::Pleat
                                              : SewEdges::Tie::OneToOne;
    steps.push_back(std::move(sew));
  }
  // One step for all pieces that are cut alike, and for all edges of one width.
  std::map<std::pair<int, bool>, SetQuantity> often;
  for (const auto& [id, cutting] : told.quantities) {
    if (cutting == Cutting()) continue;
    SetQuantity& quantity = often[{cutting.count, cutting.pairs}];
    quantity.pieces.push_back(PieceRef(names.at(id)));
    quantity.count = cutting.count, quantity.pairs = cutting.pairs;
  }
  for (auto& [key, quantity] : often) steps.push_back(std::move(quantity));
  std::map<double, SetAllowance> widths;
  for (const auto& [at, width] : told.allowances.edges) {
    SetAllowance& allowance = widths[width];
    allowance.edges.push_back({PieceRef(names.at(at.first)), at.second});
    allowance.width = Length{width}, allowance.symmetric = Choice::No;
  }
  for (auto& [width, allowance] : widths) steps.push_back(std::move(allowance));
  return steps;
}

}  // namespace karinui
