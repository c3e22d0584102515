#include "beside.h"

#include <QFileDialog>
#include <QMenu>
#include <QThread>
#include <algorithm>

#include "file_filter.h"
#include "karinui/design/glossary.h"
#include "karinui/design/variant.h"
#include "space_view.h"
#include "theme.h"
#include "worn_figure.h"

namespace karinui::studio {

namespace {

Result<SnapshotPtr> worn(Result<Document> document, Context& context, const Prints& prints) {
  if (!document) return document.error();
  BodyPtr body;
  if (document->body.chosen()) {
    auto found = bodyOf(*document, context);
    if (!found) return found.error();
    body = *std::move(found);
  }
  return snapshotOf(*std::move(document), std::move(body), prints);
}

// What was done before a step brought the cloth to rest, by which a person knows it again.
Message whatCameToRest(const std::vector<Step>& steps, std::size_t number) {
  const auto drapes = [&](std::size_t k) { return std::holds_alternative<DrapePieces>(steps[k].operation); };
  std::size_t k = number - 1;
  while (k > 0 && drapes(k)) --k;
  return *termSaid(Term::OperationName, nameOf(steps[k].operation));
}

Result<SnapshotPtr> variant(const GarmentSnapshot& now, const Operation& change, Bodies& bodies, const Token& token) {
  Workers workers(std::max(1, QThread::idealThreadCount() / 2));
  WornFigure figure(now.body);
  Context context{workers, token, figure, bodies, {}, {}};
  return worn(variantOf(now.document, change, context), context, printsOf(now));
}

Result<SnapshotPtr> ofFile(const std::filesystem::path& path, Bodies& bodies, const Token& token) {
  Result<DocumentFile> file = DocumentFile::openForReading(path);
  if (!file) return file.error();
  Workers workers(1);
  Context context{workers, token, file->blobs(), bodies, {}, {}};
  PrintShelf shelf;
  return worn(file->document(), context, [&](const std::string& photo) { return shelf.find(photo, file->blobs()); });
}

}  // namespace

Beside::Beside(Session& session, SpaceView& view, QObject* parent) : QObject(parent), session_(session), view_(view) {
  thread_.setMaxThreadCount(1);
  connect(&Theme::here(), &Theme::changed, this, [this] {
    if (fitting_) view_.setBeside(fitting_, inWords(shown_.words));
  });
}

Beside::~Beside() {
  stop();
  thread_.waitForDone();
}

void Beside::stop() {
  if (token_) token_->cancel();
  token_.reset();
}

std::vector<Beside::Choice> Beside::sizes() const {
  std::vector<Choice> all;
  for (const std::string& size : session_.snapshot().document.grading.sizes)
    all.push_back({Operation(ChooseSize{size}), say("Size {0}", size)});
  return all;
}

std::vector<Beside::Choice> Beside::fabrics() const {
  std::vector<Choice> all;
  const Document& document = session_.snapshot().document;
  if (document.pattern.pieces.empty()) return all;
  for (const std::string& fabric : fabricNames(document))
    all.push_back({Operation(cutFrom(document, fabric)), say("in {0}", nameSaid(fabric))});
  return all;
}

std::vector<Beside::Choice> Beside::choices() const {
  std::vector<Choice> all{{{}, say("nothing")}};
  std::size_t number = session_.steps().size();
  for (auto step = session_.steps().rbegin(); step != session_.steps().rend(); ++step, --number)
    if (std::holds_alternative<DrapePieces>(step->operation) || std::holds_alternative<PullCloth>(step->operation))
      all.push_back({step->seq, say("after step {0}: {1}", number, whatCameToRest(session_.steps(), number))});
  for (const Step& end : session_.otherBranches())
    all.push_back({end.seq, say("another way, {0} {0|step|steps}", static_cast<std::size_t>(end.serial))});
  for (const auto& more : {sizes(), fabrics()}) all.insert(all.end(), more.begin(), more.end());
  if (std::holds_alternative<std::filesystem::path>(shown_.what)) all.push_back(shown_);
  return all;
}

void Beside::show(const Choice& choice) {
  shown_ = choice;
  of_ = session_.path();
  if (std::holds_alternative<Operation>(shown_.what))
    session_.advise(say("It is draped to be seen beside this garment: {0}", shown_.words));
  if (!std::holds_alternative<std::monostate>(shown_.what)) return ask();
  stop();
  fitting_.reset();
  view_.setBeside(nullptr, {});
  emit changed();
}

void Beside::askFile(QWidget* window) {
  const QString path = QFileDialog::getOpenFileName(window, inWords(say("Another garment beside it")), {},
                                                    filterReading("Karinui", {FileContent::Document}));
  if (path.isEmpty()) return;
  const std::filesystem::path file = path.toStdString();
  show({file, say("{0}", file.filename().string())});
}

void Beside::fill(QMenu& menu, QWidget* window) {
  menu.clear();
  const auto add = [this](QMenu& to, const Choice& choice) {
    QAction* one = to.addAction(inWords(choice.words));
    one->setCheckable(true);
    one->setChecked(choice.what == shown_.what);
    connect(one, &QAction::triggered, this, [this, choice] { show(choice); });
  };
  add(menu, {{}, say("nothing")});
  const QAction* other = menu.addAction(inWords(say("Another garment…")));
  connect(other, &QAction::triggered, this, [this, window] { askFile(window); });
  menu.setToolTipsVisible(true);
  struct Group {
    Message words, none, why;
    std::vector<Choice> all;
  };
  const Group groups[] = {
      {say("Another size"), say("Another size – this garment has none"),
       say("This garment has no sizes: it is made to one figure's measures."), sizes()},
      {say("Another fabric"), say("Another fabric – there is no piece yet"), say("There is no piece yet."), fabrics()}};
  for (const Group& one : groups) {
    const bool some = !one.all.empty();
    QMenu* group = menu.addMenu(inWords(some ? one.words : one.none));  // read without resting on it, too
    group->setEnabled(some);
    if (!some) group->menuAction()->setToolTip(inWords(one.why));
    for (const Choice& choice : one.all) add(*group, choice);
  }
}

void Beside::ask() {
  stop();
  askedFor_ = session_.changes().history;
  if (const auto* seq = std::get_if<std::uint64_t>(&shown_.what))
    session_.snapshotAfter(*seq, [this, asked = *seq](const SnapshotPtr& found) {
      if (shown_.what == What(asked)) take(found);
    });
  else if (const auto* file = std::get_if<std::filesystem::path>(&shown_.what))
    work([path = *file](Bodies& bodies, const Token& token) { return ofFile(path, bodies, token); });
  else if (const auto* change = std::get_if<Operation>(&shown_.what))
    work([now = session_.shownPtr(), change = *change](Bodies& bodies, const Token& token) {
      return variant(*now, change, bodies, token);
    });
}

void Beside::work(std::function<Result<SnapshotPtr>(Bodies&, const Token&)> how) {
  token_ = std::make_shared<Token>();
  thread_.start([this, how = std::move(how), token = token_, bodies = bodies_] {
    const Result<SnapshotPtr> found = how(*bodies, *token);
    QMetaObject::invokeMethod(this, [this, token, found] {
      if (token_ != token) return;  // something else is wanted by now
      token_.reset();
      take(found);
    });
  });
}

void Beside::take(const Result<SnapshotPtr>& found) {
  if (!found) session_.refuse(found.error());
  if (!found || !*found) return show({{}, say("nothing")});
  fitting_ = *found;
  view_.setBeside(fitting_, inWords(shown_.words));
  emit changed();
}

void Beside::refresh() {
  if (std::holds_alternative<std::monostate>(shown_.what) || askedFor_ == session_.changes().history) return;
  if (of_ != session_.path()) return show({{}, say("nothing")});  // another document came
  if (!session_.idle()) return;
  // Every piece there is now is cut from the fabric.
  if (auto* change = std::get_if<Operation>(&shown_.what))
    if (const auto* fabric = std::get_if<SetFabric>(change))
      shown_.what = Operation(cutFrom(session_.snapshot().document, fabric->name));
  if (std::holds_alternative<Operation>(shown_.what)) return ask();
  // A step that is gone takes its picture along.
  askedFor_ = session_.changes().history;
  const auto all = choices();
  if (std::none_of(all.begin(), all.end(), [&](const Choice& one) { return one.what == shown_.what; }))
    show({{}, say("nothing")});
}

}  // namespace karinui::studio
