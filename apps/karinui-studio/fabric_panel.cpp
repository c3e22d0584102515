#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QListWidget>
#include <QPainter>
#include <QPushButton>
#include <cmath>

#include "karinui/base/number.h"
#include "look.h"
#include "panels.h"

namespace karinui::studio {

// Tension over stretch, along and across the grain, as the cloth's law has it: soft within the toe, then stiff.
class FabricPanel::Curve : public QWidget {
 public:
  Fabric fabric;
  Curve() { setMinimumHeight(120); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Palette& p = Look::here().palette();
    const QRectF box = QRectF(rect()).adjusted(44, 8, -8, -24);
    const double e = 0.03, top = std::max(fabric.warpCurve().force(e), fabric.weftCurve().force(e));
    painter.setPen(QPen(p.line, 1));
    painter.drawRect(box);
    painter.setPen(p.faint);
    painter.drawText(QRectF(0, box.top() - 6, 40, 14), Qt::AlignRight, QString::fromStdString(fixed(top, 0)));
    painter.drawText(QRectF(0, box.center().y() - 7, 40, 14), Qt::AlignRight, "N/m");
    painter.drawText(QRectF(box.left(), box.bottom() + 4, box.width(), 16), Qt::AlignRight, "3 %");
    for (const bool warp : {true, false}) {
      const ThreadCurve threads = warp ? fabric.warpCurve() : fabric.weftCurve();
      QPolygonF line;
      for (int i = 0; i <= 60; ++i)
        line << QPointF(box.left() + box.width() * i / 60,
                        box.bottom() - box.height() * threads.force(e * i / 60) / top);
      painter.setPen(QPen(warp ? p.accent : QColor(0x44, 0x77, 0xAA), 2, warp ? Qt::SolidLine : Qt::DashLine));
      painter.drawPolyline(line);
    }
    if (const auto figure = drapeFigure(fabric)) drawDraped(painter, box.topLeft() + QPointF(40, 36), *figure);
  }

 private:
  // The disc of the drape tester from above: what hangs over the support, in its folds, as large as its shadow.
  static void drawDraped(QPainter& painter, QPointF middle, const DrapeFigure& figure) {
    const Palette& p = Look::here().palette();
    constexpr double kScale = 2, kDisc = 15, kSupport = 9;  // pixels a centimetre, centimetres
    const double ring = kDisc * kDisc - kSupport * kSupport;
    const double mean = std::sqrt(kSupport * kSupport + ring * figure.coefficient / 100);
    const double wave = std::min(0.45 * (mean - kSupport), kDisc - mean);
    QPolygonF rim;
    for (int i = 0; i < 180; ++i) {
      const double turn = i * 3.14159265358979 / 90;
      const double r = std::sqrt(mean * mean - wave * wave / 2) + wave * std::cos(figure.folds * turn);
      rim << middle + QPointF(std::cos(turn), std::sin(turn)) * (kScale * r);
    }
    painter.setPen(QPen(p.line, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(middle, kScale * kDisc, kScale * kDisc);
    painter.setPen(Qt::NoPen);
    painter.setBrush(p.accent.lighter(160));
    painter.drawPolygon(rim);
    painter.setBrush(p.accent);
    painter.drawEllipse(middle, kScale * kSupport, kScale * kSupport);
    painter.setPen(p.faint);
    painter.setBrush(Qt::NoBrush);
    painter.drawText(QRectF(middle.x() + kScale * kDisc + 6, middle.y() - 16, 90, 32), Qt::AlignLeft | Qt::AlignVCenter,
                     inWords(say("drape {0} %", fixed(figure.coefficient, 0))));
  }
};

namespace {

// A square of the cloth, its threads as thick as its weight.
QIcon swatch(const Fabric& f, int n) {
  static constexpr std::array<QRgb, 6> kDyes{0xff8aa2c4, 0xffc9938a, 0xff97b89b, 0xffd1bf8f, 0xffb096bf, 0xffb9bcc0};
  QPixmap map(44, 44);
  map.fill(Qt::transparent);
  QPainter painter(&map);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor dye = QColor::fromRgba(kDyes[static_cast<std::size_t>(n) % kDyes.size()]);
  painter.setBrush(dye);
  painter.setPen(Qt::NoPen);
  painter.drawRoundedRect(QRectF(1, 1, 42, 42), 8, 8);
  const double thread = 1.6 + 5 * std::min(1.0, f.weight / 0.5);
  for (double v = 4; v < 40; v += thread)
    for (double u = 4 + (static_cast<int>(v / thread) % 2) * thread; u < 40; u += 2 * thread) {
      painter.setBrush(dye.darker(118));
      painter.drawRect(QRectF(u, v, thread * 0.8, thread * 0.55));
    }
  return QIcon(map);
}

struct Field {
  const char* key;
  Message label;
  const char* unit;
  double factor, high;
  int decimals;
};
const std::vector<Field>& fields() {
  static const std::vector<Field> all{{"weight", say("weight"), " g/m²", 1000, 3000, 0},
                                      {"warp", say("stretch, warp"), " N/m", 1, 1e6, 0},
                                      {"weft", say("stretch, weft"), " N/m", 1, 1e6, 0},
                                      {"shear", say("shear"), " N/m", 1, 1e5, 1},
                                      {"bendWarp", say("bending, warp"), " µN m", 1e6, 1e5, 2},
                                      {"bendWeft", say("bending, weft"), " µN m", 1e6, 1e5, 2},
                                      {"thickness", say("thickness"), " mm", 1000, 20, 2},
                                      {"friction", say("friction on skin"), "", 1, 2, 2}};
  return all;
}
double& valueOf(Fabric& f, std::string_view key) {
  if (key == "weight") return f.weight;
  if (key == "warp") return f.stretchWarp;
  if (key == "weft") return f.stretchWeft;
  if (key == "shear") return f.shear;
  if (key == "bendWarp") return f.bendWarp;
  if (key == "bendWeft") return f.bendWeft;
  if (key == "thickness") return f.thickness;
  return f.frictionBody;
}

}  // namespace

FabricPanel::FabricPanel(Session& session) : Panel(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(10);
  column->addWidget(title(say("Fabrics")));
  list_ = new QListWidget;
  Look::here().keep(list_, [this] { list_->setAccessibleName(inWords(say("Fabrics"))); });
  list_->setIconSize(QSize(32, 32));
  column->addWidget(list_, 2);
  curve_ = new Curve;
  column->addWidget(word(say("Tension over stretch: along the grain (full), across (dashed)")));
  column->addWidget(curve_);
  auto* form = new QFormLayout;
  for (const Field& f : fields()) {
    auto* box = new QDoubleSpinBox;
    box->setRange(0, f.high);
    box->setDecimals(f.decimals);
    box->setSuffix(QString::fromUtf8(f.unit));
    box->setKeyboardTracking(false);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    form->addRow(word(f.label), box);
    values_[f.key] = box;
    connect(box, &QDoubleSpinBox::valueChanged, this, [this, f](double v) {
      if (filling_) return;
      valueOf(fabric_, f.key) = v / f.factor;
      curve_->fabric = fabric_;
      curve_->update();
      change_->setEnabled(true);
    });
  }
  column->addLayout(form);
  cut_ = new QPushButton;
  Look::here().keep(cut_, [this] { cut_->setText(inWords(say("Cut the chosen pieces from it"))); });
  change_ = new QPushButton;
  Look::here().keep(change_, [this] { change_->setText(inWords(say("Keep the changed values"))); });
  column->addWidget(cut_);
  column->addWidget(change_);
  connect(list_, &QListWidget::currentTextChanged, this, [this](const QString& name) {
    if (filling_ || name.isEmpty()) return;
    const auto own = session_.fitting().document.fabrics.find(name.toStdString());
    if (own != session_.fitting().document.fabrics.end())
      show(own->second);
    else if (const auto f = preset(name.toStdString()))
      show(*f);
  });
  connect(cut_, &QPushButton::clicked, this, [this] {
    SetFabric set;
    set.name = fabric_.name;
    for (const PieceId id : session_.selection().pieces) set.pieces.push_back(PieceRef(id));
    if (set.pieces.empty())
      for (const auto& [id, piece] : session_.fitting().document.pattern.pieces) set.pieces.push_back(PieceRef(id));
    session_.perform(set);
  });
  connect(change_, &QPushButton::clicked, this, [this] {
    SetFabric set;
    set.name = fabric_.name;
    set.weight = fabric_.weight;
    set.stretchWarp = fabric_.stretchWarp;
    set.stretchWeft = fabric_.stretchWeft;
    set.shear = fabric_.shear;
    set.bendWarp = fabric_.bendWarp;
    set.bendWeft = fabric_.bendWeft;
    set.thickness = Length{fabric_.thickness};
    set.frictionBody = fabric_.frictionBody;
    session_.perform(set);
  });
}

void FabricPanel::show(const Fabric& fabric) {
  filling_ = true;
  fabric_ = fabric;
  for (const Field& f : fields()) values_[f.key]->setValue(valueOf(fabric_, f.key) * f.factor);
  curve_->fabric = fabric;
  curve_->update();
  change_->setEnabled(false);
  filling_ = false;
}

void FabricPanel::refresh() {
  cut_->setEnabled(!session_.fitting().document.pattern.pieces.empty());
  if (historyShown_ == session_.news().history) return;
  historyShown_ = session_.news().history;
  filling_ = true;
  const QString was = list_->currentItem() ? list_->currentItem()->text() : QString();
  list_->clear();
  int n = 0;
  std::set<std::string> used;
  for (const auto& [id, piece] : session_.fitting().document.pattern.pieces) used.insert(piece->fabric);
  const auto add = [&](const Fabric& f) {
    auto* item = new QListWidgetItem(swatch(f, n++), QString::fromStdString(f.name), list_);
    QFont font = item->font();
    font.setBold(used.contains(f.name));
    item->setFont(font);
    if (item->text() == was) list_->setCurrentItem(item);
  };
  for (const auto& [name, f] : session_.fitting().document.fabrics) add(f);
  for (const Fabric& f : presets())
    if (!session_.fitting().document.fabrics.contains(f.name)) add(f);
  if (!list_->currentItem() && list_->count() > 0) list_->setCurrentRow(0);
  filling_ = false;
  if (list_->currentItem()) emit list_->currentTextChanged(list_->currentItem()->text());
}

}  // namespace karinui::studio
