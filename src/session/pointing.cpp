// Where the hand points: a pointer's samples, and those of a hand that has only keys.
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/design/step_words.h"
#include "session/session_impl.h"

namespace karinui {

using Phase = PointerSample::Phase;
using Where = PointerSample::Where;

namespace {

// A place of the figure as one says it: to a tenth of the way between two levels, to a hundredth of a turn.
std::string nearly(BodyPoint point) {
  const auto levels = chartLevels(point.part);
  if (levels.empty()) return text(point);
  const double tenths = std::round(point.along * 10), turn = std::fmod(std::round(point.around * 100), 100) / 100;
  const auto level = static_cast<std::size_t>(tenths) / 10;
  const double more = (tenths - 10 * static_cast<double>(level)) / 10;
  point.along = 0;
  const std::string part = text(point);
  return part.substr(0, part.find(':') + 1) + std::string(levels[level]) + (more > 0 ? "+" + shortest(more) : "") +
         "@" + shortest(turn);
}

// By the landmark it is on, else by the figure's levels, a little above or below where they do not reach (the very
// crotch), else (between fingers) by height.
Message placeOn(const Body& body, SurfacePoint skin, bool inches) {
  constexpr double kOn = 0.01;  // metres
  const Vec3 place = at(body.mesh(), skin);
  const std::string* nearest = nullptr;
  double least = kOn;
  for (const auto& [name, there] : body.landmarks())
    if (const double away = distance(place, there); away < least) least = away, nearest = &name;
  if (nearest) return say("On the body, at {0}", *nearest);
  for (const double up : {0.0, -0.005, 0.005, -0.015, 0.015})
    if (const auto near = body.bvh().nearest(place + Vec3{0, up, 0}))
      if (const BodyPoint point = body.describe(near->place); point.part != BodyPoint::Part::Face)
        return say("On the body, at {0}", nearly(point));
  return say("On the body, {0} above the floor", lengthSaid(place.y, inches));
}

}  // namespace

// The menu comes first, unless a drag is on its way across it.
bool Session::Impl::overMenu(const PointerSample& sample) {
  const bool wantsMenu = sample.phase == Phase::Hover || sample.phase == Phase::Press || onMenu;
  if (!viewpoint || sample.where != Where::Space || !wantsMenu) return hot.reset(), false;
  const SceneMenu panel = menuPanel(*viewpoint, {});
  Ray ray = sample.ray;
  if (sample.tip) {  // a tip touches the board
    const Vec3 normal = normalized(cross(panel.across, panel.upward)), tip = sample.tip->carry;
    ray = {tip + normal, -normal};
    if (std::fabs(dot(tip - panel.corner, normal)) > sample.reach && !onMenu) return hot.reset(), false;
  }
  hot = menuHit(panel, ray);
  const bool board = meets(panel, ray);
  if (sample.phase == Phase::Press && board) return onMenu = true;
  if (!onMenu) return board;
  if (sample.phase == Phase::Release) onMenu = false;
  return true;
}

void Session::Impl::choose(Selection chosen) {
  if (chosen == selection) return;
  const auto name = [](const Selection& one) {
    return one.edge ? std::pair(one.edge->piece, one.edge->edge) : std::pair(PieceId(), std::string());
  };
  if (name(chosen) != name(selection)) keepWished = SetLength::Keep::Auto;
  selection = std::move(chosen);
  ++changes.overlay;
  if (options.wake) options.wake();
}

// One edge more of several, or one less. Off the edges nothing is chosen or put aside: the hand missed.
Selection Session::Impl::withEdge(const Selection& before, Selection chosen) {
  if (!before.edge) return chosen;
  if (!chosen.edge) return before;
  const auto same = [&](const EdgeNear& one) {
    return one.piece == chosen.edge->piece && one.edge == chosen.edge->edge;
  };
  std::vector<EdgeNear> all = before.more;
  all.push_back(*before.edge);
  if (std::erase_if(all, same) == 0) all.push_back(*chosen.edge);
  Selection now;
  if (all.empty()) return now;
  now.edge = all.back();
  all.pop_back();
  now.more = std::move(all);
  for (const EdgeRef& one : now.edges()) now.pieces.insert(one.piece.id);
  now.seam = seamAt(state.snapshot->document, *now.edge);
  return now;
}

void Session::Impl::carryOnTable(const std::optional<Gesture::Aside>& aside) {
  if (!aside) return;
  for (const PieceId id : aside->pieces) table.carry(id, aside->by);
}

void Session::Impl::point(const PointerSample& sample) {
  if (turnsCrossed())
    if (const auto seam = crossedAt(crossed(), table, sample)) {
      onCross = true;
      if (sample.phase == Phase::Press && !state.readOnly && !stepping()) perform(FlipSeam{SeamRef(*seam)});
      if (sample.phase != Phase::Release) return;
    }
  if (std::exchange(onCross, false)) return;
  const bool begun = gesture->begun();
  const Hit hit = pick(*seen(), table, sample);
  GestureResult answer = gesture->feed(sample, hit, context());
  countClicks();
  if (auto chosen = gesture->chosen()) {
    if (sample.shift) {
      const PieceId piece = *chosen->pieces.begin();
      chosen->pieces = selection.pieces;
      if (chosen->pieces.erase(piece) == 0) chosen->pieces.insert(piece);
    } else if (sample.control && tool == Command::Select) {
      chosen = withEdge(selection, *std::move(chosen));
    }
    choose(*std::move(chosen));
  }
  carryOnTable(gesture->laidAside());
  if (sample.phase == Phase::Press && gesture->begun() && hit.piece && tool != Command::Draw) {
    Selection taken;
    taken.pieces = {hit.piece};
    taken.edge = hit.edge;
    // What is carried with others stays chosen with them.
    if (tool == Command::Move && selection.pieces.size() > 1 && selection.pieces.contains(hit.piece))
      taken = {selection.pieces, {}, {}};
    choose(std::move(taken));
  }
  takeResult(std::move(answer), begun);
}

void Session::feed(const PointerSample& sample) {
  auto& in = *impl_;
  ++in.changes.overlay;
  if (sample.phase == Phase::Hover && in.keyboard.down()) return;  // a nudge of the table is no hand
  in.keyboard.sleep();
  if (in.overMenu(sample)) {
    if (sample.phase == Phase::Press && in.hot) command(*in.hot == Command::ViewOblique ? Command::ViewAll : *in.hot);
    return;
  }
  in.point(sample);
}

void Session::leave() {
  auto& in = *impl_;
  in.hot.reset();
  in.onCross = false;
  if (!in.keyboard.awake()) (void)in.gesture->feed({}, {}, in.context());  // a hover over nothing
  ++in.changes.overlay;
}

void Session::strike(KeyStroke key, const PointerSample& with) {
  auto& in = *impl_;
  ++in.changes.overlay;
  in.hot.reset();
  if (in.gesture->dropMenu(in.context()) && !with.shift) {  // arrows and Enter work the menu
    if (key == KeyStroke::Up) in.gesture->moveInMenu(-1, in.context());
    if (key == KeyStroke::Down) in.gesture->moveInMenu(1, in.context());
    if (key == KeyStroke::Press) command(Command::Confirm);
    if (key == KeyStroke::Up || key == KeyStroke::Down || key == KeyStroke::Press) {
      if (in.options.wake) in.options.wake();
      return;
    }
  }
  // Enter ends what the mouse began, however soon it comes.
  if (key == KeyStroke::Press && !in.keyboard.awake() && can(Command::Confirm)) return command(Command::Confirm);
  const KeyboardPointer::Around around{*in.seen(), in.table, in.viewpoint.value_or(Viewpoint()), in.gesture->keyStops(),
                                       in.gesture->clicks()};
  for (const PointerSample& sample : in.keyboard.strike(key, with, around)) in.point(sample);
  if (in.options.wake) in.options.wake();
}

std::optional<PointerSample> Session::fingertip() const {
  const auto& in = *impl_;
  if (!in.keyboard.awake()) return std::nullopt;
  return in.keyboard.now(in.viewpoint.value_or(Viewpoint()));
}

Message Session::keyHint() const {
  const auto& in = *impl_;
  if (!in.keyboard.awake()) return {};
  const std::string step = lengthSaid(in.keyboard.step(), in.inches);
  if (in.keyboard.down()) return say("Arrows carry it {0} a time, Tab to the next place; Enter lets go", step);
  if (in.gesture->clicks())
    return say("Arrows go {0} (Page Up, Page Down), Tab to the next place; Enter clicks, twice ends a line", step);
  return say("Arrows go {0} (Page Up, Page Down), Tab to the next place; Enter takes hold", step);
}

Message Session::underFingertip() const {
  const auto& in = *impl_;
  const auto tip = fingertip();
  if (!tip) return {};
  const SnapshotPtr shown = in.seen();
  const GarmentSnapshot& snapshot = *shown;
  const bool drawing = in.gesture->keyStops() == KeyStops::Skin;
  const Hit hit = drawing ? pickBody(snapshot, *tip) : pick(snapshot, in.table, *tip);
  if (hit.on == Hit::On::Body && !hit.edge) return placeOn(*snapshot.body, hit.skin, in.inches);
  if (!hit.piece) return say("Beside everything");
  const Piece& piece = *snapshot.document.find(hit.piece);
  const Piece* owner = hit.edge ? snapshot.document.find(hit.edge->piece) : nullptr;
  const Edge* edge = owner ? findEdge(*owner, hit.edge->edge) : nullptr;
  if (!edge) return say("On “{0}”", piece.name);
  const double whole = edge->curve.length();
  return say("On “{0}”, edge “{1}”, {2} of {3} along it", owner->name,
             edgeNameSaid(snapshot.document, *owner, edge->name), lengthSaid(hit.edge->fraction * whole, in.inches),
             lengthSaid(whole, in.inches));
}

void Session::select(Selection selection) { impl_->choose(std::move(selection)); }

}  // namespace karinui
