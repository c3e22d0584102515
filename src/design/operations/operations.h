#pragma once
// What each operation does, one file an operation. Two functions each, found by overloading:
//   resolve()  turns names into ids and decides what was left open, so that the record means the same for ever;
//   perform()  gives the document after, from a resolved operation. Pure; refuses in a sentence; never half done.
// apply() counts the operation and checks what is common to all; perform() must leave Document::operations alone. Ids
// are minted with mint<PieceId>(before, nth).
#include "karinui/design/apply.h"
#include "karinui/design/drape.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

#define KARINUI_DECLARE_OPERATION(Op)                                    \
  Done resolve(const Document& before, Op& operation, Context& context); \
  Result<Document> perform(const Document& before, const Op& operation, Context& context);
KARINUI_DECLARE_OPERATION(SetBody)
KARINUI_DECLARE_OPERATION(PoseBody)
KARINUI_DECLARE_OPERATION(DrawPiece)  // draw.cpp
KARINUI_DECLARE_OPERATION(MovePiece)
KARINUI_DECLARE_OPERATION(SewEdges)
KARINUI_DECLARE_OPERATION(Unsew)
KARINUI_DECLARE_OPERATION(CutPiece)
KARINUI_DECLARE_OPERATION(PullCloth)     // rest.cpp; the work is pullOnBody() in pull.cpp
KARINUI_DECLARE_OPERATION(ReshapePiece)  // reshape.cpp
KARINUI_DECLARE_OPERATION(DrapePieces)   // rest.cpp; the work is drapeOnBody() in drape.cpp
KARINUI_DECLARE_OPERATION(SetFabric)
KARINUI_DECLARE_OPERATION(FuseInterfacing)
KARINUI_DECLARE_OPERATION(LinePieces)
KARINUI_DECLARE_OPERATION(FaceEdges)
KARINUI_DECLARE_OPERATION(PinCloth)
KARINUI_DECLARE_OPERATION(UnpinCloth)
KARINUI_DECLARE_OPERATION(RemovePieces)
KARINUI_DECLARE_OPERATION(DuplicatePiece)
KARINUI_DECLARE_OPERATION(MirrorPiece)
KARINUI_DECLARE_OPERATION(Rename)
KARINUI_DECLARE_OPERATION(PlacePiece)
KARINUI_DECLARE_OPERATION(FreezePieces)
KARINUI_DECLARE_OPERATION(SetLayer)
KARINUI_DECLARE_OPERATION(ChangeSettings)
KARINUI_DECLARE_OPERATION(AddPiece)
KARINUI_DECLARE_OPERATION(SetGrain)
KARINUI_DECLARE_OPERATION(AddNotch)
KARINUI_DECLARE_OPERATION(SplitEdge)
KARINUI_DECLARE_OPERATION(JoinEdges)
KARINUI_DECLARE_OPERATION(AddDart)
KARINUI_DECLARE_OPERATION(AddDoubleDart)
KARINUI_DECLARE_OPERATION(PivotDart)
KARINUI_DECLARE_OPERATION(ShiftDart)
KARINUI_DECLARE_OPERATION(MergePieces)
KARINUI_DECLARE_OPERATION(SlashAndSpread)
KARINUI_DECLARE_OPERATION(AddPleat)
KARINUI_DECLARE_OPERATION(AddLine)
KARINUI_DECLARE_OPERATION(EraseMarks)
KARINUI_DECLARE_OPERATION(FlipSeam)
KARINUI_DECLARE_OPERATION(SewPatch)
KARINUI_DECLARE_OPERATION(SetLength)
KARINUI_DECLARE_OPERATION(Lengthen)
KARINUI_DECLARE_OPERATION(TakeIn)
KARINUI_DECLARE_OPERATION(TrueUp)
KARINUI_DECLARE_OPERATION(FairEdges)
KARINUI_DECLARE_OPERATION(SetLook)
KARINUI_DECLARE_OPERATION(MatchPrint)
KARINUI_DECLARE_OPERATION(DrawRectangle)  // paper.cpp
KARINUI_DECLARE_OPERATION(DrawPolygon)
KARINUI_DECLARE_OPERATION(DrawRing)
KARINUI_DECLARE_OPERATION(DrawBand)     // band.cpp
KARINUI_DECLARE_OPERATION(DrawStrap)    // strap.cpp
KARINUI_DECLARE_OPERATION(AttachPiece)  // attach.cpp
KARINUI_DECLARE_OPERATION(UnfoldPiece)
KARINUI_DECLARE_OPERATION(DraftBlock)  // block.cpp; the drafts are in design/blocks
KARINUI_DECLARE_OPERATION(SetVariable)
KARINUI_DECLARE_OPERATION(SetAllowance)
KARINUI_DECLARE_OPERATION(DeclareEase)  // finishing.cpp
KARINUI_DECLARE_OPERATION(SetQuantity)
KARINUI_DECLARE_OPERATION(GradePieces)  // sizes.cpp
KARINUI_DECLARE_OPERATION(ChooseSize)
KARINUI_DECLARE_OPERATION(SewElastic)  // edge_finish.cpp
KARINUI_DECLARE_OPERATION(TurnHem)
KARINUI_DECLARE_OPERATION(FoldLine)
KARINUI_DECLARE_OPERATION(Fasten)
KARINUI_DECLARE_OPERATION(SewFly)
KARINUI_DECLARE_OPERATION(SewPocket)
KARINUI_DECLARE_OPERATION(SewWelt)
KARINUI_DECLARE_OPERATION(SewTopstitch)  // trim.cpp
KARINUI_DECLARE_OPERATION(SewPiping)
KARINUI_DECLARE_OPERATION(BindEdges)
KARINUI_DECLARE_OPERATION(LayUnderlay)
#undef KARINUI_DECLARE_OPERATION

// The id of the nth thing (from 0) that the operation now being performed makes.
template <class AnyId>
AnyId mint(const Document& before, std::uint32_t nth) {
  return madeBy<AnyId>(before.operations + 1, nth);
}

// Turns a name into an id, and checks that an id is there. Refuses unknown names, listing what there is.
Done resolve(const Document& before, PieceRef& piece);
Done resolve(const Document& before, SeamRef& seam);
Done resolve(const Document& before, EdgeRef& edge);  // also that the piece has the edge and the part is a part
Done resolve(const Document& before, std::vector<PieceRef>& pieces);  // duplicates fall away; refuses an empty list

// The document with a piece added or exchanged; the piece and its seam neighbours become dirty.
Document withPiece(Document document, Piece piece);
// The document with an edited piece: its seams follow, and its symmetric copies (or the piece it is the copy of) are
// edited likewise as long as they are its likeness. `others`, if given, hears of those.
Document withEdit(Document document, const EditedPiece& edit, std::vector<PieceId>* others = nullptr);
// The same of this piece alone, for edits that are made of the others by themselves.
Document withOwnEdit(Document document, const EditedPiece& edit);
// The symmetric copies of a piece (and the piece it is the copy of) that are still its likeness.
std::vector<PieceId> likenesses(const Document& document, PieceId id);
// Whether what is done to these pieces is done to their symmetric copies too. Auto is decided; where there is none that
// is a likeness, and in a step of old that left it open, nothing is to be decided. Refuses Yes where there is none.
Done resolveCopies(const Document& before, const std::vector<PieceRef>& pieces, Choice& copies, const Context& context);
// The copies that an operation so decided is about.
std::vector<PieceId> copiesMeant(const Document& document, PieceId piece, Choice copies);
// What the symmetric copy of a piece is called.
std::string nameOfCopy(const Document& document, const std::string& name);
// The two are each other's symmetric copies from now on, the first being the one that is copied; not where they are not
// each other's likeness.
Document withLikeness(Document document, PieceId piece, PieceId copy);
// The piece cut anew, with its symmetric copies; as part of another step, which tells by itself what came of it.
Result<Document> cutAnew(const Document& before, const ReshapePiece& reshape);
// Tells the sewn edges that became longer or shorter than what they are sewn to.
void tellSeams(const Document& before, const Document& after, const Context& context);
// Tells the sewn edges, not gathered, that no longer fit what they are sewn to: off by a tenth or 5 mm more than
// before.
void tellMisfits(const Document& before, const Document& after, const Context& context);
// Tells that a piece, cut or merged, is no longer its symmetric copy's likeness.
void tellUnlike(const Document& before, const Piece& piece, const Context& context);
// Tells the edges of a piece that became longer or shorter.
void tellLengths(const Piece& before, const Piece& after, const Context& context);
// The internal line of that name, which is there.
const InternalLine& lineNamed(const Piece& piece, const std::string& name);
// Room for a layer beneath each layer that has one of the pieces. Refuses more layers than there are.
Result<Document> withLayersBeneath(Document document, const std::vector<PieceId>& pieces);
// The form a piece holds when it is cut along another outline: what is at the old one comes to the new one, in place.
std::shared_ptr<const Form> followedForm(const Piece& piece, const Outline& outline);
// Auto is decided: whether a piece is symmetric by itself and, by `both`, whether the other half has what is changed;
// where it has not, because of a slit or dart, that is told. Refuses Yes where only one half can be changed.
Done resolveSymmetric(const Piece& piece, Choice& symmetric, Context& context,
                      const std::function<bool(const PaperSymmetry&)>& both);
// Edges that are meant whole, and whether the other half of each one's piece is changed with it. Auto stays: of the
// pieces one may be symmetric and another not. Refuses none.
Done resolveWhole(const Document& before, std::vector<EdgeRef>& edges, Choice symmetric, Context& context);
// A fabric a piece may be cut from exists: one of the document or a preset.
Done checkFabricName(const Document& document, const std::string& name);
// What an edge may be called.
Done checkEdgeName(const std::string& name);
// The name a new piece gets: as asked, if it is good and free.
Done checkNewName(const Document& document, const std::string& name);
// Of several pieces that are made at once each is called after its own.
Done checkNoNameOfSeveral(const std::string& name);
// The document after a drape: new forms, poses at rest, the report kept, the pieces no longer dirty.
Document adopted(Document document, const DrapeOutcome& outcome);

}  // namespace karinui
