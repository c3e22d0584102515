#include "thumbnails.h"

#include <QCryptographicHash>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QStandardPaths>

#include "karinui/design/history.h"
#include "karinui/session/scene_of.h"
#include "thumbnail_renderer.h"

namespace karinui::studio {

namespace {

// The garment as it stands in the file, and how many steps were done in it, -1: it cannot be read.
std::pair<SceneFrame, int> lookInto(const std::filesystem::path& path, const Token& token) {
  Workers one(1);
  MemoryBlobs none;
  Bodies bodies;
  Context how{one, token, none, bodies, {}, {}};
  auto file = DocumentFile::openForReading(path, &how);
  if (!file) return {{}, -1};
  const int steps = static_cast<int>(file->steps().size() + file->undone().size());
  Context own{one, token, file->blobs(), bodies, {}, {}};
  BodyPtr body;
  if (file->document().body.chosen())
    if (auto found = bodyOf(file->document(), own)) body = *found;
  const Result<SceneFrame> frame = sceneOf(file->document(), body.get());
  if (!frame) return {{}, -1};
  return {*frame, steps};
}

}  // namespace

Thumbnails::Thumbnails(QSize pixels) : pixels_(pixels) { reader_.setMaxThreadCount(1); }

Thumbnails::~Thumbnails() {
  stop();
  if (context_ && context_->makeCurrent(surface_.get())) {
    thumbnailRenderer_.reset();
    context_->doneCurrent();
  }
}

QString Thumbnails::cached(const QString& path) const {
  const QFileInfo file(path);
  const QByteArray which = (file.absoluteFilePath() + QString("|%1|%2|%3x%4")
                                                          .arg(file.size())
                                                          .arg(file.lastModified().toMSecsSinceEpoch())
                                                          .arg(pixels_.width())
                                                          .arg(pixels_.height()))
                               .toUtf8();
  const QString name = QString::fromLatin1(QCryptographicHash::hash(which, QCryptographicHash::Sha1).toHex());
  return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + "/thumbnails/" + name + ".png";
}

void Thumbnails::stop() {
  if (token_) token_->cancel();
  reader_.clear();
  reader_.waitForDone();
  waiting_ = 0;
}

void Thumbnails::want(const QStringList& paths) {
  stop();
  token_ = std::make_shared<Token>();
  QStringList missing;
  for (const QString& path : paths)
    if (const QImage kept(cached(path)); !kept.isNull())
      emit made(path, kept, 1);
    else
      missing << path;
  waiting_ = static_cast<int>(missing.size());
  for (const QString& path : missing)
    reader_.start([this, path, token = token_] {
      if (token->cancelled()) return;
      auto [frame, steps] = lookInto(path.toStdString(), *token);
      QMetaObject::invokeMethod(
          this,
          [this, path, token, frame = std::move(frame), steps = steps] {
            if (token->cancelled()) return;
            --waiting_;
            draw(path, frame, steps);
          },
          Qt::QueuedConnection);
    });
}

void Thumbnails::draw(const QString& path, const SceneFrame& frame, int steps) {
  if (steps <= 0) return emit made(path, {}, steps);
  if (!context_) {
    surface_ = std::make_unique<QOffscreenSurface>();
    surface_->create();
    context_ = std::make_unique<QOpenGLContext>();
    if (!context_->create()) return emit made(path, {}, steps);
  }
  if (!context_->makeCurrent(surface_.get())) return emit made(path, {}, steps);
  if (!thumbnailRenderer_) thumbnailRenderer_ = std::make_unique<ThumbnailRenderer>();
  const QImage picture = thumbnailRenderer_->of(frame, pixels_);
  context_->doneCurrent();
  const QString file = cached(path);
  QDir().mkpath(QFileInfo(file).absolutePath());
  picture.save(file);
  emit made(path, picture, steps);
}

}  // namespace karinui::studio
