#pragma once
// A fixed team of threads. Work is cut into blocks whose size does not depend on the number of threads, each output is
// written by one block, and sums add the blocks' parts in order: so results are bit-identical for any team size.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace karinui {

class Workers {
 public:
  explicit Workers(int threads = 1);  // the caller's thread is one of them; fewer than 1 is 1
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  int threads() const;

  // Calls work(begin, end) for consecutive blocks of `block` items covering [0, count). Returns when all are done.
  // Not reentrant: one caller at a time, no nesting. `work` runs on several threads at once and must not throw.
  void forBlocks(std::size_t count, std::size_t block, const std::function<void(std::size_t, std::size_t)>& work);

  // The sum of part(begin, end) over all blocks, added in order.
  template <class Part>
  double sum(std::size_t count, std::size_t block, Part part) {
    std::vector<double> parts((count + block - 1) / block, 0.0);
    forBlocks(count, block, [&](std::size_t begin, std::size_t end) { parts[begin / block] = part(begin, end); });
    double total = 0;
    for (double p : parts) total += p;
    return total;
  }

 private:
  struct Team;
  std::unique_ptr<Team> team_;
};

}  // namespace karinui
