#pragma once
// How fabrics and pieces look: surface, colour, print. Part of the document like the fabric itself, but cloth of
// another colour hangs the same: nothing here disturbs a drape. Plain values; any thread.
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "karinui/base/id.h"
#include "karinui/base/result.h"
#include "karinui/design/values.h"

namespace karinui {

enum class Finish { Poplin, Linen, Denim, Suiting, Tweed, Jersey, Satin, Chiffon, Velvet, Leather };
enum class PrintKind { None, Stripe, Check, Dot, Photo };

// The other side of a cloth that is not as its right side: a coating in two colours, a lining fabric's back.
struct WrongSide {
  Dye colour;
  PrintKind print = PrintKind::None;  // with the repeat, angle and photograph of the right side's
  Dye ink{245, 244, 240};
  bool operator==(const WrongSide&) const = default;
};

struct Look {
  Finish finish = Finish::Poplin;
  Dye colour{137, 165, 205};
  PrintKind print = PrintKind::None;
  Dye ink{245, 244, 240};
  double repeat = 0.02;  // metres; of a photograph its width
  double turn = 0;       // radians from the grain, counter-clockwise
  std::string photo;     // name of a blob: packPrint()
  std::optional<WrongSide> wrong;
  bool operator==(const Look&) const = default;
};

struct Looks {
  std::map<std::string, Look> fabrics;  // by name, where they do not look as usual
  std::map<PieceId, Look> pieces;       // that look otherwise than their fabric
  std::map<PieceId, Flat> shifts;       // where on a piece its print begins: across and along the grain
  bool empty() const { return fabrics.empty() && pieces.empty(); }  // shifts aside
  bool operator==(const Looks&) const = default;
};

struct Document;
struct Piece;
Dye usualDye(Finish finish);
Look usualLook(std::string_view fabric);  // of a preset, or of its copy "denim_2"; of any other name poplin
// Of the document's own fabric, else of what it is like, else the preset's.
Look lookOf(const Document& document, std::string_view fabric);
Look lookOf(const Document& document, const Piece& piece);
Done checkLook(const Look& look);  // sizes that no print has

}  // namespace karinui
