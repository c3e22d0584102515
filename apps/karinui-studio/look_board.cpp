#include "look_board.h"

#include <QColorDialog>
#include <QComboBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <array>
#include <numbers>

#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {

QColor onScreen(const Dye& dye) { return QColor(dye.red, dye.green, dye.blue); }
Dye dyeOf(const QColor& colour) {
  return {static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
          static_cast<std::uint8_t>(colour.blue())};
}

// Words of an operation's field, in the order of its enumeration.
constexpr std::array<std::string_view, 10> kFinishes{"poplin", "linen", "denim",   "suiting", "tweed",
                                                     "jersey", "satin", "chiffon", "velvet",  "leather"};
constexpr std::array<std::string_view, 5> kPrints{"none", "stripe", "check", "dot", "photo"};

template <std::size_t n>
void fill(QComboBox& box, const std::array<std::string_view, n>& words) {
  Theme::here().keep(&box, [&box, &words] {
    while (box.count() < static_cast<int>(n)) box.addItem(QString());
    for (std::size_t k = 0; k < n; ++k)
      box.setItemText(static_cast<int>(k), inWords(termSaid(Term::Value, words[k]).value_or(Message())));
  });
}

// A photograph has its own colours.
bool hasInk(PrintKind kind) { return kind != PrintKind::None && kind != PrintKind::Photo; }

QLabel* word(const Message& words) {
  auto* label = new QLabel;
  label->setWordWrap(true);
  Theme::here().keep(label, [label, words] { label->setText(asLabel(words)); });
  return label;
}

}  // namespace

LookBoard::LookBoard(Session& session, std::function<std::optional<SetLook>()> about)
    : session_(session), about_(std::move(about)) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  finish_ = new QComboBox;
  finish_->setObjectName("look_finish");
  fill(*finish_, kFinishes);
  letShrink(*finish_);
  form->addRow(word(fieldSaid("look", "finish")), finish_);
  form->addRow(word(fieldSaid("look", "colour")),
               dyeRow(fieldSaid("look", "colour"), colour_, colourTyped_, &SetLook::colour));
  colourTyped_->setObjectName("look_colour");
  print_ = new QComboBox;
  print_->setObjectName("look_print");
  fill(*print_, kPrints);
  letShrink(*print_);
  form->addRow(word(fieldSaid("look", "print")), print_);

  printRows_ = new QWidget;
  auto* rows = new QFormLayout(printRows_);
  rows->setContentsMargins(0, 0, 0, 0);
  inkRow_ = dyeRow(fieldSaid("look", "ink"), ink_, inkTyped_, &SetLook::ink);
  rows->addRow(word(fieldSaid("look", "ink")), inkRow_);
  repeat_ = new LengthBox(fieldSaid("look", "repeat"), 0.001, 2);
  rows->addRow(word(fieldSaid("look", "repeat")), repeat_);
  turn_ = new MixedBox<QDoubleSpinBox>;
  turn_->setRange(-180, 180);
  turn_->setDecimals(1);
  turn_->setSuffix(" °");
  turn_->setKeyboardTracking(false);
  turn_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  rows->addRow(word(fieldSaid("look", "turn")), turn_);
  shiftRow_ = new QWidget;
  auto* shifts = new QHBoxLayout(shiftRow_);
  shifts->setContentsMargins(0, 0, 0, 0);
  across_ = new LengthBox(say("Print begins, across the grain"), -2, 2);
  along_ = new LengthBox(say("Print begins, along the grain"), -2, 2);
  shifts->addWidget(across_, 1);
  shifts->addWidget(along_, 1);
  rows->addRow(word(fieldSaid("look", "shift")), shiftRow_);
  form->addRow(printRows_);
  form->addRow(word(fieldSaid("look", "wrong")),
               dyeRow(fieldSaid("look", "wrong"), wrong_, wrongTyped_, &SetLook::wrong));
  wrongPrint_ = new QComboBox;
  wrongPrint_->setObjectName("look_wrong_print");
  fill(*wrongPrint_, kPrints);
  letShrink(*wrongPrint_);
  form->addRow(word(fieldSaid("look", "wrong_print")), wrongPrint_);
  wrongInkRow_ = new QWidget;
  auto* inks = new QFormLayout(wrongInkRow_);
  inks->setContentsMargins(0, 0, 0, 0);
  inks->addRow(word(fieldSaid("look", "wrong_ink")),
               dyeRow(fieldSaid("look", "wrong_ink"), wrongInk_, wrongInkTyped_, &SetLook::wrongInk));
  form->addRow(wrongInkRow_);
  photo_ = new QPushButton;
  plain_ = new QPushButton;
  Theme::here().keep(photo_, [this] {
    photo_->setText(inWords(say("Photograph…")));
    photo_->setToolTip(inWords(say("A PNG or JPEG file, printed along the grain at its true size.")));
    plain_->setText(inWords(say("As the fabric looks by itself")));
    turn_->setAccessibleName(inWords(fieldSaid("look", "turn")));
    finish_->setAccessibleName(inWords(fieldSaid("look", "finish")));
    print_->setAccessibleName(inWords(fieldSaid("look", "print")));
    wrongPrint_->setAccessibleName(inWords(fieldSaid("look", "wrong_print")));
  });
  form->addRow(photo_);
  form->addRow(plain_);

  connect(finish_, &QComboBox::activated, this, [this](int k) {
    const auto finish = static_cast<Finish>(k);
    if (finish != shown_.finish || differs([](const Look& one) { return one.finish; }))
      perform([finish](SetLook& look) { look.finish = finish; });
  });
  connect(print_, &QComboBox::activated, this, [this](int k) {
    const auto kind = static_cast<PrintKind>(k);
    if (kind == PrintKind::Photo && shown_.photo.empty()) return askPhoto();
    if (kind != shown_.print || differs([](const Look& one) { return one.print; }))
      perform([kind](SetLook& look) { look.print = kind; });
  });
  connect(wrongPrint_, &QComboBox::activated, this, [this](int k) {
    const auto kind = static_cast<PrintKind>(k);
    if (kind != wrongPrintIn(shown_) || differs(wrongPrintIn))
      perform([kind](SetLook& look) { look.wrongPrint = kind; });
  });
  connect(across_, &LengthBox::typed, this, [this](double metres) {
    perform([&](SetLook& look) { look.shift = Flat{metres, shift_.value_or(Flat()).v}; });
  });
  connect(along_, &LengthBox::typed, this, [this](double metres) {
    perform([&](SetLook& look) { look.shift = Flat{shift_.value_or(Flat()).u, metres}; });
  });
  connect(repeat_, &LengthBox::typed, this,
          [this](double metres) { perform([metres](SetLook& look) { look.repeat = Length{metres}; }); });
  connect(turn_, &QDoubleSpinBox::valueChanged, this, [this](double degrees) {
    if (turn_->showsDash()) return;
    perform([degrees](SetLook& look) { look.turn = Angle{degrees * std::numbers::pi / 180}; });
  });
  connect(photo_, &QPushButton::clicked, this, [this] { askPhoto(); });
  connect(plain_, &QPushButton::clicked, this, [this] { perform([](SetLook& look) { look.plain = true; }); });
}

// A swatch that opens the choice of colours, and the colour as it can be typed.
QWidget* LookBoard::dyeRow(const Message& name, QPushButton*& button, QLineEdit*& box,
                           std::optional<Dye> SetLook::*field) {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  button = new QPushButton;
  button->setMinimumWidth(40);
  box = new QLineEdit;
  box->setMaxLength(7);
  constexpr int kFrame = 26;  // pixels
  box->setMinimumWidth(box->fontMetrics().horizontalAdvance("#888888") + kFrame);
  line->addWidget(button);
  line->addWidget(box, 1);
  QPushButton* swatch = button;
  QLineEdit* typed = box;
  Theme::here().keep(row, [name, swatch, typed] {
    swatch->setAccessibleName(inWords(name));
    typed->setAccessibleName(inWords(name));
    typed->setToolTip(inWords(say("Red, green and blue in hexadecimal, like #1f3b6e.")));
  });
  connect(swatch, &QPushButton::clicked, this, [this, name, typed, field] {
    const QColor chosen = QColorDialog::getColor(QColor(typed->text()), this, inWords(name));
    const bool mixed = differs([&](const Look& one) { return dyeIn(one, field); });
    if (chosen.isValid() && (mixed || dyeOf(chosen) != shownDye(field)))
      perform([&](SetLook& look) { look.*field = dyeOf(chosen); });
  });
  connect(typed, &QLineEdit::editingFinished, this, [this, typed, field] {
    typed->setModified(false);
    const Dye now = shownDye(field);
    const bool mixed = differs([&](const Look& one) { return dyeIn(one, field); });
    QString words = typed->text().trimmed();
    if (mixed && words.isEmpty()) return;
    if (!words.startsWith('#')) words.prepend('#');
    const QColor wanted(words);
    if (!wanted.isValid()) {
      const std::string refusal = typed->text().trimmed().toStdString();
      typed->setText(mixed ? QString() : onScreen(now).name());
      return session_.refuse(refused(say("“{0}” is no colour; type one like {1}.", refusal, "#1f3b6e")));
    }
    if (dyeOf(wanted) == now && !mixed) return;
    perform([&](SetLook& look) { look.*field = dyeOf(wanted); });
  });
  return row;
}

Dye LookBoard::dyeIn(const Look& look, std::optional<Dye> SetLook::*field) {
  if (field == &SetLook::colour) return look.colour;
  if (field == &SetLook::ink) return look.ink;
  const WrongSide wrong = look.wrong.value_or(WrongSide{look.colour, PrintKind::None, look.ink});
  return field == &SetLook::wrong ? wrong.colour : wrong.ink;
}

void LookBoard::paint(QPushButton& button, QLineEdit& box, std::optional<Dye> SetLook::*field) {
  const bool mixed = differs([&](const Look& one) { return dyeIn(one, field); });
  const QString name = onScreen(shownDye(field)).name();
  button.setStyleSheet(mixed ? QString() : "background: " + name + ";");
  button.setText(mixed ? mixedWord() : QString());
  box.setPlaceholderText(mixed ? mixedWord() : QString());
  if (!beingTyped(box)) box.setText(mixed ? QString() : name);
}

void LookBoard::show(const Look& look, std::optional<Flat> shift) {
  show(std::vector{look}, shift ? std::vector{*shift} : std::vector<Flat>());
}

void LookBoard::show(std::vector<Look> looks, std::vector<Flat> shifts) {
  filling_ = true;
  looks_ = std::move(looks);
  shown_ = looks_.front();
  shifts_ = std::move(shifts);
  shift_ = shifts_.empty() ? std::nullopt : std::optional(shifts_.front());
  const auto choose = [&](QComboBox& box, const auto& of) {
    box.setPlaceholderText(mixedWord());
    box.setCurrentIndex(differs(of) ? -1 : static_cast<int>(of(shown_)));
  };
  choose(*finish_, [](const Look& one) { return one.finish; });
  choose(*print_, [](const Look& one) { return one.print; });
  choose(*wrongPrint_, wrongPrintIn);
  paint(*colour_, *colourTyped_, &SetLook::colour);
  paint(*ink_, *inkTyped_, &SetLook::ink);
  paint(*wrong_, *wrongTyped_, &SetLook::wrong);
  paint(*wrongInk_, *wrongInkTyped_, &SetLook::wrongInk);
  const bool repeats = differs([](const Look& one) { return one.repeat; });
  repeat_->setSpecialValueText(repeats ? mixedWord() : QString());
  repeat_->setMetres(repeats ? repeat_->minimum() : shown_.repeat);
  const bool turns = differs([](const Look& one) { return one.turn; });
  turn_->setMixed(turns);
  if (!turns) turn_->setValue(shown_.turn * 180 / std::numbers::pi);
  const auto any = [&](const auto& of) { return std::any_of(looks_.begin(), looks_.end(), of); };
  wrongInkRow_->setVisible(any([](const Look& one) { return hasInk(wrongPrintIn(one)); }));
  // A step gives both numbers, and to all of the pieces.
  const bool begins = std::any_of(shifts_.begin(), shifts_.end(), [&](Flat one) { return !(one == *shift_); });
  for (LengthBox* box : {across_, along_}) {
    box->setSpecialValueText(begins ? mixedWord() : QString());
    box->setEnabled(!begins);
    box->setToolTip(begins ? inWords(say("The print begins elsewhere on each of the chosen pieces; choose one alone."))
                           : QString());
  }
  across_->setMetres(begins ? across_->minimum() : shift_.value_or(Flat()).u);
  along_->setMetres(begins ? along_->minimum() : shift_.value_or(Flat()).v);
  auto* rows = static_cast<QFormLayout*>(printRows_->layout());
  rows->setRowVisible(shiftRow_, shift_.has_value());
  rows->setRowVisible(inkRow_, any([](const Look& one) { return hasInk(one.print); }));
  printRows_->setVisible(
      any([](const Look& one) { return one.print != PrintKind::None || wrongPrintIn(one) != PrintKind::None; }));
  filling_ = false;
}

void LookBoard::perform(const std::function<void(SetLook&)>& change) {
  if (filling_) return;
  auto look = about_();
  if (!look) return;
  change(*look);
  session_.perform(*std::move(look));
}

void LookBoard::askPhoto() {
  auto look = about_();
  const QString path = !look ? QString()
                             : QFileDialog::getOpenFileName(this, inWords(say("Photograph")), {},
                                                            inWords(say("Photographs")) + " (*.png *.jpg *.jpeg)");
  if (path.isEmpty()) return show(looks_, shifts_);
  session_.importPrint(path.toStdString(), *std::move(look));
}

}  // namespace karinui::studio
