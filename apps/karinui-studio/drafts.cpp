#include "drafts.h"

#include <QDate>
#include <QStandardPaths>

#include "karinui/body/sizes.h"

namespace karinui::studio {

std::filesystem::path documentsFolder() {
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  return std::filesystem::path(documents.toStdString()) / "Karinui";
}

std::filesystem::path draftsFolder() { return documentsFolder() / "Drafts"; }

std::string draftName(const std::string& about, Language language) {
  const std::string day = QDate::currentDate().toString(Qt::ISODate).toStdString();
  if (about.empty()) return text(say("Draft {0}", day), language);
  const auto sizes = builtInSizes();
  const bool size = std::find(sizes.begin(), sizes.end(), about) != sizes.end();
  const QString words = QString::fromStdString(about);
  return (size ? words.toUpper() : QString(words).replace('_', ' ')).toStdString() + " " + day;
}

}  // namespace karinui::studio
