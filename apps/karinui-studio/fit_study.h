#pragma once
// How a garment fits beside itself: in several poses, or on several figures. What is to be looked at is ticked; the
// table fills while it is worked out on a thread of its own, and then all are seen side by side. Of the garment as it
// was when the dialog opened. GUI thread.
#include <QDialog>
#include <QThreadPool>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/session/fit_in_motion.h"
#include "karinui/session/session.h"
#include "karinui/view/line_up.h"

class QComboBox;
class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;
class QTableWidget;
class QVBoxLayout;

namespace karinui::studio {

// One garment of a study: a row of the table, and a figure of the picture.
struct StudyItem {
  Message name;
  std::vector<Message> cells;
  bool marked = false;          // it does not fit
  std::vector<Message> below;   // told under its picture
  SnapshotPtr garment;          // null: nothing is to be seen
  std::vector<float> pressure;  // on its figure
};

class FitStudy : public QDialog {
  Q_OBJECT
 public:
  ~FitStudy() override;  // stops the work and waits for it
  bool busy() const { return token_ != nullptr; }
  const std::vector<StudyItem>& items() const { return items_; }
  const std::string& csv() const { return csv_; }

 signals:
  void ready(bool canBegin);  // something is ticked, and no work is under way
  void finished();            // the work, in whatever way
  void drawn();               // there is a picture

 protected:
  FitStudy(Session& session, QWidget* parent, const Message& title, const Message& about);
  void choice(const Message& words, bool ticked);
  std::vector<std::size_t> ticked() const;
  QVBoxLayout& below() { return *below_; }  // beneath the choices
  QVBoxLayout& saves() { return *saves_; }  // where what was made is saved
  void tell(const Message& words);

  // Runs on the working thread; what is told is a row each. Gives the whole table for other programs.
  using Tell = std::function<void(StudyItem)>;
  using Work = std::function<Result<std::string>(Workers& workers, const Token& token, const Tell& tell)>;
  void begin(std::size_t count, const std::vector<Message>& columns, Work work);
  // Runs on the working thread, too, and leaves the table as it is. Gives what is told when it is done.
  using SideWork = std::function<Result<Message>(Workers& workers, const Token& token)>;
  void beginBeside(SideWork work);
  virtual void go() = 0;                               // what is ticked is to be looked at
  virtual Message faulty(std::size_t many) const = 0;  // that so many are marked

  Session& session_;
  int sentences_ = -1;  // the column that holds some; it takes the room that is left

 private:
  // Work on the working thread begins; `ofAll` makes the share of a step one of all of it.
  void start(std::function<double(double share)> ofAll);
  // On the window's thread, unless that work has ended. From the working thread.
  void onWindow(const std::shared_ptr<Token>& token, std::function<void()> work);
  void take(const Result<std::string>& table);
  void takeBeside(const Result<Message>& done);
  void enable();
  void add(StudyItem item);
  void draw();
  void showPicture();
  void saveTable();
  void savePicture();
  void resizeEvent(QResizeEvent* event) override;

  QListWidget* choices_;
  QVBoxLayout *below_, *saves_;
  QPushButton *go_, *saveTable_, *savePicture_;
  QComboBox *from_, *map_;
  QProgressBar* progress_;
  QTableWidget* table_;
  QLabel *picture_, *said_;
  std::vector<StudyItem> items_;
  std::string csv_;
  Image image_;
  std::shared_ptr<Token> token_;  // of what is under way
  std::uint64_t drawing_ = 0;     // counts the pictures that were asked for
  QThreadPool thread_, painter_;
};

// The garment at rest in one pose beside another.
class MotionStudy : public FitStudy {
  Q_OBJECT
 public:
  MotionStudy(Session& session, QWidget* parent);

  // Writes how the garment goes through the poses that are ticked, as a GLB.
  void saveAnimation(const std::string& file);

 private:
  void go() override;
  Message faulty(std::size_t many) const override;
  std::vector<std::string> poses() const;
  void askAnimation();
  const SnapshotPtr garment_;
  QPushButton* saveAnimation_;
};

// The garment made to one figure after another.
class FiguresStudy : public FitStudy {
  Q_OBJECT
 public:
  FiguresStudy(Session& session, QWidget* parent);
  // The people of a table of measures (measurement_table.h) as more choices.
  void addTable(const std::string& file);

 private:
  void go() override;
  Message faulty(std::size_t many) const override;
  void askTable();
  std::vector<GarmentWearer> wearers_;
};

}  // namespace karinui::studio
