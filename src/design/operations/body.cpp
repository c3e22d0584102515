#include "design/operations/operations.h"
#include "karinui/body/sizes.h"
#include "karinui/design/variables.h"

namespace karinui {

namespace {

Result<Measurements> stated(const SetBody& op) {
  Measurements all;
  if (!op.size.empty()) {
    auto size = builtInSize(op.size);
    if (!size) return size.error();
    all = *std::move(size);
  }
  if (op.sex) all.sex = *op.sex;
  std::map<std::string, double> own;
  for (const Stated& s : op.set) own[s.key] = s.value;
  return withOwn(std::move(all), own);
}

}  // namespace

Done resolve(const Document&, SetBody& op, Context& context) {
  if (op.size.empty() && op.set.empty() && op.mesh.empty()) {
    return refused(say("Say which body: size=jis9ar, set=\"bust_girth=88cm; …\", or an imported mesh."));
  }
  if (!op.mesh.empty() && op.form)
    return refused(say("An imported body is worn as it is; a dress form is made from measurements: leave out mesh."));
  if (!op.mesh.empty() && (!op.size.empty() || !op.set.empty() || op.sex)) {
    return refused(say("A body is either an imported mesh or made from measurements, not both."));
  }
  if (Done done = workOutStated(op); !done) return done;
  if (!op.size.empty() && !context.recorded) op.size = plainSize(op.size);
  std::map<std::string, Stated> once;
  for (const Stated& s : op.set) {
    auto key = measurementKey(s.key);
    if (!key) return key.error();
    if (!once.emplace(*key, Stated{*key, s.value, s.formula}).second)
      return refused(say("The measurement {0} is given twice.", *key));
  }
  op.set.clear();
  for (auto& [key, stated] : once) op.set.push_back(std::move(stated));
  return {};
}

Result<Document> perform(const Document& before, const SetBody& op, Context& context) {
  Document after = before;
  after.body = BodyChoice();
  if (!op.mesh.empty()) {
    after.body.mesh = op.mesh;
  } else {
    auto all = stated(op);
    if (!all) return all.error();
    after.body.size = op.size;
    after.body.measurements = *std::move(all);
    after.body.form = op.form;
  }
  auto body = context.bodies.find(after.body, context.blobs, context.workers, context.token);
  if (!body && body.error().kind == Error::Kind::Refused && !op.size.empty() && !op.set.empty())
    return refused(say("{0} What is not stated is that of size {1}; without a size it follows from what is.",
                       body.error().what, op.size));
  if (!body) return body.error();
  after.body.hash = (*body)->hash();
  if (!before.body.pose.empty()) {  // the new figure stands as the old one did
    after.body.own = after.body.hash, after.body.pose = before.body.pose;
    body = context.bodies.find(after.body, context.blobs, context.workers, context.token);
    if (!body) return refused(say("{0} Put the figure into its own pose first: pose name=A.", body.error().what));
    after.body.hash = (*body)->hash();
  }
  for (const auto& [id, piece] : after.pattern.pieces) after.drape.dirty.insert(id);
  return after;
}

}  // namespace karinui
