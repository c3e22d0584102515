#pragma once
// What a drape tells on its way: the share of its work that is done, and where the cloth stands. It also counts the
// steps of all levels, and ends a stage at the step where the settings say so.
#include <optional>

#include "cloth/stages.h"

namespace karinui {

// How far a stage has come, as one may be told. The bar goes on by what a step is of those that are left, so that it is
// never full before the end, whatever was forecast before; a number of steps that grows is not told.
class ToldProgress {
 public:
  void step(std::optional<double> left);  // how many there are to go; nothing: not known yet
  double share() const { return share_; }
  std::optional<int> stepsToGo() const { return told_; }  // in tens

 private:
  double share_ = 0;
  std::optional<int> lowest_, told_;
};

class DrapeProgress {
 public:
  // All three must outlive it.
  DrapeProgress(const SettleSettings& settings, const Token& token, const SettleWatcher& watcher)
      : settings_(settings), token_(token), watcher_(watcher) {}

  struct Level {
    const LevelSolver& solver;
    bool finest;
    double begin, end;  // shares of the drape's work
  };
  // The watcher of a stage that takes the shares `from` to `to` of the level's work. Everything must outlive it.
  StepWatcher watch(const Level& level, Message doing, double from, double to);
  std::size_t steps() const { return steps_; }

 private:
  const SettleSettings& settings_;
  const Token& token_;
  const SettleWatcher& watcher_;
  std::size_t steps_ = 0;
};

// How much of the work of the levels from `first` on is done before `level`: a step of it costs as its nodes do.
double shareBefore(const std::vector<ClothLevel>& levels, std::size_t first, std::size_t level);

}  // namespace karinui
