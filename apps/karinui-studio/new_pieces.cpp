#include "new_pieces.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "fastening_offers.h"
#include "karinui/body/sizes.h"
#include "karinui/design/block_numbers.h"
#include "karinui/design/edge_run.h"
#include "karinui/design/glossary.h"
#include "karinui/design/sewing.h"
#include "karinui/design/variables.h"
#include "karinui/geometry/polygon.h"
#include "karinui/pattern/elastic_lines.h"
#include "karinui/pattern/grading.h"
#include "karinui/pattern/likeness.h"
#include "karinui/session/fabric_numbers.h"
#include "main_window.h"
#include "menu_letters.h"
#include "pocket_offers.h"
#include "size_box.h"
#include "step_dialog.h"
#include "theme.h"

namespace karinui::studio {

std::vector<EdgeRef> runChosen(const Document& document, const Selection& selection, const EdgeRef& edge) {
  const auto all = selection.edges();
  return all.size() > 1 && std::find(all.begin(), all.end(), edge) != all.end() ? all : runThrough(document, edge);
}

DrawBand bandAlong(const Document& document, const EdgeRef& edge, std::vector<EdgeRef> run) {
  struct Usual {
    const char *edge, *piece, *band;
    double deep;  // metres
  };
  static constexpr Usual usual[] = {{"neck", "", "collar", 0.035},
                                    {"waist", "", "waistband", 0.04},
                                    {"hem", "sleeve", "cuff", 0.06},
                                    {"wrist", "", "cuff", 0.06}};
  const Piece* piece = document.find(edge.piece.id);
  Usual made{"", "", "band", 0.04};
  for (const Usual& one : usual)
    if (edge.edge.find(one.edge) != std::string::npos && piece && piece->name.find(one.piece) != std::string::npos) {
      made = one;
      break;
    }
  DrawBand band;
  band.of = std::move(run);
  band.name = usableName(document, made.band);
  band.depth = {made.deep};
  if (piece) band.fabric = piece->fabric;
  band.sew = seamsOn(document, band.of).empty();
  constexpr double kLap = 0.03;  // metres: over the zip, or wherever it opens, for a button
  if (band.sew && opensSomewhere(document, band.of)) band.extra = Length{kLap};
  return band;
}

DrawStrap strapBetween(const Document& document, const EdgeNear& from, const std::optional<EdgeNear>& to) {
  constexpr double kShort = 0.05, kUsual = 0.02;  // metres
  DrawStrap strap;
  strap.name = usableName(document, "strap");
  strap.fabric = document.find(from.piece)->fabric;
  strap.width = Length{kUsual};
  bool whole = true;
  const auto part = [&](const EdgeNear& near) {
    EdgeRef ref{PieceRef(near.piece), near.edge};
    const Edge* edge = findEdge(*document.find(near.piece), near.edge);
    const double length = edge ? edge->curve.length() : 0;
    if (!(length > kShort)) {
      strap.width = Length{std::floor(1000 * length) / 1000};
      return ref;
    }
    whole = false;
    const double half = kUsual / 2 / length;
    ref.from = std::round(1e4 * std::clamp(near.fraction - half, 0.0, 1 - 2 * half)) / 1e4;
    ref.to = std::round(1e4 * std::fmin(1, ref.from + 2 * half)) / 1e4;
    return ref;
  };
  strap.from = part(from);
  if (to) strap.to = part(*to);
  if (whole && to) strap.width.reset();
  return strap;
}

LinePieces hangingLining(const Document& document, const std::vector<PieceRef>& pieces) {
  constexpr double kDown = 0.75;  // cosine: an edge that looks up to 41 degrees from straight down the grain
  const AllowancePlan kinds(document.pattern, document.allowances);
  LinePieces lining;
  lining.pieces = pieces;
  for (const PieceRef& ref : pieces) {
    const Piece* piece = document.find(ref.id);
    if (!piece) continue;
    for (const Edge& edge : piece->outline.edges) {
      const Flat chord = edge.curve.end - edge.curve.start, out{chord.v, -chord.u};  // outlines run counter-clockwise
      if (kinds.kind(ref.id, edge.name) == EdgeKind::Hem && -dot(out, piece->grain) > kDown * length(chord))
        lining.open.push_back({ref, edge.name});
    }
  }
  if (!lining.open.empty()) lining.shorter = Length{0.025};
  return lining;
}

FaceEdges facingAlong(const Document& document, std::vector<EdgeRef> run) {
  FaceEdges face;
  face.edges = std::move(run);
  for (const EdgeRef& own : face.edges)
    for (const auto& [id, other] : document.pattern.pieces) {
      const Piece& piece = *document.find(own.piece.id);
      if ((other->mirrorOf == piece.id || piece.mirrorOf == id) && edgeOnCopy(*other, piece, own.edge))
        face.copies = Choice::Yes;
    }
  return face;
}

AddPleat pleatsIn(const Document& document, const EdgeRef& edge) {
  constexpr double kApart = 0.06, kShare = 0.3;  // metres from pleat to pleat; of that the depth
  AddPleat pleats;
  pleats.edge = edge;
  pleats.depth = {0.02};
  const double whole = lengthOf(document, {edge});
  pleats.count = std::clamp(static_cast<int>(std::lround(whole / kApart)), 1, 40);
  if (whole > 0) pleats.depth = {std::min(0.02, std::floor(whole / pleats.count * kShare * 1000) / 1000)};
  return pleats;
}

std::vector<AddPleat> drawnPleats(const Piece& piece, const std::string& fold) {
  constexpr double kSkew = 0.4, kNarrow = 0.004, kUneven = 0.2;  // sine of the angle; metres; of the depth
  struct Straight {
    std::string name;
    Flat from, to;
  };
  std::vector<Straight> lines;
  std::optional<Straight> own;
  for (const InternalLine& line : piece.lines) {
    if (line.curves.empty() || line.crease) continue;
    const Straight one{line.name, line.curves.front().start, line.curves.back().end};
    double along = 0;
    for (const Curve& curve : line.curves) along += curve.length();
    if (distance(one.from, one.to) < 0.999 * along) continue;
    if (line.name == fold)
      own = one;
    else
      lines.push_back(one);
  }
  std::vector<AddPleat> found;
  if (!own) return found;
  const Flat along = normalized(own->to - own->from);
  struct Neighbour {
    std::string name;
    std::array<double, 2> away;  // where the fold begins and where it ends
    double middle() const { return 0.5 * (away[0] + away[1]); }
  };
  std::vector<Neighbour> beside;
  for (Straight& line : lines) {
    if (dot(line.to - line.from, along) < 0) std::swap(line.from, line.to);
    if (std::fabs(cross(along, normalized(line.to - line.from))) < kSkew)
      beside.push_back({line.name, {cross(along, line.from - own->from), cross(along, line.to - own->from)}});
  }
  const auto halfway = [&](const Neighbour& between, const Neighbour& far) {
    const double deepest = std::fmax(std::fabs(far.away[0]), std::fabs(far.away[1]));
    return std::fabs(2 * between.away[0] - far.away[0]) <= kUneven * deepest &&
           std::fabs(2 * between.away[1] - far.away[1]) <= kUneven * deepest;
  };
  for (const double side : {1.0, -1.0}) {
    const Neighbour *place = nullptr, *inner = nullptr;
    for (const Neighbour& far : beside)
      for (const Neighbour& between : beside) {
        if (side * far.middle() < kNarrow || std::fmin(side * far.away[0], side * far.away[1]) < -kNarrow ||
            &far == &between || !halfway(between, far))
          continue;
        if (!place || side * far.middle() < side * place->middle()) place = &far, inner = &between;
      }
    if (!place) continue;
    AddPleat& pleat = found.emplace_back();
    for (const std::string& name : {fold, inner->name, place->name}) pleat.lines.push_back({PieceRef(piece.id), name});
  }
  return found;
}

SlashAndSpread slashFrom(const Document& document, const EdgeRef& edge) {
  constexpr int kParts = 64;  // of an edge, looked at as straight
  SlashAndSpread slash;
  slash.from = edge;
  const Piece* piece = document.find(edge.piece.id);
  const Edge* from = piece ? findEdge(*piece, edge.edge) : nullptr;
  if (!from) return slash;
  slash.at = 0.5;
  const Flat middle = from->curve.atFraction(0.5);
  const Flat inward = leftOf(normalized(from->curve.tangent(from->curve.parameterAt(0.5 * from->curve.length()))));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Edge& other : piece->outline.edges) {
    if (other.name == edge.edge) continue;
    for (int k = 0; k < kParts; ++k) {
      const Flat a = other.curve.atFraction(double(k) / kParts), step = other.curve.atFraction((k + 1.0) / kParts) - a;
      const double turned = cross(inward, step);
      if (turned == 0) continue;
      const double along = cross(a - middle, step) / turned, share = cross(a - middle, inward) / turned;
      if (along <= 0 || along >= nearest || share < 0 || share > 1) continue;
      nearest = along;
      slash.to = {edge.piece, other.name};
      slash.toAt = std::round((k + share) / kParts * 1000) / 1000;
    }
  }
  return slash;
}

SewPatch patchOf(const Document& document, PieceId piece) {
  constexpr double kUp = 0.5;  // cosine: an edge that looks up to 60 degrees from straight up the paper
  SewPatch patch;
  patch.piece = PieceRef(piece);
  const Piece* own = document.find(piece);
  if (!own || own->outline.edges.size() < 2) return patch;
  const auto& edges = own->outline.edges;
  const std::size_t n = edges.size();
  const auto looksUp = [&](std::size_t k) {
    const Flat chord = edges[k % n].curve.end - edges[k % n].curve.start;  // outlines run counter-clockwise
    return -chord.u >= kUp * length(chord);
  };
  std::optional<std::size_t> upper;
  for (std::size_t k = 0; k < n; ++k)
    if (looksUp(k) && (!upper || edges[k].curve.atFraction(0.5).v > edges[*upper].curve.atFraction(0.5).v)) upper = k;
  if (!upper) return patch;
  // A pocket's top may be in several edges. Some edge looks down, so the run has two ends.
  std::size_t first = *upper + n, last = *upper + n;
  while (looksUp(first - 1)) --first;
  while (looksUp(last + 1)) ++last;
  for (std::size_t k = first; k <= last; ++k) patch.open.push_back(edges[k % n].name);
  return patch;
}

Fasten fastenedTo(const Document& document, const EdgeRef& over, const EdgeRef& under) {
  constexpr double kApart = 0.08;  // metres
  Fasten fasten;
  fasten.kind = FasteningKind::Button;
  if (over)
    fasten.a = {over}, fasten.count = std::max(1, static_cast<int>(std::lround(lengthOf(document, fasten.a) / kApart)));
  if (under) fasten.b = {under};
  return fasten;
}

Fasten zipIn(const Document& document, SeamId id) {
  constexpr double kUsual = 0.2;  // metres
  Fasten zip;
  zip.kind = FasteningKind::Zip;
  const Seam* seam = document.find(id);
  if (!seam) return zip;
  for (const bool over : {true, false})
    for (const EdgeSpan& span : over ? seam->a : seam->b)
      (over ? zip.a : zip.b).push_back({PieceRef(span.piece), span.edge, span.from, span.to});
  zip.reversed = seam->reversed ? Choice::Yes : Choice::No;
  zip.length = Length{std::floor(1000 * std::min(kUsual, lengthOf(document, zip.a))) / 1000};
  return zip;
}

std::optional<SewFly> flyAt(const Document& document, const EdgeRef& over) {
  for (const SeamId id : seamsOn(document, {over})) {
    const Seam& seam = *document.find(id);
    if (seam.a.size() != 1 || seam.b.size() != 1 || !seam.reversed) continue;
    const bool first = seam.a.front().piece == over.piece.id && seam.a.front().edge == over.edge;
    const EdgeSpan& other = first ? seam.b.front() : seam.a.front();
    if (!document.find(other.piece)->outline.find(other.edge)) continue;
    const Edge& edge = *findEdge(*document.find(over.piece.id), over.edge);
    const Flat chord = edge.curve.end - edge.curve.start;
    if (std::fabs(chord.v) < std::fabs(chord.u)) continue;  // it opens from the waist down
    SewFly fly;
    fly.a = {over.piece, over.edge}, fly.b = {PieceRef(other.piece), other.edge};
    const auto taken = [&] {
      return document.allowances.fastenings.contains(fly.name) || document.pieceNamed(fly.name + "_facing");
    };
    for (int n = 2; taken(); ++n) fly.name = "fly_" + std::to_string(n);
    return fly;
  }
  return std::nullopt;
}

namespace {

// The finish that the first of these has.
template <class Finish>
const Finish* finishOn(const std::map<Allowances::At, Finish>& all, const std::vector<EdgeRef>& edges) {
  for (const EdgeRef& edge : edges)
    if (const auto own = all.find({edge.piece.id, edge.edge}); own != all.end()) return &own->second;
  return nullptr;
}
template <class Finish>
Finish finishOrUsual(const std::map<Allowances::At, Finish>& all, const std::vector<EdgeRef>& edges) {
  const Finish* own = finishOn(all, edges);
  return own ? *own : Finish();
}

double tidy(double number) { return std::round(number * 1e4) / 1e4; }  // as it is read and typed

}  // namespace

SewElastic elasticAlong(const Document& document, std::vector<EdgeRef> edges) {
  constexpr double kDrawnIn = 0.6;  // of a line's length the elastic
  SewElastic made;
  made.edges = std::move(edges);
  const Piece* piece = made.edges.empty() ? nullptr : document.find(made.edges.front().piece.id);
  made.ratio = piece && findEdge(*piece, made.edges.front().edge) ? Elastic().ratio : kDrawnIn;
  if (const Elastic* own = finishOn(document.allowances.elastics, made.edges))
    made.ratio = tidy(own->ratio), made.strength = own->strength;
  return made;
}

SewElastic shirringAlong(const Document& document, std::vector<EdgeRef> edges) {
  SewElastic made;
  made.edges = std::move(edges);
  made.ratio = 0.7, made.strength = 2;
  made.rows = 5, made.spacing = Length{0.01};
  if (const Elastic* own = finishOn(document.allowances.elastics, made.edges))
    made.ratio = tidy(own->ratio), made.strength = own->strength;
  for (const EdgeRef& edge : made.edges)
    if (const Piece* piece = document.find(edge.piece.id))
      if (const ElasticRows own = elasticRows(*piece, edge.edge, document.allowances); own.count > 1) {
        made.rows = own.count, made.spacing = Length{tidy(own.spacing)};
        break;
      }
  return made;
}

SewTopstitch topstitchAlong(const Document& document, std::vector<EdgeRef> edges) {
  SewTopstitch made;
  const Topstitch own = finishOrUsual(document.allowances.topstitches, edges);
  const Piece* piece = edges.empty() ? nullptr : document.find(edges.front().piece.id);
  if (!piece || findEdge(*piece, edges.front().edge)) made.offset = Length{own.offset};
  made.edges = std::move(edges);
  made.rows = own.rows, made.length = Length{own.length};
  if (own.rows > 1) made.apart = Length{own.apart};
  return made;
}

SewPiping pipingAlong(const Document& document, std::vector<EdgeRef> edges) {
  SewPiping made;
  const Piping own = finishOrUsual(document.allowances.pipings, edges);
  made.edges = std::move(edges), made.thickness = Length{own.thickness}, made.fabric = own.fabric;
  return made;
}

BindEdges bindingAlong(const Document& document, std::vector<EdgeRef> edges) {
  BindEdges made;
  const Binding own = finishOrUsual(document.allowances.bindings, edges);
  made.edges = std::move(edges), made.width = Length{own.width}, made.fabric = own.fabric;
  return made;
}

GradePieces sizesOf(const Document& document) {
  GradePieces made;
  const Grading& grading = document.grading;
  made.sizes = grading.empty() ? std::vector<std::string>{"S", "M", "L"} : grading.sizes;
  made.base = grading.empty() ? "M" : grading.sizes[grading.base];
  return made;
}

GradePieces gradedCorner(const Document& document, const EdgeNear& near) {
  GradePieces made;
  const Piece& piece = *document.find(near.piece);
  const auto& edges = piece.outline.edges;
  const std::size_t k = (*piece.outline.find(near.edge) + (near.fraction > 0.5 ? 1 : 0)) % edges.size();
  made.corners = {{PieceRef(piece.id), edges[k].name}};
  const Grading& grading = document.grading;
  const auto own = grading.pieces.find(piece.id);
  if (own == grading.pieces.end()) return made;
  const std::size_t larger = grading.base + 1;
  const auto by = differenceAt(piece.outline, own->second, edges[k].name, 0, grading.sizes.size());
  made.by = larger < by.size() ? by[larger] : by[grading.base - 1] * -1;
  return made;
}

namespace {

// Whether a line runs across its piece from side to side, as that of a cuff does. A roll line runs out along the edge
// of the front, or cuts a corner off: what it turns back keeps its shape.
bool runsAcross(const Piece& piece, const Curve& line) {
  constexpr double kOn = 0.001;   // metres
  constexpr double kSteep = 0.5;  // of a right angle's sine
  const auto& edges = piece.outline.edges;
  const Flat along = normalized(line.end - line.start);
  std::vector<std::size_t> met[2];
  for (const bool last : {false, true}) {
    const Flat end = last ? line.end : line.start;
    bool steep = false;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const auto points = edges[k].curve.flattened();
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (distanceToSegment(points[i], points[i + 1], end) > kOn) continue;
        if (met[last].empty() || met[last].back() != k) met[last].push_back(k);
        steep = steep || std::fabs(cross(along, normalized(points[i + 1] - points[i]))) > kSteep;
      }
    }
    if (!met[last].empty() && !steep) return false;
  }
  const std::size_t n = edges.size();
  for (const std::size_t i : met[0])
    for (const std::size_t k : met[1])
      if (i == k || (i + 1) % n == k || (k + 1) % n == i) return false;
  return true;
}

}  // namespace

FoldLine turningAlong(const Document& document, PieceId piece, const std::string& line) {
  FoldLine made;
  made.piece = PieceRef(piece), made.lines = {line}, made.turned = true;
  made.angle = Angle{Crease::kSharpest};
  if (const Piece* own = document.find(piece))
    for (const InternalLine& drawn : own->lines)
      if (drawn.name == line) {
        // Across the piece it is cut to lie on what it is turned over.
        made.flared = drawn.curves.size() == 1 && drawn.curves.front().kind == Curve::Kind::Line &&
                      runsAcross(*own, drawn.curves.front());
        if (drawn.crease) made.angle = Angle{drawn.crease->angle}, made.hold = drawn.crease->hold;
      }
  return made;
}

void MainWindow::askNumbers(Operation operation) {
  if (session_->readOnly())
    return session_->refuse(refused(say("This garment was opened for reading only; keep a copy to work on it.")));
  auto* dialog = new StepDialog(*session_, std::move(operation), this);
  connect(dialog, &StepDialog::performed, this, [this] { refresh(); });
}

namespace {

// What is wrong with the formulas of a step on a figure that is not built yet; what only its body tells is left out.
std::optional<Error> formulaTrouble(const Operation& operation, std::string_view size) {
  const auto measures = builtInSize(size);
  if (!measures) return measures.error();
  Document document;
  document.body.measurements = *measures;
  bool asked = false;
  DocumentNames names(document, [&asked]() -> Result<BodyPtr> {
    asked = true;
    return refused({});
  });
  for (const FieldText& formula : operation.formulas)
    if (const auto value = workedOut(formula.value, names); !value && !asked) return value.error();
  return std::nullopt;
}

}  // namespace

void MainWindow::askBlock() {
  auto* dialog = new QDialog(this);
  dialog->setObjectName("block_dialog");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::WindowModal);
  dialog->setWindowTitle(inWords(say("Start from a block")));
  auto* form = new QFormLayout(dialog);
  form->setContentsMargins(24, 24, 24, 20);
  form->setSpacing(12);
  auto* size = new QComboBox;
  size->setObjectName("size");
  addSizes(*size);
  chooseSize(*size, kUsualSize);
  form->addRow(asLabel(say("Figure")), size);
  const OperationHelp& help = helpOf(Operation(DraftBlock{}));
  auto fields = std::make_shared<std::vector<StepField>>();
  const auto document = std::make_shared<Document>();  // the fields look at it
  auto* said = new QLabel;
  said->setObjectName("said");
  said->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  const auto wished = [size, fields, document]() -> Result<Operation> {
    std::vector<FieldText> texts;
    for (const StepField& field : *fields)
      if (std::string value = field.value(); !value.empty()) texts.push_back({field.name, std::move(value)});
    auto block = parseOperation(lineOf(DraftBlock::kName, texts));
    if (!block) return block.error();
    if (const auto why = formulaTrouble(*block, chosenSize(*size))) return *why;
    if (Done done = checkNumbers(std::get<DraftBlock>(*block)); !done) return done.error();
    return block;
  };
  const auto show = [dialog, wished, said, buttons] {
    const auto block = wished();
    said->setText(block ? QString() : inWords(block.error().what));
    buttons->button(QDialogButtonBox::Ok)->setEnabled(static_cast<bool>(block));
    dialog->layout()->activate();
    const int high = dialog->layout()->totalHeightForWidth(dialog->width());  // a long sentence hides no other
    if (dialog->isVisible() && high > dialog->height()) dialog->resize(dialog->width(), high);
  };
  const auto make = [this, dialog, size, wished, show] {
    const auto block = wished();
    if (!block) return show();
    newGarment(chosenSize(*size), {});
    session_->perform(*block);
    dialog->accept();
  };
  for (const FieldHelp& field : help.fields)
    for (const std::string_view asked : {"kind", "ease", "length", "fabric"})
      if (field.name == asked) {
        fields->push_back(stepField(*document, help.name, field, asked == "kind" ? "shirt" : "", make));
        if (auto* kinds = qobject_cast<QComboBox*>(fields->back().box); kinds && asked == "kind") {
          kinds->removeItem(kinds->findData("collar"));  // it is drafted for a neckline that is there
          const QString words = kinds->currentText();
          const QVariant shirt = kinds->currentData();
          kinds->removeItem(kinds->currentIndex());  // the first, as in the menu
          kinds->insertItem(0, words, shirt);
          kinds->setCurrentIndex(0);
        }
        auto* label = new QLabel(asLabel(fieldSaid(help.name, field.name)));
        label->setBuddy(fields->back().box);
        form->addRow(label, fields->back().box);
        if (auto* line = qobject_cast<QLineEdit*>(fields->back().box)) {
          line->setPlaceholderText(inWords(say("by the block's own rule")));
          connect(line, &QLineEdit::textChanged, dialog, show);
        }
      }
  connect(size, &QComboBox::currentIndexChanged, dialog, show);
  auto* note = new QLabel(inWords(
      say("The garment is drafted, sewn, put on the figure and draped. Type the person's measures on the board Body "
          "afterwards: it is drafted anew from them.")));
  note->setWordWrap(true);
  note->setProperty("role", "faint");
  form->addRow(note);
  said->setMinimumHeight(2 * said->fontMetrics().lineSpacing());
  form->addRow(said);
  buttons->button(QDialogButtonBox::Ok)->setText(inWords(say("Make it")));
  buttons->button(QDialogButtonBox::Ok)->setObjectName("make");
  buttons->button(QDialogButtonBox::Cancel)->setText(inWords(say("Cancel")));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, dialog, make);
  connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  dialog->open();
}

// The menus “New piece” and “Pleats, trims and fastenings”: by numbers, without the pointer.
void MainWindow::addNewPieces(QMenu& pieces, QMenu& details) {
  pieces.setObjectName("new_piece"), details.setObjectName("details");
  const auto named = [this](const char* name) { return usableName(session_->snapshot().document, name); };
  const auto chosen = [this]() -> std::optional<EdgeRef> {
    const auto& edge = session_->selection().edge;
    return edge ? std::optional(EdgeRef{PieceRef(edge->piece), edge->edge}) : std::nullopt;
  };
  QMenu* menu = &pieces;
  enum class Of { Nothing, Edge, Edges, Piece };  // what is to be chosen before
  const auto add = [&](const char* name, const Message& words, Of of, std::function<Operation()> made) {
    QAction* action = menu->addAction(QString());
    action->setObjectName(QString("new_") + name);
    action->setProperty(kEnglish, QString::fromStdString(text(words)));
    connect(menu, &QMenu::aboutToShow, action, [this, action, of, made, chosen] {
      const auto why = [&]() -> std::optional<Message> {
        if (session_->readOnly()) return say("This garment was opened for reading only; keep a copy to work on it.");
        if ((of == Of::Edge || of == Of::Edges) && !chosen()) return say("Choose an edge first.");
        if (of == Of::Edge && !session_->selection().more.empty()) return say("This takes one edge: choose it alone.");
        if (of == Of::Piece && session_->selection().pieces.empty()) return say("Choose a piece first.");
        if (of == Of::Piece && session_->selection().pieces.size() > 1) return say("Choose one piece alone.");
        return std::nullopt;
      }();
      action->setEnabled(!why);
      const Message says = why ? *why : Message{helpOf(made()).help, {}};
      action->setToolTip("<qt>" + inWords(says).toHtmlEscaped());
    });
    Theme::here().keep(action, [action, words] { action->setText(inWords(words)); });
    connect(action, &QAction::triggered, this, [this, made = std::move(made)] {
      Operation wish = made();
      cutFromItsCloth(wish, session_->snapshot().document, session_->selection().pieces);
      askNumbers(std::move(wish));
    });
  };
  add("rectangle", say("Rectangle…"), Of::Nothing, [named] {
    DrawRectangle made;
    made.name = named("rectangle");
    made.width = {0.2}, made.height = {0.2};
    return Operation(made);
  });
  add("circle", say("Circle…"), Of::Nothing, [named] {
    DrawRing made;
    made.name = named("circle");
    made.depth = {0.1};
    return Operation(made);
  });
  add("ring", say("Ring or sector, as for a circle skirt…"), Of::Nothing, [named, chosen, this] {
    DrawRing made;
    made.name = named("ring");
    made.depth = {0.5};
    made.angle = {std::numbers::pi};
    if (const auto edge = chosen())
      made.of = runChosen(session_->snapshot().document, session_->selection(), *edge);
    else
      made.inner = Length{0.6};
    return Operation(made);
  });
  add("polygon", say("Polygon…"), Of::Nothing, [named] {
    DrawPolygon made;
    made.name = named("polygon");
    made.points = {{0, 0}, {0.2, 0}, {0.2, 0.15}, {0, 0.2}};
    return Operation(made);
  });
  const auto run = [chosen, this] {
    const auto edge = chosen();
    return edge ? runChosen(session_->snapshot().document, session_->selection(), *edge) : std::vector<EdgeRef>();
  };
  add("band", say("Band along the chosen edge…"), Of::Edges, [chosen, run, this] {
    return Operation(bandAlong(session_->snapshot().document, chosen().value_or(EdgeRef{}), run()));
  });
  add("strap", say("Strap from the chosen edge…"), Of::Edge, [this] {
    const auto& edge = session_->selection().edge;
    return Operation(edge ? strapBetween(session_->snapshot().document, *edge, std::nullopt) : DrawStrap());
  });
  add("facing", say("Facing along the chosen edge…"), Of::Edges,
      [run, this] { return Operation(facingAlong(session_->snapshot().document, run())); });
  menu = &details;
  add("pleat", say("Pleats in the chosen edge…"), Of::Edge,
      [chosen, this] { return Operation(pleatsIn(session_->snapshot().document, chosen().value_or(EdgeRef{}))); });
  add("spread", say("Slash and spread, or fold out, from the chosen edge…"), Of::Edge,
      [chosen, this] { return Operation(slashFrom(session_->snapshot().document, chosen().value_or(EdgeRef{}))); });
  const auto addFinish = [&](const char* name, const Message& words, auto along) {
    add(name, words, Of::Edges, [run, along, this] { return Operation(along(session_->snapshot().document, run())); });
  };
  menu->addSeparator();
  addFinish("elastic", say("Elastic along the chosen edge…"), elasticAlong);
  addFinish("shirring", say("Shirring along the chosen edge…"), shirringAlong);
  addFinish("topstitch", say("Topstitching along the chosen edge…"), topstitchAlong);
  addFinish("piping", say("Piping along the chosen edge…"), pipingAlong);
  addFinish("binding", say("Binding along the chosen edge…"), bindingAlong);
  menu->addSeparator();
  add("fasten", say("Buttons or a zip along the chosen edge…"), Of::Edge, [chosen, this] {
    if (const auto edge = chosen())
      if (const auto buttons = buttonsAt(session_->snapshot(), *edge)) return Operation(*buttons);
    return Operation(fastenedTo(session_->snapshot().document, chosen().value_or(EdgeRef{}), EdgeRef{}));
  });
  add("zip", say("Zip in the seam of the chosen edge…"), Of::Edge, [chosen, this] {
    const Document& document = session_->snapshot().document;
    const std::vector<SeamId> seams = chosen() ? seamsOn(document, {*chosen()}) : std::vector<SeamId>();
    return Operation(zipIn(document, seams.empty() ? SeamId() : seams.front()));
  });
  add("fly", say("Fly over the chosen edge…"), Of::Edge, [chosen, this] {
    const auto edge = chosen();
    const auto fly = edge ? flyAt(session_->snapshot().document, *edge) : std::nullopt;
    SewFly bare;
    if (edge) bare.a = *edge;
    return Operation(fly.value_or(bare));
  });
  add("pocket", say("Pocket in the seam of the chosen edge…"), Of::Edge, [chosen, this] {
    const auto edge = chosen();
    const auto pocket = edge ? pocketIn(session_->snapshot().document, *edge) : std::nullopt;
    SewPocket bare;
    if (edge) bare.edge = *edge;
    return Operation(pocket.value_or(bare));
  });
  add("slanted", say("Slanted pocket at the chosen edge…"), Of::Edge, [chosen, this] {
    const auto edge = chosen();
    const auto pocket = edge ? slantedAt(session_->snapshot().document, *edge, 0) : std::nullopt;
    SewPocket bare;
    bare.kind = SewPocket::Kind::Slant;
    if (edge) bare.edge = *edge;
    return Operation(pocket.value_or(bare));
  });
  add("welt", say("Welt pocket in the chosen piece…"), Of::Piece, [this] {
    const auto& taken = session_->selection().pieces;
    const Piece* piece = taken.empty() ? nullptr : session_->snapshot().document.find(*taken.begin());
    if (!piece) return Operation(SewWelt());
    const FlatBox box = boxOf(piece->outline.flattened(1e-3));
    SewWelt bare;
    bare.piece = PieceRef(piece->id), bare.at = lerp(box.low, box.high, 0.5);
    return Operation(weltAt(session_->snapshot().document, piece->id, bare.at).value_or(bare));
  });
  add("patch", say("Chosen piece sewn onto another…"), Of::Piece, [this] {
    const auto& taken = session_->selection().pieces;
    return Operation(taken.empty() ? SewPatch() : patchOf(session_->snapshot().document, *taken.begin()));
  });
  add("attach", say("Lead the chosen edge along others…"), Of::Edge, [chosen] {
    AttachPiece made;
    if (const auto edge = chosen()) made.edge = *edge;
    return Operation(made);
  });
  for (QMenu* one : {&pieces, &details}) one->setToolTipsVisible(true);
}

}  // namespace karinui::studio
