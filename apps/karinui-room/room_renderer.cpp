#include "room_renderer.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/said_lengths.h"
#include "karinui/body/body.h"
#include "karinui/body/lines.h"
#include "karinui/design/step_words.h"

namespace karinui::room {

namespace {

constexpr double kNear = 0.05, kFar = 60;                 // metres in the room
constexpr double kStill = 0.2;                            // seconds until the soft light is worked out anew
constexpr int kPanelPixels = 160;                         // of the menu's width
constexpr int kSentencePixels = 640, kSentenceFont = 34;  // a board's width, its letters' height
constexpr double kLabelHigh = 1.3;   // of a label's plate on the table, in its font's heights; lines are 1.35
constexpr double kWordHigh = 0.026;  // of a word, radians
constexpr double kSaidAside = 0.42, kSaidFar = 0.80, kSaidBelow = -0.06, kSaidWide = 0.32;  // radians, metres
constexpr Colour kHand{0.10f, 0.10f, 0.12f}, kOtherHand{0.35f, 0.34f, 0.33f}, kRay{0.70f, 0.16f, 0.04f},
    kRayUp{0.90f, 0.80f, 0.62f}, kPicked{0.86f, 0.26f, 0.08f}, kEdge{0.05f, 0.25f, 0.62f};

// Hangs a picture before the eyes: its middle there, upright, so high.
Board facing(ImagePtr image, Vec3 middle, Vec3 eyes, double high) {
  Board board;
  const Vec3 back = normalized(eyes - middle);
  Vec3 right = normalized(cross(Vec3{0, 1, 0}, back));
  if (right == Vec3{}) right = {1, 0, 0};
  const Vec3 up = cross(back, right);
  board.across = right * (high * image->width / std::max(1, image->height));
  board.upward = up * high;
  board.corner = middle - board.across * 0.5 - board.upward * 0.5;
  board.image = std::move(image);
  return board;
}

// A dot is a line of no length: round, and alike for both eyes.
SceneLine dotAt(Vec3 at, const Colour& colour, float widthMm) {
  return {{at - Vec3{0, 1e-4, 0}, at + Vec3{0, 1e-4, 0}}, colour, widthMm, false};
}

// A sentence as it is read in the room: names and labels, no script.
std::string inWords(const Message& message, Language language) {
  return text(
      message, language, nullptr, [](std::string_view name) { return identifierSaid(name); }, withoutScript);
}

// The tool and what to do with it, what its keys are in the hand, what was said and how far a drape is.
std::vector<BoardImages::Line> toldLines(const FittingRoom& room) {
  const Language language = room.options().language;
  std::vector<BoardImages::Line> lines;
  const CommandInfo& tool = info(room.session().tool());
  const Message hint = room.hint();
  lines.push_back({text(tool.label, language) + " – " + text(hint, language), Tone::Plain});
  const std::string english = text(hint, Language::English);
  const auto names = [&](const char* key) { return english.find(key) != std::string::npos; };
  if (names("Shift") || names("Ctrl") || names("Alt"))
    lines.push_back(
        {text(say("Shift is the other hand's trigger, Ctrl this hand's stick forwards, Alt backwards."), language),
         Tone::Plain});
  if (names("Enter") || names("Esc"))
    lines.push_back({text(say("Enter is Finish, Esc is Cancel."), language), Tone::Plain});
  if (room.toolUnseen())
    lines.push_back(
        {text(room.options().left
                  ? say("The left controller, which holds the tool, is not seen: switch it on, or hold it up.")
                  : say("The right controller, which holds the tool, is not seen: switch it on, or hold "
                        "it up. For the left hand begin with --left."),
              language),
         Tone::Refused});
  for (const Caption& caption : room.captions())
    lines.push_back(
        {inWords(caption.notice.what, language), caption.notice.kind == Notice::Kind::Refused  ? Tone::Refused
                                                 : caption.notice.kind == Notice::Kind::Advice ? Tone::Advice
                                                                                               : Tone::Plain});
  if (const auto working = room.working()) lines.push_back({text(*working, language), Tone::Plain});
  return lines;
}

}  // namespace

RoomRenderer::~RoomRenderer() = default;

Result<std::unique_ptr<RoomRenderer>> RoomRenderer::make(bool plain) {
  std::unique_ptr<RoomRenderer> made(new RoomRenderer);
  Studio studio;
  studio.allRound = true;
  if (plain) studio.keyMap = 1024, studio.skyDirections = 20, studio.skyMap = 256;
  auto garment = Renderer::make(studio);
  studio.ground = false;
  studio.keyMap = std::min(studio.keyMap, 1024);
  studio.skyDirections = 12, studio.skyMap = 256;
  auto table = Renderer::make(studio);
  if (!garment || !table) return garment ? table.error() : garment.error();
  auto boards = Boards::make();
  if (!boards) return boards.error();
  made->garment_ = std::move(*garment), made->table_ = std::move(*table), made->boards_ = std::move(*boards);
  return made;
}

void RoomRenderer::mark(std::vector<SceneLine> lines) { marks_ = std::move(lines); }
std::vector<Message> RoomRenderer::takeNotes() { return images_.takeNotes(); }

void RoomRenderer::takeGarment(const FittingRoom& room, double seconds) {
  const Session& session = room.session();
  const Preview preview = session.preview();
  const bool carried = !preview.carried.empty();
  const std::uint64_t now = session.changes().garment;
  const bool changed = garmentShown_ != now || carried || carried_;
  if (changed) changed_ = seconds;
  const bool rest = !soft_ && seconds - changed_ > kStill;
  if (changed || rest) {
    const auto shown = session.shownPtr();
    SceneFrame frame = shown->frame;
    for (std::size_t k = 0; k < shown->worn.size(); ++k)
      if (const auto at = preview.carried.find(shown->worn[k].id); at != preview.carried.end())
        for (Vec3& p : frame.cloths[k].mesh.points) p = at->second(p);
    if (session.linesShown() && shown->body && !shown->underWay)
      for (const BodyLine& line : shown->body->lines()) {
        SceneLine drawn{line.points, {0.10f, 0.28f, 0.52f}, 1.6f, false};
        if (line.closed) drawn.points.push_back(drawn.points.front());
        frame.lines.push_back(std::move(drawn));
      }
    if (const ViewCut& cut = session.viewCut(); cut.any()) {
      if (!visible_ || visibleOf_ != shown->body || !(visibleCut_ == cut))
        visible_ = std::make_shared<const VisibleParts>(cut, shown->body), visibleOf_ = shown->body, visibleCut_ = cut;
      visible_->cut(frame, shown->underWay);
    }
    const bool first = garmentShown_ == ~0ull;
    garment_->show(frame, 0, rest || first ? SoftLight::Anew : shown->underWay ? SoftLight::Carried : SoftLight::Kept);
    soft_ = rest || first;
    threads_ = carried ? std::vector<SceneLine>() : threadsOf(*shown);
    garmentShown_ = now;
    carried_ = carried;
    litFor_.reset();
  }
  // The lamps stand in the room: a body that is turned turns under them.
  if (litFor_ != placement_.turn) {
    Camera lamp;
    lamp.target = {0, 1, 0};
    lamp.eye = placement_.standToFitting({0.9, 1.5, 4});
    garment_->light(lamp);
    litFor_ = placement_.turn;
  }
}

void RoomRenderer::takeTable(const FittingRoom& room) {
  if (!drawnTable_.follow(room.session(), room.table())) return;
  TableScene scene = tableSceneFor(room.session(), room.table(), room.options().language, letteringRooms_);
  table_->show(scene.frame, 0, SoftLight::Anew);
  tableLabels_ = std::move(scene.labels);
  Camera lamp;
  lamp.target = {0, 1, 0};
  lamp.eye = {0.9, 1.5, 4};
  table_->light(lamp);
}

void RoomRenderer::takeLines(const FittingRoom& room) {
  const Session& session = room.session();
  const auto shown = session.shownPtr();
  const Preview preview = session.preview();
  std::vector<SceneLine> lines = preview.space.lines;
  lines.insert(lines.end(), threads_.begin(), threads_.end());
  lines.insert(lines.end(), marks_.begin(), marks_.end());
  for (std::size_t k = 0; k < shown->worn.size(); ++k) {
    if (!session.selection().pieces.contains(shown->worn[k].id) || preview.carried.contains(shown->worn[k].id))
      continue;
    const SceneCloth& cloth = shown->frame.cloths[k];
    for (const auto& run : cloth.outlines) {
      SceneLine line{{}, kPicked, 2.4f, false};
      for (const std::uint32_t n : run) line.points.push_back(cloth.mesh.points[n]);
      lines.push_back(std::move(line));
    }
  }
  for (const EdgeRef& edge : session.selection().edges()) {
    auto line = edgeInSpace(*shown, edge);
    if (line.size() > 1) lines.push_back({std::move(line), kEdge, 4, false});
  }
  for (const Vec3 at : preview.space.dots) lines.push_back(dotAt(at, kPicked, 9));
  for (const Vec3 at : preview.space.rings) lines.push_back(dotAt(at, kEdge, 7));
  for (const auto& [id, pins] : shown->document.pins)
    for (const Flat pin : pins)
      if (const auto at = spaceOf(*shown, id, pin)) lines.push_back(dotAt(*at, kRay, 7));
  garment_->overlay(lines);

  lines = linesOnTable(preview.table, room.table());
  for (const auto& [id, outline] : preview.outlines) {
    SceneLine line{{}, kRay, 2.5f, false};
    const Flat lies = session.table().at(id);
    for (const Flat p : outline.flattened(1e-3)) line.points.push_back(room.table().at(p + lies, 0.007));
    if (!line.points.empty()) line.points.push_back(line.points.front());
    lines.push_back(std::move(line));
  }
  addHands(room, lines);
  table_->overlay(lines);
}

void RoomRenderer::addHands(const FittingRoom& room, std::vector<SceneLine>& lines) const {
  const double size = 1 / placement_.scale;  // hands are as large as hands, whatever the fitting's scale
  const auto thick = [&](double mm) { return static_cast<float>(mm * size); };
  for (const auto& hand : room.hands()) {
    if (!hand.seen) continue;
    const Vec3 palm = hand.grip.carry, ahead = hand.ray ? hand.ray->direction : hand.grip.turned({0, 0, -1});
    const Vec3 tip = hand.ray ? hand.ray->origin : palm + ahead * (0.08 * size);
    lines.push_back({{palm + ahead * (-0.05 * size), tip - ahead * (0.02 * size)},
                     hand.tool ? kHand : kOtherHand,
                     thick(22),
                     false});
    lines.push_back({{tip - ahead * (0.02 * size), tip}, hand.tool ? kRay : kOtherHand, thick(9), false});
    // Round ends, or a hand that points straight away from the eye would be nothing.
    lines.push_back(dotAt(palm + ahead * (-0.05 * size), hand.tool ? kHand : kOtherHand, thick(22)));
    if (hand.ray && !hand.touching) {
      const Vec3 end = tip + ahead * hand.along;
      lines.push_back({{tip, end}, hand.down ? kRay : kRayUp, thick(hand.down ? 2.5 : 1.6), false});
      lines.push_back(dotAt(end, hand.down ? kRay : kRayUp, thick(8)));
    }
  }
}

void RoomRenderer::takeBoards(const FittingRoom& room, const Rigid& eyesInRoom) {
  const Language language = room.options().language;
  std::vector<Board> boards;
  addWords(room, placement_.roomToStand(eyesInRoom.carry), boards);
  if (const auto menu = room.menu()) addPanel(*menu, Where::Fitting, kPanelPixels, language, boards);
  addPanel(room.strip(), Where::Fitting, kPanelPixels, language, boards);
  boards.push_back(toldBoard(room));
  if (const auto& choice = room.choice()) {
    addTitle(*choice, language, boards);
    addPanel(choice->panel, Where::Stand, kSentencePixels, language, boards);
  }
  boards_->show(std::move(boards));
  images_.tidy();
}

// Names and numbers beside what they are about, in space and on the table.
void RoomRenderer::addWords(const FittingRoom& room, Vec3 eyes, std::vector<Board>& boards) {
  const Preview preview = room.session().preview();
  std::vector<Board> words;
  const auto word = [&](Vec3 at, const std::string& said) {
    // Towards the eye, or the cloth would swallow its lower half; and above what it is about.
    const Vec3 way = eyes - at;
    const double near = std::max(0.0, length(way) - 0.06 / placement_.scale);
    const double high = kWordHigh * near;
    Board board = facing(images_.word(said), eyes - normalized(way) * near + Vec3{0, high * 0.9, 0}, eyes, high);
    board.overAll = true;
    liftClear(board, words);
    words.push_back(board);
    boards.push_back(std::move(board));
  };
  for (const SceneWord& one : preview.space.words) word(placement_.fittingToStand(one.place), one.text);
  for (const SceneLabel& label : tableLabels_) {
    Board board;
    board.image = images_.word(text(label.words, room.options().language));
    board.upward = label.upward * kLabelHigh;
    board.across = label.along * (length(board.upward) * board.image->width / board.image->height);
    board.corner = label.middle - board.across * 0.5 - board.upward * 0.5;
    boards.push_back(std::move(board));
  }
  for (const TableWord& one : preview.table.words) word(room.table().at(one.place, 0.02), one.text);
}

void RoomRenderer::addPanel(const SceneMenu& panel, Where where, int pixels, Language language,
                            std::vector<Board>& boards) {
  if (panel.buttons.empty()) return;
  Board board;
  board.image = images_.panel(panel, pixels, language);
  const auto turned = [&](Vec3 p) { return where == Where::Fitting ? placement_.fittingToStand(p) : p; };
  board.corner = turned(panel.corner), board.across = turned(panel.across), board.upward = turned(panel.upward);
  boards.push_back(std::move(board));
}

// What to do now, what was said, how far a drape is: on the other side than the menu, where it hides neither.
Board RoomRenderer::toldBoard(const FittingRoom& room) {
  const double aside = room.options().left ? -kSaidAside : kSaidAside;
  const Vec3 before = turnedAboutUp({0, 0, -1}, room.anchor().heading() + aside);
  const Vec3 middle = placement_.roomToStand(room.anchor().eyes() + before * kSaidFar - Vec3{0, kSaidBelow, 0});
  const Vec3 reader = placement_.roomToStand(room.anchor().eyes());
  const ImagePtr said = images_.sentences(toldLines(room), kSentencePixels, kSentenceFont);
  Board board = facing(said, middle, reader, kSaidWide / placement_.scale * said->height / said->width);
  // It grows downwards from its first line.
  board.corner = board.corner - board.upward * 0.5;
  const double share = room.clearShare(reader, board.corner, board.across, board.upward);
  board.corner = reader + (board.corner - reader) * share;
  board.across = board.across * share, board.upward = board.upward * share;
  return board;
}

void RoomRenderer::addTitle(const Choice& choice, Language language, std::vector<Board>& boards) {
  std::vector<BoardImages::Line> title;
  for (const Message& one : choice.title) title.push_back({text(one, language), Tone::Plain});
  if (title.empty()) return;
  Board above;
  above.image = images_.sentences(title, kSentencePixels, kSentenceFont);
  above.across = choice.panel.across;
  above.upward =
      normalized(choice.panel.upward) * (length(choice.panel.across) * above.image->height / above.image->width);
  above.corner = choice.panel.corner + choice.panel.upward * 1.03;
  boards.push_back(std::move(above));
}

void RoomRenderer::take(const FittingRoom& room, const Rigid& eyes, double seconds) {
  placement_ = room.placement();
  vignette_ = room.vignette();
  takeGarment(room, seconds);
  takeTable(room);
  takeLines(room);
  takeBoards(room, eyes);
}

void RoomRenderer::draw(const Rigid& eye, const FieldOfView& fov, const DrawArea& area) const {
  const double near = kNear / placement_.scale, far = kFar / placement_.scale;
  const Eye inFitting = eyeOfFov(placement_.roomToFitting(eye), fov, near, far);
  const Eye inStand = eyeOfFov(placement_.roomToStand(eye), fov, near, far);
  garment_->draw(inFitting, area);
  table_->draw(inStand, area, Onto::Picture);
  garment_->drawOver(inFitting, area);
  table_->drawOver(inStand, area);
  boards_->draw(inStand, area);
  boards_->vignette(inStand, area, vignette_);
}

}  // namespace karinui::room
