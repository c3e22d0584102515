#pragma once
// Small pictures of documents for lists. A document is read on a second thread and drawn on the GUI thread; its picture
// is kept in the cache folder as long as the file does not change. GUI thread.
#include <QImage>
#include <QObject>
#include <QStringList>
#include <QThreadPool>
#include <memory>

#include "karinui/base/token.h"
#include "karinui/scene/scene_frame.h"

class QOffscreenSurface;
class QOpenGLContext;

namespace karinui::studio {

class ThumbnailRenderer;

class Thumbnails : public QObject {
  Q_OBJECT
 public:
  explicit Thumbnails(QSize pixels);
  ~Thumbnails() override;

  // Makes the pictures of these documents, in this order, instead of what was wanted before.
  void want(const QStringList& paths);
  void stop();  // no document is being read when it returns
  bool busy() const { return waiting_ > 0; }

 signals:
  // `steps`: 0 of a document in which nothing was done, -1 of one that cannot be read now. Then the picture is null.
  void made(const QString& path, const QImage& picture, int steps);

 private:
  void draw(const QString& path, const SceneFrame& frame, int steps);
  QString cached(const QString& path) const;  // the file of its picture, by path, size and time of change
  QSize pixels_;
  QThreadPool reader_;
  std::shared_ptr<Token> token_;
  int waiting_ = 0;
  std::unique_ptr<QOffscreenSurface> surface_;
  std::unique_ptr<QOpenGLContext> context_;
  std::unique_ptr<ThumbnailRenderer> thumbnailRenderer_;
};

}  // namespace karinui::studio
