#include "karinui/scene/pointer.h"

#include <algorithm>
#include <array>
#include <vector>

#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::array<std::string_view, 4> kPhases{"hover", "press", "drag", "release"};

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
  std::vector<double*> wanted{&sample.seconds};
  if (sample.where == PointerSample::Where::Space)
    for (Vec3* v : {&sample.ray.origin, &sample.ray.direction, &sample.facing})
      wanted.insert(wanted.end(), {&v->x, &v->y, &v->z});
  else
    wanted.insert(wanted.end(), {&sample.place.u, &sample.place.v});
  std::size_t next = 2;
  for (double* value : wanted) {
    const auto number = next < words.size() ? parseNumber(words[next++]) : std::nullopt;
    if (!number) return wrong;
    *value = *number;
  }
  for (; next < words.size(); ++next) {
    if (words[next] == "reach" && next + 1 < words.size()) {
      const auto number = parseNumber(words[++next]);
      if (!number) return wrong;
      sample.reach = *number;
    } else if (words[next] == "shift") {
      sample.shift = true;
    } else if (words[next] == "control") {
      sample.control = true;
    } else if (words[next] == "alt") {
      sample.alt = true;
    } else {
      return wrong;
    }
  }
  return sample;
}

}  // namespace karinui
