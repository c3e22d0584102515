#include "design/figure_files.h"
#include "design/pack.h"
#include "karinui/base/hash.h"
#include "karinui/design/apply.h"

namespace karinui {

std::string blobName(std::string_view bytes) { return Hasher().add(bytes).hex(); }

Result<std::string> MemoryBlobs::put(std::string bytes) {
  std::string name = blobName(bytes);
  bytes_.emplace(name, std::move(bytes));
  return name;
}

Result<std::string> MemoryBlobs::get(const std::string& name) const {
  const auto at = bytes_.find(name);
  if (at == bytes_.end()) return notFound(say("The stored part {0} is not in this document.", name));
  return at->second;
}

Result<std::string> Blobs::figure(const std::string& hash) const {
  return notFound(say("The figure {0} was not kept in this document.", hash));
}

namespace {

constexpr std::string_view kFigure = "karinui figure 1";
constexpr std::size_t kPosed = 12;  // poses of figures that are kept ready

Error damagedBody() { return storageError(say("The stored body is damaged.")); }

}  // namespace

std::string packBody(const Body::Parts& parts) {
  Writer w;
  w.add(std::string_view("karinui body 1")).add(parts.name).all(parts.mesh.points).all(parts.mesh.faces);
  w.add(static_cast<std::uint8_t>(parts.measured.sex)).add(std::uint64_t{parts.measured.value.size()});
  for (const auto& [key, value] : parts.measured.value) w.add(key).add(value);
  w.add(std::uint64_t{parts.landmarks.size()});
  for (const auto& [name, place] : parts.landmarks) w.add(name).add(place);
  return w.taken();
}

Result<Body::Parts> unpackBody(std::string_view bytes) {
  Reader r(bytes);
  Body::Parts parts;
  const bool ours = r.text() == "karinui body 1";
  parts.name = r.text();
  parts.mesh.points.resize(r.count(24));
  for (Vec3& p : parts.mesh.points) p = r.vec3();
  parts.mesh.faces.resize(r.count(12));
  for (Triangle& t : parts.mesh.faces) t = r.triangle(parts.mesh.points.size());
  const auto sex = r.number<std::uint8_t>();
  parts.measured.sex = sex == 0 ? Sex::Female : sex == 2 ? Sex::Child : Sex::Male;
  for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
    const std::string key = r.text();
    parts.measured.value[key] = r.number<double>();
  }
  for (std::size_t n = r.count(32); n > 0 && r.good(); --n) {
    const std::string name = r.text();
    parts.landmarks[name] = r.vec3();
  }
  if (!ours || !r.finished()) return damagedBody();
  return parts;
}

std::string packFigure(const Body& body) {
  Body::Parts parts;
  parts.name = body.name();
  parts.mesh = body.mesh();
  parts.measured = body.measured();
  parts.landmarks = body.landmarks();
  Writer w;
  w.add(kFigure).add(packBody(parts)).all(body.chartNumbers());
  return w.taken();
}

Result<BodyPtr> unpackFigure(std::string_view bytes) {
  Reader r(bytes);
  if (r.text() != kFigure) return damagedBody();
  auto parts = unpackBody(r.text());
  if (!parts) return parts.error();
  std::vector<double> chart(r.count(sizeof(double)));
  for (double& number : chart) number = r.number<double>();
  if (!r.finished()) return damagedBody();
  parts->chart = Body::chartFrom(chart);
  return Body::make(*std::move(parts));
}

Result<std::shared_ptr<const Skeleton>> Bodies::skeleton(const BodyChoice& choice, const Blobs& blobs, Workers& workers,
                                                         const Token& token) {
  if (choice.form) return refused(say("A dress form takes no pose: it has neither arms nor legs."));
  BodyChoice own = choice;
  own.hash = choice.ownHash(), own.own.clear(), own.pose.clear();
  const Result<BodyPtr> body = find(own, blobs, workers, token);
  if (!body) return body.error();
  const std::lock_guard lock(mutex_);
  if (const auto at = skeletons_.find((*body)->hash()); at != skeletons_.end()) return at->second;
  const auto skeleton = Skeleton::of(*body);
  if (skeleton) skeletons_[(*body)->hash()] = *skeleton;
  return skeleton;
}

void Bodies::keep(BodyPtr body) {
  const std::lock_guard lock(mutex_);
  byHash_[body->hash()] = std::move(body);
}

Result<BodyPtr> Bodies::find(const BodyChoice& choice, const Blobs& blobs, Workers& workers, const Token& token) {
  if (!choice.pose.empty()) {
    if (const BodyPtr kept = known(choice.hash); kept && kept->pose() == choice.pose) return kept;
    const auto bones = skeleton(choice, blobs, workers, token);
    if (!bones) return bones.error();
    const std::lock_guard lock(mutex_);
    for (const BodyPtr& body : posed_)
      if (body->own().hash() == (*bones)->body()->hash() && body->pose() == choice.pose) return body;
    Result<BodyPtr> body = posed(**bones, choice.pose);
    if (!body) return body;
    posed_.push_front(*body);
    if (posed_.size() > kPosed) posed_.pop_back();
    return body;
  }
  const std::lock_guard lock(mutex_);  // held while building: a second asker for the same figure waits for the first
  if (choice.chosen()) {
    if (const auto at = byHash_.find(choice.hash); at != byHash_.end()) return at->second;
    if (const auto bytes = blobs.figure(choice.hash)) {
      if (const auto body = unpackFigure(*bytes); body && (*body)->hash() == choice.hash)
        return byHash_[choice.hash] = *body;
    }
  }
  const auto made = [&](MannequinEnds ends) -> Result<BodyPtr> {
    Writer key;
    key.add(choice.mesh).add(static_cast<std::uint8_t>(choice.measurements.sex));
    for (const auto& [name, value] : choice.measurements.value) key.add(name).add(value);
    key.add(static_cast<std::uint8_t>(ends));
    const std::string name = key.taken();
    if (const auto at = built_.find(name); at != built_.end()) return at->second;
    Result<BodyPtr> body = [&]() -> Result<BodyPtr> {
      if (choice.mesh.empty()) {
        if (BodyPtr kept = readFigureFile(name)) return kept;
        Result<BodyPtr> mannequin = makeMannequin(choice.measurements, workers, token, ends);
        if (mannequin) writeFigureFile(name, **mannequin);
        return mannequin;
      }
      const auto bytes = blobs.get(choice.mesh);
      if (!bytes) return notFound(say("The imported body {0} is not in this document; import it again.", choice.mesh));
      auto parts = unpackBody(*bytes);
      if (!parts) return parts.error();
      return Body::make(*std::move(parts));
    }();
    if (body) built_[name] = byHash_[(*body)->hash()] = *body;
    return body;
  };
  const Result<BodyPtr> body = made(choice.form ? MannequinEnds::DressForm : MannequinEnds::Modelled);
  // A figure that was lost, of a document made when mannequins had other ends, is made as it was.
  if (body && choice.chosen() && choice.mesh.empty() && !choice.form && (*body)->hash() != choice.hash)
    if (const auto drawn = made(MannequinEnds::Drawn); drawn && (*drawn)->hash() == choice.hash) return drawn;
  return body;
}

BodyPtr Bodies::known(const std::string& hash) const {
  const std::lock_guard lock(mutex_);
  for (const BodyPtr& body : posed_)
    if (body->hash() == hash) return body;
  const auto at = byHash_.find(hash);
  return at == byHash_.end() ? nullptr : at->second;
}

}  // namespace karinui
