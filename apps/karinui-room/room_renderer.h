#pragma once
// The room as pictures: takes in what a FittingRoom has to show once, then draws it for any number of eyes. Needs
// OpenGL 3.3 core; every call, and the end of its life, belongs to the thread in which its context is current.
#include <memory>

#include "board_images.h"
#include "eye_view.h"
#include "fitting_room.h"
#include "karinui/session/view_cut.h"
#include "karinui/view/boards.h"
#include "karinui/view/renderer.h"

namespace karinui::room {

class RoomRenderer {
 public:
  // `plain`: where the processor draws; coarser shadows.
  static Result<std::unique_ptr<RoomRenderer>> make(bool plain);
  ~RoomRenderer();
  RoomRenderer(const RoomRenderer&) = delete;
  RoomRenderer& operator=(const RoomRenderer&) = delete;

  // Copies what changed to the graphics memory. `eyes`: between the eyes, in the room: words face it.
  void take(const FittingRoom& room, const Rigid& eyes, double seconds);
  // Into the framebuffer that is bound; `eye` in the room.
  void draw(const Rigid& eye, const FieldOfView& fov, const DrawArea& area) const;
  // Lines of a test's own, in the fitting: a marker whose place in both pictures is known.
  void mark(std::vector<SceneLine> lines);
  std::vector<Message> takeNotes();

 private:
  RoomRenderer() = default;
  void takeGarment(const FittingRoom& room, double seconds);
  void takeTable(const FittingRoom& room);
  void takeLines(const FittingRoom& room);
  void takeBoards(const FittingRoom& room, const Rigid& eyes);
  void addHands(const FittingRoom& room, std::vector<SceneLine>& lines) const;
  // Boards hang in the stand's space; `eyes`, too.
  enum class Where { Fitting, Stand };
  void addWords(const FittingRoom& room, Vec3 eyes, std::vector<Board>& boards);
  void addPanel(const SceneMenu& panel, Where where, int pixels, Language language, std::vector<Board>& boards);
  void addTitle(const Choice& choice, Language language, std::vector<Board>& boards);
  Board toldBoard(const FittingRoom& room);

  std::unique_ptr<Renderer> garment_, table_;
  std::unique_ptr<Boards> boards_;
  BoardImages images_;
  Placement placement_;
  double vignette_ = 0;
  std::vector<SceneLine> marks_, threads_;
  std::vector<SceneLabel> tableLabels_;
  LetteringRooms letteringRooms_;
  std::uint64_t garmentShown_ = ~0ull;
  DrawnTable drawnTable_;
  std::shared_ptr<const VisibleParts> visible_;  // of this body, by this cut
  BodyPtr visibleOf_;
  ViewCut visibleCut_;
  bool carried_ = false, soft_ = false;
  double changed_ = 0;
  std::optional<double> litFor_;
};

}  // namespace karinui::room
