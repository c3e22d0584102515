#include "drafts.h"

#include <QDate>
#include <QStandardPaths>

#include <algorithm>

#include "karinui/body/sizes.h"
#include "karinui/design/glossary.h"

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
  if (std::find(sizes.begin(), sizes.end(), about) != sizes.end())
    if (const auto size = termSaid(Term::Size, about)) return text(*size, language) + " " + day;
  return QString::fromStdString(about).replace('_', ' ').toStdString() + " " + day;
}

std::string garmentName(const Document& made, const Operation& by, Language language) {
  const auto* block = std::get_if<DraftBlock>(&static_cast<const PlainOperation&>(by));
  if (!block) return {};
  using Kind = DraftBlock::Kind;
  static constexpr std::pair<Kind, const char*> kinds[] = {
      {Kind::Shirt, "shirt"}, {Kind::Bodice, "bodice"},     {Kind::Sleeve, "sleeve"},    {Kind::Collar, "collar"},
      {Kind::Skirt, "skirt"}, {Kind::Trousers, "trousers"}, {Kind::Leggings, "leggings"}};
  const auto kind =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return k.first == block->kind; });
  const Message garment = *termSaid(Term::Value, kind->second);
  const BodyChoice& body = made.body;
  const auto plain = builtInSize(body.size);
  const auto size = plain && *plain == body.measurements ? termSaid(Term::Size, body.size) : std::nullopt;
  return text(size                ? say("{0} {1}", garment, *size)
              : body.mesh.empty() ? say("{0} to measure", garment)
                                  : garment,
              language);
}

}  // namespace karinui::studio
