#pragma once
// A fixed team of threads. Work is cut into blocks whose size does not depend on the number of threads, each output is
// written by one block, and sums add the blocks' parts in order: so results are bit-identical for any team size.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
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
  // Not reentrant: one caller at a time, no nesting. Runs on several threads at once; what one throws comes out, later.
  void forBlocks(std::size_t count, std::size_t block, const std::function<void(std::size_t, std::size_t)>& work);

  // Calls work(k) for parts of different weight, of which the members of the team get about alike. `before`: the
  // weight of all parts before each, and of all of them at the end. Which part is whose is the same each time.
  void forParts(std::span<const double> before, const std::function<void(std::size_t)>& work);

  // What part(begin, end) finds in each block, in order.
  template <class Part>
  auto each(std::size_t count, std::size_t block, Part part) {
    std::vector<decltype(part(count, block))> parts((count + block - 1) / block);
    forBlocks(count, block, [&](std::size_t begin, std::size_t end) { parts[begin / block] = part(begin, end); });
    return parts;
  }

  // The sum of part(begin, end) over all blocks, added in order.
  template <class Part>
  double sum(std::size_t count, std::size_t block, Part part) {
    double total = 0;
    for (double p : each(count, block, part)) total += p;
    return total;
  }

 private:
  struct Team;
  std::unique_ptr<Team> team_;
};

}  // namespace karinui
