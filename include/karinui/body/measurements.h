#pragma once
// What a tape says of a person. Keys are the ISO 8559-1 names in snake case (bust_girth, waist_girth, height, …), in
// metres; shoulder_slope and arm_angle in radians. FreeSewing, GarmentCode and Valentina names are accepted as aliases.
// arm_length is the tape from the shoulder point over the elbow to the wrist, as all of these mean it; arm_joint_length
// runs along the bones instead, from the middle of the shoulder joint, so that it does not depend on the flesh.
// docs/user/body.md says how each is taken. Pure functions, any thread.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

// Which family of body shapes a mannequin is made from. Child: a girl or a boy up to about twelve.
enum class Sex { Female, Male, Child };
inline constexpr Sex kSexes[] = {Sex::Female, Sex::Male, Sex::Child};
constexpr std::string_view sexName(Sex sex) {
  return sex == Sex::Female ? "female" : sex == Sex::Male ? "male" : "child";
}
std::optional<Sex> sexNamed(std::string_view name);

struct Measurements {
  Sex sex = Sex::Female;
  std::map<std::string, double> value;  // only what is stated or measured
  bool operator==(const Measurements&) const = default;
};

// "waist", "waistGirth", "waist_girth" -> "waist_girth"; an unknown name lists near ones.
Result<std::string> measurementKey(std::string_view anyName);
std::span<const std::string_view> measurementKeys();      // everything measure() may say
std::span<const std::string_view> mannequinKeys();        // those a mannequin can be made to
bool isAngle(std::string_view key);                       // radians instead of metres
Message measureSaid(std::string_view key, double value);  // "88.0 cm", "12°"
// A size on which some measures are a person's own. A belly of her own takes the place of the size's waist.
Measurements withOwn(Measurements size, const std::map<std::string, double>& own);

// Every stated number is one a person from 1.10 m up can have and they go together; else which is wrong, how much.
Done plausible(const Measurements& stated);

}  // namespace karinui
