#pragma once
// What is seen while no document is open: the garments there are, drafts among them, each with its picture, and the
// ways to begin one. GUI thread.
#include <QWidget>

#include "karinui/base/message.h"

class QLabel;
class QListWidget;
class QListWidgetItem;
class QPushButton;
class QVBoxLayout;

namespace karinui::studio {

class Thumbnails;

class StartPage : public QWidget {
  Q_OBJECT
 public:
  StartPage();
  ~StartPage() override;
  void fill();         // looks again which documents there are
  void leave();        // reads no document any more
  bool still() const;  // all pictures are there

 signals:
  void freshAsked();
  void blockAsked();
  void openAsked();
  void importAsked();
  void guideAsked();
  void sampleAsked();
  void documentAsked(const QString& path);
  void stillNow();

 private:
  QPushButton* way(const Message& words, const Message& hint, const char* icon, void (StartPage::*asked)());
  QListWidgetItem* itemOf(const QString& path) const;
  void drawn(const QString& path, const QImage& picture, int steps);
  void showWords();
  void discard();  // the chosen draft, into the trash
  QVBoxLayout* ways_;
  QLabel *name_, *about_, *title_, *none_;
  QPushButton* fresh_;
  QListWidget* list_;
  Thumbnails* thumbnails_;
};

}  // namespace karinui::studio
