#pragma once
// A drape from its first level to the finest (cascadic multigrid): on each the open seams are closed and the cloth is
// relaxed, then its shape is prolonged to the next finer one. What turns out to have gone wrong on the way is begun
// anew in another manner.
#include <optional>
#include <vector>

#include "cloth/boundary_activation.h"
#include "cloth/drape_progress.h"
#include "cloth/finish.h"
#include "cloth/prolong.h"

namespace karinui {

inline constexpr double kSewn = 0.5;  // spacings: a pair of the sides of a seam nearer than this is sewn

struct CascadeStart {
  bool formed = false;        // the finest level stands formed, and sewn or nearly so: no coarser one is needed
  bool grownThrough = false;  // limbs grew through cloth that was sewn on thinner colliders: it is sewn on whole ones
  bool layersMeet = true;     // not where they snagged on each other while they were sewn
  // Pieces are sewn up through each other; where cloth has then gone through itself, once more with contact.
  enum class Sewing { Free, Meeting, FreeAfterAll } sewing = Sewing::Free;
};

class Cascade {
 public:
  // All must outlive it; the levels do not change.
  Cascade(const std::vector<ClothLevel>& levels, const ColliderList& colliders, const SettleSettings& settings,
          const Token& token, Workers& workers, const SettleWatcher& watcher);

  // Descends to the finest level; or says how to begin anew.
  Result<std::optional<CascadeStart>> descend(const CascadeStart& start);

  // Of all descents, complete after one that was not to be begun anew.
  SettleReport report;
  std::vector<Vec3> positions;

 private:
  struct GivenUp {
    Message why;
    bool throughBody = false, crossed = false;
  };
  struct Level;

  // Where a level stands before its first step: `linear` alone on the first.
  Prolonged prolongTo(std::size_t level, const Cloth& cloth) const;
  // Draws the open seams together; how to begin anew, where that went wrong. `end`: how the last stage of it ended.
  std::optional<CascadeStart> sew(Level& level, const CascadeStart& start, StageResult& end);
  StageResult relaxed(Level& level, const CascadeStart& start);
  // How to begin anew, where a relaxed level shows that the drape came out wrong.
  std::optional<CascadeStart> wentWrong(Level& level, const CascadeStart& start) const;
  // Why finer levels would only spend time, after a coarse one that is not begun anew: a seam that stays wide open, or
  // the body through cloth that found no rest.
  std::optional<GivenUp> hopeless(const Level& level, const CascadeStart& start, const StageResult& end) const;
  void count(const StageResult& stage);
  bool ended() const { return stopped_ || givenUp_; }

  const std::vector<ClothLevel>& levels_;
  const ColliderList& colliders_;
  const SettleSettings& settings_;
  const Token& token_;
  Workers& workers_;
  DrapeProgress progress_;
  ResourceUse spent_;
  BoundaryActivation activation_;
  std::size_t first_ = 0;  // level of this descent
  bool sewn_ = false, stopped_ = false;
  std::optional<GivenUp> givenUp_;
};

}  // namespace karinui
