#pragma once
// What can be done to a garment, as one value: any of the operations in operations/, with the formulas of its fields.
// A plain value; any thread.
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "karinui/design/operations/drafting.h"
#include "karinui/design/operations/draping.h"
#include "karinui/design/operations/fabric.h"
#include "karinui/design/operations/fastening.h"
#include "karinui/design/operations/figure.h"
#include "karinui/design/operations/finishing.h"
#include "karinui/design/operations/marks.h"
#include "karinui/design/operations/outline.h"
#include "karinui/design/operations/paper.h"
#include "karinui/design/operations/placing.h"
#include "karinui/design/operations/pockets.h"
#include "karinui/design/operations/sewing.h"
#include "karinui/design/operations/sizes.h"
#include "karinui/design/operations/tracing.h"
#include "karinui/design/operations/trimming.h"

namespace karinui {

struct FieldText {
  std::string name, value;
  bool operator==(const FieldText&) const = default;
};

template <class... Ops>
std::variant<Ops...> variantOf(OperationList<Ops...>);

// The order of --help and of docs/format/operations.md; the first is what an empty Operation holds.
using PlainOperation = decltype(variantOf(
    FigureOperations() + DraftingOperations() + PaperOperations() + OutlineOperations() + MarksOperations() +
    SewingOperations() + PlacingOperations() + DrapingOperations() + FabricOperations() + FinishingOperations() +
    TrimmingOperations() + SizesOperations() + FasteningOperations() + PocketOperations() + TracingOperations()));

// Any operation. The fields named in `formulas` are given by formulas: what the struct holds there is their value as
// it was last worked out (nothing after reading a text), and resolved() works them out anew for the document at hand.
// So the same operation gives a longer edge on a larger figure. Two operations with formulas are alike when their texts
// are.
// Copying, moving and destroying visit every alternative: they are compiled once, in operation.cpp, and not in each
// source.
struct Operation : PlainOperation {
  using PlainOperation::variant;
  Operation();
  Operation(const Operation&);
  Operation(Operation&&) noexcept;
  Operation& operator=(const Operation&);
  Operation& operator=(Operation&&) noexcept;
  ~Operation();
  std::vector<FieldText> formulas;  // in the fields' order, in canonical form
};
bool operator==(const Operation& a, const Operation& b);

std::string_view nameOf(const Operation& operation);

// Whether cloth that was at rest should be brought to rest again after it: said by the operation's struct.
bool disturbsDrape(const Operation& operation);

}  // namespace karinui
