#pragma once
// Making up a pattern that came without its sewing, as cutting rooms send it: what each piece is, which edges are sewn
// to which, and where the pieces stand round the body before they are draped. Nothing of it is certain, so everything
// says how sure it is and why; whoever imports applies what is sure and asks about the rest. Metres on paper. Pure; any
// thread.
#include <map>
#include <string>
#include <vector>

#include "karinui/design/apply.h"
#include "karinui/design/values.h"

namespace karinui {

enum class PieceRole {
  Unknown,
  Front,  // of the trunk: bodice, shirt, top
  Back,
  Yoke,
  Sleeve,
  Leg,  // of trousers: front and back in one
  LegFront,
  LegBack,
  SkirtFront,
  SkirtBack,
  Collar,
  CollarStand,
  Waistband,
  Cuff,
  Aside,  // pocket, facing, placket, lining: nothing the garment needs to hang
};
Message roleSaid(PieceRole role);

// Where edges lie, seen by who looks at the cloth from outside, the piece upright: plus is to the right.
enum class PiecePart {
  Hem,
  SidePlus,
  SideMinus,
  ArmholePlus,
  ArmholeMinus,
  ShoulderPlus,
  ShoulderMinus,
  Neck,
  Centre,  // of half a front or back, or of half a skirt
  Top,     // waist of a skirt or of trousers, sleeve's cap, upper edge of a band
  CrotchPlus,
  CrotchMinus,
};

// A run of edges between two corners of a piece, in the outline's own order. The sides of darts are left out, so that a
// waist is one run.
struct EdgeRun {
  std::vector<std::string> edges;
  double length = 0;
};

struct PieceReading {
  PieceRole role = PieceRole::Unknown;
  // Of a piece that lies on one side of the body: which; of one that reaches over the centre: Both.
  enum class Side { Both, Left, Right } side = Side::Both;
  bool paired = false;  // cut in pairs: the other side's piece is its mirror image
  Angle turn;           // that stands it upright
  double sure = 0;      // 0 … 1
  bool byName = false;  // its name says what it is; else its shape does
  std::map<PiecePart, EdgeRun> parts;
  std::vector<std::array<std::string, 2>> darts;  // their two legs
  double low = 0, high = 0;  // upright: v of its lowest and highest place, about the paper's origin
  Flat upright(Flat paper) const;
};
using PieceReadings = std::map<PieceId, PieceReading>;
// `told`: what the person says of pieces, in place of their names; Unknown: left alone.
using ToldRoles = std::map<PieceId, PieceRole>;
PieceReadings readPieces(const Pattern& pattern, const ToldRoles& told = {});
// What a piece's name says it is, in the languages of the trade; Unknown: nothing.
PieceRole roleNamed(std::string_view name);

// The symmetric copies that are needed before the pattern can be sewn: the other sleeve, the other leg. Names must have
// been given.
std::vector<Operation> copiesFor(const Document& document, const PieceReadings& readings);

struct SeamProposal {
  SewEdges sew;     // by names of pieces; complete but for the doubt
  double sure = 0;  // 0 … 1
  Message reason;
};
inline constexpr double kSureSeam = 0.7;  // from which on a seam is sewn without being asked about
// The seams of a pattern without sewing; edges that are sewn already are left alone. The surest first of what excludes
// each other: each edge is in one proposal at most.
std::vector<SeamProposal> proposeSeams(const Document& document, const PieceReadings& readings);

// Operations that stand the pieces round the document's body, clear of it and of each other, near to what they are sewn
// to. Pieces that nothing holds stand beside the body, frozen. The document has its seams; without a body: none.
Result<std::vector<Operation>> standPieces(const Document& document, const PieceReadings& readings, Context& context);

// A pattern whose file says where its pieces stand round a body of another height: carried up or down as a whole, so
// that its shoulders, or the waist of skirts and trousers, are as high as the body's. As it is where it nearly is,
// where pieces do not stand round anything, and where none is known.
struct RaisedPattern {
  Pattern pattern;
  double by = 0;  // metres upwards
};
RaisedPattern raisedTo(const Body& body, Pattern pattern);

// What a person who looked at the proposals wants otherwise.
struct MakeUpChoices {
  ToldRoles roles;
  std::map<std::string, bool> sewn;  // by seamKey(): whether it is sewn; others are where they are sure
};
std::string seamKey(const SeamProposal& seam, const Document& document);  // the same when all is proposed anew

// All of it: the steps that make up a document's pattern, in the order in which they are to be performed on that very
// document, and what they leave to the person.
struct MakingUp {
  std::vector<Operation> steps;      // copies, where pieces stand, seams that are sewn
  std::vector<SeamProposal> sewn;    // ids as they are after the steps
  std::vector<SeamProposal> unsure;  // so are these
  std::vector<PieceId> unknown;      // pieces that were not recognised
  std::vector<Message> notes;        // what could not be done
  PieceReadings readings;
  Document document;  // after the steps
};
Result<MakingUp> makeUp(const Document& document, Context& context, const MakeUpChoices& choices = {});

}  // namespace karinui
