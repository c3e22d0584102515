#include "fabric_wizard.h"

#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QVBoxLayout>
#include <tuple>

#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/exchange/read_print.h"
#include "karinui/session/fabric_numbers.h"
#include "karinui/session/silhouette.h"
#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr double kMilli = 0.001;

}  // namespace

FabricWizard::FabricWizard(Session& session, QWidget* parent) : QDialog(parent), session_(session) {
  setObjectName("fabric_wizard");
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(inWords(say("Measure a fabric")));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(18, 16, 18, 16);
  row->setSpacing(18);
  auto* inner = new QWidget;
  auto* form = new QFormLayout(inner);
  const auto heading = [&](const Message& words, const Message& how) {
    auto* title = new QLabel(inWords(words));
    title->setProperty("role", "title");
    form->addRow(title);
    auto* told = new QLabel(inWords(how));
    told->setWordWrap(true);
    told->setProperty("role", "faint");
    form->addRow(told);
  };
  // A rectangle of cloth, and what it weighs or is weighed down by.
  const auto addCloth = [&](const Message& length, const Message& width, const Message& mass) {
    return std::tuple{add(*form, length, kMilli, "mm"), add(*form, width, kMilli, "mm"), add(*form, mass, kMilli, "g")};
  };
  heading(say("Weight"),
          say("Cut a swatch with straight edges, as large as you can spare, and lay it on the scales. Several "
              "readings of one thing are typed with spaces between them."));
  std::tie(swatchLength_, swatchWidth_, mass_) =
      addCloth(say("Length of the swatch"), say("Width of the swatch"), say("Its mass"));
  heading(
      say("Bending"),
      say("Push a strip of 25 mm by 200 mm over the table's edge until its tip lies 41.5 degrees below the edge, as a "
          "set square of card tells, and read how far it hangs over. Both ends, both sides. Or type the angle too."));
  const std::array hangs{say("Overhang, warp"), say("Overhang, weft"), say("Overhang, bias")};
  const std::array angles{say("Angle, warp"), say("Angle, weft"), say("Angle, bias")};
  for (std::size_t g = 0; g < kGrains; ++g) {
    overhang_[g] = add(*form, hangs[g], kMilli, "mm");
    angle_[g] = add(*form, angles[g], kDegree, "°", "41.5");
  }
  drape_ = add(*form, say("Or a disc's drape"), 0.01, "%");
  auto* photographs = new QPushButton(inWords(say("From photographs…")));
  photographs->setAutoDefault(false);
  photographs->setToolTip(
      inWords(say("A disc of 300 mm, photographed from straight above on a plain ground: first flat on a board at the "
                  "height of a tin of 180 mm, then draped over the tin.")));
  connect(photographs, &QPushButton::clicked, this, &FabricWizard::readPhotographs);
  form->addRow({}, photographs);
  heading(say("Stretch"),
          say("Make two marks on a strip, hang a weight on it and read how far apart they are now. The strip "
              "on the bias tells the shear."));
  std::tie(stripLength_, stripWidth_, weight_) =
      addCloth(say("Between the marks"), say("Width of the strip"), say("Weight that hangs on it"));
  const std::array under{say("Then, warp"), say("Then, weft"), say("Then, bias")};
  for (std::size_t g = 0; g < kGrains; ++g) hung_[g] = add(*form, under[g], kMilli, "mm");
  heading(say("Thickness, and the tools"), say("What each tool is good to, either way."));
  thickness_ = add(*form, say("Thickness"), kMilli, "mm");
  ruler_ = add(*form, say("Ruler"), kMilli, "mm", "0.5");
  scales_ = add(*form, say("Scales"), kMilli, "g", "1");
  angleError_ = add(*form, say("Angle"), kDegree, "°", "1");
  auto* scroll = new QScrollArea;
  scroll->setWidget(inner);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  row->addWidget(scroll, 4);
  auto* column = new QVBoxLayout;
  result_ = new QLabel;
  result_->setTextFormat(Qt::RichText);
  result_->setObjectName("measured");
  result_->setWordWrap(true);
  result_->setAlignment(Qt::AlignTop);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(result_, 1);
  name_ = new QLineEdit;
  name_->setPlaceholderText(inWords(say("Name of the fabric")));
  name_->setAccessibleName(inWords(say("Name of the fabric")));
  column->addWidget(name_);
  auto* buttons = new QHBoxLayout;
  accept_ = new QPushButton(inWords(say("Add this fabric")));
  accept_->setDefault(true);
  auto* cancel = new QPushButton(inWords(say("Cancel")));
  cancel->setAutoDefault(false);
  buttons->addWidget(accept_), buttons->addWidget(cancel);
  column->addLayout(buttons);
  row->addLayout(column, 5);
  connect(name_, &QLineEdit::textChanged, this, &FabricWizard::workOut);
  connect(accept_, &QPushButton::clicked, this, &QDialog::accept);
  connect(cancel, &QPushButton::clicked, this, &QDialog::close);
  resize(940, 640);
  workOut();
}

QLineEdit* FabricWizard::add(QFormLayout& form, const Message& label, double unit, const char* unitText,
                             const char* usual) {
  auto* line = new QLineEdit;
  line->setPlaceholderText(QString::fromUtf8(usual));
  line->setAccessibleName(inWords(label));
  form.addRow(inWords(label) + ", " + QString::fromUtf8(unitText), line);
  lines_.push_back({line, unit, std::string_view(unitText) == "mm"});
  connect(line, &QLineEdit::textChanged, this, &FabricWizard::workOut);
  return line;
}

// In SI; nothing typed: what the line says in grey, or none.
Result<std::vector<double>> FabricWizard::read(const QLineEdit* line) const {
  static const QRegularExpression kBetween(QString::fromUtf8("[\\s;、]+"));
  static const QRegularExpression kOwnUnit(QString::fromUtf8("(?<=[0-9])\\s+(?=(mm|cm|m|in|\")(\\s|;|$))"));
  const auto& [own, unit, isLength] =
      *std::find_if(lines_.begin(), lines_.end(), [&](const Reading& r) { return r.line == line; });
  std::vector<double> all;
  QString typed = line->text().normalized(QString::NormalizationForm_KC);  // full-width digits and blanks too
  if (isLength) typed.remove(kOwnUnit);
  for (const QString& word :
       (typed.trimmed().isEmpty() ? line->placeholderText() : typed).split(kBetween, Qt::SkipEmptyParts)) {
    const auto number = parseNumber(QString(word).replace(',', '.').toStdString());
    if (const auto metres = isLength && !number ? metresIn(word) : std::nullopt) {  // with a unit of its own
      all.push_back(*metres);
      continue;
    }
    if (!number)
      return badInput(say("{0}: “{1}” is no number; type readings with spaces between them.",
                          line->accessibleName().toStdString(), word.toStdString()));
    all.push_back(*number * unit);
  }
  return all;
}

Result<TableReadings> FabricWizard::readings() const {
  TableReadings t;
  std::optional<Error> why;
  const auto many = [&](const QLineEdit* line) {
    auto found = read(line);
    if (!found && !why) why = found.error();
    return found ? *std::move(found) : std::vector<double>();
  };
  const auto one = [&](const QLineEdit* line) {
    const auto all = many(line);
    return all.empty() ? 0 : meanOf(all, 0).value;
  };
  t.swatchLength = one(swatchLength_), t.swatchWidth = one(swatchWidth_), t.swatchMasses = many(mass_);
  t.stripLength = one(stripLength_), t.stripWidth = one(stripWidth_), t.thicknesses = many(thickness_);
  for (std::size_t g = 0; g < kGrains; ++g) {
    t.overhang[g].lengths = many(overhang_[g]);
    if (!angle_[g]->text().trimmed().isEmpty()) t.overhang[g].angles = many(angle_[g]);
    if (auto lengths = many(hung_[g]); !lengths.empty()) t.hung[g] = {{one(weight_), std::move(lengths)}};
  }
  t.drapes = many(drape_);
  t.ruler = uncertaintyOf(one(ruler_)), t.scales = uncertaintyOf(one(scales_));
  t.angle = uncertaintyOf(one(angleError_));
  if (why) return *why;
  return t;
}

void FabricWizard::workOut() {
  const auto typed = readings();
  const auto found = typed ? measuredFabric(*typed) : Result<MeasuredFabric>(typed.error());
  measured_ = found ? std::optional(*found) : std::nullopt;
  const std::string name = nameTyped(name_->text().toStdString());
  const Done usable = checkName(name);
  accept_->setEnabled(measured_ && usable);
  if (!measured_) return result_->setText(inWords(found.error().what).toHtmlEscaped());
  QString rows = "<tr><th></th>";
  for (const QString& head : {inWords(say("Measured")), inWords(say("Error (95 %)")), nameText(measured_->like)})
    rows += "<th align=right>&nbsp;&nbsp;" + head + "</th>";
  rows += "</tr>";
  for (const MeasuredRow& row : rowsOf(*measured_)) {
    const QString error =
        row.error ? QString::fromStdString(row.errorText()) : inWords(say("not measured, in proportion"));
    rows += "<tr><td>" + inWords(row.label) + "</td>";
    for (const QString& cell : {QString::fromStdString(row.valueText()), error, QString::fromStdString(row.likeText())})
      rows += "<td align=right>&nbsp;&nbsp;" + cell + "</td>";
    rows += "</tr>";
  }
  QString words = "<table cellspacing=4>" + rows + "</table><p>" +
                  inWords(say("The nearest fabric of the shop is {0}; what was not measured is as there.",
                              nameText(measured_->like).toStdString())) +
                  "</p>";
  if (measured_->bendBias)
    words += "<p>" +
             inWords(say("On the bias cloth bends as warp and weft let it; that is the number in the last column.")) +
             "</p>";
  if (!name.empty() && !usable) words += "<p>" + inWords(usable.error().what).toHtmlEscaped() + "</p>";
  result_->setText(words);
}

void FabricWizard::readPhotographs() {
  const QString filter = inWords(say("Photographs")) + " (*.png *.jpg *.jpeg)";
  const QString flat = QFileDialog::getOpenFileName(this, inWords(say("The disc lying flat, from above")), {}, filter);
  if (flat.isEmpty()) return;
  const QStringList draped =
      QFileDialog::getOpenFileNames(this, inWords(say("The disc draped, from the same place")), {}, filter);
  if (draped.isEmpty()) return;
  const Token token;
  const auto whole = readPrint(flat.toStdString(), token);
  std::optional<Error> why;
  if (!whole)
    why = whole.error();
  else if (const auto covered = coveredShare(*whole); !covered)
    why = inFile(flat.toStdString(), covered.error());
  QStringList typed;
  for (const QString& name : draped) {
    if (why) break;
    const auto hanging = readPrint(name.toStdString(), token);
    const auto drape = hanging ? drapeOfPhotographs(*whole, *hanging) : Result<double>(hanging.error());
    if (drape)
      typed += QString::number(100 * *drape, 'f', 1);
    else
      why = hanging ? inFile(name.toStdString(), drape.error()) : drape.error();
  }
  if (why) return result_->setText(inWords(why->what).toHtmlEscaped());
  drape_->setText(typed.join(' '));
}

void FabricWizard::accept() {
  if (!measured_) return;
  const std::string name = nameTyped(name_->text().toStdString());
  emit added(QString::fromStdString(name));
  session_.perform(fabricStep(*measured_, name));
  QDialog::accept();
}

}  // namespace karinui::studio
