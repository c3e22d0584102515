#include "report.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <numeric>

#include "karinui/design/script.h"

namespace karinui::room {

double monotonicSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double LatencyStats::mean() const {
  return all_.empty() ? 0 : std::accumulate(all_.begin(), all_.end(), 0.0) / static_cast<double>(all_.size());
}

double LatencyStats::share(double part) const {
  if (all_.empty()) return 0;
  std::vector<double> sorted = all_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1) + 0.5)];
}

std::string json(const RoomReport& r, const Session& session) {
  const auto part = [](const LatencyStats& d) {
    return nlohmann::ordered_json{
        {"mean", d.mean()}, {"median", d.share(0.5)}, {"p95", d.share(0.95)}, {"most", d.share(1)}};
  };
  nlohmann::ordered_json out;
  out["runtime"] = r.runtime, out["system"] = r.system, out["driver"] = r.driver;
  out["space"] = r.space, out["swapchain_format"] = r.format;
  out["profiles"] = r.profiles;
  out["session_states"] = r.states;
  out["failed_calls"] = r.failures;
  out["said"] = r.said;
  out["sessions"] = r.sessions, out["pictures"] = r.pictures, out["pictures_not_drawn"] = r.undrawn;
  out["pictures_while_draping"] = r.whileDraping, out["pulses"] = r.pulses;
  out["milliseconds"] = {{"poses_to_session", part(r.input)},
                         {"poses_to_graphics_memory", part(r.taken)},
                         {"poses_to_drawn", part(r.drawn)},
                         {"poses_to_submitted", part(r.submitted)},
                         {"waiting_for_the_headset", part(r.waited)}};
  nlohmann::ordered_json steps = nlohmann::ordered_json::array();
  for (const Step& step : session.steps()) steps.push_back(text(step.operation));
  out["document"] = {{"path", session.path().string()},
                     {"hash", hash(session.snapshot().document)},
                     {"drape_hash", drapeHash(session.snapshot().document)},
                     {"steps", steps}};
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace karinui::room
