#pragma once
// The JSON objects of the command line, one function a kind. Metres and seconds unless a key says otherwise.
#include "console.h"
#include "karinui/body/body.h"
#include "karinui/design/drape.h"
#include "karinui/design/history.h"
#include "karinui/design/print_match.h"
#include "karinui/pattern/truing.h"
#include "karinui/session/fit.h"

namespace karinui::app {

Json bodyJson(const Measurements& measured, const MeshReport& mesh);
Json checkJson(const Examination& check);
// The same after what the last drape came to, `settled` and `why`, which a document that was never draped has not, and
// `at_rest`: whether all of it is, and nothing changed since.
Json checkJson(const Examination& check, const Document& document, const Console& console);
// Of steps that were done: `settled`, whether every drape among them came to rest, which a document that was never
// draped has not, and `at_rest` as above.
Json restJson(const Document& document, bool settled);
Json settleJson(const SettleReport& report, const Examination& check, const Console& console);
Json continuationJson(const SettleReport& report);  // of a report that has one
Json stepJson(const Step& step, const Document& after);
Json fitJson(const std::vector<Girths>& girths, const std::optional<PressureReport>& pressure);
Json infoJson(const Document& document);
Json pieceJson(const Document& document, const Piece& piece);  // with places on paper
Json printsJson(const Document& document, const PhotoTall& tall);
Json truingJson(const Document& document, const TruingReport& report);

// "key: value" lines, nested objects indented: for answers that programs read more than people.
std::string words(const Json& object, int indent = 0);

}  // namespace karinui::app
