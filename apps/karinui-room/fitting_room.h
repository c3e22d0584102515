#pragma once
// The room without headset and without pictures: two controllers and a head work a session, its menus hang before the
// person, and the hands feel. Knows neither OpenXR nor OpenGL, so that tests can be its hands. One thread.
#include <array>
#include <filesystem>
#include <vector>

#include "choice_board.h"
#include "controller_mapper.h"
#include "haptic_cues.h"
#include "karinui/session/session.h"
#include "menu_anchor.h"
#include "pattern_table.h"
#include "placement.h"
#include "tool_boards.h"

namespace karinui::room {

inline constexpr double kUnseen = 3;        // seconds without the tool hand until that is told
inline constexpr double kMenuBelow = 0.10;  // metres the menu's middle hangs below the eyes

struct RoomOptions {
  Scale scale = Scale::One;
  bool left = false;  // the left hand holds the tool; menu and table change sides
  Posture posture;
  Language language = Language::English;
  std::filesystem::path documents;  // where Keep moves a draft; empty: there is no Keep
};

// A sentence that is read in the air for a while.
struct Caption {
  Notice notice;
  double until = 0;
};

class FittingRoom {
 public:
  enum Side : std::size_t { kLeft = 0, kRight = 1 };
  using Hands = std::array<ControllerState, 2>;

  FittingRoom(Session& session, RoomOptions options);

  // One picture's worth of input. `head` and the hands: in the room; seconds since any fixed moment, never backwards.
  void step(const Rigid& head, const Hands& hands, double seconds);
  // The hands are gone (focus, session or headset lost): a drag that was under way is dropped, nothing else.
  void dropHands();
  // The same room space no more (the person recentred, another headset): the fitting is placed anew at the next step.
  void placeAnew() { placed_ = false; }
  void setFloor(std::optional<double> height) { options_.posture.floor = height; }

  // --- to be drawn
  Session& session() { return session_; }
  const Session& session() const { return session_; }
  const Placement& placement() const { return placement_; }
  const PatternTable& table() const { return table_; }
  const RoomOptions& options() const { return options_; }
  Scale scale() const { return options_.scale; }
  bool holding() const { return grip_.holding(); }
  double vignette() const { return vignette_; }  // 0 to 1
  const MenuAnchor& anchor() const { return anchor_; }
  struct HandShown {
    bool seen = false, tool = false;
    Rigid grip;              // in the stand
    std::optional<Ray> ray;  // of the tool hand, in the stand
    double along = 0;        // metres to what it meets
    bool touching = false, down = false;
  };
  const std::array<HandShown, 2>& hands() const { return shown_; }
  std::optional<SceneMenu> menu() const { return session_.menu(); }  // in the fitting
  SceneMenu strip() const;                                           // in the fitting
  // Where something is to be chosen: how a seam is meant, or from the list that the strip's "More" opens.
  const std::optional<Choice>& choice() const { return choice_; }
  const std::vector<Caption>& captions() const { return captions_; }
  Message hint() const;                                  // what to do now
  std::optional<Message> working() const;                // what is being worked out, where that takes a while
  bool toolUnseen() const { return unseen_ > kUnseen; }  // for a while: asleep, laid down, or the wrong hand's
  Viewpoint menuViewpoint() const;                       // in the fitting
  // How near to eyes that are there a board has to hang to stand before the figure and not in it or behind it: a share
  // of the way. All in the stand.
  double clearShare(Vec3 eyes, Vec3 corner, Vec3 across, Vec3 upward) const;

  // --- to be felt, since the last call: for the left and the right controller
  std::array<std::vector<HapticPulse>, 2> takeHapticPulses();

 private:
  std::size_t toolSide() const { return options_.left ? kLeft : kRight; }
  bool dragging() const { return input_.down() && session_.begun(); }
  void buttons(const ControllerState& tool, const ControllerState& other);
  void sticks(const ControllerState& other, double passed);
  void point(const Rigid& head, const ControllerState& tool, const ControllerState& other, double seconds);
  bool onBoards(const PointerSample& sample);  // then it is not for the session
  void perform(const Offer& offer);
  void pressOnChoice(std::size_t item);
  void pressOnNumber(const DropMenu& menu, std::size_t button);
  void changeScale(const Rigid& head);
  void keep();
  void hangChoice(const Rigid& head);
  void takeNotices(double seconds);
  void takeView(const Rigid& head);
  void hangMenuClear();
  PointerSample inStand(PointerSample sample) const;

  Session& session_;
  RoomOptions options_;
  Placement placement_;
  bool placed_ = false, changeScale_ = false;
  MenuAnchor anchor_;
  GrabLocomotion grip_;
  AnalogButton toolGrip_, otherGrip_;
  ControllerMapper input_;
  HapticCues haptics_;
  PatternTable table_;
  std::uint64_t tableOf_ = ~0ull;
  std::array<HandShown, 2> shown_;
  std::array<std::vector<HapticPulse>, 2> pulses_;
  ControllerState toolBefore_, otherBefore_;
  bool handsBack_ = true;   // what they press now was pressed before
  bool boardDown_ = false;  // the trigger was pressed on a board of ours
  bool overBoard_ = false;  // the last sample was on one
  std::optional<std::size_t> hotStrip_, hotChoice_;
  std::optional<Choice> choice_;
  std::optional<RoomCommand> list_;      // that was opened; what is to be chosen of a seam goes before it
  std::optional<RoomCommand> choiceOf_;  // the list that hangs as the choice; none: what a seam needs
  std::optional<double> number_;         // that is turned up and down instead of typed
  std::vector<Caption> captions_;
  double unseen_ = 0, busy_ = 0;                     // seconds
  double vignette_ = 0, before_ = 0, menuNear_ = 1;  // a share of the menu's distance
  bool begun_ = false;
};

}  // namespace karinui::room
