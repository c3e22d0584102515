#include "session/pose_steps.h"

namespace karinui {

Operation poseStep(const std::string& name) {
  PoseBody pose;
  pose.name = name;
  return pose;
}

Done posesKnown(const Document& document, const std::vector<std::string>& names, Context& context) {
  for (const std::string& name : names)
    if (const auto known = resolved(document, poseStep(name), context); !known) return known.error();
  return {};
}

Result<Document> rested(Document document, Context& context) {
  if (document.atRest()) return document;
  return apply(document, DrapePieces{}, context);
}

}  // namespace karinui
