#pragma once
// Operations change documents: apply() is pure, the same document and operation give the same result. A refused
// operation changes nothing and says why in a sentence a tailor understands.
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "karinui/body/skeleton.h"
#include "karinui/cloth/stop_request.h"
#include "karinui/design/operation.h"

namespace karinui {

// Bytes by the hash of their content: imported bodies, forms of drapes. Not thread-safe.
class Blobs {
 public:
  virtual ~Blobs() = default;
  virtual Result<std::string> put(std::string bytes) = 0;              // gives the name
  virtual Result<std::string> get(const std::string& name) const = 0;  // NotFound: no such blob
  // A figure that was built before, by its Body::hash(), as packFigure() left it. NotFound: build it.
  virtual Result<std::string> figure(const std::string& hash) const;
};
class MemoryBlobs : public Blobs {
 public:
  Result<std::string> put(std::string bytes) override;
  Result<std::string> get(const std::string& name) const override;

 private:
  std::map<std::string, std::string> bytes_;
};
std::string blobName(std::string_view bytes);

// An imported figure as bytes for a blob, and back (refuses damaged ones). The template does not travel.
std::string packBody(const Body::Parts& parts);
Result<Body::Parts> unpackBody(std::string_view bytes);
// A built figure as bytes, chart included, and back: the same Body::hash(). Refuses damaged ones.
std::string packFigure(const Body& body);
Result<BodyPtr> unpackFigure(std::string_view bytes);

// Figures that were built already. May be shared by documents and threads.
class Bodies {
 public:
  // The figure of a choice: as `blobs` kept it, else built now from the measurements or the imported mesh in `blobs`.
  // One that was kept is taken as it is, even where this program would build another: a person's figure does not change
  // because the program did.
  Result<BodyPtr> find(const BodyChoice& choice, const Blobs& blobs, Workers& workers, const Token& token);
  // The skeleton under the figure of a choice, whatever pose it stands in.
  Result<std::shared_ptr<const Skeleton>> skeleton(const BodyChoice& choice, const Blobs& blobs, Workers& workers,
                                                   const Token& token);
  BodyPtr known(const std::string& hash) const;  // null: not built here yet
  void keep(BodyPtr body);                       // one that was built elsewhere, as it stands

 private:
  mutable std::mutex mutex_;
  std::map<std::string, BodyPtr> built_;                              // by what they are made from
  std::map<std::string, BodyPtr> byHash_;                             // by Body::hash(), kept ones included
  std::map<std::string, std::shared_ptr<const Skeleton>> skeletons_;  // by Body::hash() in the own pose
  std::deque<BodyPtr> posed_;                                         // the newest first
};

// Where a drape or a pull left the cloth.
struct DrapeOutcome {
  std::map<PieceId, std::shared_ptr<const Form>> forms;  // in space; the pieces' poses become the identity
  SettleReport report;
  std::vector<Vec3> force;  // of a pull, newtons along the path
};

// What a person should know of what was just done, where it is, and what would mend it.
struct Advice {
  Message what;
  PieceId piece = {};
  std::string edge = {};               // of the piece; empty: about no edge
  std::optional<Flat> at = {};         // the place on its paper
  std::optional<Operation> mend = {};  // the operation that does as advised
};

// A figure between two poses, and its garment with it. To be looked at while it is told; copy what is to stay.
struct PoseUnderWay {
  double share = 0;               // of the way from the pose before, growing from one to the next
  const BodyPose& pose;           // between the two
  const std::vector<Vec3>& skin;  // where the points of the figure's mesh are in it
  std::function<std::map<PieceId, std::shared_ptr<const Form>>()> forms;  // of the garment there
};
using PoseOnlooker = std::function<void(const PoseUnderWay&)>;

// What operations may use beside the document. Owned by the caller, for one call of apply at a time.
struct Context {
  Workers& workers;
  const Token& token;
  Blobs& blobs;
  Bodies& bodies;
  // The solver; empty: the real one (see drape.h). Tests put a cheap one here.
  std::function<Result<DrapeOutcome>(const Document&, const DrapePieces&, Context&)> drape;
  std::function<Result<DrapeOutcome>(const Document&, const PullCloth&, Context&)> pull;
  std::function<void(const Advice&)> advise = {};  // told what was just done; empty: nobody asks
  // Stops a drape where the cloth is; the recorded operation then says after how many steps. Null: nobody stops it.
  StopRequest* stop = nullptr;
  // Set by resolved(): the operation's numbers come from formulas. What is so already is then no mistake.
  bool byFormula = false;
  // A recorded step is done again: what it says is taken as it stands, as it was when it was recorded.
  bool recorded = false;
  // Shown the figure on its way to another pose, on the caller's thread; changes nothing of the outcome. Empty: nobody
  // looks.
  PoseOnlooker onPose = {};
  // How a drape goes about it, as SettleSettings has it: asked for by drapes in stages.
  bool giveUpCrossed = false, fromCoarsest = false, giveUpThroughBody = false;
};

Result<BodyPtr> bodyOf(const Document& document, Context& context);  // refused: no body chosen yet

// The operation as it is recorded: names become ids, what was left to choose is chosen, so that its meaning no longer
// depends on names or on where the cloth happened to stand. Refuses what does not make sense here.
Result<Operation> resolved(const Document& before, Operation operation, Context& context);

// The document after. An operation that is not resolved yet is resolved first.
Result<Document> apply(const Document& before, const Operation& operation, Context& context);

}  // namespace karinui
