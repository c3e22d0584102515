#pragma once
// Blocks: pieces drafted from a figure's measures, by the rules of docs/user/blocks.md. Metres on paper, u to the right
// of who looks at the cloth from outside, v up; v = 0 is the waist of upper pieces, skirts and trousers, the underarm
// of sleeves. Pure; any thread.
#include <optional>
#include <string>
#include <vector>

#include "karinui/body/body.h"
#include "karinui/design/operation.h"

namespace karinui {

// Refused with what is missing, where a figure lacks a measure that a block needs.
class Measured {
 public:
  explicit Measured(const Body& body) : body_(body) {}
  double operator()(std::string_view key) const;  // metres or radians; 0 and missing() where there is none
  // A belly wider than the hip: more than 0, and where. Figures from before bellies were measured have none.
  struct Belly {
    double girth = 0, belowWaist = 0;
  };
  Belly belly() const;
  // The trunk between hip and waist: its greatest girth, and its least below the upper quarter.
  struct Trunk {
    double widest = 0, narrowest = 0, narrowHeight = 0;
  };
  Trunk underWaist() const;
  // Metres to the left of the middle; nothing where the figure has no such landmark.
  std::optional<double> aside(const std::string& landmark) const;
  bool female() const { return body_.measured().sex == Sex::Female; }
  Done enough() const;

 private:
  const Body& body_;
  mutable std::string missing_;
};

// How a piece first stands: wrapped at a place of the body, or flat before or behind it.
struct FirstStand {
  std::optional<BodyPoint> at;  // wrapped: the paper place `point` comes there
  Flat point;
  double ease = 0.01;
  bool taper = false;   // wrapped: as a tube that narrows with the limb
  double x = 0, z = 0;  // flat: carried so far to the left and forward; behind it is turned round
  double lean = 0;      // flat: radians by which its lower end goes farther to that side, as a leg does, or less far
};

inline EdgeRef draftedEdge(const std::string& piece, const std::string& edge) { return {PieceRef(piece), edge}; }

struct DraftPiece {
  std::string name;
  Outline outline;
  std::vector<InternalLine> lines;
  std::vector<Mark> marks;
  FirstStand stands;
  std::string mirrorOf;  // made as that piece's symmetric copy; the rest is empty
};
struct DraftDart {
  std::string piece, edge;
  double at = 0.5, width = 0;
  Flat tip;
  std::string name;
};
struct DraftSeam {
  std::string name;
  std::vector<EdgeRef> a, b;  // by names
};
struct DraftBand {  // stood and sewn along a run when all else is there
  std::string name;
  std::vector<EdgeRef> of;
  double depth = 0, ratio = 1, turn = 0;
  std::optional<BodyPoint> at;  // where its middle is wrapped while the run's edges still stand apart
};
struct Draft {
  std::vector<DraftPiece> pieces;
  std::vector<DraftDart> darts;
  std::vector<DraftSeam> seams;
  std::vector<DraftBand> bands;
  std::optional<double> height;   // metres above the floor at which v = 0 of flat pieces stands; none: the waist's
  std::optional<Message> advice;  // on what it will look like
};

struct BlockWish {
  std::optional<double> ease, length;
  bool belly = false;  // lower pieces have room for a belly that is wider than the hip
  DraftBlock::Worn worn = DraftBlock::Worn::Waist;
  bool armhole = false;                       // upper pieces have an armhole that an arm has room in
  std::optional<double> knee = {}, hem = {};  // of trousers: round a leg
  bool legs = false;                          // and these are wider or narrower as the hip is by its ease
  // Of lower pieces: the waist they are sewn to, for one side of front and back, from the centre to the dart and from
  // there to the side; no dart: all of it as `centre`.
  struct Waist {
    double centre = 0;
    std::optional<double> side = {};
    double whole() const { return centre + side.value_or(0); }
  };
  struct Waists {
    Waist front, back;
  };
  std::optional<Waists> meets = {};
};
Result<Draft> bodiceDraft(const Measured& of, const BlockWish& wish);
Result<Draft> shirtDraft(const Measured& of, const BlockWish& wish);
// A stand for a neckline: from the front's middle over the wearer's right round to its left.
DraftBand collarBand(std::vector<EdgeRef> neckline, double depth);
Result<Draft> skirtDraft(const Measured& of, const BlockWish& wish);
double skirtWaist(const Measured& of);  // all round, by itself
Result<Draft> trousersDraft(const Measured& of, const BlockWish& wish);
Result<Draft> leggingsDraft(const Measured& of, const BlockWish& wish);
// Both sleeves for an armhole of that length.
struct Armhole {
  double front = 0, back = 0;
};
Armhole bodiceArmhole(const Measured& of, const BlockWish& wish);
Result<Draft> sleeveDraft(const Measured& of, const BlockWish& wish, Armhole armhole);

// The half of an upper piece, from the centre of the hem round to the centre of the neck.
struct UpperHalf {
  double hem = 0;  // v of the hem, below the waist
  double hemWidth = 0, waistWidth = 0, chestWidth = 0;
  double underarm = 0;  // v
  Flat tip, neck;       // shoulder point; where the neckline meets the shoulder
  double across = 0;    // narrowest half width along the armhole
  double centre = 0;    // v of the neckline's middle
};
// Its edges: hem, side, armhole, shoulder, neck.
std::vector<Edge> upperHalf(const UpperHalf& half);
// Both halves; edges of the half at positive u end in `plus`, those of the other in `minus`.
Outline wholeOf(const std::vector<Edge>& half, const std::string& plus, const std::string& minus);
// The half alone, closed along the centre by an edge "centre".
Outline halfOf(const std::vector<Edge>& half);
double lengthOf(const std::vector<Edge>& half, std::string_view edge);

}  // namespace karinui
