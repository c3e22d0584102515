#pragma once
// The boards at the right: the garment and its properties, figure, fabric, fit, history. Each shows the session and
// asks it for operations; none keeps a state of its own. GUI thread.
#include <QDoubleSpinBox>
#include <QSpinBox>
#include <QVBoxLayout>
#include <QWidget>
#include <functional>
#include <span>

#include "karinui/session/session.h"
#include "mixed_box.h"
#include "space_view.h"
#include "step_field.h"

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QListWidgetItem;
class QPushButton;
class QScrollArea;
class QSlider;
class QTabBar;
class QTreeWidget;

namespace karinui::studio {

class FabricPlot;
class LengthBox;
class LengthChoice;
class TakeInBoard;
class LongerBoard;
class EdgeNumbers;
class LookBoard;
class AllowanceBoard;
class CutBoard;
class MeasureDrawing;
class MeasureRow;

class Panel : public QWidget {
  Q_OBJECT
 public:
  explicit Panel(Session& session, QWidget* in = nullptr);  // what is made in its place is given its style once
  virtual void refresh() = 0;                               // the session has something new
  virtual void showAgain() {}                               // what was entered was refused

 protected:
  QLabel* title(const Message& words);
  QLabel* word(const Message& words);
  Session& session_;
  bool filling_ = false;  // values are being shown, not entered
  std::uint64_t historyShown_ = ~0ull;
};

class GarmentPanel : public Panel {
  Q_OBJECT
 public:
  GarmentPanel(Session& session, QWidget* in);
  void refresh() override;
  void showAgain() override;

 signals:
  void blockAsked();                     // with its numbers typed
  void menuAsked(const QPoint& global);  // of what is chosen in the tree

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void makePieceBoard();
  void makeEdgeBoard();
  void connectTree();
  void connectPieceBoard();
  void connectEdgeBoard();
  Selection chosenInTree() const;
  const Piece* pieceChosen() const;
  void fillTree();
  void fillProperties();
  void fillPieces(const std::vector<const Piece*>& pieces);  // that are chosen
  std::vector<const Piece*> chosenPieces() const;
  std::vector<PieceRef> chosenRefs() const;
  void edgeTyped(const std::function<Result<Outline>(const Piece&)>& change);
  // The chosen edge, and what is sewn to it, by a length or, if it is not empty, a formula that comes to it.
  void lengthen(const std::string& formula, double metres);
  void takeIn(const std::string& formula, double metres);
  QTreeWidget* tree_;
  QWidget* pieceBoard_;
  QWidget* edgeBoard_;
  QLineEdit* name_;
  QComboBox* fabric_;
  QLabel* pieceTitle_;
  MixedBox<QSpinBox>* layer_;
  QCheckBox* frozen_;
  MixedBox<QDoubleSpinBox>* grain_;
  QLabel* area_;
  LookBoard* look_;
  QLineEdit* edgeName_;
  LengthBox *length_, *takeIn_, *u_, *v_;
  TakeInBoard* takenIn_;
  LengthBox* longer_;
  LongerBoard* longerHow_;
  EdgeNumbers* numbers_;
  QLabel* several_;
  void showSeveral();
  LengthChoice* stays_;
  QScrollArea* scroll_;
  AllowanceBoard* allowance_;
  CutBoard* cut_;
  QLabel* sewn_;
  Selection selectionShown_;
};

class BodyPanel : public Panel {
  Q_OBJECT
 public:
  BodyPanel(Session& session, QWidget* in);
  void refresh() override;
 signals:
  void importAsked();
  void replayAsked(const SetBody& body);

 private:
  SetBody wished() const;
  void addRows(const Message& group, std::span<const std::string_view> keys);
  void findRows(const QString& wanted);  // only those with a word like this
  void drawTape(const std::string& key);
  void askMeasures();
  void askSaveMeasures();
  std::vector<Stated> asMeasured(std::span<const std::string_view> keys) const;  // of the figure that stands
  bool imported() const;
  void fillMeasured();
  QFormLayout* form_;
  QLabel *imported_, *consequence_;
  QPushButton* mannequin_;
  QComboBox* size_;
  bool sizeMeant_ = false;  // chosen, and not only what a board without a figure offers
  QComboBox* sex_;
  void wear();
  void fill();  // with the figure as it was chosen
  struct MeasureGroup {
    QLabel* title;
    std::vector<std::string> keys;
  };
  std::map<std::string, MeasureRow*> rows_;
  std::map<std::string, QLabel*> names_;
  std::vector<MeasureGroup> groups_;
  QFormLayout* measures_;
  QLineEdit* find_;
  MeasureDrawing* drawing_;
  std::string drawnKey_ = "bust_girth";
  QCheckBox *dressForm_, *follow_;
  QPushButton *use_, *replay_;
  QLabel* measured_;
  std::string shown_, listed_;  // the figures that the rows and the list tell of
};

class FabricPanel : public Panel {
  Q_OBJECT
 public:
  FabricPanel(Session& session, QWidget* in);
  void refresh() override;

 private:
  void show(const Fabric& fabric);
  void fillValues();
  void showWhatMayBeDone();
  void goTo(const std::string& name);
  void follow(const std::string& name);  // of what is chosen, until another is looked up
  Fabric fabricCalled(const std::string& name) const;
  void perform(SetFabric set, bool cut);
  QListWidget* list_;
  QTabBar* law_;
  FabricPlot* plot_;
  LookBoard* look_;
  QPushButton *cut_, *change_, *own_;
  std::vector<QDoubleSpinBox*> values_;
  Fabric fabric_, kept_;                     // as it is being changed, and as it is
  std::string wanted_;                       // what is chosen when the list is made anew
  bool following_ = false, byHand_ = false;  // the list goes along with the garment; the hand went on in it
  std::filesystem::path path_;               // of the garment that is shown
  Selection selectionShown_;
};

class FitPanel : public Panel {
  Q_OBJECT
 public:
  FitPanel(Session& session, SpaceView& view, QWidget* in);
  void refresh() override;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void fillBeside();
  void compare();
  void fillReport();
  QComboBox* beside_;
  SnapshotPtr then_;  // null: nothing is shown beside
  QLabel* girths_;
  QCheckBox* level_;
  LengthBox* height_;
  QSlider* slide_;
  SpaceView& view_;
  QComboBox* map_;
  QCheckBox* tape_;
  QComboBox* stereo_;
  LengthBox* eyes_;
  QDoubleSpinBox* focus_;
  QLabel* report_;
};

// Every step with its picture; going back to any, and changing one of them.
class HistoryPanel : public Panel {
  Q_OBJECT
 public:
  HistoryPanel(Session& session, SpaceView& view, QWidget* in);
  void refresh() override;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QListWidgetItem* addStep(std::size_t number, const Step* step, bool undone);
  void fillSteps();
  void fillFields();  // of the chosen step
  void playAgain();
  std::vector<QListWidgetItem*> inSight() const;  // rows, from the top
  void askPicture();                              // the next one that is missing in sight, while the panel is seen
  void keepPicture(const std::string& chain, const SnapshotPtr& then);
  QIcon pictureOf(const Step& step) const;
  const Step* stepIn(const QListWidgetItem& item) const;  // null: the beginning, or the end of another way
  const Step* chosen() const;                             // null: none, or not done

  SpaceView& view_;
  QListWidget* list_;
  QWidget* board_;
  QLabel* about_;
  QFormLayout* fields_;
  QPushButton* again_;
  std::vector<StepField> typed_;
  std::map<std::string, QPixmap> pictures_;  // by the hash of all steps up to there
  bool asked_ = false;
  int stay_ = 0;  // the row that stays chosen when the list is made anew; 0: the step one stands at
};

}  // namespace karinui::studio
