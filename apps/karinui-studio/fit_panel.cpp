#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QSlider>
#include <cmath>

#include "beside.h"
#include "karinui/base/number.h"
#include "karinui/session/wide_edges.h"
#include "length_box.h"
#include "panels.h"
#include "theme.h"

namespace karinui::studio {

FitPanel::FitPanel(Session& session, SpaceView& view, QWidget* in) : Panel(session, in), view_(view) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(10);
  auto* form = new QFormLayout;
  form->addRow(title(say("Fit")));
  map_ = new QComboBox;
  Theme::here().keep(map_, [this] {
    const int was = map_->currentIndex();
    const QSignalBlocker quiet(map_);
    map_->clear();
    map_->addItems({inWords(say("cloth")), inWords(say("strain")), inWords(say("distance to body")),
                    inWords(say("pressure on the body"))});
    map_->setCurrentIndex(std::max(0, was));
  });
  form->addRow(word(say("Show")), map_);
  tape_ = new QCheckBox;
  Theme::here().keep(tape_, [this] {
    tape_->setText(inWords(say("tape measure at the pointer")));
    tape_->setToolTip(
        inWords(say("On cloth the tape goes round the garment, on skin round the body, at the pointer's height.")));
  });
  form->addRow(word(say("Tape")), tape_);
  beside_ = new QComboBox;
  Theme::here().keep(beside_, [this] { beside_->setAccessibleName(inWords(say("Beside it"))); });
  letShrink(*beside_,
            say("At the left another garment, another size or fabric, or the garment as it was after a step; at the "
                "right the garment as it is."));
  form->addRow(word(say("Beside it")), beside_);
  column->addLayout(form);
  report_ = new QLabel;
  report_->setWordWrap(true);
  report_->setTextFormat(Qt::RichText);
  column->addWidget(report_);

  form = new QFormLayout;
  form->addRow(title(say("Girths")));
  girths_ = new QLabel;
  girths_->setTextFormat(Qt::RichText);
  girths_->setWordWrap(true);
  girths_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  form->addRow(girths_);
  level_ = new QCheckBox;
  Theme::here().keep(level_, [this] {
    level_->setText(inWords(say("at a height")));
    level_->setToolTip(inWords(say("A level tape round garment and body, at any height above the floor.")));
  });
  height_ = new LengthBox(say("Height above the floor"), 0, 2.6);
  height_->setMetres(1.0);
  slide_ = new QSlider(Qt::Horizontal);
  slide_->setRange(0, 2200);
  slide_->setValue(1000);
  Theme::here().keep(slide_, [this] { slide_->setAccessibleName(inWords(say("Height above the floor"))); });
  form->addRow(level_, height_);
  form->addRow(slide_);
  column->addLayout(form);

  form = new QFormLayout;
  form->addRow(title(say("Stereo")));
  stereo_ = new QComboBox;
  stereo_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  Theme::here().keep(stereo_, [this] {
    const int was = stereo_->currentIndex();
    const QSignalBlocker quiet(stereo_);
    stereo_->clear();
    for (const Message& name : stereoNames()) stereo_->addItem(inWords(name));
    stereo_->setCurrentIndex(std::max(0, was));
  });
  letShrink(*stereo_);
  letShrink(*map_);
  eyes_ = new LengthBox(say("Eyes apart"), 0, 0.2);
  eyes_->setMetres(0.063);
  focus_ = new QDoubleSpinBox;
  focus_->setRange(0.3, 3);
  focus_->setSingleStep(0.05);
  focus_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  focus_->setValue(1);
  form->addRow(word(say("Screen")), stereo_);
  form->addRow(word(say("Eyes apart")), eyes_);
  form->addRow(word(say("Depth of the screen")), focus_);
  column->addLayout(form);
  column->addStretch(1);
  const auto levelled = [this] {
    view_.setLevel(level_->isChecked() ? std::optional(height_->value()) : std::nullopt);
  };
  connect(level_, &QCheckBox::toggled, this, levelled);
  connect(height_, &LengthBox::typed, this, [this](double metres) {
    level_->setChecked(true);
    slide_->setValue(static_cast<int>(std::lround(1000 * metres)));
  });
  connect(slide_, &QSlider::valueChanged, this, [this, levelled](int millimetres) {
    if (std::lround(1000 * height_->value()) != millimetres) height_->setMetres(millimetres / 1000.0);
    level_->setChecked(true);
    levelled();
  });
  auto* beside = new Beside(session, view, this);
  connect(beside_, &QComboBox::activated, this, &FitPanel::compare);
  connect(beside, &Beside::changed, this, [this, beside] {
    then_ = beside->fitting();
    fillBeside();
    fillReport();
  });
  connect(map_, &QComboBox::currentIndexChanged, this, [this](int i) { view_.setMap(static_cast<FitMap>(i)); });
  connect(tape_, &QCheckBox::toggled, this, [this](bool on) { view_.setTape(on); });
  connect(stereo_, &QComboBox::currentIndexChanged, this, [this](int i) {
    view_.setStereo(static_cast<Stereo>(i));
    stereo_->setCurrentIndex(static_cast<int>(view_.stereo()));
  });
  for (QDoubleSpinBox* box : {static_cast<QDoubleSpinBox*>(eyes_), focus_})
    connect(box, &QDoubleSpinBox::valueChanged, this, [this] { view_.setEyes(eyes_->value(), focus_->value()); });
}

void FitPanel::showEvent(QShowEvent* event) {
  Panel::showEvent(event);
  refresh();
}

void FitPanel::refresh() {
  findChild<Beside*>()->refresh();
  if (map_->currentIndex() != static_cast<int>(view_.map())) {
    const QSignalBlocker quiet(map_);
    map_->setCurrentIndex(static_cast<int>(view_.map()));
  }
  if (stereo_->currentIndex() != static_cast<int>(view_.stereo())) {
    const QSignalBlocker quiet(stereo_);
    stereo_->setCurrentIndex(static_cast<int>(view_.stereo()));
  }
  if (!isVisible() || historyShown_ == session_.changes().history) return;
  historyShown_ = session_.changes().history;
  fillBeside();
  fillReport();
}

void FitPanel::fillBeside() {
  const auto* beside = findChild<Beside*>();
  const QSignalBlocker quiet(beside_);
  beside_->clear();
  for (const Beside::Choice& choice : beside->choices()) {
    beside_->addItem(inWords(choice.words));
    if (choice.what == beside->what()) beside_->setCurrentIndex(beside_->count() - 1);
  }
  beside_->addItem(inWords(say("Another garment…")));
}

void FitPanel::compare() {
  auto* beside = findChild<Beside*>();
  const std::vector<Beside::Choice> all = beside->choices();
  const auto which = static_cast<std::size_t>(std::max(0, beside_->currentIndex()));
  if (which < all.size())
    beside->show(all[which]);
  else
    beside->askFile(this);
  fillBeside();  // what is not had is not chosen
}

void FitPanel::fillReport() {
  // Names break between their words, numbers do not; with a column more the columns stand closer together.
  const QString apart = then_ ? "&nbsp;" : "&nbsp;&nbsp;";
  const auto whole = [](QString number) { return number.replace(" ", "&nbsp;"); };
  const auto row = [&](const std::vector<QString>& cells) {
    QString all = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
      all += (i == 0 ? "<td>" + cells[i] : "<td align=right>" + whole(cells[i])) + (i + 1 < cells.size() ? apart : "") +
             "</td>";
    return all + "</tr>";
  };
  const auto& last = session_.snapshot().document.drape.last;
  if (!last) {
    report_->setText(inWords(say("Not draped yet. Space settles the cloth.")));
  } else {
    using Said = std::function<QString(const SettleReport&)>;
    const auto percent = [](double x) { return QString::fromStdString(fixed(100 * x, 2)) + " %"; };
    const std::pair<Message, Said> lines[] = {
        {say("at rest"), [](const auto& r) { return r.settled ? inWords(say("yes")) : inWords(say("no")); }},
        {say("stretch, on average"), [&](const auto& r) { return percent(r.strain.mean); }},
        {say("99 % of the cloth is stretched less than"), [&](const auto& r) { return percent(r.strain.p99); }},
        {say("widest seam gap"), [](const auto& r) { return lengthText(r.seamGap, 2); }},
        {say("deepest in the body"), [](const auto& r) { return lengthText(r.penetration, 2); }}};
    const SettleReport* before = then_ && then_->document.drape.last ? &*then_->document.drape.last : nullptr;
    QString table;
    if (before) table = row({"", inWords(say("left")), inWords(say("now"))});
    for (const auto& [words, said] : lines)
      table += before ? row({inWords(words), said(*before), said(*last)}) : row({inWords(words), said(*last)});
    table = "<table>" + table + "</table>";
    if (session_.snapshot().document.drape.dirty.empty()) {
      QString fastened;
      const auto length = [](double metres) { return lengthText(metres, 2).toStdString(); };
      for (const FasteningPull& pull : fasteningsOf(session_.snapshot()))
        fastened += "<tr><td>" + inWords(fastenerSaid(pull)).toHtmlEscaped() + apart + "</td><td>" +
                    (pull.holds() ? QString() : QString::fromUtf8("⚠ ")) +
                    inWords(pulledSaid(pull, length)).toHtmlEscaped() + "</td></tr>";
      if (!fastened.isEmpty())
        table += "<p><b>" + inWords(say("Fastenings")) + "</b></p><table>" + fastened + "</table>";
    }
    for (const WideEdge& edge : wideEdges(session_.snapshot()))
      table += "<p>" + inWords(wideEdgeSaid(session_.snapshot().document, edge)).toHtmlEscaped() + "</p>";
    report_->setText(table);
  }
  const std::vector<Girths> now = girthsOf(session_.snapshot());
  if (now.empty()) return girths_->setText("–");
  // Beside another garment the unit is told once, for there is no room for it in every column.
  const auto number = [&](double metres) {
    const QString said = lengthText(metres);
    return then_ ? said.left(said.lastIndexOf(' ')) : said;
  };
  std::vector<QString> head{then_ ? lengthText(0).section(' ', -1) : QString(), inWords(say("body")),
                            inWords(say("garment")), inWords(say("ease"))};
  if (then_) head.push_back(inWords(say("left")));
  constexpr double kThere = 0.005;  // metres: so near it is that level
  QString table = row(head);
  for (const Girths& g : now) {
    const QString where = std::fabs(g.off) < kThere ? inWords(g.name)
                          : g.off < 0 ? inWords(say("{0}, {1} below it", g.name, lengthText(-g.off).toStdString()))
                                      : inWords(say("{0}, {1} above it", g.name, lengthText(g.off).toStdString()));
    std::vector<QString> cells{where, number(g.body), number(g.garment), number(g.garment - g.body)};
    if (then_)
      for (const Girths& before : girthsAt(*then_, g.height))
        if (before.what == g.what) cells.push_back(number(before.garment));
    table += row(cells);
  }
  girths_->setText("<table>" + table + "</table>");
}

}  // namespace karinui::studio
