#include "menu_anchor.h"

#include <cmath>

namespace karinui::room {

namespace {

constexpr double kTurned = 0.9;  // radians
constexpr double kGone = 0.45;   // metres
constexpr double kMoment = 0.7;  // seconds

}  // namespace

void MenuAnchor::place(const Rigid& head) {
  eyes_ = head.carry;
  heading_ = headingOf(head);
  placed_ = true;
  awaySince_.reset();
}

void MenuAnchor::follow(const Rigid& head, double seconds, bool kept) {
  if (!placed_) return place(head);
  const double turned = std::fabs(std::remainder(headingOf(head) - heading_, 2 * 3.14159265358979323846));
  if (kept || (turned < kTurned && distance(head.carry, eyes_) < kGone)) return awaySince_.reset();
  if (!awaySince_) awaySince_ = seconds;
  if (seconds - *awaySince_ >= kMoment) place(head);
}

}  // namespace karinui::room
