#include "karinui/design/truing_said.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/design/step_words.h"

namespace karinui {

namespace {

std::string mm(double metres) { return fixed(metres * 1000, 1); }

Message edgeSaid(const Document& document, PieceId piece, const std::string& edge) {
  return karinui::edgeSaid(document, EdgeRef{PieceRef(piece), edge, 0, 1});
}

Message sideSaid(const Document& document, const std::vector<EdgeSpan>& side) {
  Message all;
  for (const EdgeSpan& span : side) {
    const Message one = edgeSaid(document, span.piece, span.edge);
    all = all.empty() ? one : say("{0} + {1}", all, one);
  }
  return all;
}

}  // namespace

Message lengthsSaid(const Document& document, const SeamTruing& walked) {
  const Seam& seam = *document.find(walked.seam);
  const double differ = std::abs(walked.a - walked.b);
  if (walked.gathered)
    return say("gathered, {0} mm on {1} mm", mm(std::max(walked.a, walked.b)), mm(std::min(walked.a, walked.b)));
  const Message longer = sideSaid(document, walked.a > walked.b ? seam.a : seam.b),
                shorter = sideSaid(document, walked.a > walked.b ? seam.b : seam.a);
  if (walked.fits())
    return walked.ease > 0 ? say("eased by {0} mm, as declared", mm(differ)) : say("even, {0} mm", mm(walked.a));
  if (walked.ease > 0)
    return say("{0} is {1} mm longer than {2}; an ease of {3} mm is declared", longer, mm(differ), shorter,
               mm(walked.ease));
  return say("{0} is {1} mm longer than {2}; no ease is declared", longer, mm(differ), shorter);
}

Message cornerSaid(const Document& document, const CornerTruing& corner) {
  const Message a = edgeSaid(document, corner.a.piece, corner.a.edge),
                b = edgeSaid(document, corner.b.piece, corner.b.edge);
  const std::string degrees = fixed(std::abs(corner.off()), 1);
  if (corner.smooth()) return say("{0} goes on smoothly in {1}", a, b);
  if (corner.off() > 0) return say("{0} and {1} meet in a dent of {2} degrees", a, b, degrees);
  return say("{0} and {1} meet in a point of {2} degrees", a, b, degrees);
}

std::vector<Message> faultsSaid(const Document& document, const TruingReport& report, SeamId of) {
  std::vector<Message> all;
  for (const SeamTruing& seam : report.seams)
    if (!seam.fits() && (!of || seam.seam == of)) all.push_back(lengthsSaid(document, seam));
  for (const CornerTruing& corner : report.corners)
    if (!corner.smooth() && (!of || corner.seam == of)) all.push_back(cornerSaid(document, corner));
  return all;
}

}  // namespace karinui
