#include "file_filter.h"

#include <QFileDialog>
#include <QFileInfo>

namespace karinui::studio {

namespace {

QString patterns(const std::vector<std::string>& endings) {
  QStringList all;
  for (const std::string& ending : endings) all << "*." + QString::fromStdString(ending);
  return all.join(' ');
}

}  // namespace

QString filterReading(const QString& words, FileContents contents) {
  return words + " (" + patterns(endingsRead(contents)) + ")";
}

QString filterWriting(const FileFormat& format) {
  return patterns(std::vector<std::string>(format.endings.begin(), format.endings.end()));
}

QStringList endingsOf(const FileFormat& format) {
  QStringList all;
  for (const std::string_view ending : format.endings)
    all << QString::fromUtf8(ending.data(), static_cast<qsizetype>(ending.size()));
  return all;
}

QString withEnding(const QString& path, const FileFormat& format) {
  return QString::fromStdString(karinui::withEnding(path.toStdString(), format).string());
}

QString askToWrite(QWidget* window, const QString& title, const QString& proposed, const QString& filter,
                   const QStringList& endings) {
  QFileDialog dialog(window, title, QFileInfo(proposed).path(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(endings.front());
  dialog.selectFile(proposed);
  for (;;) {
    if (dialog.exec() != QDialog::Accepted) return {};
    const QString path = dialog.selectedFiles().value(0);
    if (path.isEmpty() || endings.contains(QFileInfo(path).suffix(), Qt::CaseInsensitive)) return path;
    const QString whole = path + "." + endings.front();
    if (!QFileInfo::exists(whole)) return whole;
    dialog.selectFile(whole);  // to be said once more: then it is asked about
  }
}

}  // namespace karinui::studio
