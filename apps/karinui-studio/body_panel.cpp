#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <cmath>

#include "file_filter.h"
#include "karinui/base/number.h"
#include "karinui/body/measure_range.h"
#include "karinui/body/tape_path.h"
#include "karinui/design/variables.h"
#include "length_box.h"
#include "measure_drawing.h"
#include "measure_row.h"
#include "measures_file.h"
#include "panels.h"
#include "size_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// The measures one is asked for first, and all others that a mannequin can be made to.
constexpr std::string_view kFirst[]{"height",         "bust_girth", "under_bust_girth", "waist_girth", "hip_girth",
                                    "shoulder_width", "arm_length", "crotch_height",    "belly_girth"};
constexpr std::string_view kOwn[]{"height", "bust_girth", "waist_girth", "hip_girth"};  // that make a figure
constexpr std::string_view kLevels[]{"bust_height", "armpit_height", "waist_height", "back_waist_length"};
constexpr std::string_view kArms[]{"upper_arm_girth", "elbow_girth", "wrist_girth", "arm_joint_length", "neck_girth"};
constexpr std::string_view kLegs[]{"thigh_girth", "knee_girth", "calf_girth", "ankle_girth"};

}  // namespace

BodyPanel::BodyPanel(Session& session, QWidget* in) : Panel(session, in) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(10);
  auto* form = form_ = new QFormLayout;
  form->addRow(title(say("Figure")));
  size_ = new QComboBox;
  Theme::here().keep(size_, [this] {
    const std::string was = size_->count() > 0 ? chosenSize(*size_) : std::string(kUsualSize);
    size_->clear();
    size_->addItem(inWords(say("by measurements only")));
    addSizes(*size_);
    chooseSize(*size_, was);
  });
  sex_ = new QComboBox;
  Theme::here().keep(sex_, [this] {
    const int was = sex_->currentIndex();
    sex_->clear();
    sex_->addItem(inWords(say("as the size")));
    sex_->addItem(inWords(say("female")));
    sex_->addItem(inWords(say("male")));
    sex_->addItem(inWords(say("child")));
    sex_->setCurrentIndex(std::max(0, was));
  });
  letShrink(*size_), letShrink(*sex_);
  sex_->setMinimumContentsLength(5);  // the dress form stands beside it
  form->addRow(word(say("Size")), size_);
  dressForm_ = new QCheckBox;
  Theme::here().keep(dressForm_, [this] {
    dressForm_->setText(inWords(say("Dress form")));
    dressForm_->setToolTip(inWords(say("The trunk of the same measures, without head, arms and legs.")));
  });
  connect(dressForm_, &QCheckBox::clicked, this, &BodyPanel::wear);
  auto* shape = new QHBoxLayout;  // one row: the measures below need the height
  shape->addWidget(sex_, 1);
  shape->addWidget(dressForm_);
  form->addRow(word(say("Shape")), shape);
  column->addLayout(form);
  imported_ = new QLabel;  // no row of the form, which leaves a sentence that was hidden at first no height
  imported_->setWordWrap(true);
  imported_->hide();
  column->addWidget(imported_);
  find_ = new QLineEdit;
  find_->setClearButtonEnabled(true);
  Theme::here().keep(find_, [this] {
    find_->setPlaceholderText(inWords(say("Find a measure")));
    find_->setAccessibleName(inWords(say("Find a measure")));
  });
  connect(find_, &QLineEdit::textChanged, this, &BodyPanel::findRows);
  column->addWidget(find_);
  drawing_ = new MeasureDrawing;
  drawing_->setMaximumHeight(170);
  column->addWidget(drawing_, 1);
  auto* inner = new QWidget;
  auto* rows = new QVBoxLayout(inner);
  rows->setContentsMargins(0, 0, 4, 0);
  measures_ = new QFormLayout;
  rows->addLayout(measures_);
  addRows(say("Asked for first"), kFirst);
  addRows(say("Levels"), kLevels);
  addRows(say("Arms and neck"), kArms);
  addRows(say("Legs"), kLegs);
  rows->addWidget(title(say("As measured")));
  measured_ = new QLabel;
  measured_->setTextFormat(Qt::RichText);
  measured_->setProperty("role", "faint");
  measured_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  rows->addWidget(measured_);
  rows->addStretch(1);
  auto* scroll = new QScrollArea;
  column->addWidget(scroll, 4);
  scroll->setWidget(inner);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setMinimumHeight(90);
  mannequin_ = new QPushButton;
  consequence_ = new QLabel;
  consequence_->setWordWrap(true);
  consequence_->setProperty("role", "faint");
  Theme::here().keep(mannequin_, [this] {
    mannequin_->setText(inWords(say("Make a mannequin with these measures")));
    consequence_->setText(inWords(
        say("It takes this body's place, with its measures but a mannequin's shape and posture. The garment keeps "
            "its paper and settles anew; Undo brings the body back.")));
    mannequin_->setAccessibleDescription(consequence_->text());
  });
  connect(mannequin_, &QPushButton::clicked, this, [this] {
    SetBody own;
    own.set = asMeasured(mannequinKeys());
    session_.perform(own);
  });
  column->addWidget(mannequin_);
  column->addWidget(consequence_);
  follow_ = new QCheckBox;
  follow_->setChecked(true);
  Theme::here().keep(follow_, [this] {
    follow_->setText(inWords(say("make the garment again at once")));
    follow_->setToolTip(
        inWords(say("Every step is played again on the figure as you change it; one undo brings the old one back.")));
  });
  column->addWidget(follow_);
  use_ = new QPushButton;
  Theme::here().keep(use_, [this] {
    use_->setText(inWords(say("Put the garment on this figure")));
    use_->setToolTip(inWords(say("The same paper on another figure: it settles anew.")));
  });
  replay_ = new QPushButton;
  Theme::here().keep(replay_, [this] {
    replay_->setText(inWords(say("Make the garment anew for it…")));
    replay_->setToolTip(
        inWords(say("Plays every step again on the new figure, into a document of its own: made to measure.")));
  });
  auto* load = new QPushButton;
  Theme::here().keep(load, [load] { load->setText(inWords(say("Import a body…"))); });
  column->addWidget(use_);
  column->addWidget(replay_);
  column->addWidget(load);
  auto* files = new QVBoxLayout;  // side by side they are wider than a narrow board
  const auto button = [&](const Message& words, const Message& hint, void (BodyPanel::*what)()) {
    auto* made = new QPushButton;
    Theme::here().keep(made, [made, words, hint] {
      made->setText(inWords(words));
      made->setToolTip(inWords(hint));
    });
    connect(made, &QPushButton::clicked, this, what);
    files->addWidget(made);
  };
  button(say("Open measures…"),
         say("A person's measures from a file: Karinui, Valentina, Seamly2D, FreeSewing, GarmentCode."),
         &BodyPanel::askMeasures);
  button(say("Save measures…"), say("All that this figure measures, into a file of one of these."),
         &BodyPanel::askSaveMeasures);
  column->addLayout(files);
  connect(size_, &QComboBox::activated, this, [this] { sizeMeant_ = true; });
  for (QComboBox* box : {size_, sex_}) connect(box, &QComboBox::activated, this, &BodyPanel::wear);
  connect(use_, &QPushButton::clicked, this, [this] { session_.perform(wished()); });
  connect(replay_, &QPushButton::clicked, this, [this] { emit replayAsked(wished()); });
  connect(load, &QPushButton::clicked, this, &BodyPanel::importAsked);
}

void BodyPanel::addRows(const Message& group, std::span<const std::string_view> keys) {
  const auto made = mannequinKeys();
  MeasureGroup& own = groups_.emplace_back(MeasureGroup{title(group), {}});
  measures_->addRow(own.title);
  for (const std::string_view named : keys) {
    if (std::find(made.begin(), made.end(), named) == made.end()) continue;
    const std::string key(named);
    const Message name = termSaid(Term::Measure, key).value_or(say("{0}", key));
    auto* row = new MeasureRow(name);
    if (const auto range = measureRange(key)) row->box().setSensible(range->first, range->second);
    QLabel* label = names_[key] = word(name);
    label->setWordWrap(true);
    Theme::here().keep(label, [label, key] {
      const Message how = tapeSaid(key);
      label->setToolTip(inWords(how) + "\n" + scriptHint(key));
    });
    measures_->addRow(label, row);
    connect(row, &MeasureRow::turned, this, [this] {
      if (!imported()) session_.previewFigure(wished());
    });
    connect(row, &MeasureRow::set, this, &BodyPanel::wear);
    connect(row->box().findChild<QLineEdit*>(), &QLineEdit::returnPressed, this, [this, row] {
      if (session_.figure() || session_.busy().any) return;
      session_.perform(wished());  // the first figure
      emit row->box().left();
    });
    connect(row, &MeasureRow::entered, this, [this, key] { drawTape(key); });
    row->box().takeFormulas([this, key](const std::string& formula) -> Result<double> {
      SetBody body = wished();
      std::erase_if(body.set, [&](const Stated& s) { return s.key == key; });
      const auto read = Formula::parse(formula);
      if (!read) return read.error();
      body.set.push_back({key, {}, read->text()});
      if (Done done = workOutStated(body); !done) return done.error();
      return body.set.back().value.metres;
    });
    rows_[key] = row;
    own.keys.push_back(key);
  }
}

void BodyPanel::findRows(const QString& wanted) {
  for (const MeasureGroup& group : groups_) {
    bool any = false;
    for (const std::string& key : group.keys) {
      const bool found = names_.at(key)->text().contains(wanted.trimmed(), Qt::CaseInsensitive) ||
                         QString::fromStdString(key).contains(wanted.trimmed().replace(' ', '_'), Qt::CaseInsensitive);
      measures_->setRowVisible(rows_.at(key), found);
      any = any || found;
    }
    measures_->setRowVisible(group.title, any);
  }
}

void BodyPanel::drawTape(const std::string& key) {
  drawnKey_ = key;
  drawing_->show(session_.shown().body, drawnKey_);
}

void BodyPanel::askMeasures() {
  const QString path = QFileDialog::getOpenFileName(
      this, inWords(say("Open measures…")), {},
      inWords(say("Measures")) + " (" + filterReading("", {FileContent::Measures}).section('(', 1).section(')', 0, 0) +
          " *.json)");
  if (!path.isEmpty()) wearMeasures(session_, path.toStdString());
}

void BodyPanel::askSaveMeasures() {
  QStringList endings;
  for (const std::string& ending : measureEndingsWritten()) endings << QString::fromStdString(ending);
  const QString path = askToWrite(this, inWords(say("Save measures…")), {},
                                  inWords(say("Measures")) + " (*." + endings.join(" *.") + ")", endings);
  if (path.isEmpty()) return;
  saveMeasures(session_, path.toStdString());
}

SetBody BodyPanel::wished() const {
  SetBody body;
  body.size = chosenSize(*size_);
  if (sex_->currentIndex() > 0) body.sex = kSexes[sex_->currentIndex() - 1];
  body.form = dressForm_->isChecked();
  for (const auto& [key, row] : rows_)
    if (const auto metres = row->stated()) body.set.push_back({key, {*metres}, row->formula()});
  // The size that a board without a figure offers was not chosen: what is typed there is a person's own.
  if (!session_.figure() && !sizeMeant_ && !body.set.empty()) body.size.clear();
  // Without a size the figure that stands goes on, as far as its own measures make it.
  if (body.size.empty() && body.set.empty() && session_.snapshot().body) {
    constexpr double kMillimetre = 1e-3;
    body.set = asMeasured(kOwn);
    for (Stated& own : body.set) own.value.metres = std::round(own.value.metres / kMillimetre) * kMillimetre;
  }
  return body;
}

bool BodyPanel::imported() const {
  const SetBody* now = session_.figure();
  return now && !now->mesh.empty();
}

// Of these measures the figure's own.
std::vector<Stated> BodyPanel::asMeasured(std::span<const std::string_view> keys) const {
  std::vector<Stated> all;
  const auto& measured = session_.snapshot().body->measured().value;
  for (const std::string_view key : keys)
    if (const auto at = measured.find(std::string(key)); at != measured.end() && !isAngle(at->first))
      all.push_back({at->first, {at->second}});
  return all;
}

// A garment is made again for the figure as it is now; where there is no figure yet, the button asks for one.
void BodyPanel::wear() {
  if (!session_.figure() || imported()) return;
  if (follow_->isChecked())
    session_.applyFigure(wished());
  else
    session_.previewFigure(wished());
}

void BodyPanel::fill() {
  const SetBody* now = session_.figure();
  const bool mesh = imported();
  int sizeRow = 0;
  QFormLayout::ItemRole role{};
  form_->getWidgetPosition(size_, &sizeRow, &role);
  for (const int own : {sizeRow, sizeRow + 1}) form_->setRowVisible(own, !mesh);  // size, and shape with the dress form
  for (QWidget* own :
       {static_cast<QWidget*>(imported_), static_cast<QWidget*>(mannequin_), static_cast<QWidget*>(consequence_)})
    own->setVisible(mesh && session_.snapshot().body);
  for (QWidget* own : {static_cast<QWidget*>(follow_), static_cast<QWidget*>(use_), static_cast<QWidget*>(replay_)})
    own->setVisible(!mesh);
  if (mesh && session_.snapshot().body)
    imported_->setText(inWords(say("The imported body “{0}”. Its measures are taken from it and cannot be turned.",
                                   session_.snapshot().body->name())));
  if (now && !mesh) {
    chooseSize(*size_, now->size);
    dressForm_->setChecked(now->form);
    sex_->setCurrentIndex(now->sex ? static_cast<int>(*now->sex) + 1 : 0);
  }
  const BodyPtr& body = session_.snapshot().body;
  SetBody worn = now ? *now : SetBody();
  (void)workOutStated(worn);  // what was worn was not refused
  for (const auto& [key, row] : rows_) {
    std::optional<double> stated;
    std::string formula;
    for (const Stated& s : worn.set)
      if (s.key == key) stated = s.value.metres, formula = s.formula;
    QFont font = names_.at(key)->font();  // what was typed stands out from what follows
    font.setBold(stated.has_value());
    names_.at(key)->setFont(font);
    const auto& measured = body ? body->measured().value : std::map<std::string, double>();
    const auto at = measured.find(key);
    if (mesh)
      row->showMeasured(at == measured.end() ? 0 : at->second);
    else
      row->show(stated, formula, at == measured.end() ? 0 : at->second);
  }
}

void BodyPanel::refresh() {
  replay_->setEnabled(!session_.snapshot().document.pattern.pieces.empty());
  const GarmentSnapshot& fitting = session_.snapshot();
  const std::string now = (fitting.body ? fitting.body->hash() : "-") + (imported() ? " imported" : "");
  if (historyShown_ == ~0ull) historyShown_ = 0, shown_.clear(), listed_.clear();  // in another language or unit
  // What was refused, or stopped half-way, is not what is worn.
  const SetBody* worn = session_.figure();
  if (follow_->isChecked() && worn && !imported() && !session_.busy().any && !(wished() == *worn)) fill();
  fillMeasured();
  if (now == shown_) return;
  shown_ = now;
  fill();
}

// Of the figure that is seen, also while another is only tried.
void BodyPanel::fillMeasured() {
  const BodyPtr& body = session_.shown().body;
  const std::string now = body ? body->hash() : "-";
  drawing_->setVisible(body != nullptr);  // the rows have its room before
  drawing_->show(body, drawnKey_);
  if (now == listed_) return;
  listed_ = now;
  QString lines;
  if (body)
    for (const auto& [key, value] : body->measured().value)
      lines +=
          "<tr><td>" + inWords(identifierSaid(key).value_or(say("{0}", key))) + "&nbsp;&nbsp;</td><td align=right>" +
          QString::fromStdString(isAngle(key) ? fixed(value * 57.29577951, 1) + "°" : lengthText(value).toStdString()) +
          "</td></tr>";
  measured_->setText("<table>" + lines + "</table>");
}

}  // namespace karinui::studio
