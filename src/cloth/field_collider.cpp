#include "karinui/cloth/settle.h"

namespace karinui {
namespace {

// The body's distance field answers each step; the mesh itself, by its tree of boxes, answers when it must be exact.
class FieldCollider : public Collider {
 public:
  explicit FieldCollider(BodyPtr body) : body_(std::move(body)) {}

  Contact contact(Vec3 place) const override {
    const DistanceField::Sample sample = body_->field().sample(place);
    const double steep = length(sample.gradient);
    return {sample.distance, steep > 1e-9 ? sample.gradient * (1 / steep) : Vec3{0, 1, 0}};
  }

  bool mayTouch(Vec3 place, double within) const override { return body_->field().distance(place) < within; }

  Contact confirmed(Vec3 place) const override {
    const Contact rough = contact(place);
    if (rough.distance > 3 * body_->field().cell()) return rough;
    const auto near = body_->bvh().nearest(place);
    if (!near) return rough;
    const double distance = body_->bvh().signedDistance(place);
    // Right on the surface the way to the nearest point says nothing; the face does.
    const Vec3 out = place - near->point;
    const double away = length(out);
    const Vec3 normal =
        away > 1e-7 ? out * ((distance < 0 ? -1 : 1) / away) : faceNormal(body_->mesh(), near->place.face);
    return {distance, length(normal) > 0 ? normal : rough.normal};
  }

 private:
  BodyPtr body_;
};

}  // namespace

std::unique_ptr<Collider> fieldCollider(BodyPtr body) { return std::make_unique<FieldCollider>(std::move(body)); }

}  // namespace karinui
