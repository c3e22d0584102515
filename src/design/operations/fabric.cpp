#include "design/operations/operations.h"

namespace karinui {

namespace {

// Whether the operation describes the fabric, or only cuts pieces from one that is known.
bool describes(const SetFabric& op) {
  SetFabric cuts;
  cuts.name = op.name, cuts.pieces = op.pieces;
  return !(op == cuts);
}

Result<Fabric> known(const Document& document, const std::string& name) {
  const auto own = document.fabrics.find(name);
  return own != document.fabrics.end() ? Result<Fabric>(own->second) : preset(name);
}

}  // namespace

Done resolve(const Document& before, SetFabric& op, Context&) {
  if (Done done = checkName(op.name); !done) return done;
  if (!op.pieces.empty()) {
    if (Done done = resolve(before, op.pieces); !done) return done;
  }
  if (!op.like.empty()) return checkFabricName(before, op.like);
  if (known(before, op.name)) return {};
  if (describes(op)) return refused(say("“{0}” is a new fabric; say which one it starts from: like=cotton.", op.name));
  return checkFabricName(before, op.name);
}

Result<Document> perform(const Document& before, const SetFabric& op, Context&) {
  Document after = before;
  if (describes(op)) {
    auto base = known(before, op.like.empty() ? op.name : op.like);
    if (!base) return base.error();
    Fabric fabric = *std::move(base);
    fabric.name = op.name;
    if (op.law) fabric.law = *op.law;
    const auto take = [](double& into, const auto& given) {
      if (given) into = *given;
    };
    take(fabric.weight, op.weight), take(fabric.stretchWarp, op.stretchWarp), take(fabric.stretchWeft, op.stretchWeft);
    take(fabric.toeWarp, op.toe), take(fabric.toeWeft, op.toe);
    take(fabric.toeWarp, op.toeWarp), take(fabric.toeWeft, op.toeWeft);
    take(fabric.stiffenWarp, op.stiffenWarp), take(fabric.stiffenWeft, op.stiffenWeft);
    take(fabric.shear, op.shear), take(fabric.shearStiffen, op.shearStiffen);
    take(fabric.bendWarp, op.bendWarp), take(fabric.bendWeft, op.bendWeft);
    take(fabric.compression, op.compression), take(fabric.thickness, op.thickness);
    take(fabric.frictionBody, op.frictionBody), take(fabric.frictionCloth, op.frictionCloth);
    if (Done done = checkFabric(fabric); !done) return done.error();
    after.fabrics[op.name] = std::move(fabric);
    for (const auto& [id, piece] : before.pattern.pieces)
      if (piece->fabric == op.name) after.drape.dirty.insert(id);
  }
  for (const PieceRef& ref : op.pieces) {
    Piece piece = *after.find(ref.id);
    piece.fabric = op.name;
    after = withPiece(std::move(after), std::move(piece));
  }
  return after;
}

}  // namespace karinui
