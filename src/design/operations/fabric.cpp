#include "design/operations/operations.h"

namespace karinui {

namespace {

// Whether the operation describes the fabric, or only cuts pieces from one that is known.
bool describes(const SetFabric& op) {
  SetFabric cuts;
  cuts.name = op.name, cuts.pieces = op.pieces;
  return !(op == cuts);
}

}  // namespace

Done resolve(const Document& before, SetFabric& op, Context&) {
  if (Done done = checkName(op.name); !done) return done;
  if (!op.pieces.empty()) {
    if (Done done = resolve(before, op.pieces); !done) return done;
  }
  if (!op.like.empty()) return checkFabricName(before, op.like);
  if (fabricNamed(before, op.name)) return {};
  if (describes(op)) return refused(say("“{0}” is a new fabric; say which one it starts from: like=cotton.", op.name));
  return checkFabricName(before, op.name);
}

Result<Document> perform(const Document& before, const SetFabric& op, Context&) {
  Document after = before;
  if (describes(op)) {
    auto base = fabricNamed(before, op.like.empty() ? op.name : op.like);
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
      if (piece->fabric == op.name || piece->interfacing == op.name) after.drape.dirty.insert(id);
  }
  for (const PieceRef& ref : op.pieces) {
    Piece piece = *after.find(ref.id);
    piece.fabric = op.name;
    after = withPiece(std::move(after), std::move(piece));
  }
  return after;
}

Done resolve(const Document& before, FuseInterfacing& op, Context& context) {
  if (Done done = resolve(before, op.pieces); !done) return done;
  if (Done done = resolveCopies(before, op.pieces, op.copies, context); !done) return done;
  if (op.none) {
    if (!op.fabric.empty()) return refused(say("An interfacing that is taken off has no fabric."));
    for (const PieceRef& ref : op.pieces)
      if (const Piece& piece = *before.find(ref.id); piece.interfacing.empty())
        return refused(say("No interfacing is fused to “{0}”.", piece.name));
    return {};
  }
  if (op.fabric.empty()) op.fabric = "interfacing";
  if (Done done = checkFabricName(before, op.fabric); !done) return done;
  const auto inner = fabricNamed(before, op.fabric);
  if (!inner) return inner.error();
  const auto check = [&](PieceId id) -> Done {
    const auto outer = fabricNamed(before, before.find(id)->fabric);
    if (!outer) return outer.error();
    if (outer->law == Fabric::Law::Simcloth || inner->law == Fabric::Law::Simcloth)
      return refused(say("Simcloth does not bend, so nothing is fused to it."));
    return checkFabric(fused(*outer, *inner));
  };
  for (const PieceRef& ref : op.pieces) {
    if (Done done = check(ref.id); !done) return done;
    for (const PieceId copy : copiesMeant(before, ref.id, op.copies))
      if (Done done = check(copy); !done) return done;
  }
  return {};
}

Result<Document> perform(const Document& before, const FuseInterfacing& op, Context&) {
  Document after = before;
  const auto fuse = [&](PieceId id) {
    Piece piece = *after.find(id);
    piece.interfacing = op.fabric;
    after = withPiece(std::move(after), std::move(piece));
  };
  for (const PieceRef& ref : op.pieces) {
    fuse(ref.id);
    for (const PieceId copy : copiesMeant(before, ref.id, op.copies)) fuse(copy);
  }
  return after;
}

}  // namespace karinui
