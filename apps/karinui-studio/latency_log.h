#pragma once
// How long things take for the person: from an event to the picture that shows it, from a drag to its preview, from
// letting go to the first new drape and to rest. Milliseconds; GUI thread.
#include <QElapsedTimer>
#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace karinui::studio {

class LatencyLog {
 public:
  LatencyLog() { clock_.start(); }
  double now() const { return static_cast<double>(clock_.nsecsElapsed()) * 1e-6; }
  void begin(const std::string& what) { begun_.try_emplace(what, now()); }  // the oldest counts until it is shown
  void end(const std::string& what) {
    const auto at = begun_.find(what);
    if (at == begun_.end()) return;
    taken_[what].push_back(now() - at->second);
    begun_.erase(at);
  }
  void forget(const std::string& what) { begun_.erase(what); }
  // p in [0, 1]; negative: never happened.
  double quantile(const std::string& what, double p) const {
    const auto at = taken_.find(what);
    if (at == taken_.end() || at->second.empty()) return -1;
    std::vector<double> sorted = at->second;
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(p * static_cast<double>(sorted.size())))];
  }
  std::size_t count(const std::string& what) const {
    const auto at = taken_.find(what);
    return at == taken_.end() ? 0 : at->second.size();
  }

 private:
  QElapsedTimer clock_;
  std::map<std::string, double> begun_;
  std::map<std::string, std::vector<double>> taken_;
};

}  // namespace karinui::studio
