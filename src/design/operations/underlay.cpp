#include <cmath>
#include <numbers>

#include "design/operations/operations.h"
#include "design/straightened.h"
#include "karinui/design/print_image.h"

namespace karinui {

namespace {

// Which scan is meant where none is named: the only one, or the new one.
Done resolveName(const Document& before, LayUnderlay& op) {
  const Underlays& all = before.underlays;
  const bool fresh = !op.photo.empty() && op.corners.empty();
  if (op.name.empty()) {
    if (!fresh && all.size() > 1)
      return refused(say("There are several scans; say which: name={0}.", all.begin()->first));
    op.name = !fresh && !all.empty() ? all.begin()->first : "scan";
    for (int n = 2; fresh && all.contains(op.name); ++n) op.name = "scan_" + std::to_string(n);
  }
  if (const Done name = checkName(op.name); !name) return name;
  if (all.contains(op.name) || fresh) {
    if (!all.contains(op.name) && all.size() >= static_cast<std::size_t>(kMostUnderlays))
      return refused(say("There are {0} scans under the pattern already; take one out first.", kMostUnderlays));
    return {};
  }
  if (all.empty())
    return notFound(say("There is no scan under the pattern yet; lay one there with photo=, or --photo FILE."));
  return notFound(say("There is no scan “{0}” under the pattern.", op.name));
}

// The photograph is straightened here, once: the record names the straight one.
Done straighten(const Document& before, LayUnderlay& op, Context& context) {
  if (op.corners.size() != 4) return refused(say("A rectangle has four corners; {0} were given.", op.corners.size()));
  const Underlay& slanted = before.underlays.at(op.name);
  const auto bytes = context.blobs.get(slanted.photo);
  if (!bytes) return bytes.error();
  const auto picture = unpackPrint(*bytes);
  if (!picture) return picture.error();
  std::array<Flat, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = slanted.inPicture(op.corners[i]);
  const auto made = straightened(*picture, corners, op.rectangle.value_or(Flat{}));
  if (!made) return made.error();
  std::string packed = packPrint(made->image);
  op.photo = blobName(packed);
  if (!context.blobs.get(op.photo))
    if (const auto kept = context.blobs.put(std::move(packed)); !kept) return kept.error();
  const auto hundredth = [](double metres) { return std::round(metres * 1e5) / 1e5; };
  const Flat at = op.corners[0] + made->middle;
  op.width = Length{made->width}, op.at = Flat{hundredth(at.u), hundredth(at.v)}, op.turn = Angle{0};
  return {};
}

Result<Underlay> laid(const Document& before, const LayUnderlay& op, Context& context) {
  const auto was = before.underlays.find(op.name);
  Underlay lies = was == before.underlays.end() ? Underlay() : was->second;
  if (!op.photo.empty() && op.photo != lies.photo) {
    const auto bytes = context.blobs.get(op.photo);
    if (!bytes) return refused(say("The photograph {0} is not in this document; open it again.", op.photo));
    const auto size = printSize(*bytes);
    if (!size) return size.error();
    const bool fresh = lies.photo.empty();
    lies.photo = op.photo, lies.wide = size->at(0), lies.high = size->at(1);
    if (fresh) lies.width = kUsualScan * lies.wide;
    if (op.width) lies.width = *op.width;
    if (fresh) lies.at = {0.5 * lies.width, -0.5 * lies.height()};  // right and down from where pieces begin
  }
  if (op.width) lies.width = *op.width;
  if (op.at) lies.at = *op.at;
  if (op.turn) lies.turn = *op.turn;
  if (op.strength) lies.strength = *op.strength;
  if (op.hidden) lies.hidden = *op.hidden;
  // About a place of the picture that stays on the table.
  const auto keeping = [&](Flat table, auto&& change) {
    const Flat held = lies.inPicture(table);
    change();
    lies.at = lies.at + (table - lies.onTable(held));
  };
  if (!op.between.empty() || op.apart != 0) {
    if (op.between.size() != 2 || !(op.apart > 0))
      return refused(
          say("A scan is scaled by two places and how far they are apart: between=\"0,0; 20cm,0\" "
              "apart=20.4cm."));
    const double now = distance(op.between[0], op.between[1]);
    if (!(now > 1e-4)) return refused(say("These two places lie on each other; take two that are far apart."));
    keeping(op.between[0], [&] { lies.width *= op.apart / now; });
  }
  if (!op.upright.empty()) {
    if (op.upright.size() != 2)
      return refused(say("A line to be turned upright has two places; {0} were given.", op.upright.size()));
    const Flat way = op.upright[1] - op.upright[0];
    if (!(length(way) > 1e-4)) return refused(say("These two places lie on each other; take two that are far apart."));
    double by = std::atan2(way.u, way.v);  // from upright, clockwise
    if (std::fabs(by) > 0.5 * std::numbers::pi) by -= std::copysign(std::numbers::pi, by);
    keeping(op.upright[0], [&] { lies.turn = std::remainder(lies.turn + by, 2 * std::numbers::pi); });
  }
  if (const Done sound = checkUnderlay(lies); !sound) return sound.error();
  return lies;
}

}  // namespace

Done resolve(const Document& before, LayUnderlay& op, Context& context) {
  if (const Done name = resolveName(before, op); !name) return name;
  if (op.none) return {};
  if (op.rectangle && op.corners.empty())
    return refused(say("A rectangle has four corners; {0} were given.", op.corners.size()));
  if (!op.corners.empty())
    if (const Done straight = straighten(before, op, context); !straight) return straight;
  const auto lies = laid(before, op, context);
  return lies ? Done() : Done(lies.error());
}

Result<Document> perform(const Document& before, const LayUnderlay& op, Context& context) {
  Document after = before;
  if (op.none) {
    after.underlays.erase(op.name);
    return after;
  }
  auto lies = laid(before, op, context);
  if (!lies) return lies.error();
  after.underlays[op.name] = *std::move(lies);
  return after;
}

}  // namespace karinui
