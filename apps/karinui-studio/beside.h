#pragma once
// What stands beside the fitting and turns with it: the garment after an earlier step, in another size or fabric, or
// another garment. A size or fabric follows what is done to the garment. The board Fit owns it. GUI thread; what takes
// time is done on a thread of its own, from the garment as it was when it was asked for.
#include <QObject>
#include <QThreadPool>
#include <filesystem>
#include <functional>
#include <memory>
#include <variant>

#include "karinui/session/session.h"

class QMenu;

namespace karinui::studio {

class SpaceView;

class Beside : public QObject {
  Q_OBJECT
 public:
  // A step by its seq, a file, or a size or fabric as the operation that makes the garment so.
  using What = std::variant<std::monostate, std::uint64_t, std::filesystem::path, Operation>;
  struct Choice {
    What what;
    Message words;
  };
  Beside(Session& session, SpaceView& view, QObject* parent);
  ~Beside() override;  // nothing is under way when it returns

  // Nothing; the steps after which the garment hung at rest, the newest first; its sizes; fabrics. And what is shown,
  // where it is another file.
  std::vector<Choice> choices() const;
  void show(const Choice& choice);
  void askFile(QWidget* window);
  void fill(QMenu& menu, QWidget* window);  // with all of these
  void refresh();                           // the session has something new

  const What& what() const { return shown_.what; }
  const Message& words() const { return shown_.words; }
  const SnapshotPtr& fitting() const { return fitting_; }  // null: nothing is shown
  bool busy() const { return token_ != nullptr; }          // what was asked for last is not shown yet

 signals:
  void changed();

 private:
  std::vector<Choice> sizes() const;
  std::vector<Choice> fabrics() const;
  void ask();
  void work(std::function<Result<SnapshotPtr>(Bodies&, const Token&)> how);
  void take(const Result<SnapshotPtr>& found);
  void stop();

  Session& session_;
  SpaceView& view_;
  Choice shown_{{}, say("nothing")};
  SnapshotPtr fitting_;
  std::uint64_t askedFor_ = 0;    // SessionChanges::history
  std::filesystem::path of_;      // the document it is beside
  std::shared_ptr<Token> token_;  // of what is under way
  std::shared_ptr<Bodies> bodies_ = std::make_shared<Bodies>();
  QThreadPool thread_;
};

}  // namespace karinui::studio
