#pragma once
// The bridge from a garment to the solver: a document's pattern is laid, put together as cloth where it stands, brought
// to rest on the document's body, and the forms it leaves are read off. Long work: one context, one thread at a time.
// A drape that did not settle is an outcome whose report says so, not an error.
#include "karinui/check/check.h"
#include "karinui/cloth/pulls.h"
#include "karinui/design/apply.h"

namespace karinui {

// The pieces that move in a drape: those named, or every piece that is not frozen.
std::set<PieceId> livePieces(const Document& document, const std::vector<PieceRef>& named);
// Those that move when one of them is pulled: it, and what it hangs together with by seams and fastenings, without
// what is frozen. A neighbour that stood still would be a wall, and tear what is pulled.
std::set<PieceId> hangTogether(const Document& document, PieceId piece);

// While it lasts `onlooker` may ask, after every step, for the forms as they are then; on the caller's thread.
using FormsNow = std::function<std::map<PieceId, std::shared_ptr<const Form>>()>;
using DrapeOnlooker = std::function<void(const FormsNow&)>;
// `continueAfterRest`: as in SettleSettings.
Result<DrapeOutcome> drapeOnBody(const Document& document, const DrapePieces& drape, Context& context,
                                 const DrapeOnlooker& onlooker = {}, bool continueAfterRest = false);
// Whether a drape that was given up may come to rest without its widest cells: those had sewn cloth up with a limb
// through it.
bool finerMayHelp(const Document& document, const SettleReport& report);
// What the report of a drape says of cloth that is too small: by how much (metres, to a centimetre) and where. Nothing:
// it says something else.
struct Shortage {
  double by = 0;
  Message where;
};
std::optional<Shortage> shortageTold(const Message& why);
Result<DrapeOutcome> pullOnBody(const Document& document, const PullCloth& pull, Context& context);

// The garment as its figure carries it from the pose in which it stands to another (follow.h): the forms it then has,
// in space. Cloth that was never draped is carried piece by piece as it is.
Result<std::map<PieceId, std::shared_ptr<const Form>>> carriedByBody(const Document& document, const Skeleton& skeleton,
                                                                     const BodyPose& to, Context& context,
                                                                     const PoseOnlooker& onlooker = {});

// How a garment looks a little way on, before carriedByBody() has come there: each place of it goes as the skin nearest
// to it, pieces that were never draped as a whole. Made in milliseconds.
class AlongWithSkin {
 public:
  // `body`: the figure as it stands.
  static Result<AlongWithSkin> of(const Document& document, const Body& body);
  // `moved`: of each point of the body's mesh, from where it is to where it has come.
  std::map<PieceId, std::shared_ptr<const Form>> at(const std::vector<Rigid>& moved) const;

 private:
  Cloth cloth_;
  std::vector<Vec3> places_;
  std::vector<std::uint32_t> point_;  // of the mesh, that a place goes with; kNoNode: none is near
};

// A hand on the cloth while it still moves: a preview of the pull that will be performed once it lets go. Each step
// drapes a little further from where the last one left the cloth. One thread at a time.
class LivePull {
 public:
  // `pull` need not be resolved but its pieces must be ids; its path is not used. The context's workers must outlive
  // it.
  static Result<LivePull> take(const Document& document, const PullCloth& pull, Context& context);
  // Leads the hand to `by` from where it took hold; gives the force it feels, newtons.
  Result<Vec3> to(Vec3 by, Context& context);
  std::map<PieceId, std::shared_ptr<const Form>> forms() const;  // as the cloth is now

  LivePull(LivePull&&) noexcept;
  ~LivePull();

 private:
  LivePull();
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

// The garment as cloth at its finest level, where it stands now: what check, pictures and exports need.
struct Standing {
  Cloth cloth;
  ClothState state;
};
Result<Standing> standingCloth(const Document& document, const std::set<PieceId>& live);
// What the examiner found, and what elastics and fastenings pull with.
struct Examination : ClothCheck {
  std::vector<ElasticPull> elastics;
  std::vector<FasteningPull> fastenings;
};
// On the document's body if it has one.
Result<Examination> examined(const Document& document, Context& context);

}  // namespace karinui
