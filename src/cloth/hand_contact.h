#pragma once
// A hand that holds nodes: springs that draw them to places around its middle.
#include <optional>
#include <vector>

#include "cloth/contact.h"

namespace karinui {

struct Hand {
  std::vector<NodeIndex> nodes;
  std::vector<Vec3> offset;  // of each from the middle
  Vec3 middle;
  double stiffness = 0;  // N/m, per node
};

class HandContact : public Contact {
 public:
  void set(std::optional<Hand> hand) { hand_ = std::move(hand); }
  const std::optional<Hand>& hand() const { return hand_; }

  const char* name() const override { return "hand"; }
  void detect(const ContactQuery& query, Workers&) override {
    force_.clear();
    for (std::size_t k = 0; hand_ && k < hand_->nodes.size(); ++k)
      force_.push_back((query.x[hand_->nodes[k]] - hand_->middle - hand_->offset[k]) * hand_->stiffness);
  }
  void addGradient(std::span<Vec3> gradient) const override {
    for (std::size_t k = 0; k < force_.size(); ++k) gradient[hand_->nodes[k]] += force_[k];
  }
  void addHessian(ContactHessian& hessian) const override {
    for (std::size_t k = 0; k < force_.size(); ++k) hessian.addIsotropic(hand_->nodes[k], hand_->stiffness);
  }

 private:
  std::optional<Hand> hand_;
  std::vector<Vec3> force_;
};

}  // namespace karinui
