#include <algorithm>

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

// How the figure stands after it.
Result<BodyPose> poseAfter(const Document& before, const PoseBody& op, const Skeleton& skeleton) {
  BodyPose pose = before.body.pose;
  if (!op.name.empty()) {
    auto named = skeleton.named(*namedPose(op.name));
    if (!named) return named.error();
    pose = *std::move(named);
  }
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

// The document with what it is remembered by, if it is at rest.
std::vector<RestedInPose> restedWith(const Document& document) {
  std::vector<RestedInPose> rested = document.drape.rested;
  const DrapeInfo& drape = document.drape;
  if (!drape.last || !drape.last->settled || !drape.dirty.empty() || document.pattern.pieces.empty()) return rested;
  RestedInPose now{hash(document), {}};
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
  auto pose = poseAfter(before, op, **skeleton);
  if (!pose) return pose.error();
  if (*pose == before.body.pose) return before;
  Document after = before;
  after.body.own = pose->empty() ? std::string() : before.body.ownHash();
  after.body.hash = before.body.ownHash();
  after.body.pose = *pose;
  const auto body = context.bodies.find(after.body, context.blobs, context.workers, context.token);
  if (!body) return body.error();
  after.body.hash = (*body)->hash();
  after.drape.rested = restedWith(before);
  const std::string garment = hash(after);
  for (const RestedInPose& rested : after.drape.rested)
    if (rested.garment == garment) {
      after.drape.dirty.clear();
      return standing(std::move(after), rested.forms);
    }
  const auto forms = carriedByBody(before, **skeleton, *pose, context);
  if (!forms) return forms.error();
  after = standing(std::move(after), *forms);
  for (const auto& [id, form] : *forms) after.drape.dirty.insert(id);
  return after;
}

}  // namespace karinui
