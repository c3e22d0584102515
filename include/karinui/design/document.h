#pragma once
// The garment: an immutable value whose parts are shared. A copy is cheap, nothing in it is ever edited in place, and
// any thread may read one. Metres, y up.
//
// The paper pattern (outlines, seams, fabrics, pins, settings, the choice of body) is the truth; forms and poses, that
// is where the cloth stands, are derived by drapes and can be made again. Hence two hashes.
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/body/body.h"
#include "karinui/cloth/fabric.h"
#include "karinui/cloth/settle_report.h"
#include "karinui/design/look.h"
#include "karinui/design/underlay.h"
#include "karinui/pattern/allowance.h"
#include "karinui/pattern/grading.h"

namespace karinui {

// Which figure the garment is made on. The figure itself is built on first need and kept (see Bodies in apply.h), so
// that reading, undoing or exporting a pattern does not wait for one.
struct BodyChoice {
  std::string size;           // built-in size it starts from, or empty
  Measurements measurements;  // all stated values, those of the size included; empty for a mesh
  bool form = false;          // a dress form on a stand instead of a whole figure; never of a mesh
  std::string mesh;           // name (hash) of an imported mesh among the document's blobs; then the rest is empty
  std::string hash;           // Body::hash() of the figure as it stands; empty: no body chosen
  BodyPose pose = {};         // how it stands; empty: in its own pose
  std::string own = {};       // Body::hash() of the figure in its own pose, where it stands otherwise; else empty
  bool chosen() const { return !hash.empty(); }
  const std::string& ownHash() const { return own.empty() ? hash : own; }
  bool operator==(const BodyChoice&) const = default;
};

struct Settings {
  enum class Collider { Field, Planes };
  double spacing = 0.010;               // metres between the lattice's threads
  Collider collider = Collider::Field;  // what stops the cloth: the distance field, or the historical merged planes
  double ease = 0.008;                  // metres between the body and a newly drawn piece
  bool operator==(const Settings&) const = default;
};

// How often a piece is cut from the cloth.
inline constexpr int kMostCut = 999;
struct Cutting {
  int count = 1;
  bool pairs = false;  // half of them turned over
  bool operator==(const Cutting&) const = default;
};

// Where the garment came to rest before its figure took another pose. A garment that comes back unchanged, on a figure
// that stands as then, takes it up again (docs/develop/poses.md).
struct RestedInPose {
  std::string garment;  // the hash of what the rest depends on; of long ago, hash() of the document then
  std::map<PieceId, std::shared_ptr<const Form>> forms;
};
inline constexpr std::size_t kMostRested = 8;

// What is known of the last drape.
struct DrapeInfo {
  std::optional<SettleReport> last;  // nothing: never draped
  std::vector<Vec3> force;           // newtons along the path, if the last drape was a pull
  std::set<PieceId> dirty;           // pieces that changed (or moved) since they were last brought to rest
  std::vector<RestedInPose> rested;  // the newest first, kMostRested at the most
};

struct Document {
  BodyChoice body;
  Pattern pattern;
  std::map<std::string, Fabric> fabrics;      // by name; a piece's fabric not named here is a preset
  std::map<PieceId, std::vector<Flat>> pins;  // paper places held where they are while draping
  Looks looks;
  Allowances allowances;               // of seams and corners that are not as usual (pattern/allowance.h)
  std::map<PieceId, Cutting> cutting;  // of pieces that are cut more than once
  std::map<SeamId, double> eases;      // metres by which one side of a seam is longer on purpose
  Grading grading;                     // the sizes the pieces are made in
  Settings settings;
  std::map<std::string, std::string> variables;  // formulas by name (formula.h); worked out where they are used
  Underlays underlays;                           // scans to trace
  DrapeInfo drape;
  std::uint32_t operations = 0;  // how many led here; the next one mints its ids from operations + 1

  // Compiled once (document.cpp), not wherever a document is copied.
  Document();
  Document(const Document&);
  Document(Document&&) noexcept;
  Document& operator=(const Document&);
  Document& operator=(Document&&) noexcept;
  ~Document();

  const Piece* find(PieceId id) const;  // null: no such piece
  const Piece* pieceNamed(std::string_view name) const;
  const Seam* find(SeamId id) const;
  std::vector<PieceId> unrested() const;  // changed since it was draped; what is frozen never drapes, and is none of it
  bool atRest() const;                    // all that drapes, and nothing of it changed since
};

// Of the pattern truth: body, outlines, marks, seams, allowances, eases, counts, sizes, fabrics, looks, pins, settings,
// variables, scans, names and ids; not of forms, poses, reports.
std::string hash(const Document& document);
// Of where the cloth stands: forms and poses.
std::string drapeHash(const Document& document);

// The document's own fabric of that name, else the preset.
Result<Fabric> fabricNamed(const Document& document, const std::string& name);
// The cloth a piece is made of: its fabric, with the interfacing that is fused to it.
Result<Fabric> fabricOf(const Document& document, const Piece& piece);
// All fabrics that are in use, interfacings too, by name (what assemble() wants).
Result<std::map<std::string, Fabric>> fabricsInUse(const Document& document);

// Where a paper place of a piece is in space, by its form and pose. Built once per form, then cheap.
class Stand {
 public:
  explicit Stand(const Piece& piece);
  Vec3 operator()(Flat place) const;

 private:
  Rigid pose_;
  std::shared_ptr<const Form> form_;
  std::shared_ptr<const class LatticeFinder> finder_;
};

// "p3" for the first thing made by step 3, "p3.2" for the second; "s5" likewise. "-" for none.
std::string text(PieceId id);
std::string text(SeamId id);
// Letters of any script, digits, _ and -; not like an id ("p3"). Says what is wrong with it.
Done checkName(std::string_view name);
// The nearest usable name, for importers: "left sleeve.1" -> "left_sleeve_1"; never empty, unique among the document's.
std::string usableName(const Document& document, std::string_view wanted);

}  // namespace karinui
