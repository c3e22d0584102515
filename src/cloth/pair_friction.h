#pragma once
// Coulomb friction of cloth on cloth: a spring between the two points of each pair that stuck to each other. Where the
// spring's force would exceed friction's limit the points are drawn after the pair (return mapping).
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "cloth/contact_pairs.h"

namespace karinui {

class PairFriction {
 public:
  // `coefficient`: per node; that of a pair is the geometric mean of its two sides'. `stiffness`: of the spring at
  // most, N/m. `stretch`: metres by which it gives at least before the pair slips, so that light contacts do not stick
  // and slip in turn.
  PairFriction(std::vector<double> coefficient, double stiffness, double stretch)
      : coefficient_(std::move(coefficient)), stiffness_(stiffness), stretch_(stretch) {}

  // Finds friction's force on each pair, whose push is known, and its stiffness (ContactPair::across). `sliding`: as
  // ContactQuery's.
  void apply(std::vector<ContactPair>& pairs, std::span<const Vec3> x, bool sliding);
  // Of pair p of those last applied: newtons on the weighted sum of its nodes.
  Vec3 force(std::size_t p) const { return hold_[p].force; }
  Vec3 slipForce(std::size_t p) const { return hold_[p].slipForce; }
  void afterStep(const std::vector<ContactPair>& pairs, std::span<const Vec3> x);
  void clear() { hold_.clear(); }
  void reset() { stuck_.clear(); }

 private:
  struct Anchor {
    std::array<double, 4> weight{};  // of the points that stuck to each other,
    Vec3 offset;                     // and minus how far they lay apart then, along the cloth
    double slip = 0;                 // metres, in the last step
    double push = 0;                 // newtons, averaged over steps: lying cloth trembles by micrometres
  };
  struct Stuck {
    std::array<NodeIndex, 4> node{};
    Anchor anchor;
  };
  struct Hold {
    Anchor anchor;
    Vec3 force, slipForce;  // newtons
  };
  static Vec3 pullOf(const ContactPair& pair, const Anchor& anchor, std::span<const Vec3> x);
  Hold holdOf(ContactPair& pair, std::span<const Vec3> x) const;
  double coefficientOf(const ContactPair& pair) const;
  double stiffnessAt(double limit, double length) const {
    return std::fmin(stiffness_, limit / std::fmax(length, stretch_));
  }

  std::vector<double> coefficient_;
  double stiffness_, stretch_;
  std::vector<Hold> hold_;    // one for each pair
  std::vector<Stuck> stuck_;  // sorted by nodes
};

}  // namespace karinui
