// Parts of the house that are still being built. Each line here goes when its part comes.
#include "design/operations/operations.h"

namespace karinui {

namespace {
Error missing(std::string_view what) { return refused(say("“{0}” is not built yet.", what)); }
}  // namespace

Done resolve(const Document&, DrawPiece&, Context&) { return missing("draw"); }
Result<Document> perform(const Document&, const DrawPiece&, Context&) { return missing("draw"); }
Done resolve(const Document&, ReshapePiece&, Context&) { return missing("reshape"); }
Result<Document> perform(const Document&, const ReshapePiece&, Context&) { return missing("reshape"); }
Done resolve(const Document&, CutPiece&, Context&) { return missing("cut"); }
Result<Document> perform(const Document&, const CutPiece&, Context&) { return missing("cut"); }

}  // namespace karinui
