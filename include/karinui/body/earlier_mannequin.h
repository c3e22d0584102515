#pragma once
// Mannequins as they were drawn before they had modelled heads, hands and feet and an even skin, bit for bit. A
// document keeps its figure; only where the kept one was lost is it made anew, and then its drapes still fit.
#include "karinui/body/body.h"

namespace karinui {

// As makeMannequin.
Result<BodyPtr> makeEarlierMannequin(const Measurements& wanted, Workers& workers, const Token& token);

}  // namespace karinui
