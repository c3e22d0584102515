#include "cloth/true_distance.h"

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

  Contact confirmed(Vec3 place) const override { return trueContact(*body_, place); }

 private:
  BodyPtr body_;
};

}  // namespace

std::unique_ptr<Collider> fieldCollider(BodyPtr body) { return std::make_unique<FieldCollider>(std::move(body)); }

}  // namespace karinui
