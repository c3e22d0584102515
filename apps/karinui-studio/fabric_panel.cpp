#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QPushButton>
#include <QScrollArea>
#include <QTabBar>
#include <algorithm>

#include "fabric_plot.h"
#include "fabric_wizard.h"
#include "karinui/base/number.h"
#include "karinui/design/variant.h"
#include "karinui/session/fabric_numbers.h"
#include "look_board.h"
#include "panels.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// A fabric of the shop as it hangs on the drape tester (scripts/fabric_pictures made it), else a square of its threads.
QIcon pictureOf(const Fabric& f, int n) {
  if (drapeFigure(f)) {
    const QPixmap hung(":/drapes/" + QString::fromStdString(f.name) + ".png");
    QIcon icon(hung);
    icon.addPixmap(hung, QIcon::Selected);  // its own colours, chosen or not
    return icon;
  }
  static constexpr std::array<QRgb, 6> kDyes{0xff8aa2c4, 0xffc9938a, 0xff97b89b, 0xffd1bf8f, 0xffb096bf, 0xffb9bcc0};
  QPixmap map(128, 128);
  map.fill(Qt::transparent);
  QPainter painter(&map);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor dye = QColor::fromRgba(kDyes[static_cast<std::size_t>(n) % kDyes.size()]);
  painter.setBrush(dye);
  painter.setPen(Qt::NoPen);
  painter.drawRoundedRect(QRectF(3, 3, 122, 122), 16, 16);
  const double thread = 5 + 15 * std::min(1.0, f.weight / 0.5);
  for (double v = 12; v < 116; v += thread)
    for (double u = 12 + (static_cast<int>(v / thread) % 2) * thread; u < 116; u += 2 * thread) {
      painter.setBrush(dye.darker(118));
      painter.drawRect(QRectF(u, v, thread * 0.8, thread * 0.55));
    }
  return QIcon(map);
}

}  // namespace

FabricPanel::FabricPanel(Session& session, QWidget* in) : Panel(session, in) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(8);
  column->addWidget(title(say("Fabrics")));
  list_ = new QListWidget;
  list_->setIconSize(QSize(60, 60));
  list_->setMinimumHeight(84);
  column->addWidget(list_, 2);
  law_ = new QTabBar;
  law_->setObjectName("law");
  law_->setExpanding(false);
  law_->setDrawBase(false);
  Theme::here().keep(law_, [this] {
    list_->setAccessibleName(inWords(say("Fabrics")));
    law_->setAccessibleName(inWords(say("Curve")));
    while (law_->count() < 2) law_->addTab(QString());
    law_->setTabText(0, inWords(say("Stretch")));
    law_->setTabText(1, inWords(say("Shear")));
  });
  plot_ = new FabricPlot;
  Theme::here().keep(plot_, [this] {
    plot_->setToolTip(inWords(say("Tension over stretch: along the grain full, across it dashed. Drag the points.")));
  });
  auto* inner = new QWidget;
  auto* form = new QFormLayout(inner);
  form->setContentsMargins(0, 0, 6, 0);
  look_ = new LookBoard(session, [this] {
    SetLook look;
    look.fabric = fabric_.name;
    return std::optional(look);
  });
  form->addRow(look_);
  form->addRow(law_);
  form->addRow(plot_);
  for (const FabricNumber& f : fabricNumbers()) {
    auto* box = new QDoubleSpinBox;
    box->setRange(0, f.high);
    box->setDecimals(f.decimals);
    box->setSuffix(QString::fromUtf8(f.unit));
    box->setKeyboardTracking(false);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    form->addRow(word(f.label), box);
    values_.push_back(box);
    connect(box, &QDoubleSpinBox::valueChanged, this, [this, f](double v) {
      if (filling_) return;
      fabric_.*f.value = v / f.factor;
      plot_->show(fabric_, true);
      showWhatMayBeDone();
    });
  }
  auto* scroll = new QScrollArea;
  column->addWidget(scroll, 3);
  scroll->setWidget(inner);
  scroll->setWidgetResizable(true);
  const auto button = [&](const Message& words, const Message& tip) {
    auto* made = new QPushButton;
    Theme::here().keep(made, [made, words, tip] {
      made->setText(inWords(words));
      made->setToolTip(inWords(tip));
    });
    column->addWidget(made);
    return made;
  };
  cut_ = button(say("Cut the chosen pieces from it"), say("The pieces that are chosen; where none is, all of them."));
  change_ = button(say("Keep the changed values"), say("For every piece that is cut from this fabric."));
  own_ = button(say("Only for the chosen pieces"), say("They get a fabric of their own with these values."));
  Theme::here().keep(cut_, [this] { showWhatMayBeDone(); });  // which says of which pieces
  connect(button(say("Measure a fabric…"), say("A fabric of your own, from scales, a table's edge and a weight.")),
          &QPushButton::clicked, this, [this] {
            auto* wizard = new FabricWizard(session_, this);
            connect(wizard, &FabricWizard::added, this, [this](const QString& name) { wanted_ = name.toStdString(); });
            wizard->open();
          });
  connect(law_, &QTabBar::currentChanged, this,
          [this](int k) { plot_->setLaw(k == 0 ? FabricPlot::Law::Stretch : FabricPlot::Law::Shear); });
  connect(plot_, &FabricPlot::changed, this, [this] {
    fabric_ = plot_->fabric();
    fillValues();
    showWhatMayBeDone();
  });
  connect(list_, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
    if (filling_ || !item) return;
    byHand_ = !following_;
    show(fabricCalled(item->data(Qt::UserRole).toString().toStdString()));
  });
  connect(cut_, &QPushButton::clicked, this, [this] {
    SetFabric set;
    set.name = fabric_.name;
    perform(std::move(set), true);
  });
  connect(change_, &QPushButton::clicked, this, [this] {
    SetFabric set = described(fabric_, kept_);
    set.name = fabric_.name;
    perform(std::move(set), false);
  });
  connect(own_, &QPushButton::clicked, this, [this] {
    SetFabric set = described(fabric_, kept_);
    set.like = fabric_.name;
    const auto known = [&](const std::string& name) {
      return session_.snapshot().document.fabrics.contains(name) || preset(name);
    };
    std::string stem = fabric_.name;
    std::replace(stem.begin(), stem.end(), ' ', '_');
    for (int n = 2; set.name.empty() || known(set.name); ++n) set.name = stem + "_" + std::to_string(n);
    wanted_ = set.name;
    perform(std::move(set), true);
  });
}

Fabric FabricPanel::fabricCalled(const std::string& name) const {
  const auto found = fabricNamed(session_.snapshot().document, name);
  return found ? *found : Fabric();
}

// Of the chosen pieces, or of all.
void FabricPanel::perform(SetFabric set, bool cut) {
  if (cut) {
    for (const PieceId id : session_.selection().pieces) set.pieces.push_back(PieceRef(id));
    if (set.pieces.empty())
      for (const auto& [id, piece] : session_.snapshot().document.pattern.pieces) set.pieces.push_back(PieceRef(id));
  }
  session_.perform(std::move(set));
}

void FabricPanel::fillValues() {
  filling_ = true;
  for (std::size_t k = 0; k < values_.size(); ++k)
    values_[k]->setValue(fabric_.*fabricNumbers()[k].value * fabricNumbers()[k].factor);
  filling_ = false;
}

void FabricPanel::show(const Fabric& fabric) {
  fabric_ = kept_ = fabric;
  fillValues();
  look_->show(lookOf(session_.snapshot().document, fabric.name));
  plot_->show(fabric, fabric.law == Fabric::Law::Woven);
  showWhatMayBeDone();
}

void FabricPanel::showWhatMayBeDone() {
  const bool changed = !(fabric_ == kept_), pieces = !session_.snapshot().document.pattern.pieces.empty();
  cut_->setEnabled(pieces && !changed);
  cut_->setText(inWords(session_.selection().pieces.empty() ? say("Cut all pieces from it")
                                                            : say("Cut the chosen pieces from it")));
  change_->setEnabled(changed);
  own_->setEnabled(changed && !session_.selection().pieces.empty());
}

void FabricPanel::refresh() {
  const Selection& chosen = session_.selection();
  if (historyShown_ == session_.changes().history) {
    // A piece that is chosen shows what it is cut from.
    if (!(chosen == selectionShown_)) {
      selectionShown_ = chosen;
      const Piece* piece = chosen.pieces.empty() ? nullptr : session_.snapshot().document.find(*chosen.pieces.begin());
      if (piece && fabric_ == kept_) follow(piece->fabric);
      showWhatMayBeDone();
    }
    return;
  }
  historyShown_ = session_.changes().history;
  filling_ = true;
  const Document& document = session_.snapshot().document;
  // A garment that was opened shows its own cloth; what was looked up in the list stays while one works.
  const bool opened = std::exchange(path_, session_.path()) != session_.path() && session_.steps().size() > 1;
  if (opened) byHand_ = false;
  std::string was = fabric_.name;
  if (!wanted_.empty())
    was = std::exchange(wanted_, {}), byHand_ = true;
  else if (!byHand_ && (opened || fabric_ == kept_))
    if (const std::string own = clothOf(document, chosen.pieces); !own.empty()) was = own;
  list_->clear();
  int n = 0;
  std::set<std::string> used;
  for (const auto& [id, piece] : session_.snapshot().document.pattern.pieces) used.insert(piece->fabric);
  const auto add = [&](const Fabric& f) {
    QString words = nameText(f.name);
    if (const auto figure = drapeFigure(f))
      words += "\n" + inWords(say("drape {0} %, {1} {1|fold|folds}", fixed(figure->coefficient, 0), figure->folds));
    auto* item = new QListWidgetItem(pictureOf(f, n++), words, list_);
    item->setData(Qt::UserRole, QString::fromStdString(f.name));
    QFont font = item->font();
    font.setBold(used.contains(f.name));
    item->setFont(font);
  };
  for (const std::string& name : fabricNames(document))
    if (const auto f = fabricNamed(document, name)) add(*f);
  filling_ = false;
  following_ = true;
  goTo(was);
  if (!list_->currentItem() && list_->count() > 0) list_->setCurrentRow(0);
  following_ = false;
}

void FabricPanel::follow(const std::string& name) {
  following_ = true;
  goTo(name);
  following_ = byHand_ = false;
}

void FabricPanel::goTo(const std::string& name) {
  for (int row = 0; row < list_->count(); ++row)
    if (list_->item(row)->data(Qt::UserRole).toString().toStdString() == name) list_->setCurrentRow(row);
}

}  // namespace karinui::studio
