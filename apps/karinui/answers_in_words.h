#pragma once
// What a person reads of an answer: sentences and tables with units, in the person's language. Each ends with a line
// break.
#include "console.h"
#include "karinui/body/body.h"
#include "karinui/design/drape.h"
#include "karinui/design/print_match.h"
#include "karinui/pattern/truing.h"
#include "karinui/session/fit.h"

namespace karinui::app {

std::string bodyWords(const Measurements& measured, const MeshReport& mesh, const Console& console);
// Whether it is at rest: the first that one wants to know of what stands there.
Message restSaid(const Document& document);
// `document`: whose cloth was examined.
std::string checkWords(const Examination& check, const Document& document, const Console& console);
std::string pressureWords(const PressureReport& pressure, double spacing, const Console& console);
// `document`: as it was settled, with its report. `kept`: it was at rest before.
std::string settleWords(const Examination& check, const Document& document, bool kept, const Console& console);
std::string infoWords(const Document& document, const Console& console);
std::string pieceWords(const Document& document, const Piece& piece, const Console& console);  // with places on paper
// Whether prints match at the seams; empty where nothing is printed on both sides of one.
std::string printWords(const Document& document, const PhotoTall& tall, const Console& console);
std::string truingWords(const Document& document, const TruingReport& report, const Console& console);

}  // namespace karinui::app
