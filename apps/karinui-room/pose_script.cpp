#include "pose_script.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "karinui/base/file.h"

namespace karinui::room {

namespace {

template <class Value>
const Value* holding(const std::map<long, Value>& lines, long picture) {
  const auto after = lines.upper_bound(picture);
  return after == lines.begin() ? nullptr : &std::prev(after)->second;
}

constexpr double kFarthest = 1000;  // metres; a runtime hands places on as floats

bool readPose(std::istringstream& words, Rigid& pose) {
  words >> pose.carry.x >> pose.carry.y >> pose.carry.z >> pose.w >> pose.x >> pose.y >> pose.z;
  if (!words) return false;
  const double size = std::sqrt(pose.w * pose.w + pose.x * pose.x + pose.y * pose.y + pose.z * pose.z);
  const auto inRoom = [](double v) { return std::fabs(v) <= kFarthest; };
  return inRoom(pose.carry.x) && inRoom(pose.carry.y) && inRoom(pose.carry.z) && std::fabs(size - 1) < 1e-3;
}

bool isEvent(const std::string& what) {
  static const std::vector<std::string> known{"wait on",      "wait off",      "end",        "focus off",
                                              "focus on",     "visible off",   "visible on", "session lost",
                                              "headset gone", "instance lost", "recentre"};
  constexpr std::string_view kPicture = "picture ";
  if (what.starts_with(kPicture)) return isPlainName(std::string_view(what).substr(kPicture.size()));
  return std::find(known.begin(), known.end(), what) != known.end();
}

std::string poseText(const Rigid& p) {
  char said[256];
  std::snprintf(said, sizeof said, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g", p.carry.x, p.carry.y, p.carry.z, p.w, p.x, p.y,
                p.z);
  return said;
}

}  // namespace

Rigid asFloats(const Rigid& p) {
  const auto f = [](double v) { return static_cast<double>(static_cast<float>(v)); };
  return {f(p.w), f(p.x), f(p.y), f(p.z), {f(p.carry.x), f(p.carry.y), f(p.carry.z)}};
}

std::optional<Rigid> PoseScript::headAt(long picture) const {
  const Rigid* found = holding(head, picture);
  return found ? std::optional(*found) : std::nullopt;
}

ControllerState PoseScript::handAt(std::size_t side, long picture) const {
  const ControllerState* found = holding(hands[side], picture);
  return found ? *found : ControllerState();
}

long PoseScript::end() const {
  long last = 0;
  for (const Event& event : events) {
    if (event.what == "end") return event.picture;
    last = std::max(last, event.picture);
  }
  if (!head.empty()) last = std::max(last, head.rbegin()->first);
  for (const auto& hand : hands)
    if (!hand.empty()) last = std::max(last, hand.rbegin()->first);
  return last + 1;
}

Result<PoseScript> parsePoseScript(std::string_view all) {
  PoseScript script;
  std::istringstream lines{std::string(all)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    long picture = 0;
    std::string what;
    if (!(words >> picture)) {
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      return badInput(say("Line {0} of the recorded poses begins with no picture's number: {1}", number, line));
    }
    const auto bad = [&] { return badInput(say("Line {0} of the recorded poses cannot be read: {1}", number, line)); };
    if (picture < 0 || picture > kLongestScript || !(words >> what)) return bad();
    if (what == "head") {
      Rigid pose;
      if (!readPose(words, pose)) return bad();
      script.head[picture] = asFloats(pose);
    } else if (what == "left" || what == "right") {
      ControllerState hand;
      const auto start = words.tellg();
      std::string first;
      words >> first;
      if (first != "lost") {
        words.clear(), words.seekg(start);
        hand.tracked = true;
        if (!readPose(words, hand.aim)) return bad();
        hand.grip = hand.aim = asFloats(hand.aim);
        for (std::string name; words >> name;) {
          if (name == "trigger")
            words >> hand.trigger;
          else if (name == "hold")
            words >> hand.hold;
          else if (name == "stick")
            words >> hand.stick.u >> hand.stick.v;
          else if (name == "confirm")
            hand.confirm = true;
          else if (name == "cancel")
            hand.cancel = true;
          else if (name == "scale")
            hand.scaleSwitch = true;
          else
            return bad();
          if (words.fail()) return bad();
        }
        for (const double value : {hand.trigger, hand.hold, hand.stick.u, hand.stick.v})
          if (!(std::fabs(value) <= 1)) return bad();
      }
      script.hands[what == "left" ? 0 : 1][picture] = hand;
    } else {
      std::string rest;
      std::getline(words, rest);
      what += rest;
      while (what.ends_with(' ') || what.ends_with('\r')) what.pop_back();
      if (!isEvent(what)) return bad();
      script.events.push_back({picture, what});
    }
  }
  std::stable_sort(script.events.begin(), script.events.end(),
                   [](const auto& a, const auto& b) { return a.picture < b.picture; });
  return script;
}

std::string handLine(long picture, std::size_t side, const ControllerState& hand) {
  std::string line = std::to_string(picture) + (side == 0 ? " left " : " right ");
  if (!hand.tracked) return line + "lost\n";
  line += poseText(hand.aim);
  char said[64];
  const auto number = [&](const char* name, double value) {
    if (value == 0) return;
    std::snprintf(said, sizeof said, " %s %.9g", name, value);
    line += said;
  };
  number("trigger", hand.trigger), number("hold", hand.hold);
  if (!(hand.stick == Flat{})) {
    std::snprintf(said, sizeof said, " stick %.9g %.9g", hand.stick.u, hand.stick.v);
    line += said;
  }
  line += hand.confirm ? " confirm" : "";
  line += hand.cancel ? " cancel" : "";
  line += hand.scaleSwitch ? " scale" : "";
  return line + "\n";
}

std::string headLine(long picture, const Rigid& head) {
  return std::to_string(picture) + " head " + poseText(head) + "\n";
}

}  // namespace karinui::room
