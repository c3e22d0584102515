#pragma once
// How a garment fits while its wearer moves: the same garment brought to rest in one pose after another, each time from
// where it stands now. The document is left as it is. Long; any thread, with its own context.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/drape.h"
#include "karinui/session/fit.h"

namespace karinui {

// Edges of a garment that nothing is sewn to, by where they lie on the body.
enum class OpenEdge { Neck, Waist, Hem, Cuff };  // Neck: armholes of a sleeveless garment too
inline constexpr std::array kOpenEdges{OpenEdge::Neck, OpenEdge::Waist, OpenEdge::Hem, OpenEdge::Cuff};
Message openEdgeSaid(OpenEdge edge);

struct FitInPose {
  std::string name;  // of the pose; empty: as the garment stands now
  Message said;
  std::optional<Message> refused;  // why this figure cannot take the pose, or the garment not follow; then only this
  Document document;               // the garment at rest in it
  BodyPtr body;
  bool settled = false;
  StrainReport strain;
  std::optional<PressureReport> pressure;
  SnapshotPtr garment;            // of that document
  std::vector<float> pressureAt;  // pressureOnBody() of it
  // How far such edges slid over the skin since the first pose, on average, metres: towards the trunk along an arm,
  // upwards elsewhere; what lies beside a hand now is left out. None: the garment has no such edge.
  std::array<std::optional<double>, kOpenEdges.size()> slid{};
};

// The garment as it stands now, brought to rest if it is not, and then in each pose. Refused: no body, or a pose that
// does not exist. A pose that this figure cannot take is told as one, and the others are looked at all the same.
// `each` is told of every pose that is ready, on the caller's thread.
Result<std::vector<FitInPose>> fitInMotion(const Document& document, const std::vector<std::string>& poses,
                                           Context& context, const std::function<void(const FitInPose&)>& each = {});

// As a table for other programs: RFC 4180, shares, pascals, metres.
std::string csvOf(const std::vector<FitInPose>& fits);

}  // namespace karinui
