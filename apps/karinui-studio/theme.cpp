#include "theme.h"

#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QFontDatabase>
#include <QIconEngine>
#include <QLabel>
#include <QLibraryInfo>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QProxyStyle>
#include <QScreen>
#include <QStyleFactory>
#include <QStyleOption>

#include "karinui/base/number.h"
#include "karinui/base/said_lengths.h"
#include "karinui/design/step_words.h"
#include "karinui/scene/icon.h"
#include "karinui/view/image.h"
#include "menu_letters.h"

namespace karinui::studio {

namespace {

// Letters stand out from every ground they lie on at least 4.5:1 (WCAG 2.2, 1.4.3); a test computes it.
const Palette kLight{QColor("#f3f0eb"), QColor("#faf8f5"), QColor("#ffffff"), QColor("#e0dad1"),
                     QColor("#3b3630"), QColor("#6d665c"), QColor("#ad4822"), QColor("#f6e3d8"),
                     QColor("#fffdf9"), QColor("#ece6dc"), QColor("#ffffff")};
const Palette kDark{QColor("#24211e"), QColor("#2c2926"), QColor("#363230"), QColor("#46413c"),
                    QColor("#ece6de"), QColor("#bab1a5"), QColor("#f0a27c"), QColor("#5a3a2b"),
                    QColor("#302c29"), QColor("#3b3733"), QColor("#24211e")};

class HouseIcon : public QIconEngine {
 public:
  explicit HouseIcon(std::string_view name) : name_(name) {}
  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    const Palette& p = Theme::here().palette();
    QColor ink = state == QIcon::On ? p.accent : p.ink;
    if (mode == QIcon::Disabled) ink.setAlphaF(0.3f);
    drawIcon(*painter, name_, rect, ink);
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap map(size);
    map.fill(Qt::transparent);
    QPainter painter(&map);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return map;
  }
  QIconEngine* clone() const override { return new HouseIcon(*this); }

 private:
  std::string name_;
};

// As Fusion, but for what a dark ground would hide; and a label never takes a name for markup.
class HouseStyle : public QProxyStyle {
 public:
  HouseStyle() : QProxyStyle(QStyleFactory::create("Fusion")) {}
  using QProxyStyle::polish;
  void polish(QWidget* widget) override {
    auto* label = qobject_cast<QLabel*>(widget);
    if (label && label->textFormat() == Qt::AutoText && !widget->inherits("QTipLabel"))
      label->setTextFormat(Qt::PlainText);
    QProxyStyle::polish(widget);
  }
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    if (element != PE_IndicatorCheckBox && element != PE_IndicatorItemViewItemCheck)
      return QProxyStyle::drawPrimitive(element, option, painter, widget);
    const Palette& p = Theme::here().palette();
    const bool on = option->state & State_On, may = option->state & State_Enabled;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setOpacity(may ? 1 : 0.5);
    painter->setPen(QPen(on || option->state & State_HasFocus ? p.accent : p.faint, 1.2));
    painter->setBrush(on ? p.accent : p.raised);
    const QRectF box = QRectF(option->rect).adjusted(1.5, 1.5, -1.5, -1.5);
    painter->drawRoundedRect(box, 3, 3);
    if (on) {
      const auto at = [&](double u, double v) { return box.topLeft() + QPointF(u * box.width(), v * box.height()); };
      painter->setPen(QPen(p.onAccent, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter->drawPolyline(QPolygonF{at(0.22, 0.52), at(0.42, 0.72), at(0.78, 0.28)});
    }
    painter->restore();
  }
};

// The house's letters, or the system's where those are larger.
double lettersOf(const QApplication& app) {
  static const double size = std::max(10.0, app.font().pointSizeF());  // before a sheet of ours says otherwise
  return size;
}

QString sheetFor(const Palette& p, double letters) {
  QString sheet = QStringLiteral(R"(
* { font-size: @letters; }
QMainWindow, QDialog { background: @window; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QToolTip { background: @raised; color: @ink; border: 1px solid @line; padding: 6px; }
QMenuBar { background: @window; padding: 2px 6px; }
QMenuBar::item { padding: 5px 10px; border-radius: 5px; background: transparent; }
QMenuBar::item:selected { background: @accentSoft; }
QMenu { background: @raised; border: 1px solid @line; padding: 5px; }
QMenu::item { padding: 6px 26px 6px 26px; border-radius: 5px; }
QMenu::item:selected { background: @accentSoft; color: @ink; }
QMenu::item:disabled { color: @faint; }
QMenu::separator { height: 1px; background: @line; margin: 5px 8px; }
QToolBar { background: @window; border: none; spacing: 2px; padding: 5px; }
QToolBar::separator { background: @line; width: 1px; height: 1px; margin: 7px; }
QToolBar QToolButton { border: none; border-radius: 8px; padding: 4px; margin: 1px; color: @ink; }
QToolBar QToolButton#qt_toolbar_ext_button { padding: 0px; margin: 0px; background: @accentSoft; }
QToolBar QToolButton:hover { background: @raised; }
QToolBar QToolButton:checked { background: @accentSoft; color: @accent; }
QStatusBar { background: @window; color: @faint; min-height: 26px; }
QStatusBar QLabel { color: @ink; padding: 2px 10px; }
QStatusBar::item { border: none; }
QDockWidget { titlebar-close-icon: none; }
QTabWidget::pane { border: none; background: @panel; }
QTabBar { qproperty-drawBase: 0; }
QTabBar::tab { padding: 8px 6px; color: @faint; background: transparent; border-bottom: 2px solid transparent; }
QTabBar::tab:selected { color: @ink; border-bottom: 2px solid @accent; }
QTabBar::tab:hover { color: @ink; }
QSplitter::handle { background: @line; }
QTreeWidget, QListWidget, QTableWidget { background: @panel; border: none; outline: none; alternate-background-color: @panel; }
QTreeWidget::item, QListWidget::item { padding: 4px 4px; border-radius: 5px; }
QTreeWidget::item:selected, QListWidget::item:selected { background: @accentSoft; color: @ink; }
QHeaderView::section { background: @panel; border: none; color: @faint; padding: 4px; }
QLineEdit, QComboBox, QDoubleSpinBox, QSpinBox { background: @raised; border: 1px solid @line; border-radius: 6px; padding: 4px 7px; selection-background-color: @accent; selection-color: @onAccent; }
QLineEdit:focus, QComboBox:focus, QDoubleSpinBox:focus, QSpinBox:focus { border: 1px solid @accent; }
QComboBox::drop-down { border: none; width: 22px; }
QComboBox::down-arrow { image: url(:/look/arrow.png); width: 10px; height: 6px; }
QComboBox QAbstractItemView { background: @raised; border: 1px solid @line; selection-background-color: @accentSoft; selection-color: @ink; }
QPushButton { background: @raised; border: 1px solid @line; border-radius: 7px; padding: 6px 14px; }
QPushButton:hover { border: 1px solid @accent; }
QAbstractSpinBox { qproperty-buttonSymbols: NoButtons; }
QPushButton:focus { border: 2px solid @accent; padding: 5px 13px; }
QPushButton:default { background: @accent; color: @onAccent; border: 1px solid @accent; }
QPushButton:default:focus { border: 2px solid @ink; padding: 5px 13px; }
QPushButton:disabled { color: @faint; }
QPushButton:default:disabled { background: @panel; border: 1px solid @line; }
QScrollArea { border: none; background: transparent; }
QScrollBar:vertical { width: 10px; background: transparent; }
QScrollBar::handle:vertical { background: @line; border-radius: 4px; min-height: 24px; margin: 1px; }
QScrollBar:horizontal { height: 10px; background: transparent; }
QScrollBar::handle:horizontal { background: @line; border-radius: 4px; min-width: 24px; margin: 1px; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QProgressBar { background: @line; border: none; border-radius: 3px; max-height: 6px; }
QProgressBar::chunk { background: @accent; border-radius: 3px; }
QLabel[role="title"] { font-size: @titles; font-weight: 600; color: @ink; }
QLabel[role="faint"] { color: @faint; }
)");
  const std::pair<const char*, QColor> names[] = {
      {"@window", p.window},    {"@panel", p.panel}, {"@raised", p.raised},         {"@line", p.line},
      {"@ink", p.ink},          {"@faint", p.faint}, {"@accentSoft", p.accentSoft}, {"@accent", p.accent},
      {"@onAccent", p.onAccent}};
  sheet.replace("@letters", QString::number(letters) + "pt");
  sheet.replace("@titles", QString::number(1.1 * letters) + "pt");
  for (const auto& [name, colour] : names) sheet.replace(QLatin1String(name), colour.name());
  return sheet;
}

}  // namespace

Theme& Theme::here() {
  static Theme look;
  return look;
}

const Palette& Theme::palette() const { return dark_ ? kDark : kLight; }

QString Theme::say(const Message& message) const {
  const auto words = [](double metres) { return lengthText(metres, 2).toStdString(); };
  return QString::fromStdString(text(message, language_, words, names_, withoutScript));
}

QIcon Theme::icon(std::string_view name) const { return name.empty() ? QIcon() : QIcon(new HouseIcon(name)); }

QString Theme::Untranslated::translate(const char*, const char* source, const char*, int) const {
  const std::string_view words(source);
  return words == "Folder" || words == "File Folder" ? inWords(karinui::say("Folder")) : QString();
}

// Qt's own words, as of its file dialogs, are translated by Qt (Debian package qt6-translations-l10n).
void Theme::setLanguage(Language language) {
  language_ = language;
  QCoreApplication::removeTranslator(&ofQt_);
  QCoreApplication::removeTranslator(&besideQt_);
  if (language == Language::Japanese && ofQt_.load("qtbase_ja", QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
    QCoreApplication::installTranslator(&ofQt_);
  if (language == Language::Japanese) QCoreApplication::installTranslator(&besideQt_);  // asked first
  emit changed();
}

void Theme::setInches(bool inches) {
  if (inches == inches_) return;
  inches_ = inches;
  emit changed();
}
void Theme::setDark(bool dark) {
  dark_ = dark;
  if (auto* app = qobject_cast<QApplication*>(QCoreApplication::instance())) apply(*app);
  emit changed();
}

void Theme::apply(QApplication& app) {
  const Palette& p = palette();
  const double letters = lettersOf(app);
  app.setStyle(new HouseStyle);
  QPalette q;
  q.setColor(QPalette::Window, p.window);
  q.setColor(QPalette::WindowText, p.ink);
  q.setColor(QPalette::Base, p.panel);
  q.setColor(QPalette::AlternateBase, p.panel);
  q.setColor(QPalette::Text, p.ink);
  q.setColor(QPalette::Button, p.raised);
  q.setColor(QPalette::ButtonText, p.ink);
  q.setColor(QPalette::Highlight, p.accent);
  q.setColor(QPalette::HighlightedText, p.onAccent);
  q.setColor(QPalette::ToolTipBase, p.raised);
  q.setColor(QPalette::ToolTipText, p.ink);
  q.setColor(QPalette::PlaceholderText, p.faint);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    q.setColor(QPalette::Disabled, role, p.faint);
  app.setPalette(q);
  app.setStyleSheet(sheetFor(p, letters));
}

void Theme::keep(QObject* owner, std::function<void()> put) {
  put();
  QObject::connect(this, &Theme::changed, owner, std::move(put));
}

void Theme::keep(QAction* action, const Message& label, const Message& hint, std::string_view icon) {
  const std::string name(icon);
  keep(action, [this, action, label, hint, name] {
    action->setText(say(label));
    action->setProperty(kEnglish, QString::fromStdString(text(label)));
    const QString key = action->shortcut().toString(QKeySequence::NativeText);
    const QString teach = say(hint);
    action->setToolTip("<b>" + say(label) + "</b>" + (key.isEmpty() ? QString() : "  (" + key + ")") + "<br>" + teach);
    action->setStatusTip(teach);
    if (!name.empty()) action->setIcon(this->icon(name));
  });
}

QColor shown(const Colour& linear) {
  const Pixel p = pixelOf(linear);
  return QColor(p[0], p[1], p[2]);
}

void drawIcon(QPainter& painter, std::string_view name, const QRectF& square, const QColor& ink) {
  const Icon* drawn = karinui::icon(name);
  if (!drawn) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(square.topLeft());
  painter.scale(square.width() / 24, square.height() / 24);
  QPen pen(ink, 1.6);
  pen.setCapStyle(Qt::RoundCap);
  pen.setJoinStyle(Qt::RoundJoin);
  for (const IconStroke& stroke : drawn->strokes) {
    QPainterPath path;
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
      const QPointF p(stroke.points[i].u, stroke.points[i].v);
      i == 0 ? path.moveTo(p) : path.lineTo(p);
    }
    painter.setPen(stroke.filled ? Qt::NoPen : pen);
    painter.setBrush(stroke.filled ? QBrush(ink) : QBrush(Qt::NoBrush));
    painter.drawPath(path);
  }
  painter.restore();
}

QString asLabel(const Message& message) {
  QString words = inWords(message);
  if (!words.isEmpty()) words[0] = words[0].toUpper();
  return words;
}
QString nameText(std::string_view name) { return inWords(nameSaid(name)); }
QString nameLabel(std::string_view name) {
  const auto known = identifierSaid(name);
  return known ? asLabel(*known) : nameText(name);
}
QString scriptHint(const std::string& word) {
  return inWords(karinui::say("In scripts:")) + " " + QString::fromStdString(word);
}

void letShrink(QComboBox& box, const Message& hint) {
  box.setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box.setMinimumContentsLength(8);
  const auto tell = [&box, hint] {
    const QString more = inWords(hint);
    box.setToolTip(more.isEmpty() ? box.currentText() : box.currentText().toHtmlEscaped() + "<br>" + more);
  };
  QObject::connect(&box, &QComboBox::currentTextChanged, &box, tell);
  Theme::here().keep(&box, tell);  // after the box has its items in the other language
}

std::optional<Message> japaneseTrouble() {
  if (!QFontDatabase::families(QFontDatabase::Japanese).isEmpty()) return std::nullopt;
  return karinui::say(
      "No font of this machine has Japanese letters; install one, for instance the Debian package "
      "fonts-ipafont-gothic.");
}

QString lengthText(double metres, int decimals) {
  return QString::fromStdString(lengthSaid(metres, Theme::here().inches(), decimals));
}

void resizeOnScreen(QWidget& window, QSize wish) {
  constexpr QSize kFrame(16, 48);
  window.resize(wish.boundedTo(window.screen()->availableSize() - kFrame));
}
QString areaText(double squareMetres) {
  const bool inches = Theme::here().inches();
  return QString::fromStdString(fixed(squareMetres / (inches ? 0.0254 * 0.0254 : 1e-4), 0)) +
         (inches ? " in²" : " cm²");
}

void paintFingertip(QPainter& painter, const QPointF& at) {
  painter.save();
  painter.setBrush(Qt::NoBrush);
  const std::pair<QColor, double> strokes[] = {{Qt::white, 4.5}, {QColor("#1a1714"), 1.8}};
  for (const auto& [ink, wide] : strokes) {
    painter.setPen(QPen(ink, wide, Qt::SolidLine, Qt::RoundCap));
    painter.drawEllipse(at, 8, 8);
    for (const QPointF way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(at + way * 8, at + way * 17);
  }
  painter.restore();
}

void paintPin(QPainter& painter, const QPointF& tip) {
  painter.setPen(QPen(QColor("#4a453f"), 1.3));
  painter.drawLine(tip, tip + QPointF(5, -9));
  painter.setPen(QPen(Qt::white, 1));
  painter.setBrush(QColor("#b3261e"));
  painter.drawEllipse(tip + QPointF(5.6, -10.2), 3.4, 3.4);
}

void paintRing(QPainter& painter, const QPointF& at, const QColor& colour) {
  painter.setBrush(Qt::white);
  painter.setPen(QPen(Qt::white, 5));
  painter.drawEllipse(at, 4.5, 4.5);
  painter.setPen(QPen(colour, 2.4));
  painter.drawEllipse(at, 4.5, 4.5);
}

namespace {
QFont wordFont(QFont font) {
  font.setPointSizeF(9.5);
  font.setWeight(QFont::DemiBold);
  return font;
}
constexpr double kBeside = 9, kOver = 4, kAside = 3;  // pixels round the letters, and from the bounds
}  // namespace

QRectF wordTag(const QFont& font, const QPointF& above, const QString& words, const QRectF& bounds) {
  const QRectF within = bounds.adjusted(kAside, kAside, -kAside, -kAside);
  const QRectF most(0, 0, std::max(1.0, within.width() - 2 * kBeside), 1e4);
  QRectF tag = QFontMetricsF(wordFont(font)).boundingRect(most, Qt::AlignCenter | Qt::TextWordWrap, words);
  tag.adjust(-kBeside, -kOver, kBeside, kOver);
  tag.moveCenter(above + QPointF(0, -20));
  tag.moveLeft(std::max(within.left(), std::min(tag.left(), within.right() - tag.width())));
  tag.moveTop(std::max(within.top(), std::min(tag.top(), within.bottom() - tag.height())));
  return tag;
}

void paintWord(QPainter& painter, const QPointF& above, const QString& words, const QRectF& bounds) {
  painter.save();
  const QRectF tag = wordTag(painter.font(), above, words, bounds);
  painter.setFont(wordFont(painter.font()));
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(40, 36, 32, 215));
  painter.drawRoundedRect(tag, 8, 8);
  painter.setPen(Qt::white);
  painter.drawText(tag, Qt::AlignCenter | Qt::TextWordWrap, words);
  painter.restore();
}

}  // namespace karinui::studio
