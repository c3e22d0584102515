#include "karinui/design/apply.h"

#include "design/operations/operations.h"

namespace karinui {

namespace {
constexpr std::uint32_t kMostOperations = 1'000'000;  // a garment of a lifetime; keeps ids small
}

Result<BodyPtr> bodyOf(const Document& document, Context& context) {
  if (!document.body.chosen())
    return refused(say("There is no body yet; choose one first, for example: body size=jis9ar."));
  return context.bodies.find(document.body, context.blobs, context.workers, context.token);
}

Result<Operation> resolved(const Document& before, Operation operation, Context& context) {
  const Done done = std::visit([&](auto& op) { return resolve(before, op, context); }, operation);
  if (!done) return done.error();
  return operation;
}

Result<Document> apply(const Document& before, const Operation& operation, Context& context) {
  if (before.operations >= kMostOperations) return refused(say("This document has too many operations."));
  auto op = resolved(before, operation, context);
  if (!op) return op.error();
  auto after = std::visit([&](const auto& o) { return perform(before, o, context); }, *op);
  if (!after) return after.error();
  if (context.token.cancelled()) return cancelled();
  after->operations = before.operations + 1;
  return after;
}

}  // namespace karinui
