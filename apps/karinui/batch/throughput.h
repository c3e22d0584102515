#pragma once
// How many garments a batch makes in an hour, measured on a sample, and what many processors would bring.
#include "../commands.h"
#include "plan.h"

namespace karinui::app {

struct ThroughputWish {
  BatchWish batch;          // its folder is not used
  std::size_t sample = 16;  // garments that are made, spread over the batch
  int seconds = 600;        // one may take
};
// Seconds of processor time, so that other work on the machine does not count, one thread a garment. What a garment
// waits for files is the rest of its time by the clock.
struct Throughput {
  std::size_t sample = 0;
  double alone = 0;        // a garment, one at a time
  double clock = 0;        // the same, by the clock
  double beside = 0;       // a garment while every processor of this machine makes one
  double megabytes = 0;    // of memory, the largest process
  double fixed = 0;        // once a batch: the program's own hash, the designs, an empty table
  double plan = 0;         // a garment of the plan: made and written; what one more costs
  double read = 0;         // a garment of the plan, read by the process of a part, whatever its share
  double merge = 0;        // a garment of the table: its outcome read, a row of CSV and SQLite
  double manifest = 0;     // bytes of the manifest a garment
  double in = 0, out = 0;  // bytes that a garment's process reads (design, its own plan) and leaves
  int processors = 0;      // of this machine
};
Result<Throughput> measureThroughput(Program& program, const ThroughputWish& wish);

// Seconds that a batch takes, by Amdahl: planning and merging are serial, and each processor, one part of the batch,
// reads the whole plan before it makes its share. Waiting for a file server, and what the memory of a node with more
// processors than this one does, is not in it.
struct BatchTime {
  double plan = 0, garments = 0, merge = 0;
  double all() const { return plan + garments + merge; }
};
BatchTime timeOf(const Throughput& measured, double garments, double cores);

// Both as a person reads them.
std::string throughputWords(const Throughput& measured, double garments, double cores, const Console& console);

}  // namespace karinui::app
