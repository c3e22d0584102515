#include "karinui/design/operation.h"

namespace karinui {

Operation::Operation() = default;
Operation::Operation(const Operation&) = default;
Operation::Operation(Operation&&) noexcept = default;
Operation& Operation::operator=(const Operation&) = default;
Operation& Operation::operator=(Operation&&) noexcept = default;
Operation::~Operation() = default;

bool disturbsDrape(const Operation& operation) {
  return std::visit(
      []<class Op>(const Op&) {
        return requires { Op::kDisturbsDrape; };
      },
      operation);
}

}  // namespace karinui
