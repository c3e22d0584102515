#include "tool_boards.h"

#include <algorithm>
#include <array>

#include "karinui/body/sizes.h"
#include "karinui/design/glossary.h"
#include "karinui/design/variant.h"

namespace karinui::room {

namespace {

constexpr std::array kOnStrip{Command::Select, Command::Confirm, Command::Cancel, Command::Redo};

bool onStrip(Command command) { return std::find(kOnStrip.begin(), kOnStrip.end(), command) != kOnStrip.end(); }

Offer offered(const Session& session, Command command) {
  return {command, info(command).label, session.can(command), isTool(command) && session.tool() == command};
}

// The chosen pieces, or all.
std::vector<PieceRef> cutFrom(const Session& session) {
  std::vector<PieceRef> pieces;
  for (const PieceId id : session.selection().pieces) pieces.push_back(PieceRef(id));
  if (pieces.empty())
    for (const auto& [id, piece] : session.snapshot().document.pattern.pieces) pieces.push_back(PieceRef(id));
  return pieces;
}

std::vector<Offer> fabrics(const Session& session) {
  const Document& document = session.snapshot().document;
  const std::vector<PieceRef> pieces = cutFrom(session);
  std::vector<Offer> all;
  for (const std::string& name : fabricNames(document)) {
    SetFabric set;
    set.name = name;
    set.pieces = pieces;
    const bool chosen = !pieces.empty() && std::all_of(pieces.begin(), pieces.end(), [&](const PieceRef& ref) {
      const auto fabric = fabricOf(document, *document.find(ref.id));
      return fabric && fabric->name == name;
    });
    all.push_back({Operation(std::move(set)), nameSaid(name), !pieces.empty(), chosen});
  }
  return all;
}

// All sizes of the series that is worn, so that one size smaller or larger is at hand; of the others the usual one.
std::vector<std::string_view> sizesOffered(const SetBody* now) {
  std::vector<std::string_view> all;
  for (const SizeSeries& series : sizeSeries()) {
    const bool worn = now && std::any_of(series.sizes.begin(), series.sizes.end(),
                                         [&](const BuiltInSize& size) { return size.name == now->size; });
    for (const BuiltInSize& size : series.sizes)
      if (worn || size.name == series.usual) all.push_back(size.name);
  }
  return all;
}

std::vector<Offer> figures(const Session& session) {
  const SetBody* now = session.figure();
  std::vector<Offer> all;
  for (const std::string_view size : sizesOffered(now)) {
    SetBody body;
    body.size = size;
    body.form = now && now->form;
    all.push_back({Operation(std::move(body)), termSaid(Term::Size, size).value_or(nameSaid(size)), true,
                   now && now->size == size});
  }
  if (now && now->mesh.empty()) {
    SetBody body = *now;
    body.form = !now->form;
    all.push_back({Operation(std::move(body)), say("Dress form"), true, now->form});
  }
  return all;
}

}  // namespace

std::vector<Offer> stripOffers(const Session& session, Scale scale, std::optional<RoomCommand> opened, bool keeps) {
  std::vector<Offer> all;
  for (const Command command : kOnStrip) all.push_back(offered(session, command));
  all.push_back({RoomCommand::More, say("More"), true, opened.has_value()});
  all.push_back({RoomCommand::ChangeScale, scale == Scale::One ? say("On a desk") : say("Life size")});
  if (keeps) all.push_back({RoomCommand::Keep, say("Keep"), !session.path().empty()});
  return all;
}

std::vector<Offer> listOffers(const Session& session, RoomCommand list) {
  if (list == RoomCommand::Figure) return figures(session);
  if (list == RoomCommand::Fabric) return fabrics(session);
  std::vector<Offer> all;
  if (list != RoomCommand::More) return all;
  for (const CommandInfo& one : commands())  // All shows what View does: body and table before the person
    if (!one.onBar && !onStrip(one.command) && one.command != Command::ViewAll)
      all.push_back(offered(session, one.command));
  all.push_back({RoomCommand::Figure, say("Figure")});
  all.push_back({RoomCommand::Fabric, say("Fabric"), !session.snapshot().document.pattern.pieces.empty()});
  return all;
}

Message titleOf(RoomCommand list) {
  if (list == RoomCommand::Figure) return say("The figure that is fitted");
  if (list == RoomCommand::Fabric) return say("The fabric of the chosen pieces, or of all");
  return say("More tools and commands");
}

}  // namespace karinui::room
