#pragma once
// The numbers of a fabric as people read and type them, and the step that sets them. Pure; any thread.
#include <set>
#include <span>
#include <string>
#include <vector>

#include "karinui/cloth/measured_fabric.h"
#include "karinui/design/document.h"
#include "karinui/design/operation.h"

namespace karinui {

struct FabricNumber {
  Message label;
  const char* unit;     // with a space before it, or empty
  double factor, high;  // read = value * factor; the most that may be typed
  int decimals;
  double Fabric::*value;
  std::optional<double> SetFabric::*step;  // null: the thickness, which is a length
};
std::span<const FabricNumber> fabricNumbers();

// What the first chosen piece is cut from, else the most of a garment; empty: there is no piece.
std::string clothOf(const Document& document, const std::set<PieceId>& chosen);
// A new piece that is drawn is cut from that too, where it does not say what from.
void cutFromItsCloth(Operation& operation, const Document& document, const std::set<PieceId>& chosen);

// The step that says what differs from the fabric it was; its name and `like` are for the caller.
SetFabric described(const Fabric& now, const Fabric& was);

// The step that adds a fabric measured on a table, its numbers to three digits.
SetFabric fabricStep(const MeasuredFabric& measured, std::string name);

// What was measured, or follows from it, beside the preset it is like.
struct MeasuredRow {
  const FabricNumber* number = nullptr;  // null: bending on the bias
  Message label;
  double value = 0;
  std::optional<double> error;  // standard; none: in proportion to another
  double like = 0;              // bending on the bias: as warp and weft of the fabric itself let it
  std::string valueText() const, errorText() const, likeText() const;  // as people read them, with the unit
};
std::vector<MeasuredRow> rowsOf(const MeasuredFabric& measured);

// The standard uncertainty of a tool that is good to this much either way.
double uncertaintyOf(double halfWidth);

}  // namespace karinui
