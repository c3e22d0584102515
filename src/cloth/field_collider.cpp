#include "cloth/mesh_distance.h"

namespace karinui {
namespace {

// The body's distance field answers each step; the mesh itself, by its tree of boxes, answers when it must be exact.
class FieldCollider : public Collider {
 public:
  explicit FieldCollider(BodyPtr body) : body_(std::move(body)) {}

  // The way out is the field's slope over a cell around the place. The slope at the place itself jumps from cell to
  // cell and from side to side of a crease, as under the arm, where cloth would go to and fro between two answers.
  Sample sample(Vec3 place) const override {
    const DistanceField& field = body_->field();
    const double reach = 0.5 * field.cell();
    const auto slope = [&](Vec3 by) { return field.distance(place + by) - field.distance(place - by); };
    const Vec3 steepest{slope({reach, 0, 0}), slope({0, reach, 0}), slope({0, 0, reach})};
    const double steep = length(steepest);
    return {field.distance(place), steep > 1e-9 ? steepest * (1 / steep) : Vec3{0, 1, 0}};
  }

  // Between the field's points its slope may be the root of three.
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
