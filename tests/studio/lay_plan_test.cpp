// The lay plan in the real window: searched, stopped, moved by hand and by keys, written.
#include <gmock/gmock.h>

#include <QAbstractButton>
#include <QCheckBox>
#include <QFileDialog>
#include <QLabel>
#include <QTabBar>
#include <QTimer>
#include <cmath>

#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "lay_dialog.h"
#include "lay_view.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// A skirt: the front half on the fold, two backs, four pockets; and a waistband of another fabric.
const char* const kSkirt =
    "piece name=front outline=\"M 0 0; hem L 300 0; side L 280 600; waist L 0 600; fold L 0 0\"\n"
    "piece name=back outline=\"M 0 0; hem L 300 0; side L 280 600; waist L 0 600; cb L 0 0\" pose=\"0,0,-0.3\"\n"
    "piece name=pocket outline=\"M 0 0; low L 150 0; side L 140 180; top L 0 180; in L 0 0\" pose=\"1,0,-0.3\"\n"
    "piece name=band outline=\"M 0 0; low L 700 0; e L 700 60; top L 0 60; w L 0 0\" pose=\"1,1,0\" fabric=denim\n"
    "quantity piece=back count=2 pairs=yes\nquantity piece=pocket count=4 pairs=yes\n"
    "sew a=front.side b=back.side\n";

class Bench {
 public:
  explicit Bench(const char* script = kSkirt) {
    application();
    for (const char* key : {"width", "fold", "gap", "nap", "stripes", "rows"})
      QSettings().remove(QString("lay/") + key);
    QSettings().setValue("lay/search", 0);
    if (const auto lines = parseScript(script))
      for (const ScriptLine& line : *lines) w.session().perform(line.operation);
    w.rest();
    for (QAction* action : w.main().findChildren<QAction*>())
      if (action->text() == QString::fromUtf8("Lay plan…")) action->trigger();
    dialog = w.main().findChild<LayDialog*>();
    if (!dialog) return;
    view = dialog->findChild<LayView*>();
    wait();
  }
  ~Bench() { delete dialog; }
  void wait() {
    while (dialog->busy()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    QApplication::processEvents();
  }
  // Of all widgets, by the name that is heard or read.
  template <class Kind>
  Kind& named(const char* name) {
    for (Kind* one : dialog->findChildren<Kind*>()) {
      if (one->accessibleName() == name) return *one;
      if (auto* button = qobject_cast<QAbstractButton*>(one); button && button->text() == name) return *one;
    }
    ADD_FAILURE() << "nothing is called " << name;
    std::abort();
  }
  void anew() {
    named<QPushButton>("Lay anew").click();
    EXPECT_TRUE(dialog->busy());
    wait();
  }
  std::string said() const { return dialog->findChild<QLabel*>("lay_said")->text().toStdString(); }
  std::string use() const { return dialog->findChild<QLabel*>("lay_use")->text().toStdString(); }
  const FabricLay& lay(std::size_t fabric = 0) const { return dialog->plan()->fabrics[fabric]; }
  std::size_t nth(const char* piece) const {
    const PieceId id = dialog->plan()->document.pieceNamed(piece)->id;
    for (std::size_t i = 0; i < lay().pieces.size(); ++i)
      if (lay().pieces[i].piece == id) return i;
    ADD_FAILURE() << piece;
    return 0;
  }
  Flat middle(std::size_t i) const {
    Flat sum;
    for (const Flat p : lay().cut[i]) sum += p;
    return sum * (1 / static_cast<double>(lay().cut[i].size()));
  }
  void drag(std::size_t piece, Flat by, std::function<void()> before = {}) {
    const Flat from = middle(piece);
    w.drag(*view, {view->onScreen(from), view->onScreen(from + by)}, {}, std::move(before));
  }
  void doubleClick(std::size_t piece) {
    const QPointF at = view->onScreen(middle(piece));
    w.click(*view, at);
    QMouseEvent twice(QEvent::MouseButtonDblClick, at, view->mapToGlobal(at), Qt::LeftButton, Qt::LeftButton, {});
    QApplication::sendEvent(view, &twice);
    QApplication::processEvents();
  }
  // Saves through the file dialog.
  fs::path save(const char* name) {
    const fs::path path = folder.path / name;
    QTimer watch;
    QObject::connect(&watch, &QTimer::timeout, [&] {
      auto* asks = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!asks) return;
      watch.stop();
      asks->findChild<QLineEdit*>()->setText(QString::fromStdString(path.string()));
      QMetaObject::invokeMethod(asks, "accept");
    });
    watch.start(0);
    named<QPushButton>("Save…").click();
    return path;
  }

  Window w;
  LayDialog* dialog = nullptr;
  LayView* view = nullptr;
  Folder folder;
};

bool red(const QColor& colour) { return colour.red() > 150 && colour.green() < 150 && colour.blue() < 150; }

TEST(StudioLayPlan, APieceStaysWhereItIsClearAndElseGoesBack) {
  KARINUI_NEEDS_DISPLAY();
  Bench bench;
  ASSERT_TRUE(bench.dialog && bench.dialog->plan()) << bench.said();
  EXPECT_FALSE(clash(bench.lay()));
  ASSERT_EQ(bench.named<QTabBar>("Fabric").count(), 2);
  const FabricLay before = bench.lay();
  const std::string told = bench.use();
  const std::size_t pocket = bench.nth("pocket"), back = bench.nth("back");
  bench.w.keepDialog(*bench.dialog, "studio_lay");

  bench.drag(pocket, bench.middle(back) - bench.middle(pocket), [&] {
    const QPointF at = bench.view->onScreen(bench.middle(pocket)) + QPointF(20, 15);
    EXPECT_TRUE(red(bench.view->grab().toImage().pixelColor(at.toPoint()))) << "while it is held";
    EXPECT_TRUE(bench.view->holding());
    bench.w.keepDialog(*bench.dialog, "studio_lay_clash");
  });
  EXPECT_EQ(bench.lay().cut, before.cut);
  EXPECT_EQ(bench.lay().length, before.length);
  EXPECT_EQ(bench.use(), told);
  EXPECT_THAT(bench.said(), HasSubstr("would lie over"));
  bench.drag(pocket, {0, -2});
  EXPECT_EQ(bench.lay().cut, before.cut);
  EXPECT_THAT(bench.said(), HasSubstr("would not lie on the cloth"));

  const Flat from = bench.middle(pocket);
  double high = 0, last = 0;
  for (const Flat p : before.cut[pocket]) high = std::max(high, p.u - from.u);
  const Flat by{before.length - from.u - high + 0.03, 0};
  // Where the cloth goes on behind the last piece; a wide bay may need it further down.
  bench.drag(pocket, by + Flat{high + 0.2, 0});
  EXPECT_NE(bench.lay().cut, before.cut) << bench.said();
  EXPECT_NEAR(bench.middle(pocket).u, from.u + by.u + high + 0.2, 1e-9);
  EXPECT_FALSE(clash(bench.lay()));
  for (const Flat p : bench.lay().cut[pocket]) last = std::max(last, p.u);
  EXPECT_DOUBLE_EQ(bench.lay().length, last);
  EXPECT_LT(bench.lay().use, before.use);
  EXPECT_NE(bench.use(), told);
  EXPECT_THAT(bench.use(), HasSubstr(lengthText(std::ceil(last * 1000 - 1e-3) / 1000).toStdString()));

  bench.doubleClick(pocket);
  EXPECT_NE(bench.lay().pieces[pocket].turned, before.pieces[pocket].turned);
  bench.named<QTabBar>("Fabric").setCurrentIndex(1);
  EXPECT_THAT(bench.use(), testing::Not(HasSubstr(lengthText(std::ceil(last * 1000 - 1e-3) / 1000).toStdString())));
}

TEST(StudioLayPlan, TheKeysDoWhatTheMouseDoes) {
  KARINUI_NEEDS_DISPLAY();
  Bench bench;
  ASSERT_TRUE(bench.dialog && bench.dialog->plan()) << bench.said();
  const FabricLay before = bench.lay();
  bench.view->setFocus();
  for (std::size_t i = 0; i <= bench.nth("pocket"); ++i) bench.w.type(*bench.view, Qt::Key_Tab);
  const std::size_t pocket = bench.nth("pocket");
  EXPECT_THAT(bench.said(), HasSubstr("pocket"));
  // Over everything to behind the last piece; what it passes over is no matter until Enter.
  const auto carry = [&] {
    while (bench.middle(pocket).u < before.length + 0.15) bench.w.type(*bench.view, Qt::Key_Right);
  };
  carry();
  EXPECT_TRUE(bench.view->holding());
  bench.w.type(*bench.view, Qt::Key_Escape);
  EXPECT_EQ(bench.lay().cut, before.cut) << "Escape puts it back";
  EXPECT_TRUE(bench.dialog->isVisible());
  carry();
  bench.w.type(*bench.view, Qt::Key_T);
  bench.w.type(*bench.view, Qt::Key_Return);
  EXPECT_FALSE(bench.view->holding());
  EXPECT_FALSE(bench.dialog->busy()) << "Enter is not the dialog's";
  EXPECT_GT(bench.lay().length, before.length + 0.1);
  EXPECT_NE(bench.lay().pieces[pocket].turned, before.pieces[pocket].turned);
  EXPECT_FALSE(clash(bench.lay()));
  // A move that is taken back, to the bit.
  bench.w.type(*bench.view, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(bench.lay().cut, before.cut);
  EXPECT_EQ(bench.lay().length, before.length);
  EXPECT_EQ(bench.lay().pieces[pocket].turned, before.pieces[pocket].turned);
  bench.w.type(*bench.view, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_THAT(bench.said(), HasSubstr("no move"));
  // Every control is reached and has a name.
  for (QWidget* one : bench.dialog->findChildren<QWidget*>()) {
    if (!(one->focusPolicy() & Qt::TabFocus) || !one->isVisible() || one->focusProxy()) continue;
    if (qobject_cast<LengthBox*>(one->parentWidget())) continue;  // its line, which speaks as the box
    const auto* button = qobject_cast<QAbstractButton*>(one);
    EXPECT_FALSE(one->accessibleName().isEmpty() && (!button || button->text().isEmpty()))
        << one->metaObject()->className();
  }
}

TEST(StudioLayPlan, TheFieldsDecideAndNapForbidsTurning) {
  KARINUI_NEEDS_DISPLAY();
  Bench bench;
  ASSERT_TRUE(bench.dialog && bench.dialog->plan()) << bench.said();
  LengthBox& width = bench.named<LengthBox>("Width of the cloth");
  width.findChild<QLineEdit*>()->setText("110");
  bench.named<QCheckBox>("Folded lengthwise").click();
  bench.named<QCheckBox>("One way only").click();
  LengthBox& rows = bench.named<LengthBox>("Rows");
  rows.findChild<QLineEdit*>()->setText("8");
  width.setFocus(), rows.setFocus(), bench.view->setFocus();
  bench.anew();
  const LaySettings& settings = bench.dialog->plan()->settings;
  EXPECT_NEAR(settings.width, 1.1, 1e-9);
  EXPECT_NEAR(settings.rows, 0.08, 1e-9);
  EXPECT_TRUE(settings.folded && settings.nap);
  EXPECT_NEAR(bench.lay().width, 0.55, 1e-9);
  EXPECT_THAT(bench.use(), HasSubstr("folded"));
  bench.w.keepDialog(*bench.dialog, "studio_lay_folded");
  const FabricLay before = bench.lay();
  bench.doubleClick(bench.nth("pocket"));
  EXPECT_EQ(bench.lay().cut, before.cut);
  EXPECT_THAT(bench.said(), HasSubstr("nap"));
  // On the fold along it only, and by whole rows.
  const std::size_t front = bench.nth("front");
  ASSERT_TRUE(bench.lay().pieces[front].onFold);
  double high = 0;
  for (const Flat p : before.cut[front]) high = std::max(high, p.u);
  const double behind = before.length - before.pieces[front].at.u + high;
  bench.drag(front, {behind - high + 0.61, 0.2});
  const Flat went = bench.lay().pieces[front].at - before.pieces[front].at;
  EXPECT_GT(went.u, 0.1) << bench.said();
  EXPECT_EQ(went.v, 0);
  EXPECT_NEAR(went.u / 0.08, std::round(went.u / 0.08), 1e-9);
  // Cloth that is too narrow is refused in a sentence, and the plan stays.
  width.setFocus();
  width.findChild<QLineEdit*>()->setText("30");
  bench.view->setFocus();
  const FabricLay kept = bench.lay();
  bench.anew();
  EXPECT_THAT(bench.said(), HasSubstr("folded cloth"));
  EXPECT_EQ(bench.lay().cut, kept.cut);
}

TEST(StudioLayPlan, TheSearchCanBeStopped) {
  KARINUI_NEEDS_DISPLAY();
  Bench bench;
  ASSERT_TRUE(bench.dialog && bench.dialog->plan()) << bench.said();
  const FabricLay before = bench.lay();
  bench.named<QComboBox>("Search").setCurrentIndex(2);
  bench.named<QPushButton>("Lay anew").click();
  ASSERT_TRUE(bench.dialog->busy());
  EXPECT_FALSE(bench.named<QPushButton>("Save…").isEnabled());
  bench.named<QPushButton>("Stop").click();
  bench.wait();
  EXPECT_THAT(bench.said(), StartsWith("Stopped"));
  EXPECT_EQ(bench.lay().cut, before.cut);
  EXPECT_TRUE(bench.named<QPushButton>("Save…").isEnabled());
  // A dialog that is closed in mid-search waits for it.
  bench.named<QPushButton>("Lay anew").click();
  delete bench.dialog;
  bench.dialog = nullptr;
}

TEST(StudioLayPlan, EveryKindIsWritten) {
  KARINUI_NEEDS_DISPLAY();
  Bench bench;
  ASSERT_TRUE(bench.dialog && bench.dialog->plan()) << bench.said();
  auto& kind = bench.named<QComboBox>("What");
  const std::pair<const char*, const char*> begins[] = {{"pdf", "%PDF"}, {"svg", "<?xml"}, {"dxf", ""}, {"plt", ""}};
  std::set<std::string> endings;
  for (int k = 0; k < kind.count(); ++k) {
    kind.setCurrentIndex(k);
    const fs::path path = bench.save(("plan" + std::to_string(k)).c_str());
    for (const auto& [ending, start] : begins)
      if (const auto bytes = readFile(path.string() + "." + ending)) {
        endings.insert(ending);
        EXPECT_THAT(*bytes, StartsWith(start));
        EXPECT_GT(bytes->size(), 1000u);
      }
    EXPECT_THAT(bench.said(), HasSubstr("was written")) << kind.currentText().toStdString();
  }
  EXPECT_EQ(endings.size(), 4u);
  // A folder that cannot be written.
  bench.save("none/there");
  EXPECT_FALSE(fs::exists(bench.folder.path / "none"));
}

TEST(StudioLayPlan, InJapaneseAndWithoutAPiece) {
  KARINUI_NEEDS_DISPLAY();
  {
    Bench bench("");
    ASSERT_TRUE(bench.dialog);
    EXPECT_FALSE(bench.dialog->plan());
    EXPECT_THAT(bench.said(), HasSubstr("no piece"));
    EXPECT_FALSE(bench.named<QPushButton>("Save…").isEnabled());
    for (const int key : {Qt::Key_Tab, Qt::Key_Right, Qt::Key_T, Qt::Key_Return, Qt::Key_0})
      bench.w.type(*bench.view, key);
    bench.w.drag(*bench.view, {{40, 40}, {90, 90}});
  }
  Bench bench;
  delete bench.dialog;
  Theme::here().setLanguage(Language::Japanese);
  auto* dialog = new LayDialog(bench.w.session(), &bench.w.main());
  bench.dialog = dialog;
  bench.wait();
  bench.w.keepDialog(*dialog, "studio_lay_ja");
  for (const QLabel* label : dialog->findChildren<QLabel*>())
    for (const QChar c : label->text().section(' ', 0, 0))
      EXPECT_FALSE(c.isLower() && c.unicode() < 128 && label->text().size() > 8) << label->text().toStdString();
  Theme::here().setLanguage(Language::English);
}

}  // namespace
}  // namespace karinui::studio
