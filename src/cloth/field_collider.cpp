#include "cloth/mesh_distance.h"

namespace karinui {
namespace {

// The body's distance field at each step; the mesh itself, by its tree of boxes, where the distance must be exact.
class FieldCollider : public Collider {
 public:
  explicit FieldCollider(BodyPtr body) : body_(std::move(body)) {}

  // The normal is the central difference of the field over a whole cell. The gradient at the place itself is
  // discontinuous between cells and across a crease, as under the arm, where cloth would oscillate between two normals.
  Sample sample(Vec3 place) const override {
    const DistanceField& field = body_->field();
    const double reach = 0.5 * field.cell();
    const auto difference = [&](Vec3 by) { return field.distance(place + by) - field.distance(place - by); };
    const Vec3 steepest{difference({reach, 0, 0}), difference({0, reach, 0}), difference({0, 0, reach})};
    const double steep = length(steepest);
    return {field.distance(place), steep > 1e-9 ? steepest * (1 / steep) : Vec3{0, 1, 0}};
  }

  // A trilinear field's gradient may be as long as sqrt(3), which is below kLipschitz.
  double clearance(Vec3 place) const override { return body_->field().distance(place); }

  Sample exactSample(Vec3 place) const override { return meshSample(*body_, place); }
  Vec3 intersectionNormal(const std::array<Vec3, 3>& face) const override {
    return meshIntersectionNormal(*body_, face);
  }

 private:
  BodyPtr body_;
};

}  // namespace

std::unique_ptr<Collider> fieldCollider(BodyPtr body) { return std::make_unique<FieldCollider>(std::move(body)); }

}  // namespace karinui
