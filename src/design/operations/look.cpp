#include <cmath>

#include "design/operations/operations.h"
#include "karinui/design/glossary.h"
#include "karinui/design/print_image.h"
#include "karinui/design/print_match.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

Look with(Look look, const SetLook& op) {
  if (op.finish) look.finish = *op.finish, look.colour = usualDye(*op.finish);  // a surface comes in its usual colour
  if (op.colour) look.colour = *op.colour;
  if (op.print) look.print = *op.print;
  if (op.ink) look.ink = *op.ink;
  if (op.repeat) look.repeat = *op.repeat;
  if (op.turn) look.turn = *op.turn;
  if (!op.photo.empty()) look.photo = op.photo;
  if (op.wrong || op.wrongPrint || op.wrongInk) {
    WrongSide wrong = look.wrong.value_or(WrongSide{look.colour, PrintKind::None, look.ink});
    if (op.wrong) wrong.colour = *op.wrong;
    if (op.wrongPrint) wrong.print = *op.wrongPrint;
    if (op.wrongInk) wrong.ink = *op.wrongInk;
    look.wrong = wrong;
  }
  return look;
}

// The looks the operation leaves, each where it belongs.
template <class Visit>
Done each(const Document& before, const SetLook& op, Visit&& visit) {
  const auto one = [&](Look look, auto&& place) -> Done {
    look = with(look, op);
    if (Done done = checkLook(look); !done) return done;
    visit(place, std::move(look));
    return {};
  };
  if (!op.fabric.empty())
    if (Done done = one(op.plain ? usualLook(op.fabric) : lookOf(before, op.fabric), op.fabric); !done) return done;
  for (const PieceRef& ref : op.pieces) {
    const Piece& piece = *before.find(ref.id);
    if (Done done = one(op.plain ? lookOf(before, piece.fabric) : lookOf(before, piece), ref.id); !done) return done;
  }
  return {};
}

}  // namespace

Done resolve(const Document& before, SetLook& op, Context& context) {
  if (op.fabric.empty() && op.pieces.empty())
    return refused(say("Say what is to look so: fabric=denim, or piece=front."));
  if (!op.fabric.empty())
    if (Done done = checkFabricName(before, op.fabric); !done) return done;
  if (!op.pieces.empty())
    if (Done done = resolve(before, op.pieces); !done) return done;
  if (!op.photo.empty()) {
    const auto bytes = context.blobs.get(op.photo);
    if (!bytes) return refused(say("The photograph {0} is not in this document; open it again.", op.photo));
    if (const auto image = unpackPrint(*bytes); !image) return image.error();
    if (!op.print) op.print = PrintKind::Photo;
  }
  if (op.shift && (op.pieces.empty() || !op.fabric.empty()))
    return refused(say("A print is placed on a piece: piece=front shift=0,12mm."));
  constexpr double kFarthest = 2;  // metres, as the largest repeat
  if (op.shift && !(std::fabs(op.shift->u) <= kFarthest && std::fabs(op.shift->v) <= kFarthest))
    return refused(say("A print is shifted by {0} m at most.", kFarthest));
  return each(before, op, [](const auto&, Look) {});
}

Result<Document> perform(const Document& before, const SetLook& op, Context&) {
  Document after = before;
  const auto put = [&](const auto& place, Look look) {
    if constexpr (std::is_same_v<std::decay_t<decltype(place)>, PieceId>) {
      if (look == lookOf(before, before.find(place)->fabric))
        after.looks.pieces.erase(place);
      else
        after.looks.pieces[place] = std::move(look);
    } else {
      if (look == usualLook(place))
        after.looks.fabrics.erase(place);
      else
        after.looks.fabrics[place] = std::move(look);
    }
  };
  if (Done done = each(before, op, put); !done) return done.error();
  if (op.plain)
    for (const PieceRef& ref : op.pieces) after.looks.shifts.erase(ref.id);
  if (op.shift)
    for (const PieceRef& ref : op.pieces) after.looks.shifts[ref.id] = *op.shift;
  return after;
}

namespace {

constexpr double kMatchedAlready = 1e-4;  // metres

Result<Flat> matched(const Document& before, const MatchPrint& op, const Context& context) {
  return matchingShift(before, *before.find(op.seam.id), op.at, op.piece.id, photosIn(context.blobs));
}

}  // namespace

Done resolve(const Document& before, MatchPrint& op, Context& context) {
  if (Done done = resolve(before, op.seam); !done) return done;
  if (!(op.at >= 0 && op.at <= 1)) return refused(say("A place along a seam lies between 0 and 1."));
  if (op.piece) {
    if (Done done = resolve(before, op.piece); !done) return done;
  } else {
    op.piece = PieceRef(SeamSides(before.pattern, *before.find(op.seam.id)).b.at(op.at).piece);
  }
  const auto shift = matched(before, op, context);
  return shift ? Done() : Done(shift.error());
}

Result<Document> perform(const Document& before, const MatchPrint& op, Context& context) {
  const auto shift = matched(before, op, context);
  if (!shift) return shift.error();
  Document after = before;
  after.looks.shifts[op.piece.id] = *shift;
  if (context.advise) {
    const SeamSides sides(before.pattern, *before.find(op.seam.id));
    const PieceId own = op.piece.id, a = sides.a.at(op.at).piece, b = sides.b.at(op.at).piece;
    const Message moved = nameSaid(before.find(own)->name), other = nameSaid(before.find(own == b ? a : b)->name);
    const auto was = before.looks.shifts.find(own);
    const bool there = was == before.looks.shifts.end() ? length(*shift) < kMatchedAlready
                                                        : distance(was->second, *shift) < kMatchedAlready;
    context.advise({there ? say("The print of {0} meets that of {1} there already.", moved, other)
                          : say("The print of {0} meets that of {1} there now: {0} is cut from another place of the "
                                "cloth.",
                                moved, other),
                    own});
  }
  return after;
}

}  // namespace karinui
