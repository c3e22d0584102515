#pragma once
// The figure, the variables of formulas and the settings of a document.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/body/body.h"
#include "karinui/design/document.h"
#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

// body size=jis9ar            body size=eu38 form=yes            body size=eu38 set="bust_girth=90cm; waist=72cm" body
// mesh=<hash of a blob>
struct SetBody {
  static constexpr std::string_view kName = "body";
  static constexpr std::string_view kHelp = "Chooses the figure: a built-in size, measurements, or an imported mesh.";
  static constexpr bool kDisturbsDrape = true;
  std::string size;
  std::optional<Sex> sex;
  std::vector<Stated> set;
  bool form = false;
  std::string mesh;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("size", self.size,
          "a built-in size to start from: jis9ar, eu38, eu50, child128 …; karinui body sizes lists them", kOptional);
    visit("sex", self.sex, "female, male or child: which family of shapes (a size brings its own)", kOptional);
    visit("set", self.set, "measurements: bust_girth=88cm; waist_girth=70cm, or formulas of each other", kOptional);
    visit("form", self.form, "yes: a dress form on a stand, without head, arms and legs", kOptional);
    visit("mesh", self.mesh, "an imported mesh, by its name among the document's blobs", kOptional);
  }
  bool operator==(const SetBody&) const = default;
};

// pose name=seated        pose joint=left_elbow flex=90deg        pose name=T joint=elbow flex=20deg
struct PoseBody {
  static constexpr std::string_view kName = "pose";
  static constexpr std::string_view kHelp =
      "Puts the figure into a pose, by name or joint by joint; the garment is carried along.";
  static constexpr bool kDisturbsDrape = true;
  std::string name;
  std::vector<std::string> joint;
  std::optional<Angle> flex, abduct, turn;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "A (the figure's own), T, arms_down, forward, overhead, hands_on_hips, step, seated, bent",
          kOptional);
    visit("joint", self.joint, "joints to set: left_elbow, or elbow for both sides", kOptional);
    visit("flex", self.flex, "forwards; of elbow and knee: bent", kOptional);
    visit("abduct", self.abduct, "sideways, away from the middle; of the trunk: to the left", kOptional);
    visit("turn", self.turn, "about the bone: inwards; of the trunk: to the left", kOptional);
  }
  bool operator==(const PoseBody&) const = default;
};

// variable name=cuff value="wrist_girth + 4cm"        variable name=cuff remove=yes
struct SetVariable {
  static constexpr std::string_view kName = "variable";
  static constexpr std::string_view kHelp = "Gives a formula a name, for other formulas; worked out where it is used.";
  std::string name, value;
  bool remove = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "letters, digits and _; no measure's name", kNeeded);
    visit("value", self.value, "a length, an angle or a number: 4cm, wrist_girth + 4cm, front.side_left/3", kOptional);
    visit("remove", self.remove, "yes: there is no such variable any more", kOptional);
  }
  bool operator==(const SetVariable&) const = default;
};

struct ChangeSettings {
  static constexpr std::string_view kName = "set";
  static constexpr std::string_view kHelp = "Changes the document's settings.";
  std::optional<Length> spacing, ease;
  std::optional<Settings::Collider> collider;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("spacing", self.spacing, "between the lattice's threads", kOptional);
    visit("ease", self.ease, "between the body and new pieces", kOptional);
    visit("collider", self.collider, "what stops the cloth: field, or planes (the historical merged planes)",
          kOptional);
  }
  bool operator==(const ChangeSettings&) const = default;
};

using FigureOperations = OperationList<SetBody, PoseBody, SetVariable, ChangeSettings>;

}  // namespace karinui
