#include "design/operations/operations.h"
#include "karinui/design/print_image.h"

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
  return after;
}

}  // namespace karinui
