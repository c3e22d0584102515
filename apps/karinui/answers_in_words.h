#pragma once
// What a person reads of an answer: sentences and tables with units, in the person's language. Each ends with a line
// break.
#include "console.h"
#include "karinui/body/body.h"
#include "karinui/cloth/check.h"
#include "karinui/design/document.h"
#include "karinui/pattern/truing.h"

namespace karinui::app {

std::string bodyWords(const Measurements& measured, const MeshReport& mesh, const Console& console);
std::string checkWords(const ClothCheck& check, const Console& console);
// `kept`: it was at rest before.
std::string settleWords(const SettleReport& report, const ClothCheck& check, bool kept, const Console& console);
std::string infoWords(const Document& document, const Console& console);
std::string truingWords(const Document& document, const TruingReport& report, const Console& console);

}  // namespace karinui::app
