#include "session/sew_plan.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kPlainRatio = 1.05;  // sides that differ by no more are eased in without asking,
constexpr double kPlainSpare = 0.01;  // or by so many metres
constexpr double kMore = 1.02;        // longer by no more, a side is not sewn in part
constexpr double kGathers = 1.25;     // from this ratio on it is called gathering, not ease

// The longer side only in part, and to what ratio that may be typed.
void offerParts(SewPlan& plan, const GestureContext& context, bool backwards) {
  const double shorter = std::fmin(plan.la, plan.lb), longer = std::fmax(plan.la, plan.lb);
  for (const double ratio : {1.0, 1.5, 2.0}) {
    if (longer < ratio * kMore * shorter) continue;
    const std::string open = context.said(longer - ratio * shorter);
    Message label = ratio == 1     ? say("1:1, {0} stays open", open)
                    : ratio == 1.5 ? say("Gathered 1.5:1, {0} stays open", open)
                                   : say("Gathered 2:1, {0} stays open", open);
    plan.items.push_back({SewPlan::Does::Sew, std::move(label), gatheredTo(context, plan, ratio, backwards)});
  }
  if (longer < kMore * shorter) return;
  const double most = std::floor(100 * longer / shorter) / 100;
  plan.ratio = DropMenu::Number{say("Gathered so many times"), std::fmin(1.25, most), 1, most};
  plan.items.push_back({SewPlan::Does::Type, say("Another ratio…")});
}

}  // namespace

bool SewPlan::plain() const {
  const double spare = std::fabs(la - lb);
  return doubts.empty() && (spare <= kPlainSpare || spare <= (kPlainRatio - 1) * std::fmin(la, lb));
}

SewEdges seamOf(const GestureContext& context, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b,
                bool swapped) {
  const Document& document = context.snapshot->document;
  SewEdges sew;
  sew.a = a, sew.b = b;
  if (swapped) sew.reversed = facesReversed(document, sew, context.snapshot->body.get()) ? Choice::No : Choice::Yes;
  sew.mirror = context.options.mirrorSeams && mirrorImage(document, sew);
  return sew;
}

SewEdges gatheredTo(const GestureContext& context, const SewPlan& plan, double ratio, bool backwards) {
  const Document& document = context.snapshot->document;
  const bool longerIsA = plan.la > plan.lb;
  SewEdges part = plan.whole;
  const bool against = part.reversed == Choice::Auto ? facesReversed(document, part, context.snapshot->body.get())
                                                     : part.reversed == Choice::Yes;
  auto& side = longerIsA ? part.a : part.b;
  const double shorter = std::fmin(plan.la, plan.lb), longer = std::fmax(plan.la, plan.lb);
  if (ratio * shorter < longer)
    side = trimmed(document, side, ratio * shorter, longerIsA ? backwards : backwards != against);
  part.tie = ratio == 2 ? SewEdges::Tie::TwoToOne : SewEdges::Tie::OneToOne;
  return part;
}

SewPlan sewPlan(const GestureContext& context, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b,
                bool swapped, bool backwards) {
  using Does = SewPlan::Does;
  using Kind = SeamDoubt::Kind;
  const Document& document = context.snapshot->document;
  SewPlan plan{lengthOf(document, a), lengthOf(document, b), seamOf(context, a, b, swapped), {}, {}, {}};
  plan.doubts = seamDoubts(document, plan.whole, context.snapshot->body.get());
  for (const SeamDoubt& doubt : plan.doubts) {
    if (!doubt.instead || (swapped && doubt.kind == Kind::Twisted)) continue;
    SewEdges instead = *doubt.instead;
    instead.mirror = context.options.mirrorSeams && mirrorImage(document, instead);
    plan.items.push_back({Does::Sew, doubt.proposal, std::move(instead)});
  }
  const auto all = [&](auto&& is) { return std::all_of(plan.doubts.begin(), plan.doubts.end(), is); };
  if (all([](const SeamDoubt& d) { return d.kind != Kind::Sewn; })) {
    const double spare = std::fabs(plan.la - plan.lb), ratio = 1 + spare / std::fmin(plan.la, plan.lb);
    // Of a seam that is hardly meant, how it is gathered matters little.
    const bool meant = all([](const SeamDoubt& d) { return d.kind == Kind::Gathered || d.kind == Kind::Twisted; });
    plan.items.push_back({Does::Sew,
                          !meant              ? say("Sew it all the same")
                          : ratio >= kGathers ? say("All of it, gathered {0}:1", fixed(ratio, 2))
                          : spare < 1e-3      ? say("1:1")
                                              : say("All of it, {0} of ease", context.said(spare)),
                          plan.whole});
    if (meant) offerParts(plan, context, backwards);
    plan.items.push_back({Does::Swap, say("The other way round"), {}, swapped});
  }
  if (mirrorImage(document, plan.whole))
    plan.items.push_back({Does::Mirror, say("The mirrored seam too"), {}, context.options.mirrorSeams});
  plan.items.push_back({Does::Leave, say("Leave it")});
  return plan;
}

}  // namespace karinui
