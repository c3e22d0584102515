#pragma once
// The headset program between start and end: finds a runtime and a headset, makes picture after picture, and keeps the
// garment through whatever happens to them. One thread; the session works out drapes on its own.
#include <filesystem>
#include <optional>

#include "controllers.h"
#include "fitting_room.h"
#include "pose_script.h"
#include "report.h"
#include "room_renderer.h"

namespace karinui::room {

struct ProgramOptions {
  RoomOptions room;
  std::optional<PoseScript> script;  // hands and events instead of a person's
  std::optional<std::filesystem::path>
      headless;  // a folder for eye pictures and report.json; no window, ends by itself
  enum class Share { Auto, Window, Windowless } share = Share::Auto;
  bool json = false;
};

// Codes the program ends with.
inline constexpr int kEndedWell = 0, kWrongCall = 2, kNoRuntime = 3, kNoHeadset = 4, kNoGraphics = 5, kFailed = 6;

class RoomProgram {
 public:
  RoomProgram(Session& session, ProgramOptions options);
  ~RoomProgram();
  int run();

 private:
  void tell(const Message& what);  // once: in the terminal, in the window's title, in the report
  std::vector<ProgramOptions::Share> waysToShare() const;
  Done openGraphicsAndHeadset();
  Done openGraphics(ProgramOptions::Share way);
  Done openHeadset();
  void closeHeadset();
  void closeGraphics();
  bool makePicture();
  void playEvents();
  bool leavePictures(const std::string& name);
  void finish();
  void idle(double seconds);

  Session& session_;
  ProgramOptions options_;
  FittingRoom room_;
  std::unique_ptr<Graphics> graphics_;
  std::unique_ptr<RoomRenderer> picture_;
  std::unique_ptr<Runtime> runtime_;
  std::unique_ptr<Headset> headset_;
  std::unique_ptr<Controllers> controllers_;
  std::array<std::unique_ptr<EyeTarget>, 2> eyes_;
  RoomReport report_;
  std::string title_;
  long pictures_ = 0;                // waited for, over all sessions: the clock of recorded poses
  std::size_t played_ = 0;           // events of the script
  std::vector<std::string> wanted_;  // pictures to leave of this frame
  std::optional<XrTime> began_;
  double seconds_ = 0;
  bool waits_ = false, ending_ = false, focused_ = false, seen_ = false;
  Rigid head_;
};

}  // namespace karinui::room
