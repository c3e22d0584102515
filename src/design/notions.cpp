#include "karinui/design/notions.h"

#include <cmath>

#include "karinui/design/glossary.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

TimesCut timesCut(const Pattern& pattern, const Allowances& finish, const std::map<PieceId, Cutting>& cutting) {
  const AllowancePlan plan(pattern, finish);
  TimesCut times;
  for (const auto& [id, piece] : pattern.pieces) {
    const auto told = cutting.find(id);
    times[id] = (told == cutting.end() ? 1 : told->second.count) * (plan.onFold(*piece) ? 2 : 1);
  }
  return times;
}

std::vector<Message> notionsSaid(const Pattern& pattern, const Allowances& finish,
                                 const std::map<PieceId, Cutting>& cutting) {
  const TimesCut times = timesCut(pattern, finish, cutting);
  std::vector<Message> words = notionsSaid(pattern, finish.fastenings);
  const auto centimetres = [](double metres) { return std::ceil(metres * 100 - 1e-6); };
  const auto millimetres = [](double metres) { return std::round(metres * 1e4) / 10; };
  std::map<double, double> cords;
  for (const auto& [at, own] : finish.pipings)
    if (const Curve* curve = curveOf(pattern, at.first, at.second))
      cords[own.thickness] += curve->length() * times.at(at.first);
  for (const auto& [thickness, whole] : cords)
    words.push_back(say("piping cord {0} mm, {1} cm", millimetres(thickness), centimetres(whole)));
  for (const BiasStrip& strip : biasStrips(pattern, finish, times))
    words.push_back(say("bias strip of {0}, {1} mm wide, {2} × {3} cm", nameSaid(strip.fabric),
                        millimetres(strip.width), strip.count, centimetres(strip.cutLength)));
  return words;
}

}  // namespace karinui
