#include "sizes_said.h"

#include <cmath>

#include "karinui/base/number.h"
#include "karinui/design/glossary.h"

namespace karinui::app {

namespace {

std::string centimetres(double metres) { return fixed(metres * 100, 1); }

}  // namespace

std::vector<Message> sizesSaid(const SizeFit& fit, const Grading& grading, Json& json) {
  const std::string &nearest = grading.sizes[fit.nearest], &standing = grading.sizes[grading.standing];
  std::vector<Message> all;
  if (fit.nearest == grading.standing)
    all.push_back(say("Of its sizes {0}, which stands, is nearest to this body.", nearest));
  else
    all.push_back(
        say("Of its sizes {0} is nearest to this body; {1} stands. “size name={0}” takes it.", nearest, standing));
  json = {{"nearest", nearest}, {"standing", standing}, {"ease_known", fit.easeKnown}, {"girths", Json::array()}};
  for (const SizeFit::Girth& girth : fit.girths) {
    const double has = girth.ofSizes[fit.nearest], miss = girth.miss(fit.nearest);
    const Message measure = termSaid(Term::Measure, girth.measure).value_or(say("{0}", girth.measure));
    const Message off =
        miss < 0 ? say("{0} cm too narrow", centimetres(-miss)) : say("{0} cm too wide", centimetres(miss));
    all.push_back(fit.easeKnown
                      ? say("{0}: this body {1} cm, with the ease of before {2} cm; size {3} has {4} cm, {5}.", measure,
                            centimetres(girth.body), centimetres(girth.wanted()), nearest, centimetres(has), off)
                      : say("{0}: this body {1} cm; size {2} has {3} cm, {4}.", measure, centimetres(girth.body),
                            nearest, centimetres(has), off));
    json["girths"].push_back({{"measure", girth.measure},
                              {"body_mm", girth.body * 1000},
                              {"ease_mm", girth.ease * 1000},
                              {"has_mm", has * 1000},
                              {"miss_mm", miss * 1000}});
  }
  if (!fit.easeKnown)
    all.push_back(
        say("It was made on no figure, so its ease is not known: its sizes were compared with the body itself."));
  return all;
}

}  // namespace karinui::app
