#include "karinui/scene/pointer.h"

#include <algorithm>
#include <array>
#include <vector>

#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::array<std::string_view, 4> kPhases{"hover", "press", "drag", "release"};
constexpr std::array<std::string_view, 4> kDevices{"mouse", "space_mouse", "stylus", "controller"};
constexpr std::array<std::string_view, 3> kHands{"either", "left", "right"};

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

std::string text(Vec3 v) { return shortest(v.x) + " " + shortest(v.y) + " " + shortest(v.z); }

}  // namespace

std::string text(const PointerSample& sample) {
  const bool space = sample.where == PointerSample::Where::Space;
  std::string line(kPhases[static_cast<std::size_t>(sample.phase)]);
  line += (space ? " space " : " table ") + shortest(sample.seconds) + " ";
  if (space)
    line += text(sample.ray.origin) + " " + text(sample.ray.direction) + " " + text(sample.facing);
  else
    line += shortest(sample.place.u) + " " + shortest(sample.place.v);
  line += " reach " + shortest(sample.reach);
  if (sample.shift) line += " shift";
  if (sample.control) line += " control";
  if (sample.alt) line += " alt";
  if (const auto& tip = sample.tip) {
    line += " tip " + text(tip->carry);
    for (const double part : {tip->w, tip->x, tip->y, tip->z}) line += " " + shortest(part);
  }
  if (sample.second) line += " second";
  if (sample.trigger != 0) line += " trigger " + shortest(sample.trigger);
  if (sample.grip != 0) line += " grip " + shortest(sample.grip);
  if (sample.device != PointerSample::Device::Mouse)
    line += " device " + std::string(kDevices[static_cast<std::size_t>(sample.device)]);
  if (sample.hand != PointerSample::Hand::Either)
    line += " hand " + std::string(kHands[static_cast<std::size_t>(sample.hand)]);
  return line;
}

Result<PointerSample> parsePointerSample(std::string_view line) {
  const std::vector<std::string_view> words = wordsOf(line);
  const Error wrong = badInput(say("“{0}” is no line of a recorded pointer.", line));
  PointerSample sample;
  if (words.size() < 5) return wrong;
  const auto phase = std::find(kPhases.begin(), kPhases.end(), words[0]);
  if (phase == kPhases.end() || (words[1] != "space" && words[1] != "table")) return wrong;
  sample.phase = static_cast<PointerSample::Phase>(phase - kPhases.begin());
  sample.where = words[1] == "space" ? PointerSample::Where::Space : PointerSample::Where::Table;
  std::size_t next = 2;
  const auto numbers = [&](std::initializer_list<double*> wanted) {
    for (double* value : wanted) {
      const auto number = next < words.size() ? parseNumber(words[next++]) : std::nullopt;
      if (!number) return false;
      *value = *number;
    }
    return true;
  };
  const auto vector = [&](Vec3& v) { return numbers({&v.x, &v.y, &v.z}); };
  const auto name = [&]<class Value>(const auto& names, Value& value) {
    const auto found = next < words.size() ? std::find(names.begin(), names.end(), words[next++]) : names.end();
    if (found == names.end()) return false;
    value = static_cast<Value>(found - names.begin());
    return true;
  };
  if (!numbers({&sample.seconds})) return wrong;
  if (sample.where == PointerSample::Where::Space
          ? !vector(sample.ray.origin) || !vector(sample.ray.direction) || !vector(sample.facing)
          : !numbers({&sample.place.u, &sample.place.v}))
    return wrong;
  while (next < words.size()) {
    const std::string_view word = words[next++];
    if (word == "shift") {
      sample.shift = true;
    } else if (word == "control") {
      sample.control = true;
    } else if (word == "alt") {
      sample.alt = true;
    } else if (word == "second") {
      sample.second = true;
    } else if (word == "tip") {
      Rigid& tip = sample.tip.emplace();
      if (!vector(tip.carry) || !numbers({&tip.w, &tip.x, &tip.y, &tip.z})) return wrong;
    } else if (!(word == "reach"     ? numbers({&sample.reach})
                 : word == "trigger" ? numbers({&sample.trigger})
                 : word == "grip"    ? numbers({&sample.grip})
                 : word == "device"  ? name(kDevices, sample.device)
                                     : word == "hand" && name(kHands, sample.hand))) {
      return wrong;
    }
  }
  return sample;
}

}  // namespace karinui
