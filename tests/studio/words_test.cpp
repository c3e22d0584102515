// What a person reads in the window: no identifier of scripts, nothing left in the other language, nothing cut off.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileIconProvider>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QPaintEngine>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QStyleOption>
#include <QTabBar>
#include <QTabWidget>
#include <QTextDocument>
#include <QToolButton>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>

#include "export_dialog.h"
#include "karinui/design/script.h"
#include "soak.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

QString plain(const QString& text) {
  if (!Qt::mightBeRichText(text)) return text;
  QTextDocument document;
  document.setHtml(text);
  return document.toPlainText();
}

// The words a widget paints, without its pixels.
class Words : public QPaintEngine {
 public:
  QStringList said;
  Words() : QPaintEngine(AllFeatures) {}
  bool begin(QPaintDevice*) override { return true; }
  bool end() override { return true; }
  void updateState(const QPaintEngineState&) override {}
  void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override {}
  void drawImage(const QRectF&, const QImage&, const QRectF&, Qt::ImageConversionFlags) override {}
  void drawPath(const QPainterPath&) override {}
  void drawPolygon(const QPointF*, int, PolygonDrawMode) override {}
  void drawTextItem(const QPointF&, const QTextItem& item) override { said << item.text(); }
  Type type() const override { return User; }
};
class Page : public QPaintDevice {
 public:
  explicit Page(QSize size) : size_(size) {}
  QStringList said() const { return words_.said; }
  QPaintEngine* paintEngine() const override { return &words_; }

 protected:
  int metric(PaintDeviceMetric which) const override {
    switch (which) {
      case PdmWidth:
        return size_.width();
      case PdmHeight:
        return size_.height();
      case PdmDevicePixelRatio:
        return 1;
      case PdmDevicePixelRatioScaled:
        return 65536;
      case PdmDepth:
        return 32;
      default:
        return 96;
    }
  }

 private:
  QSize size_;
  mutable Words words_;
};

// Everything a person can read or hear of these widgets now.
std::set<QString> readIn(QWidget& root) {
  std::set<QString> all;
  const auto add = [&](const QString& text) {
    if (!text.trimmed().isEmpty()) all.insert(plain(text));
  };
  QList<QWidget*> widgets = root.findChildren<QWidget*>();
  widgets << &root;
  for (QWidget* widget : widgets) {
    if (widget->objectName() == "toast" && !widget->isVisible()) continue;
    if (widget->objectName().startsWith("Scroll")) continue;  // Qt's own arrows
    add(widget->toolTip());
    add(widget->statusTip());
    add(widget->accessibleName());
    add(widget->accessibleDescription());
    for (const QAction* action : widget->actions()) add(action->text()), add(action->toolTip());
    if (auto* label = qobject_cast<QLabel*>(widget)) add(label->text());
    if (auto* button = qobject_cast<QAbstractButton*>(widget)) add(button->text());
    if (auto* line = qobject_cast<QLineEdit*>(widget)) add(line->text()), add(line->placeholderText());
    if (auto* spin = qobject_cast<QAbstractSpinBox*>(widget)) add(spin->text());
    if (auto* combo = qobject_cast<QComboBox*>(widget))
      for (int i = 0; i < combo->count(); ++i) add(combo->itemText(i));
    if (auto* tabs = qobject_cast<QTabBar*>(widget))
      for (int i = 0; i < tabs->count(); ++i) add(tabs->tabText(i)), add(tabs->tabToolTip(i));
    if (auto* list = qobject_cast<QListWidget*>(widget))
      for (int i = 0; i < list->count(); ++i) add(list->item(i)->text()), add(list->item(i)->toolTip());
    if (auto* tree = qobject_cast<QTreeWidget*>(widget))
      for (QTreeWidgetItemIterator it(tree); *it; ++it) add((*it)->text(0)), add((*it)->toolTip(0));
    if (auto* menu = qobject_cast<QMenu*>(widget)) add(menu->title());
  }
  return all;
}

// A garment with names of the program's own making: edges by number, a slit's edges, a dart, marks, a copied fabric.
void openNamed(Window& w) {
  w.openTunic();
  for (const char* line : {"draw name=panel line=\"torso:hip@0.05; torso:hip@0.2; torso:waist@0.2; torso:waist@0.05\"",
                           "fabric name=cotton_2 like=cotton weight=0.2 piece=panel", "notch edge=panel.e1 at=0.25",
                           "line piece=panel along=\"0,0; 0,2cm\"", "split edge=panel.e2 at=0.5",
                           "sew a=panel.e1 b=back.hem_left", "drape gravity=0,-9.7,0"}) {
    const auto operation = parseOperation(line);
    ASSERT_TRUE(operation) << line;
    w.session().perform(*operation);
    w.session().finish();
  }
  w.rest();
}

// And names of several words, of our own and of the person's.
void openLongNamed(Window& w) {
  openNamed(w);
  for (const char* line :
       {"polygon name=pocket_left_lining points=\"0,0; 9cm,0; 9cm,9cm; 0,9cm\" edges=\"pocket_left_low "
        "side_right pleat_fold_2 side_left\"",
        "freeze piece=pocket_left_lining"}) {
    w.session().perform(*parseOperation(line));
    w.session().finish();
  }
  w.rest();
  ASSERT_TRUE(w.session().snapshot().document.pieceNamed("pocket_left_lining")) << w.main().said().toStdString();
}

std::set<QString> readInTheWindow(Window& w) {
  std::set<QString> all = readIn(w.main());
  const auto take = [&] { all.merge(readIn(w.main())); };
  for (const auto& [id, piece] : w.session().snapshot().document.pattern.pieces) {
    Selection chosen;
    chosen.pieces = {id};
    chosen.edge = EdgeNear{id, piece->outline.edges.front().name, 0.5, 0};
    w.session().select(chosen);
    w.rest();
    take();
  }
  for (int board = 0; board < w.main().boards().count(); ++board) {
    w.main().boards().setCurrentIndex(board);
    w.rest();
    take();
  }
  for (QListWidget* list : w.main().boards().currentWidget()->findChildren<QListWidget*>())
    for (int row = 0; row < list->count(); ++row) {
      list->setCurrentRow(row);
      QApplication::processEvents();
      take();
    }
  Page page(w.table().size());
  w.table().render(&page);
  for (const QString& words : page.said()) all.insert(words);
  ExportDialog dialog(w.session(), w.space(), &w.main());
  all.merge(readIn(dialog));
  return all;
}

// What scripts call it stands in tooltips after these words; keys have English names.
QString withoutScripts(QString text) {
  static const QRegularExpression script("(In scripts: |台本では： ?)[^\n]*"), keys("\\((Ctrl|Alt|Shift|F\\d)[^)]*\\)");
  return text.remove(script).remove(keys);
}

TEST(StudioWords, NoIdentifierIsSeenInEitherLanguage) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openLongNamed(w);
  static const QRegularExpression machine(
      "[a-z0-9]_[a-z0-9]|\\be\\d+\\b|\\bp\\d+\\b|torso:|landmark:|\\d(mm|cm)\\b|\\b[a-z]+=");
  for (const Language language : {Language::English, Language::Japanese}) {
    Theme::here().setLanguage(language);
    w.rest();
    for (const QString& text : readInTheWindow(w))
      EXPECT_FALSE(machine.match(withoutScripts(text)).hasMatch()) << withoutScripts(text).toStdString();
  }
  Theme::here().setLanguage(Language::English);
}

TEST(StudioWords, NothingStaysEnglishInJapanese) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openLongNamed(w);
  Theme::here().setLanguage(Language::Japanese);
  w.rest();
  static const QRegularExpression latin("[A-Za-z]{2,}");
  static const std::set<QString> allowed{
      "Karinui", "GLB",       "OBJ",     "PDF",        "SVG",     "JSON",    "GarmentCode", "JIS",     "AR",
      "EU",      "cm",        "mm",      "kPa",        "kB",      "MB",      "Ctrl",        "Alt",     "Shift",
      "Esc",     "Tab",       "Enter",   "Space",      "Page",    "Up",      "Down",        "Del",     "Return",
      "Pause",   "Blender",   "English", "Haply",      "Inverse", "Systems", "Touch",       "Phantom", "PDF",
      "Karinui", "tunic",     "karinui", "DXF",        "AAMA",    "ASTM",    "HPGL",        "RUL",     "PNG",
      "JPEG",    "Valentina", "Seamly",  "FreeSewing", "cd"};  // cd: of a colour, 89a5cd
  for (const QString& text : readInTheWindow(w))
    for (auto it = latin.globalMatch(withoutScripts(text)); it.hasNext();) {
      const QString word = it.next().captured();
      EXPECT_TRUE(allowed.contains(word)) << word.toStdString() << " in: " << text.toStdString();
    }
  Theme::here().setLanguage(Language::English);
}

// Who works with dialogs and gestures writes no scripts: refusals speak of what stands in the window.
TEST(StudioWords, RefusalsSpeakOfLabels) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openLongNamed(w);
  const auto refused = [&](const char* line) {
    w.session().perform(*parseOperation(line));
    w.rest();
    return w.main().said().toStdString();
  };
  EXPECT_EQ(refused("pleat depth=1cm"),
            "Say which edge is pleated: “Edge”; or three lines that are drawn: “Fold, inner fold and placement line”.");
  EXPECT_EQ(refused("rename piece=front to=pocket_left_lining"),
            "There is already a piece “lining of left pocket”; choose another name.");
  EXPECT_EQ(
      refused("pull piece=pocket_left_lining at=1cm,1cm by=\"0,5cm,0\""),
      "“lining of left pocket” is frozen; thaw it first: “Freeze (Piece: lining of left pocket, Stays as it is: No)”.");
  Theme::here().setLanguage(Language::Japanese);
  EXPECT_EQ(refused("pleat depth=1cm"),
            "どの辺にたたむかを書いてください：「辺」。または描いた三本の線：「山折り線、谷折り線、合わせ位置の線」。");
  EXPECT_EQ(refused("rename piece=front to=pocket_left_lining"),
            "パーツ「左ポケットの裏地」はもうあります。別の名前にしてください。");
  Theme::here().setLanguage(Language::English);
}

// A name with spaces, as a person writes it.
TEST(StudioWords, AnOwnNameMayHaveSpaces) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("front")->id};
  w.session().select(chosen);
  w.rest();
  QLineEdit* name = nullptr;
  for (QLineEdit* box : w.main().findChildren<QLineEdit*>())
    if (box->isVisible() && box->text() == "front") name = box;
  ASSERT_TRUE(name);
  name->setFocus();
  name->setText("my best front");
  emit name->editingFinished();
  w.rest();
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("my_best_front")) << w.main().said().toStdString();
  EXPECT_EQ(name->text(), "my best front");
  EXPECT_FALSE(w.main()
                   .findChild<QTreeWidget*>()
                   ->findItems("my best front", Qt::MatchStartsWith | Qt::MatchCaseSensitive)
                   .isEmpty());
}

TEST(StudioWords, DialogsOfQtAreInTheLanguageToo) {
  KARINUI_NEEDS_DISPLAY();
  application();
  const auto cancel = [] {
    const QDialogButtonBox box(QDialogButtonBox::Cancel);
    return box.button(QDialogButtonBox::Cancel)->text().toStdString();
  };
  Theme::here().setLanguage(Language::Japanese);
  EXPECT_EQ(cancel(), "キャンセル");
  EXPECT_EQ(QFileIconProvider().type(QFileInfo(QDir::tempPath())).toStdString(), "フォルダー");
  Theme::here().setLanguage(Language::English);
  EXPECT_THAT(cancel(), testing::HasSubstr("ancel"));
}

// Between two Japanese words of a sentence there is no blank, whatever a value was; beside letters and digits it stays.
TEST(StudioWords, NoBlankStandsBeforeAParticle) {
  const auto said = [](const Message& message) { return text(message, Language::Japanese); };
  EXPECT_EQ(said(say("the end at {0} stays", "衿ぐり")), "衿ぐり側の端を固定");
  EXPECT_EQ(said(say("the end at {0} stays", "hem")), "hem 側の端を固定");
  EXPECT_EQ(said(say("{0} and {1} lie on opposite sides of the body.", "前身頃の右肩", "後ろ身頃の左肩")),
            "前身頃の右肩と後ろ身頃の左肩は体の左右反対側にあります。");
  EXPECT_EQ(said(say("{0} and {1} lie on opposite sides of the body.", "front.a", "後ろ身頃の左肩")),
            "front.a と後ろ身頃の左肩は体の左右反対側にあります。");
  EXPECT_EQ(said(say("“{0}” has no edge “{1}”; it has: {2}.", "前", "辺3", "裾")),
            "「前」に「辺3」はありません。あるのは：裾。");
  EXPECT_EQ(said(say("“{0}” has no edge “{1}”; it has: {2}.", "前", "脇", "裾")),
            "「前」に辺「脇」はありません。あるのは：裾。");
}

TEST(StudioWords, LengthsFollowTheUnitOfOnesChoice) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  openNamed(w);
  Theme::here().setInches(true);
  w.rest();
  static const QRegularExpression metric("\\d ?cm\\b|\\d mm\\b");
  for (const QString& text : readInTheWindow(w)) {
    if (text.contains("1 cm") || text.endsWith(" mm")) continue;  // the help of a field; a cloth's thickness
    EXPECT_FALSE(metric.match(withoutScripts(text)).hasMatch()) << text.toStdString();
  }
  Theme::here().setInches(false);
}

// --- nothing is cut off

// Whether there is something to read that is not seen whole, and cannot be had by scrolling or pointing.
QStringList cutIn(QWidget& root) {
  QStringList cut;
  for (QWidget* widget : root.findChildren<QWidget*>()) {
    if (!widget->isVisible() || widget->visibleRegion().isEmpty()) continue;
    QString words;
    QSize needed;
    if (auto* label = qobject_cast<QLabel*>(widget)) {
      if (label->text().isEmpty() || label->objectName() == "toast") continue;
      words = plain(label->text());
      needed = label->wordWrap() ? QSize(0, label->heightForWidth(label->width())) : label->sizeHint();
      if (label->wordWrap())  // a word that is wider than the line
        for (const QString& word : words.split(QRegularExpression("\\s+")))
          if (word.toLatin1() == word)
            needed.rwidth() = std::max(needed.width(), label->fontMetrics().horizontalAdvance(word));
    } else if (auto* button = qobject_cast<QAbstractButton*>(widget)) {
      if (button->text().isEmpty() || qobject_cast<QToolButton*>(widget)) continue;
      words = button->text();
      needed = button->minimumSizeHint();
    } else if (auto* combo = qobject_cast<QComboBox*>(widget)) {
      QStyleOptionComboBox option;
      option.initFrom(combo);
      option.editable = false;
      const QRect field =
          combo->style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, combo);
      words = combo->currentText();
      const bool told = plain(combo->toolTip()).contains(words);
      if (told || words.isEmpty()) continue;
      needed = QSize(combo->fontMetrics().horizontalAdvance(words) + combo->width() - field.width(), 0);
    } else if (auto* spin = qobject_cast<QAbstractSpinBox*>(widget)) {
      auto* line = spin->findChild<QLineEdit*>();
      words = spin->text();
      needed = QSize(line->fontMetrics().horizontalAdvance(words) + spin->width() - line->width(), 0);
    } else if (auto* tabs = qobject_cast<QTabBar*>(widget)) {
      for (int i = 0; i < tabs->count(); ++i) {
        const QRect tab = tabs->tabRect(i);
        if (tab.right() > tabs->width() || tab.width() < tabs->fontMetrics().horizontalAdvance(tabs->tabText(i)))
          cut << "tab " + tabs->tabText(i);
      }
      continue;
    } else if (auto* tree = qobject_cast<QTreeWidget*>(widget)) {
      for (QTreeWidgetItemIterator it(tree); *it; ++it) {
        const QRect row = tree->visualItemRect(*it);
        if (row.isEmpty() || !(*it)->toolTip(0).isEmpty()) continue;
        const int icon = (*it)->icon(0).isNull() ? 0 : tree->iconSize().width() + 6;
        if (row.left() + icon + tree->fontMetrics().horizontalAdvance((*it)->text(0)) >
            std::max(row.right(), tree->viewport()->width()))
          cut << "row " + (*it)->text(0);
      }
      continue;
    } else if (auto* list = qobject_cast<QListWidget*>(widget)) {
      for (int i = 0; i < list->count(); ++i) {
        const QListWidgetItem* item = list->item(i);
        if (!item->toolTip().isEmpty()) continue;
        for (const QString& line : item->text().split('\n'))
          if (list->iconSize().width() + 16 + QFontMetrics(item->font()).horizontalAdvance(line) >
                  list->viewport()->width() &&
              list->horizontalScrollBarPolicy() == Qt::ScrollBarAlwaysOff)
            cut << "row " + line;
      }
      continue;
    } else {
      continue;
    }
    if (needed.width() > widget->width() + 1 || needed.height() > widget->height() + 1)
      cut << QString("%1 [%2] %3x%4 in %5x%6")
                 .arg(words.left(60), widget->metaObject()->className())
                 .arg(needed.width())
                 .arg(needed.height())
                 .arg(widget->width())
                 .arg(widget->height());
    // Beyond what holds it, where nothing scrolls sideways.
    const int right = widget->mapTo(&root, QPoint(widget->width(), 0)).x();
    if (right > root.width() + 1) cut << "beyond the window: " + words.left(60);
    for (QWidget* up = widget->parentWidget(); up && up != &root; up = up->parentWidget())
      if (auto* scroll = qobject_cast<QScrollArea*>(up)) {
        const int beyond =
            widget->mapTo(scroll->viewport(), QPoint(widget->width(), 0)).x() - scroll->viewport()->width();
        if (beyond > 1 && scroll->horizontalScrollBarPolicy() == Qt::ScrollBarAlwaysOff)
          cut << "beyond its board: " + words.left(60);
        break;
      }
  }
  return cut;
}

void lookAtAll(Window& w, Language language) {
  Theme::here().setLanguage(language);
  const bool japanese = language == Language::Japanese;
  const Piece* front = w.session().snapshot().document.pieceNamed("front");
  Selection chosen;
  chosen.pieces = {front->id};
  chosen.edge = EdgeNear{front->id, "side_left", 0.5, 0};
  w.session().select(chosen);
  w.rest();
  const auto look = [&](QWidget& widget, const QString& name) {
    QApplication::processEvents();
    for (const QString& words : cutIn(widget))
      ADD_FAILURE() << (japanese ? "ja " : "en ") << name.toStdString() << ": " << words.toStdString();
    if (const char* folder = std::getenv("KARINUI_PICTURES"))
      widget.grab().save(QString("%1/words_%2_%3_%4.png")
                             .arg(folder, japanese ? "ja" : "en",
                                  qEnvironmentVariable("QT_SCALE_FACTOR") + "_" + qEnvironmentVariable("QT_FONT_DPI"),
                                  name));
  };
  const char* names[] = {"garment", "body", "fabric", "fit", "steps"};
  for (int board = 0; board < w.main().boards().count(); ++board) {
    w.main().boards().setCurrentIndex(board);
    w.rest();
    if (board == 4)
      for (QListWidget* list : w.main().boards().currentWidget()->findChildren<QListWidget*>()) list->setCurrentRow(3);
    w.rest();
    look(w.main(), board < 5 ? names[board] : "more");
  }
  ExportDialog dialog(w.session(), w.space(), &w.main());
  dialog.show();
  look(dialog, "export");
}

TEST(StudioWordsWhole, DISABLED_AtThisScale) {  // run as a process of its own by the next test
  Window w;
  w.main().resize(1366, 768);
  openNamed(w);
  for (const Language language : {Language::English, Language::Japanese}) lookAtAll(w, language);
}

TEST(StudioWords, NothingIsCutOffAtAnyScaleInEitherLanguage) {
  KARINUI_NEEDS_DISPLAY();
  application();
  const std::string self = fs::read_symlink("/proc/self/exe").string();
  // Everything larger, and the letters alone (96 points to the inch are 100 %).
  std::vector<std::pair<const char*, const char*>> screens = {{"1.5", "96"}};
  if (atLength()) screens.insert(screens.end(), {{"1", "192"}, {"1", "96"}, {"2", "96"}, {"1", "144"}});
  for (const auto& [scale, letters] : screens) {
    const pid_t child = fork();
    if (child == 0) {
      setenv("QT_SCALE_FACTOR", scale, 1);
      setenv("QT_FONT_DPI", letters, 1);
      execl(self.c_str(), self.c_str(), "--gtest_also_run_disabled_tests", "--gtest_filter=StudioWordsWhole.*",
            nullptr);
      _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "at " << scale << ", letters " << letters;
  }
}

}  // namespace
}  // namespace karinui::studio
