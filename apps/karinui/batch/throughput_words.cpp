// What was measured of a batch, for a person.
#include "../word_table.h"
#include "karinui/base/number.h"
#include "throughput.h"

namespace karinui::app {

namespace {

std::string countSaid(double count) { return fixed(count, 0); }
// Three figures are told of what a clock measured.
std::string clockSaid(double seconds) {
  const bool small = seconds < 0.1;
  const double number = small ? 1e3 * seconds : seconds;
  return fixed(number, number < 1 ? 3 : number < 10 ? 2 : number < 100 ? 1 : 0) + (small ? " ms" : " s");
}

}  // namespace

std::string throughputWords(const Throughput& found, double garments, double cores, const Console& console) {
  const auto said = [&](const Message& message) { return console.said(message); };
  const auto each = [&](double seconds) {
    return said(say("{0} of processor time, {1} an hour", clockSaid(seconds), countSaid(3600 / seconds)));
  };
  WordTable measured, reckoned;
  measured.row({said(say("A garment by itself")), each(found.alone)});
  measured.row({said(say("the same, by the clock")), clockSaid(found.clock)});
  measured.row({said(say("A garment while every processor makes one ({0})", found.processors)), each(found.beside)});
  measured.row({said(say("Memory of the largest process")), fixed(found.megabytes, 0) + " MB"});
  measured.row({said(say("Once for a batch")), clockSaid(found.fixed)});
  measured.row({said(say("For each garment: planned")), clockSaid(found.plan)});
  measured.row({said(say("its plan read, by every processor")), clockSaid(found.read)});
  measured.row({said(say("written into the table")), clockSaid(found.merge)});
  measured.row(
      {said(say("Files of a garment")), said(say("{0} bytes of the plan, {1} read, {2} left", countSaid(found.manifest),
                                                 countSaid(found.in), countSaid(found.out)))});

  const BatchTime time = timeOf(found, garments, cores), one = timeOf(found, garments, 1);
  const double busy = cores / found.beside;  // garments a second
  reckoned.row({said(say("Planning")), clockSaid(time.plan)});
  reckoned.row({said(say("Garments")), clockSaid(time.garments)});
  reckoned.row({said(say("The table")), clockSaid(time.merge)});
  reckoned.row(
      {said(say("All together")),
       said(say("{0}, {1} {1|garment|garments} an hour, {2} {2|time|times} as many as on one processor",
                clockSaid(time.all()), countSaid(3600 * garments / time.all()), countSaid(one.all() / time.all())))});
  reckoned.row({said(say("The file server")),
                said(say("{0} {0|file|files} a second, {1} MB/s read, {2} MB/s written", countSaid(busy),
                         fixed(busy * found.in * 1e-6, 2), fixed(busy * found.out * 1e-6, 2)))});
  return said(say("Measured on {0} {0|garment|garments}, one thread each:", found.sample)) + "\n" + measured.words(2) +
         said(say("{0} {0|garment|garments} on {1} {1|processor|processors} would take:", countSaid(garments),
                  countSaid(cores))) +
         "\n" + reckoned.words(2);
}

}  // namespace karinui::app
