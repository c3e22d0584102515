#pragma once
// Whom a batch's garments do not fit, where and by how much, in the words of the report.
#include <span>
#include <string>
#include <vector>

#include "table.h"

namespace karinui::app {

// The ways not to fit, the worst first: values of the table's column "misfit".
std::span<const Message> misfits();

struct Misfit {
  std::size_t row = 0, kind = 0;  // of the table; of misfits()
  double by = 0;
};
// The worst of each kind first.
std::vector<Misfit> misfitsOf(const BatchTable& table);
// By how much, and where (may be empty); nothing at all for what has a sentence instead.
std::vector<Message> amountOf(const BatchTable& table, const Misfit& misfit);
// All of it in one sentence: "too small: 3 cm, 98 cm above the floor".
Message saidOf(const BatchTable& table, const Misfit& misfit);

}  // namespace karinui::app
