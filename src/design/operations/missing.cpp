// Parts of the house that are still being built. Each line here goes when its part comes.
#include "design/operations/operations.h"

namespace karinui {

namespace {
Error missing(std::string_view what) { return refused(say("“{0}” is not built yet.", what)); }
}  // namespace

Done resolve(const Document&, CutPiece&, Context&) { return missing("cut"); }
Result<Document> perform(const Document&, const CutPiece&, Context&) { return missing("cut"); }

}  // namespace karinui
