#pragma once
// What the drape engine is measured on. Three scenes that other solvers were measured on too, exactly as defined in
// docs/performance.md (SI units, y up, 0.15 kg/m2), and drafted garments on a body. Pure but for the files of the
// garments; any thread.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "karinui/cloth/settle.h"

namespace karinui::bench {

class Capsules : public Collider {  // an analytic body; a ball is a capsule of no length
 public:
  struct Capsule {
    Vec3 a, b;
    double radius = 0;
  };
  explicit Capsules(std::vector<Capsule> capsules) : capsules_(std::move(capsules)) {}
  Sample sample(Vec3 place) const override;
  double clearance(Vec3 place) const override { return sample(place).distance; }
  const std::vector<Capsule>& all() const { return capsules_; }

 private:
  std::vector<Capsule> capsules_;
};

struct Workload {
  std::string name;
  std::vector<ClothLevel> levels;  // coarse first
  std::unique_ptr<Collider> collider;
  BodyPtr body;  // null where the body is analytic
};

// About so many vertices on the finest level; 0: as defined (10,201, 10,201 and 12,096).
Workload curtain(std::size_t vertices);  // W1: a cloth of 1 m2 hung by two corners
Workload sphere(std::size_t vertices);   // W2: the same cloth dropped on a ball, held by friction 0.3
Workload tunic(std::size_t vertices);    // W3: two panels sewn together on three capsules

// A GarmentCode specification on a body from a file.
struct GarmentFiles {
  std::filesystem::path pattern, body;
};
Result<Workload> garment(std::string name, const GarmentFiles& files, std::size_t vertices, Workers& workers,
                         const Token& token);

}  // namespace karinui::bench
