#include <cmath>

#include "design/content.h"
#include "design/operations/operations.h"
#include "design/pack.h"

namespace karinui {

namespace {

constexpr std::size_t kMostEdges = 2000;

Done checkMark(const Piece& piece, const Mark& mark) {
  if (!mark.name.empty()) {
    if (Done done = checkName(mark.name); !done) return done;
  }
  if (mark.edge.empty()) return {};
  if (!piece.outline.find(mark.edge))
    return refused(say("A notch lies on the edge “{0}”, which is not there.", mark.edge));
  if (!(mark.fraction >= 0 && mark.fraction <= 1)) {
    return refused(say("A notch lies between 0, the edge's beginning, and 1, its end."));
  }
  return {};
}

Done checkHoles(const Piece& piece) {
  const Ring outer = piece.outline.flattened(1e-4);
  std::vector<Ring> rings;
  for (const Outline& hole : piece.holes) {
    rings.push_back(hole.flattened(1e-4));
    for (const Flat p : rings.back()) {
      if (!contains(outer, p)) return refused(say("A hole of “{0}” is not inside its outline.", piece.name));
      for (std::size_t i = 0; i + 1 < rings.size(); ++i)
        if (contains(rings[i], p)) return refused(say("Two holes of “{0}” run into each other.", piece.name));
    }
  }
  return {};
}

// A stranger's file may have brought it.
Result<std::shared_ptr<const Form>> bentAs(const AddPiece& op, const Blobs& blobs) {
  const auto bytes = blobs.get(op.bent);
  if (!bytes)
    return refused(
        say("How “{0}” is bent ({1}) is not in this document. Import its pattern again, or leave bent away: "
            "then it stands flat.",
            op.name, op.bent));
  auto form = unpackForm(*bytes);
  if (!form) return form.error();
  if (!soundForm(**form))
    return refused(say("“{0}” would be bent to places out of the room, or without any surface.", op.name));
  return form;
}

}  // namespace

Done resolve(const Document& before, AddPiece& op, Context&) {
  if (Done done = checkNewName(before, op.name); !done) return done;
  if (op.outline.edges.size() > kMostEdges || op.holes.size() > kMostEdges) {
    return refused(say("“{0}” has more than {1} edges.", op.name, kMostEdges));
  }
  if (!op.fabric.empty()) {
    if (Done done = checkFabricName(before, op.fabric); !done) return done;
  }
  if (!finite(op.grain) || !(length(op.grain) > 1e-9)) return refused(say("The grain needs a direction, like to=0,1."));
  if (op.layer < 0 || op.layer > 20) return refused(say("A layer is a number from 0, next to the skin, to 20."));
  if (!(length(op.pose.carry) <= 1000)) return refused(say("“{0}” would be moved out of the room.", op.name));
  return {};
}

Result<Document> perform(const Document& before, const AddPiece& op, Context& context) {
  Piece piece;
  piece.id = mint<PieceId>(before, 0);
  piece.name = op.name;
  auto outline = checked(op.outline);
  if (!outline) return outline.error();
  piece.outline = *std::move(outline);
  for (const Outline& given : op.holes) {
    auto hole = checked(given);
    if (!hole) return hole.error();
    piece.holes.push_back(*std::move(hole));
  }
  if (Done done = checkHoles(piece); !done) return done.error();
  piece.lines = op.lines;
  for (const InternalLine& line : piece.lines)
    if (Done done = checkName(line.name); !done) return done.error();
  piece.marks = op.marks;
  for (const Mark& mark : piece.marks)
    if (Done done = checkMark(piece, mark); !done) return done.error();
  piece.grain = normalized(op.grain);
  if (!op.fabric.empty()) piece.fabric = op.fabric;
  piece.pose = op.pose;
  if (!op.bent.empty()) {
    auto form = bentAs(op, context.blobs);
    if (!form) return form.error();
    piece.form = *std::move(form);
  }
  piece.layer = op.layer;
  return withPiece(before, std::move(piece));
}

}  // namespace karinui
