#include "misfit.h"

#include <algorithm>

#include "karinui/base/number.h"
#include "karinui/design/glossary.h"

namespace karinui::app {

namespace {

Message plain(const std::string& words) { return say("{0}", words); }

// A count that came from a file.
std::size_t wholeNumber(double count) { return count >= 1 && count < 1e9 ? static_cast<std::size_t>(count) : 0; }

}  // namespace

std::span<const Message> misfits() {
  static const std::vector<Message> all{
      say("too small"),      say("does not close"), say("crosses the body"), say("stretched"),     say("presses"),
      say("did not settle"), say("refused"),        say("timeout"),          say("out of memory"), say("crashed")};
  return all;
}

std::vector<Misfit> misfitsOf(const BatchTable& table) {
  std::vector<Misfit> all;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string word = table.text(r, "misfit");
    if (word.empty()) continue;
    const char* by = word == "too small"          ? "too_small_m"
                     : word == "does not close"   ? "fastenings_open"
                     : word == "crosses the body" ? "cloth_body_crossings"
                     : word == "stretched"        ? "strain_p99"
                                                  : "pressure_p99_pa";
    const auto kind =
        std::find_if(misfits().begin(), misfits().end(), [&](const Message& known) { return known.pattern == word; }) -
        misfits().begin();
    all.push_back({r, static_cast<std::size_t>(kind), table.number(r, by).value_or(0)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Misfit& a, const Misfit& b) { return a.kind != b.kind ? a.kind < b.kind : a.by > b.by; });
  return all;
}

// By how much, and where; nothing of what has a sentence instead.
std::vector<Message> amountOf(const BatchTable& table, const Misfit& misfit) {
  const std::size_t r = misfit.row;
  const std::string& word = misfits()[misfit.kind].pattern;
  const Message& said = table.said[r];
  if (word == "too small") {
    const bool placed = said.values.size() > 1 && std::holds_alternative<Message>(said.values[1]);
    return {plain(misfit.by < 0.01 ? "< 1 cm" : fixed(100 * misfit.by, 0) + " cm"),
            placed ? std::get<Message>(said.values[1]) : Message()};
  }
  if (word == "stretched") return {plain(fixed(100 * misfit.by, 1) + " %"), nameSaid(table.text(r, "strain_at"))};
  if (word == "presses") {
    const auto place = parseBodyPoint(table.text(r, "pressure_at"));
    return {plain(fixed(misfit.by / 1000, 1) + " kPa"), place ? placeSaid(*place) : Message()};
  }
  if (word == "crosses the body") return {say("{0} {0|place|places}", wholeNumber(misfit.by)), Message()};
  if (word == "does not close") return {say("{0} {0|fastening|fastenings}", wholeNumber(misfit.by)), Message()};
  return {};
}

Message saidOf(const BatchTable& table, const Misfit& misfit) {
  const Message& what = misfits()[misfit.kind];
  std::vector<Message> amount = amountOf(table, misfit);
  if (amount.empty()) return say("{0}: {1}", what, table.said[misfit.row]);
  std::erase_if(amount, [](const Message& part) { return part.empty(); });
  return say("{0}: {1}", what, listSaid(amount));
}

}  // namespace karinui::app
