// The menu of the right button: what can be done with the piece, the edge or the seam it was clicked on.
#include <QMenu>
#include <QStatusBar>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cut_apart.h"
#include "fastening_offers.h"
#include "karinui/design/edge_run.h"
#include "karinui/design/sewing.h"
#include "karinui/design/step_words.h"
#include "karinui/design/variant.h"
#include "karinui/geometry/polygon.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/seam_walk.h"
#include "karinui/pattern/symmetry.h"
#include "karinui/pattern/truing.h"
#include "main_window.h"
#include "menu_letters.h"
#include "new_pieces.h"
#include "pocket_offers.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// A pocket's place is shown, and can be typed finer.
Flat atHalfCentimetres(Flat place) {
  constexpr double kPlaced = 0.005;  // metres
  return {std::round(place.u / kPlaced) * kPlaced, std::round(place.v / kPlaced) * kPlaced};
}

constexpr double kSkirtDeep = 0.5;  // metres, first written in the box
constexpr double kDartDeep = 0.1;   // metres, as the board "Garment" offers it
constexpr double kShifted = 0.02;   // metres: that a dart is moved along its edge, as first offered
constexpr double kApart = 0.1;      // of an edge: the ends of a strap that begins and ends on it

// Qt leaves what an entry says at the foot when the keys go on to one that says nothing, and when that is chosen.
QMenu* contextMenuOf(QMainWindow& window) {
  auto* menu = new QMenu(&window);
  menu->setObjectName("context");
  menu->setAttribute(Qt::WA_DeleteOnClose);
  keepLetters(*menu);
  QStatusBar* foot = window.statusBar();
  QObject::connect(menu, &QMenu::hovered, foot, [foot](const QAction* entry) {
    if (entry->statusTip().isEmpty()) foot->clearMessage();
  });
  QObject::connect(menu, &QMenu::aboutToHide, foot, &QStatusBar::clearMessage);
  return menu;
}

// By length, to the millimetre, as it is then written into the step.
double toMillimetre(double share, double whole) {
  return whole > 0 ? std::clamp(std::round(share * whole * 1000) / 1000 / whole, 0.0, 1.0) : share;
}

constexpr double kLineReach = 0.008;  // metres

// The inner line under a place of the paper that is nearer than so much; empty: none.
std::string lineAt(const Piece& piece, Flat place, double nearest = kLineReach) {
  std::string found;
  for (const InternalLine& line : piece.lines)
    for (const Curve& curve : line.curves) {
      const auto points = curve.flattened(1e-4);
      for (std::size_t k = 0; k + 1 < points.size(); ++k)
        if (const double away = distanceToSegment(points[k], points[k + 1], place); away < nearest)
          nearest = away, found = line.name;
    }
  return found;
}

// A line that runs along an edge is met where the pointer is nearer to it.
void preferLine(const Document& document, Hit& hit) {
  const Piece* piece = hit.edge && hit.edge->piece == hit.piece ? document.find(hit.piece) : nullptr;
  const Edge* edge = piece ? findEdge(*piece, hit.edge->edge) : nullptr;
  if (!edge) return;
  const double away = distance(hit.paper, edge->curve.atFraction(hit.edge->fraction));
  if (!lineAt(*piece, hit.paper, std::fmin(away, kLineReach)).empty()) hit.edge.reset();
}

bool isLoose(const Document& document, PieceId id) {
  std::vector<EdgeRef> edges;
  if (const Piece* piece = document.find(id))
    for (const Edge& edge : piece->outline.edges) edges.push_back({PieceRef(id), edge.name});
  return seamsOn(document, edges).empty();
}

// Of a seam on this edge that joins two pieces and nothing else: the two as one paper, where they lie flat as one.
std::vector<MergePieces> mergesAlong(const Document& document, const EdgeRef& edge) {
  std::vector<MergePieces> all;
  for (const SeamId id : seamsOn(document, {edge})) {
    const Seam& seam = *document.find(id);
    MergePieces merge;
    const auto refs = [](const std::vector<EdgeSpan>& side) {
      std::vector<EdgeRef> run;
      for (const EdgeSpan& span : side) run.push_back({PieceRef(span.piece), span.edge, span.from, span.to});
      return run;
    };
    merge.a = refs(seam.a), merge.b = refs(seam.b);
    if (overlap(merge.b, {edge})) std::swap(merge.a, merge.b);
    const auto names = [](const std::vector<EdgeRef>& run) {
      std::vector<std::string> whole;
      for (const EdgeRef& one : run)
        if (one.piece == run.front().piece && one.from <= 0 && one.to >= 1) whole.push_back(one.edge);
      return whole;
    };
    const auto mine = names(merge.a), other = names(merge.b);
    if (mine.size() != merge.a.size() || other.size() != merge.b.size() || !seam.reversed) continue;
    const Piece *a = document.find(merge.a.front().piece.id), *b = document.find(merge.b.front().piece.id);
    if (a != b && mergePieces(*a, mine, *b, other)) all.push_back(std::move(merge));
  }
  return all;
}

struct Strength {
  Message words;
  Operation operation;
};

// What is there, a step firmer and a step softer: an elastic along edges or a line, a fold pressed along a line.
std::vector<Strength> strengthsOf(const Document& document, const std::vector<EdgeRef>& run) {
  constexpr double kTimes = 1.5, kHoldStep = 0.1, kHoldLeast = 0.1, kHoldMost = 0.99;
  std::vector<Strength> all;
  std::vector<EdgeRef> held;
  const Elastic* first = nullptr;
  for (const EdgeRef& edge : run)
    if (const auto own = document.allowances.elastics.find({edge.piece.id, edge.edge});
        own != document.allowances.elastics.end()) {
      held.push_back(edge);
      if (!first) first = &own->second;
    }
  const auto newtons = [](double wanted) {  // as one reads them off a spring scale
    const double to = wanted < 10 ? 10 : 1;
    return std::clamp(std::round(wanted * to) / to, kWeakestElastic, kStrongestElastic);
  };
  for (const bool firmer : {true, false}) {
    if (!first) break;
    SewElastic op;
    op.edges = held;
    op.strength = newtons(firmer ? first->strength * kTimes : first->strength / kTimes);
    if (*op.strength == first->strength) continue;
    all.push_back(
        {firmer ? say("Stronger elastic: {0} N", *op.strength) : say("Weaker elastic: {0} N", *op.strength), op});
  }
  const Piece* piece = run.size() == 1 ? document.find(run.front().piece.id) : nullptr;
  if (!piece) return all;
  for (const InternalLine& line : piece->lines) {
    if (line.name != run.front().edge || !line.crease) continue;
    for (const bool firmer : {true, false}) {
      FoldLine op;
      op.piece = run.front().piece, op.lines = {line.name}, op.angle = Angle{line.crease->angle};
      op.hold = std::clamp(std::round((line.crease->hold + (firmer ? kHoldStep : -kHoldStep)) * 100) / 100, kHoldLeast,
                           kHoldMost);
      if (op.hold == line.crease->hold) continue;
      const double percent = std::round(op.hold * 100);
      all.push_back(
          {firmer ? say("Press the fold harder: {0} %", percent) : say("Press the fold softer: {0} %", percent), op});
    }
  }
  return all;
}

// Of an edge that leads over the middle of a symmetric piece the part on that half in which the other edge lies:
// several slashes all over it would lead across the middle, and leave the piece no longer symmetric.
EdgeRef keptToHalf(const Piece& piece, EdgeRef whole, const Curve& other) {
  const auto symmetry = symmetryOf(piece.outline);
  const auto k = piece.outline.find(whole.edge);
  const Flat there = other.atFraction(0.5);
  if (!symmetry || !k || symmetry->partner[*k] != *k || distance(symmetry->image(there), there) < 1e-4) return whole;
  const Flat end = piece.outline.edges[*k].curve.end;
  (distance(end, there) < distance(symmetry->image(end), there) ? whole.from : whole.to) = 0.5;
  return whole;
}

}  // namespace

void MainWindow::menuAt(const PointerSample& sample, const QPoint& global) {
  Hit hit = pick(session_->snapshot(), session_->table(), sample);
  preferLine(session_->snapshot().document, hit);
  Selection chosen;
  if (hit.piece) chosen.pieces = {hit.piece};
  chosen.edge = hit.edge;
  if (hit.edge) chosen.seam = seamAt(session_->snapshot().document, *hit.edge);
  // Pointing at the body with a piece chosen: that piece is to come there.
  const PieceId wrapped = session_->selection().pieces.size() == 1 ? *session_->selection().pieces.begin() : PieceId();
  if (hit.on == Hit::On::Body && wrapped && session_->snapshot().body) {
    PlacePiece place;
    place.piece = wrapped;
    place.at = session_->snapshot().body->describe(hit.skin);
    return menuOfPlace(place, global);
  }
  if (hit.on == Hit::On::Body && session_->selection().pieces.size() > 1 && session_->snapshot().body) {
    QMenu* menu = contextMenuOf(*this);
    menu->addAction(inWords(say("Only one piece is wrapped round here: choose it alone")))->setEnabled(false);
    return menu->popup(global);
  }
  const auto led = session_->selection().edge;
  // Pointing at cloth or paper with another piece chosen: that piece, if it is sewn to nothing, can be sewn on there.
  patch_.reset();
  if (wrapped && hit.piece && hit.piece != wrapped && !hit.edge && isLoose(session_->snapshot().document, wrapped)) {
    patch_ = patchOf(session_->snapshot().document, wrapped);
    patch_->on = hit.piece, patch_->at = atHalfCentimetres(hit.paper);
  }
  // Several chosen pieces stay chosen, for what is to be done with all of them.
  const auto edges = session_->selection().edges();
  if (hit.edge && edges.size() > 1 &&
      std::find(edges.begin(), edges.end(), EdgeRef{PieceRef(hit.edge->piece), hit.edge->edge}) != edges.end()) {
    chosen.more = session_->selection().more;  // likewise several edges; the menu is of the one that is pointed at
    std::erase_if(chosen.more,
                  [&](const EdgeNear& one) { return one.piece == hit.edge->piece && one.edge == hit.edge->edge; });
    if (chosen.more.size() + 1 < edges.size()) chosen.more.push_back(*session_->selection().edge);
    chosen.pieces = session_->selection().pieces;
    session_->select(chosen);
  } else if (hit.edge || !hit.piece || !session_->selection().pieces.contains(hit.piece))
    session_->select(chosen);
  else
    chosen.pieces = session_->selection().pieces;
  refresh();
  scan_.clear();
  if (sample.where == PointerSample::Where::Table && !hit.edge) {
    const Underlays& scans = session_->snapshot().document.underlays;
    if (const auto* name = underlayAt(scans, sample.place)) scan_ = *name;
    if (scan_.empty() && !hit.piece)  // one that is hidden is shown again
      for (const auto& [name, scan] : scans)
        if (scan.holds(sample.place)) scan_ = name;
  }
  menuOf(chosen, hit, global, led);
}

// Where the print on both sides is alike: it can meet here, at a notch near by, or at the seam's start.
void MainWindow::addMatching(QMenu& menu, const Selection& chosen) {
  const Document& document = session_->snapshot().document;
  const Seam& seam = *document.find(chosen.seam);
  if (!printMeeting(document, seam, photosOf(session_->snapshot()))) return;
  MatchPrint start;
  start.seam = SeamRef(chosen.seam);
  offer(menu, say("Match the print at the seam's start"), start);
  if (!chosen.edge) return;
  const SeamSides sides(document.pattern, seam);
  for (const SeamSide* side : {&sides.a, &sides.b})
    for (std::size_t k = 0; k < side->spans().size(); ++k) {
      const EdgeSpan& span = side->spans()[k];
      if (span.piece != chosen.edge->piece || span.edge != chosen.edge->edge) continue;
      constexpr double kNotch = 0.02;  // metres along the edge: so near a notch is meant
      const Piece& piece = *document.find(span.piece);
      const double whole = findEdge(piece, span.edge) ? findEdge(piece, span.edge)->curve.length() : 0;
      double at = chosen.edge->fraction, nearest = kNotch;
      for (const Mark& mark : piece.marks)
        if (const double away = std::fabs(mark.fraction - chosen.edge->fraction) * whole;
            mark.edge == span.edge && away < nearest)
          nearest = away, at = mark.fraction;
      MatchPrint here = start;
      here.at = std::clamp(std::round(side->fractionOf(k, at) * 1000) / 1000, 0.0, 1.0);
      return offer(menu, nearest < kNotch ? say("Match the print at this notch") : say("Match the print here"), here);
    }
}

void MainWindow::addScanOperations(QMenu& menu, const std::string& name) {
  const Underlay& lies = session_->snapshot().document.underlays.at(name);
  const auto wish = [&] {
    LayUnderlay op;
    op.name = name;
    return op;
  };
  LayUnderlay hidden = wish(), weaker = wish(), stronger = wish(), numbers = wish(), none = wish();
  hidden.hidden = !lies.hidden;
  constexpr double kStep = 0.2;
  weaker.strength = std::max(0.1, std::round((lies.strength - kStep) * 10) / 10);
  stronger.strength = std::min(1.0, std::round((lies.strength + kStep) * 10) / 10);
  numbers.width = Length{lies.width}, numbers.at = lies.at, numbers.turn = Angle{lies.turn};
  numbers.strength = lies.strength;
  none.none = true;
  offer(menu, lies.hidden ? say("Show the scan") : say("Hide the scan"), hidden);
  offer(menu, say("Fainter"), weaker);
  offer(menu, say("Stronger"), stronger);
  offer(menu, say("Size and place of the scan…"), [this, numbers] { askNumbers(numbers); });
  offer(menu, say("Take the scan out"), none);
}

void MainWindow::offer(QMenu& menu, const Message& words, std::function<void()> what) {
  QAction* action = menu.addAction(inWords(words));
  action->setProperty(kEnglish, QString::fromStdString(text(words)));
  action->setEnabled(!session_->readOnly());
  connect(action, &QAction::triggered, this, [this, what = std::move(what)] {
    what();
    refresh();
  });
}

void MainWindow::offer(QMenu& menu, const Message& words, Operation operation) {
  offer(menu, words, [this, operation = std::move(operation)] { session_->perform(operation); });
}

void MainWindow::menuOf(const Selection& chosen, std::optional<Hit> at, const QPoint& global,
                        const std::optional<EdgeNear>& led) {
  QMenu* menu = contextMenuOf(*this);
  if (session_->can(Command::Confirm)) {  // the hand is in the middle of something
    for (const Command c : {Command::Confirm, Command::Undo, Command::Cancel}) menu->addAction(actions_[c]);
    return menu->popup(global);
  }
  if (chosen.seam) {
    menu->addAction(actions_[Command::FlipSeam]);
    offer(*menu, say("Unpick this seam"), Unsew{{SeamRef(chosen.seam)}});
    const TruingReport report = truing(session_->snapshot().document.pattern);
    if (std::any_of(report.corners.begin(), report.corners.end(),
                    [&](const CornerTruing& corner) { return corner.seam == chosen.seam && !corner.smooth(); })) {
      TrueUp trueUp;
      trueUp.seams = {SeamRef(chosen.seam)};
      offer(*menu, say("True the line across its ends"), trueUp);
    }
    addMatching(*menu, chosen);
    menu->addSeparator();
  }
  const auto offerTopstitch = [&](PieceId piece, const std::string& line) {
    offer(*menu, say("Topstitch along {0}…", nameSaid(line)),
          [this, topstitch = topstitchAlong(session_->snapshot().document, {{PieceRef(piece), line}})] {
            askNumbers(topstitch);
          });
  };
  const auto offerTurning = [&](PieceId piece, const std::string& line) {
    offer(*menu, say("Turn back along {0}…", nameSaid(line)),
          [this, fold = turningAlong(session_->snapshot().document, piece, line)] { askNumbers(fold); });
  };
  const auto offerPleats = [&](PieceId id, const std::string& line) {
    if (const Piece* piece = session_->snapshot().document.find(id))
      for (const AddPleat& pleat : drawnPleats(*piece, line))
        offer(*menu, say("Pleat: fold {0} onto {1}…", nameSaid(line), nameSaid(pleat.lines.back().edge)),
              [this, pleat] { askNumbers(pleat); });
  };
  const auto offerElastic = [&](PieceId piece, const std::string& line) {
    for (const Strength& one : strengthsOf(session_->snapshot().document, {{PieceRef(piece), line}}))
      offer(*menu, one.words, one.operation);
    offer(*menu, say("Elastic along {0}…", nameSaid(line)),
          [this, elastic = elasticAlong(session_->snapshot().document, {{PieceRef(piece), line}})] {
            askNumbers(elastic);
          });
  };
  if (chosen.mark || !chosen.line.empty()) {
    if (!chosen.line.empty() && !chosen.pieces.empty()) {
      offerElastic(*chosen.pieces.begin(), chosen.line);
      offerTopstitch(*chosen.pieces.begin(), chosen.line);
      offerTurning(*chosen.pieces.begin(), chosen.line);
      offerPleats(*chosen.pieces.begin(), chosen.line);
    }
    menu->addAction(actions_[Command::Remove]);
    return menu->popup(global);
  }
  if (at && !scan_.empty() && session_->snapshot().document.underlays.contains(scan_)) {
    if (!at->piece) {
      menu->addAction(actions_[Command::Trace]);
      addScanOperations(*menu, scan_);
    } else {  // it lies under a piece
      addScanOperations(*menu->addMenu(inWords(say("Scan “{0}”", nameSaid(scan_)))), scan_);
    }
  }
  if (chosen.edge) addEdgeOperations(*menu, *chosen.edge, led);
  if (at && at->piece && !at->edge) {
    PinCloth pin;
    pin.piece = at->piece;
    pin.at = {at->paper};
    offer(*menu, say("Pin here"), pin);
    if (const Piece* piece = session_->snapshot().document.find(at->piece))
      if (const std::string line = lineAt(*piece, at->paper); !line.empty())
        offerElastic(at->piece, line), offerTopstitch(at->piece, line), offerTurning(at->piece, line),
            offerPleats(at->piece, line);
    if (const auto welt = weltAt(session_->snapshot().document, at->piece, atHalfCentimetres(at->paper)))
      offer(*menu, say("Welt pocket here…"), [this, welt] { askNumbers(*welt); });
    if (patch_)
      offer(*menu, say("Sew {0} on here…", session_->snapshot().document.find(patch_->piece.id)->name),
            [this, patch = *patch_] { askNumbers(patch); });
  }
  if (!chosen.pieces.empty() && chosen.edge) {  // of an edge most is about that, and all of it has to fit the screen
    const Piece* piece = session_->snapshot().document.find(*chosen.pieces.begin());
    const Message words = chosen.pieces.size() == 1 && piece ? say("Piece {0}", nameSaid(piece->name))
                                                             : say("The {0} {0|piece|pieces}", chosen.pieces.size());
    QMenu* whole = menu->addMenu(inWords(words));
    whole->setObjectName("context_piece");
    whole->menuAction()->setProperty(kEnglish, QString::fromStdString(text(words)));
    addPieceOperations(*whole, chosen);
  } else if (!chosen.pieces.empty()) {
    addPieceOperations(*menu, chosen);
  }
  if (menu->isEmpty())
    for (const Command c : {Command::ViewFront, Command::ViewBack, Command::ViewLeft, Command::ViewRight,
                            Command::ViewOblique, Command::ViewAll})
      menu->addAction(actions_[c]);
  menu->popup(global);
}

void MainWindow::menuOfPlace(PlacePiece place, const QPoint& global) {
  QMenu* menu = contextMenuOf(*this);
  offer(*menu, say("Wrap the chosen piece round here"), place);
  PlacePiece half = place;
  half.arc = 0.5;
  offer(*menu, say("Wrap it half-way round, what is wider in waves"), half);
  place.over = true;
  offer(*menu, say("Wrap it over the cloth that is there"), place);
  menu->popup(global);
}

// What is done along several edges.
void MainWindow::addRunOperations(QMenu& menu, const EdgeRef& ref, const std::vector<EdgeRef>& run) {
  const Document& document = session_->snapshot().document;
  offer(menu, say("Band along it…"),
        [this, ref, run] { askNumbers(bandAlong(session_->snapshot().document, ref, run)); });
  offer(menu, say("Facing…"), [this, run] { askNumbers(facingAlong(session_->snapshot().document, run)); });
  const auto offerFinish = [&](const Message& words, auto along) {
    offer(menu, words, [this, run, along] { askNumbers(along(session_->snapshot().document, run)); });
  };
  for (const Strength& one : strengthsOf(document, run)) offer(menu, one.words, one.operation);
  offerFinish(say("Elastic…"), elasticAlong);
  offerFinish(say("Shirring…"), shirringAlong);
  offerFinish(say("Topstitch…"), topstitchAlong);
  offerFinish(say("Piping…"), pipingAlong);
  if (seamsOn(document, run).empty()) offerFinish(say("Binding…"), bindingAlong);
  DrawRing skirt;
  skirt.name = usableName(document, "ring");
  skirt.of = run;
  skirt.depth = {kSkirtDeep};
  skirt.angle = {std::numbers::pi};
  offer(menu, say("Ring from it…"), [this, skirt] { askNumbers(skirt); });
}

void MainWindow::addEdgeOperations(QMenu& menu, const EdgeNear& near, const std::optional<EdgeNear>& led) {
  const Piece* piece = session_->snapshot().document.find(near.piece);
  const Edge* edge = piece ? findEdge(*piece, near.edge) : nullptr;
  if (!edge) return;
  const EdgeRef ref{PieceRef(near.piece), near.edge};
  const Curve& curve = edge->curve;
  const double share = toMillimetre(near.fraction, curve.length());
  AddNotch notch;
  notch.edge = ref;
  notch.at = share;
  notch.symmetric = symmetryOf(piece->outline).has_value();
  AddDart dart;
  dart.edge = ref;
  dart.at = share;
  dart.width = {session_->toolOptions().dartWidth};
  dart.tip = curve.atFraction(share) +
             leftOf(normalized(curve.tangent(curve.parameterAt(share * curve.length())))) * kDartDeep;
  const bool several = !session_->selection().more.empty();
  if (several) {
    const QString why = inWords(say("Points, notches, darts and pleats take one edge: choose it alone"));
    menu.addAction(why)->setEnabled(false);
    const auto all = session_->selection().edges();
    offer(menu, say("Redraw as a fair line"), FairEdges{all});
    return addRunOperations(menu, ref, all);
  }
  if (const auto again = sewnAgain(session_->snapshot().document, ref))
    offer(menu, say("Sew it to {0} again", edgeSaid(session_->snapshot().document, again->b.front())), *again);
  offer(menu, say("Point there"), SplitEdge{ref, share});
  offer(menu, say("Take its end away"), JoinEdges{ref});
  if (curve.kind != Curve::Kind::Line) {
    FairEdges fair;
    fair.edges = {ref};
    offer(menu, say("Redraw as a fair line"), fair);
  }
  if (!session_->snapshot().document.grading.empty())
    offer(menu, say("Grade the corner beside it…"),
          [this, near] { askNumbers(gradedCorner(session_->snapshot().document, near)); });
  offer(menu, say("Notch there"), notch);
  offer(menu, say("Dart there"), dart);
  addDartOperations(menu, near, share);
  const Document& document = session_->snapshot().document;
  if (led && led->piece == near.piece && led->edge != near.edge) addSpreads(menu, near, share, *led);
  menu.addSeparator();
  const std::vector<EdgeRef> run = runThrough(document, ref);
  addRunOperations(menu, ref, run);
  offer(menu, say("Pleats…"), [this, ref] { askNumbers(pleatsIn(session_->snapshot().document, ref)); });
  if (led && document.find(led->piece) &&
      (led->piece != near.piece || led->edge != near.edge || std::fabs(led->fraction - near.fraction) > kApart))
    offer(menu, say("Strap from {0} to here…", edgeSaid(document, {PieceRef(led->piece), led->edge})),
          [this, led, near] { askNumbers(strapBetween(session_->snapshot().document, *led, near)); });
  if (led && led->piece != near.piece && document.find(led->piece)) addPartnerOperations(menu, near, *led);
  for (const SeamId id : seamsOn(document, {ref}))
    offer(menu, say("Zip in seam {0}…", seamSaid(document, *document.find(id))),
          [this, id] { askNumbers(zipIn(session_->snapshot().document, id)); });
  if (const auto pocket = pocketIn(document, ref))
    offer(menu, say("Pocket in this seam…"), [this, pocket] { askNumbers(*pocket); });
  if (const auto pocket = slantedAt(document, ref, near.fraction))
    offer(menu, say("Slanted pocket…"), [this, pocket] { askNumbers(*pocket); });
  if (const auto buttons = buttonsAt(session_->snapshot(), ref))
    offer(menu, say("Buttons…"), [this, buttons] { askNumbers(*buttons); });
  if (const auto fly = flyAt(document, ref); fly && flyFits(session_->snapshot(), *fly))
    offer(menu, say("Fly…"), [this, fly] { askNumbers(*fly); });
  for (const MergePieces& merge : mergesAlong(document, ref))
    offer(menu, say("Merge with {0} along the seam", nameSaid(document.find(merge.b.front().piece.id)->name)), merge);
  addFasteningOperations(menu, near);
  if (unfolded(*piece, near.edge) && seamsOn(document, {ref}).empty())
    offer(menu, say("Unfold on it: both halves"), UnfoldPiece{ref});
  menu.addSeparator();
}

void MainWindow::addDartOperations(QMenu& menu, const EdgeNear& near, double share) {
  const Document& document = session_->snapshot().document;
  const Piece* piece = document.find(near.piece);
  for (const PaperDart& other : dartsOf(document.pattern)) {
    const auto& edges = piece->outline.edges;
    if (other.piece != near.piece || edges[other.to].name == near.edge || edges[other.back].name == near.edge) continue;
    PivotDart pivot;
    pivot.dart = {PieceRef(near.piece), edges[other.to].name};
    pivot.to = {PieceRef(near.piece), near.edge}, pivot.at = share;
    offer(menu, say("Move {0} there", nameSaid(edges[other.to].name)), pivot);
  }
  for (const PaperDart& own : dartsOf(document.pattern)) {
    const auto& edges = piece->outline.edges;
    const std::size_t n = edges.size();
    if (own.piece != near.piece || (edges[own.to].name != near.edge && edges[own.back].name != near.edge)) continue;
    for (const std::size_t beyond : {(own.to + n - 2) % n, (own.back + 2) % n}) {
      ShiftDart shift;
      shift.dart = {PieceRef(near.piece), edges[own.to].name};
      shift.by = {kShifted};
      shift.towards = edges[beyond].name;
      const auto symmetry = symmetryOf(piece->outline);
      const Flat end = edges[beyond == (own.to + n - 2) % n ? (own.to + n - 1) % n : beyond].curve.start;
      const bool centre = symmetry && distance(symmetry->image(end), end) < 1e-5;
      offer(menu,
            centre ? say("Move the dart along its edge towards the centre…")
                   : say("Move the dart along its edge towards {0}…", edgeNameSaid(document, *piece, shift.towards)),
            [this, shift] { askNumbers(shift); });
    }
  }
}

// Between the edge and one of the same piece that was chosen before.
void MainWindow::addSpreads(QMenu& menu, const EdgeNear& near, double share, const EdgeNear& led) {
  const Document& document = session_->snapshot().document;
  const Piece* piece = document.find(near.piece);
  const Edge* other = piece ? findEdge(*piece, led.edge) : nullptr;
  const Edge* edge = piece ? findEdge(*piece, near.edge) : nullptr;
  if (!other || !edge) return;
  SlashAndSpread spread;
  spread.from = keptToHalf(*piece, {PieceRef(near.piece), near.edge}, other->curve), spread.at = share;
  spread.to = keptToHalf(*piece, {PieceRef(near.piece), led.edge}, edge->curve);
  spread.toAt = toMillimetre(led.fraction, other->curve.length());
  offer(menu, say("Slash to {0} and spread or fold out…", edgeSaid(document, {spread.to.piece, led.edge})),
        [this, spread] { askNumbers(spread); });
  AddPleat pleat;  // soft below where it is sewn, as of a peg-top skirt
  pleat.edge = {spread.from.piece, near.edge}, pleat.at = share, pleat.hold = 0;
  pleat.to = {spread.to.piece, led.edge}, pleat.toAt = spread.toAt;
  offer(menu, say("Pleat that runs out at {0}…", edgeSaid(document, pleat.to)), [this, pleat] { askNumbers(pleat); });
}

// With an edge of another piece that was chosen before.
void MainWindow::addPartnerOperations(QMenu& menu, const EdgeNear& near, const EdgeNear& led) {
  const Document& document = session_->snapshot().document;
  const EdgeRef ref{PieceRef(near.piece), near.edge};
  const std::vector<EdgeRef> run = runThrough(document, ref);
  const EdgeRef own{PieceRef(led.piece), led.edge};
  AttachPiece attach;
  attach.edge = own;
  attach.to = run;
  SewEdges sew;
  sew.a = {own};
  sew.b = run;
  const Message chosen = edgeSaid(document, own);
  offer(menu, say("Buttons or a zip with {0}…", chosen),
        [this, own, ref] { askNumbers(fastenedTo(session_->snapshot().document, own, ref)); });
  offer(menu, say("Lead {0} along it", chosen), attach);
  if (seamsOn(document, {own}).empty() && seamsOn(document, {ref}).empty())
    offer(menu, say("Merge with {0}, laid against it", nameSaid(document.find(led.piece)->name)),
          MergePieces{{ref}, {own}});
  if (seamsOn(document, {own}).empty() && seamsOn(document, run).empty())
    offer(menu, say("Lead {0} along it and sew", chosen), [this, attach, sew] {
      session_->perform(attach);
      session_->perform(sew);
    });
}

// Of those that are on the edge.
void MainWindow::addFasteningOperations(QMenu& menu, const EdgeNear& near) {
  const Document& document = session_->snapshot().document;
  for (const auto& [name, own] : document.allowances.fastenings) {
    const auto holds = [&](const EdgeSpan& span) { return span.piece == near.piece && span.edge == near.edge; };
    if (std::none_of(own.a.begin(), own.a.end(), holds) && std::none_of(own.b.begin(), own.b.end(), holds)) continue;
    const bool zip = own.kind == FasteningKind::Zip, open = zip ? own.zipped <= 0 : own.closed == 0;
    Fasten turned, none;
    turned.name = none.name = name;
    none.none = true;
    if (zip)
      turned.closedLength = Length{open ? lengthOf(document.pattern, own) : 0};
    else
      turned.closed = open ? static_cast<int>(own.at.size()) : 0;
    if (zip || own.at.size() > 1) {
      Fasten part;
      part.name = name;
      if (zip)
        part.closedLength = Length{own.zipped * lengthOf(document.pattern, own)};
      else
        part.closed = own.closed;
      offer(
          menu,
          zip ? say("Close {0} part of the way…", fasteningSaid(name)) : say("Close some of {0}…", fasteningSaid(name)),
          [this, part] { askNumbers(part); });
    }
    offer(menu, open ? say("Close {0}", fasteningSaid(name)) : say("Open {0}", fasteningSaid(name)), turned);
    offer(menu, say("Take {0} out", fasteningSaid(name)), none);
  }
}

void MainWindow::addPieceOperations(QMenu& menu, const Selection& chosen) {
  const Document& document = session_->snapshot().document;
  std::vector<const Piece*> pieces;
  for (const PieceId id : chosen.pieces)
    if (const Piece* piece = document.find(id)) pieces.push_back(piece);
  if (pieces.empty()) return;
  const auto allOf = [&](const auto& so) {
    return std::all_of(pieces.begin(), pieces.end(), [&](const Piece* piece) { return so(*piece); });
  };
  QMenu* fabrics = menu.addMenu(inWords(say("Fabric")));
  fabrics->menuAction()->setProperty(kEnglish, "Fabric");
  fabrics->setEnabled(!session_->readOnly());
  for (const std::string& name : fabricNames(document)) {
    SetFabric set;
    set.name = name;
    for (const PieceId id : chosen.pieces) set.pieces.push_back(PieceRef(id));
    QAction* one = fabrics->addAction(nameText(name));
    one->setCheckable(true);
    one->setChecked(allOf([&](const Piece& piece) { return piece.fabric == name; }));
    connect(one, &QAction::triggered, this, [this, set] {
      session_->perform(set);
      refresh();
    });
  }
  for (const Command c : {Command::Duplicate, Command::Mirror}) menu.addAction(actions_[c]);
  FuseInterfacing fuse;
  LinePieces line;
  fuse.none = allOf([](const Piece& piece) { return !piece.interfacing.empty(); });
  for (const Piece* piece : pieces) {
    line.pieces.push_back(PieceRef(piece->id));
    if (fuse.none || piece->interfacing.empty()) fuse.pieces.push_back(PieceRef(piece->id));  // it keeps its own
  }
  offer(menu, fuse.none ? say("Take the interfacing off") : say("Fuse interfacing"), fuse);
  const bool alone = pieces.size() == 1;
  offer(menu, alone ? say("Line it") : say("Line them"), line);
  if (const LinePieces free = hangingLining(session_->snapshot().document, line.pieces); !free.open.empty())
    offer(menu, alone ? say("Line it, free at the hem") : say("Line them, free at the hem"), free);
  FreezePieces freeze;
  RemovePieces remove;
  for (const PieceId id : chosen.pieces) freeze.pieces.push_back(PieceRef(id)), remove.pieces.push_back(PieceRef(id));
  freeze.frozen = !allOf([](const Piece& piece) { return piece.frozen; });
  offer(menu, freeze.frozen ? say("Freeze") : say("Thaw"), freeze);
  offer(menu, alone ? say("Remove the piece") : say("Remove the {0} {0|piece|pieces}", pieces.size()), remove);
}

}  // namespace karinui::studio
