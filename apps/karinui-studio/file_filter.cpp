#include "file_filter.h"

#include <QStringList>

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

QString withEnding(const QString& path, const FileFormat& format) {
  return QString::fromStdString(karinui::withEnding(path.toStdString(), format).string());
}

}  // namespace karinui::studio
