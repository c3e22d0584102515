#include <QFileDialog>
#include <QListWidget>
#include <QPointer>
#include <QPushButton>
#include <QThread>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "fit_study.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/body/sizes.h"
#include "karinui/design/glossary.h"
#include "theme.h"

namespace karinui::studio {

namespace {

Message figureCell(const std::string& plain) { return say("{0}", plain); }

// The levels that are told, as far as the garment covers them.
const std::vector<Message>& studiedLevels() {
  static const std::vector<Message> all{say("bust"), say("waist"), say("hip")};
  return all;
}

StudyItem figureItem(const FitOnBody& fit) {
  StudyItem item;
  item.name = figureCell(fit.name);
  item.marked = !fit.fits();
  const bool drapes = fit.fault != FitFault::Refused;
  item.cells = {fit.fits() ? say("fits") : faultSaid(fit),
                drapes ? figureCell(fixed(fit.strain.p99 * 100, 1) + " %") : figureCell("–"),
                fit.pressure ? figureCell(fixed(fit.pressure->p99 / 1000, 2) + " kPa") : figureCell("–")};
  for (const Message& level : studiedLevels()) {
    const auto girths = std::find_if(fit.girths.begin(), fit.girths.end(),
                                     [&](const Girths& one) { return one.name.pattern == level.pattern; });
    item.cells.push_back(
        figureCell(girths == fit.girths.end() ? "–" : lengthText(girths->garment - girths->body).toStdString()));
  }
  if (item.marked) item.below.push_back(faultSaid(fit));
  item.garment = fit.garment, item.pressure = fit.pressureAt;
  return item;
}

}  // namespace

FiguresStudy::FiguresStudy(Session& session, QWidget* parent)
    : FitStudy(session, parent, say("Fit over figures"),
               say("The garment is made to each figure that is ticked, as to a person's own measures, and brought to "
                   "rest. Whom it does not fit is told, with where and by how much. The garment is left as it is.")) {
  setObjectName("figures_study");
  sentences_ = 1;
  const BodyChoice& body = session.snapshot().document.body;
  if (body.mesh.empty() && !body.measurements.value.empty())
    for (const int wider : {-8, -4, 0, 4, 8}) {
      const Message words = wider == 0 ? say("This figure")
                            : wider < 0
                                ? say("This figure, girths {0} smaller", lengthText(-wider * 0.01).toStdString())
                                : say("This figure, girths {0} larger", lengthText(wider * 0.01).toStdString());
      wearers_.push_back({inWords(words).toStdString(), figureOf(widened(body.measurements, wider * 0.01))});
      choice(words, true);
    }
  for (const std::string_view size : builtInSizes()) {
    const Message words = termSaid(Term::Size, size).value_or(figureCell(std::string(size)));
    SetBody figure;
    figure.size = std::string(size);
    wearers_.push_back({inWords(words).toStdString(), figure});
    choice(words, false);
  }
  auto* table = new QPushButton(inWords(say("People from a table of measures…")));
  table->setObjectName("study_people");
  table->setAutoDefault(false);
  below().addWidget(table);
  connect(table, &QPushButton::clicked, this, &FiguresStudy::askTable);
}

void FiguresStudy::askTable() {
  const QString path = QFileDialog::getOpenFileName(this, inWords(say("People from a table of measures")), {},
                                                    "CSV (*.csv *.tsv *.txt)");
  if (!path.isEmpty()) addTable(path.toStdString());
}

void FiguresStudy::addTable(const std::string& file) {
  const auto bytes = readFile(file);
  const auto table = bytes ? readMeasurementTable(*bytes) : Result<MeasurementTable>(bytes.error());
  if (!table) return tell(table.error().what);
  // Who is added is meant.
  for (int k = 0; k < findChild<QListWidget*>("study_choices")->count(); ++k)
    findChild<QListWidget*>("study_choices")->item(k)->setCheckState(Qt::Unchecked);
  for (const GarmentWearer& wearer : wearersOf(*table)) {
    wearers_.push_back(wearer);
    choice(figureCell(wearer.name), true);
  }
  tell(say("{0} {0|person|people} added.", table->people.size()));
}

Message FiguresStudy::faulty(std::size_t many) const {
  return say("Done; it does not fit {0} of {1}.", many, items().size());
}

void FiguresStudy::go() {
  std::vector<GarmentWearer> wearers;
  for (const std::size_t k : ticked()) wearers.push_back(wearers_[k]);
  tell(say("Reading the steps …"));
  session_.recipe([this, wearers, alive = QPointer<FiguresStudy>(this)](const Result<RecipePtr>& found) {
    if (!alive || busy()) return;
    if (!found) return tell(found.error().what);
    std::vector<Message> columns{say("Figure"), say("Fit"), say("Stretch, 99 %"), say("Pressure, 99 %")};
    for (const Message& level : studiedLevels()) columns.push_back(say("Ease, {0}", level));
    begin(wearers.size(), columns,
          [recipe = *found, wearers](Workers& workers, const Token& token, const Tell& tell) -> Result<std::string> {
            MemoryBlobs blobs;
            Bodies bodies;
            Context context{workers, token, blobs, bodies, {}, {}};
            const auto fits =
                fitOverBodies(*recipe, wearers, context, [&](const FitOnBody& fit) { tell(figureItem(fit)); });
            if (!fits) return fits.error();
            return csvOf(*fits);
          });
  });
}

}  // namespace karinui::studio
