#pragma once
// What the boards offer beside the floating bar: the strip next to it, and the list that its "More" opens. Commands are
// the rows of commands(): whatever is on neither bar nor strip is on the list. Only what a headset needs of its own is
// added. Pure; one thread, the session's.
#include <variant>
#include <vector>

#include "karinui/session/session.h"
#include "placement.h"

namespace karinui::room {

// More, Figure and Fabric open a list (or close it again), the others are done.
enum class RoomCommand { More, Figure, Fabric, ChangeScale, Keep };

struct Offer {
  std::variant<Command, RoomCommand, Operation> what;
  Message label;
  bool enabled = true, chosen = false;
};

// `opened`: the list that hangs. `keeps`: a draft can be given a place.
std::vector<Offer> stripOffers(const Session& session, Scale scale, std::optional<RoomCommand> opened, bool keeps);
// Of More: all other commands; of Figure: the built-in sizes; of Fabric: the shop's and the document's, for the chosen
// pieces or all. Nothing for the others.
std::vector<Offer> listOffers(const Session& session, RoomCommand list);
Message titleOf(RoomCommand list);

}  // namespace karinui::room
