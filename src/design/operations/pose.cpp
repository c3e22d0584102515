#include <algorithm>
#include <optional>

#include "design/operations/operations.h"
#include "karinui/design/drape.h"

namespace karinui {

namespace {

using Forms = std::map<PieceId, std::shared_ptr<const Form>>;

std::string poseNames() {
  std::string all;
  for (const NamedPose& pose : namedPoses()) all += (all.empty() ? "" : ", ") + std::string(pose.name);
  return all;
}

Result<std::shared_ptr<const Skeleton>> skeletonOf(const Document& document, Context& context) {
  if (!document.body.chosen()) return bodyOf(document, context).error();
  return context.bodies.skeleton(document.body, context.blobs, context.workers, context.token);
}

// How the figure stands after it, `pose` being how it would without the joints that are named.
Result<BodyPose> poseAfter(BodyPose pose, const PoseBody& op, const Skeleton& skeleton) {
  for (const std::string& name : op.joint) {
    const auto joints = jointsNamed(name);
    if (!joints) return joints.error();
    for (const Joint joint : *joints) {
      JointAngles& angles = pose.try_emplace(joint, skeleton.own(joint)).first->second;
      if (op.flex) angles.flex = *op.flex;
      if (op.abduct) angles.abduct = *op.abduct;
      if (op.turn) angles.turn = *op.turn;
      if (angles == skeleton.own(joint)) pose.erase(joint);
    }
  }
  if (const Done ok = withinLimits(pose); !ok) return ok.error();
  return pose;
}

// What is shown of a way before any of it is gone: whether the figure can stand so, and what the cloth is made of,
// takes longer to find out than a person should wait for the first picture. Where there is no cloth this is all of the
// way.
class Beginning {
 public:
  Beginning(const Document& before, const Skeleton& skeleton, Context& context)
      : before_(before), skeleton_(skeleton), context_(context) {}

  // Shows the figure a little nearer to this pose.
  void goOn(const BodyPose& to) {
    if (!context_.onPose || context_.token.cancelled() || (!along_ && !begin())) return;
    const std::vector<Vec3> end = skeleton_.points(skeleton_.placements(to));
    double far = 0;
    for (std::size_t i = 0; i < end.size(); ++i) far = std::max(far, distance(end[i], skin_[i]));
    if (far == 0) return;
    ++times_;
    const bool bare = before_.pattern.pieces.empty();
    share_ = std::max(share_, std::min(kMostOfIt, bare ? 0.25 : kStep / far) * times_);
    const BodyPose pose = skeleton_.between(before_.body.pose, to, share_);
    std::vector<Rigid> moved = skeleton_.placements(pose);
    const std::vector<Vec3> skin = skeleton_.points(moved);
    context_.onPose({share_, pose, skin, [&] {
                       for (std::size_t i = 0; i < moved.size(); ++i)
                         moved[i] = karinui::after(moved[i], inverseOf(placed_[i]));
                       return along_->at(moved);
                     }});
  }
  double share() const { return share_; }

 private:
  static constexpr double kStep = 0.01;      // metres that skin moves from one picture to the next, at most,
  static constexpr double kMostOfIt = 0.25;  // and of the way

  bool begin() {
    const auto body = bodyOf(before_, context_);
    if (!body) return false;
    auto along = AlongWithSkin::of(before_, **body);
    if (!along) return false;
    along_ = *std::move(along);
    placed_ = skeleton_.placements(before_.body.pose);
    skin_ = skeleton_.points(placed_);
    return true;
  }

  const Document& before_;
  const Skeleton& skeleton_;
  Context& context_;
  std::optional<AlongWithSkin> along_;
  std::vector<Rigid> placed_;
  std::vector<Vec3> skin_;
  int times_ = 0;
  double share_ = 0;
};

// The hash of what a rest depends on: not of colours, scans, counts, declared eases, formulas, sizes, and not of names.
std::string restKey(Document document) {
  document.looks = {}, document.underlays = {}, document.cutting = {}, document.eases = {};
  document.variables = {}, document.grading = {};
  for (auto& [id, piece] : document.pattern.pieces) {
    Piece nameless = *piece;
    nameless.name.clear();
    piece = std::make_shared<const Piece>(std::move(nameless));
  }
  for (auto& [id, seam] : document.pattern.seams) seam.name.clear();
  return hash(document);
}

// The document with what it is remembered by, if it is at rest.
std::vector<RestedInPose> restedWith(const Document& document) {
  std::vector<RestedInPose> rested = document.drape.rested;
  const bool changed = !document.drape.dirty.empty();  // what is frozen, too
  if (!document.atRest() || changed || document.pattern.pieces.empty()) return rested;
  RestedInPose now{restKey(document), {}};
  for (const auto& [id, piece] : document.pattern.pieces) {
    if (!piece->form || piece->pose != Rigid()) return rested;
    now.forms[id] = piece->form;
  }
  std::erase_if(rested, [&](const RestedInPose& other) { return other.garment == now.garment; });
  rested.insert(rested.begin(), std::move(now));
  if (rested.size() > kMostRested) rested.pop_back();
  return rested;
}

Document standing(Document document, const Forms& forms) {
  for (const auto& [id, form] : forms) {
    Piece piece = *document.find(id);
    piece.form = form;
    piece.pose = Rigid();
    document.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));
  }
  return document;
}

}  // namespace

Done resolve(const Document& before, PoseBody& op, Context& context) {
  const bool angles = op.flex || op.abduct || op.turn;
  if (op.name.empty() && op.joint.empty())
    return refused(say("Say which pose: name=seated, or a joint and its angle: joint=left_elbow flex=90deg."));
  if (!op.name.empty() && !namedPose(op.name))
    return refused(say("There is no pose “{0}”; there are: {1}.", op.name, poseNames()));
  if (angles && op.joint.empty()) return refused(say("Say which joint has this angle: joint=left_elbow."));
  if (!angles && !op.joint.empty()) return refused(say("Say how the joint stands: flex, abduct or turn."));
  std::vector<std::string> joints;
  for (const std::string& name : op.joint) {
    const auto found = jointsNamed(name);
    if (!found) return refused(found.error().what);
    for (const Joint joint : *found) {
      const std::string own(jointNames()[static_cast<std::size_t>(joint)]);
      if (std::find(joints.begin(), joints.end(), own) == joints.end()) joints.push_back(own);
    }
  }
  op.joint = std::move(joints);
  const auto skeleton = skeletonOf(before, context);
  return skeleton ? Done() : Done(skeleton.error());
}

Result<Document> perform(const Document& before, const PoseBody& op, Context& context) {
  const auto skeleton = skeletonOf(before, context);
  if (!skeleton) return skeleton.error();
  const NamedPose* named = op.name.empty() ? nullptr : namedPose(op.name);
  auto pose = poseAfter(named ? named->pose : before.body.pose, op, **skeleton);
  if (!pose) return pose.error();
  if (!named && *pose == before.body.pose) return before;
  context.token.progress(0, say("Moving the figure"));
  Beginning beginning(before, **skeleton, context);
  beginning.goOn(*pose);
  if (named) {
    const auto opened = (*skeleton)->named(*named);
    if (!opened) return opened.error();
    pose = poseAfter(*opened, op, **skeleton);
    if (!pose) return pose.error();
    if (*pose == before.body.pose) return before;
    beginning.goOn(*pose);
  }
  if (context.token.cancelled()) return cancelled();
  Document after = before;
  after.body.own = pose->empty() ? std::string() : before.body.ownHash();
  after.body.hash = before.body.ownHash();
  after.body.pose = *pose;
  const auto body = context.bodies.find(after.body, context.blobs, context.workers, context.token);
  if (!body) return body.error();
  after.body.hash = (*body)->hash();
  beginning.goOn(*pose);
  if (context.token.cancelled()) return cancelled();
  after.drape.rested = restedWith(before);
  const std::string garment = restKey(after), asLongAgo = hash(after);
  for (const RestedInPose& rested : after.drape.rested)
    if (rested.garment == garment || rested.garment == asLongAgo) {
      after.drape.dirty.clear();
      return standing(std::move(after), rested.forms);
    }
  PoseOnlooker onlooker;
  if (context.onPose)
    onlooker = [&](const PoseUnderWay& way) {
      if (way.share > beginning.share()) context.onPose(way);
    };
  const auto forms = carriedByBody(before, **skeleton, *pose, context, onlooker);
  if (!forms) return forms.error();
  after = standing(std::move(after), *forms);
  for (const auto& [id, form] : *forms) after.drape.dirty.insert(id);
  return after;
}

}  // namespace karinui
