#include <algorithm>

#include "design/operations/operations.h"

namespace karinui {

namespace {

Flat across(Flat p) { return {-p.u, p.v}; }
Vec3 across(Vec3 p) { return {-p.x, p.y, p.z}; }

// Mirroring turns an outline clockwise; running it backwards turns it counter-clockwise again.
Outline across(const Outline& outline) {
  Outline copy;
  for (auto edge = outline.edges.rbegin(); edge != outline.edges.rend(); ++edge) {
    copy.edges.push_back({otherSide(edge->name), edge->curve.mirrored({0, 0}, {0, 1}).reversed()});
  }
  // An edge "left" beside an edge "right" changes names with it; one whose other name is taken keeps its own.
  std::map<std::string, int> count;
  for (const Edge& edge : copy.edges) ++count[edge.name];
  if (std::any_of(count.begin(), count.end(), [](const auto& c) { return c.second > 1; })) {
    for (std::size_t i = 0; i < copy.edges.size(); ++i)
      copy.edges[i].name = outline.edges[copy.edges.size() - 1 - i].name;
  }
  return copy;
}

// M R M for the mirror M = diag(-1, 1, 1): the turn's part about x stays, those about y and z turn the other way.
Rigid across(const Rigid& pose) { return {pose.w, pose.x, -pose.y, -pose.z, across(pose.carry)}; }

}  // namespace

Piece mirroredPiece(const Piece& piece) {
  Piece copy = piece;
  copy.id = PieceId();
  copy.name.clear();
  copy.outline = across(piece.outline);
  for (Outline& hole : copy.holes) hole = across(hole);
  for (InternalLine& line : copy.lines) {
    line.name = otherSide(line.name);
    for (Curve& curve : line.curves) curve = curve.mirrored({0, 0}, {0, 1});
  }
  for (Mark& mark : copy.marks) {
    if (const auto at = piece.outline.find(mark.edge)) {
      mark.edge = copy.outline.edges[copy.outline.edges.size() - 1 - *at].name;
      mark.fraction = 1 - mark.fraction;
    }
    mark.place = across(mark.place);
  }
  copy.grain = across(piece.grain);
  copy.pose = across(piece.pose);
  if (piece.form) {
    auto form = std::make_shared<Form>(*piece.form);
    for (Flat& p : form->flat) p = across(p);
    for (Vec3& p : form->space) p = across(p);
    for (Triangle& face : form->faces) std::swap(face[1], face[2]);
    copy.form = std::move(form);
  }
  return copy;
}

Done resolve(const Document& before, MirrorPiece& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (op.name.empty()) {
    const std::string& own = before.find(op.piece.id)->name;
    const std::string other = otherSide(own);
    op.name = usableName(before, other == own ? own + "_mirrored" : other);
  }
  return checkNewName(before, op.name);
}

Result<Document> perform(const Document& before, const MirrorPiece& op, Context&) {
  Piece copy = mirroredPiece(*before.find(op.piece.id));
  copy.id = mint<PieceId>(before, 0);
  copy.name = op.name;
  copy.mirrorOf = op.piece.id;
  return withPiece(before, std::move(copy));
}

}  // namespace karinui
