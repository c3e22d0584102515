#include "design/document_parts.h"

#include <new>

#include "design/content.h"
#include "design/pack.h"

namespace karinui {

namespace {

std::string restedPart(std::size_t which, PieceId piece) {
  return "rested " + std::to_string(which) + "." + std::to_string(piece.value);
}

}  // namespace

Parts KeptParts::pack(const Document& document, const Bodies& bodies, std::map<std::string, std::string>& fresh) const {
  Parts parts;
  const auto put = [&](const std::string& part, std::shared_ptr<const void> thing, auto&& bytesOf) {
    const auto known = thing ? packed_.find(thing) : packed_.end();
    if (known != packed_.end()) return void(parts[part] = known->second);
    std::string bytes = bytesOf();
    const std::string name = blobName(bytes);
    fresh.emplace(name, std::move(bytes));
    parts[part] = name;
  };
  put("rest", nullptr, [&] { return packRest(document); });
  // The figure is kept so that nobody waits for it again. Where no figure was needed nothing is built for this.
  if (const auto known = figures_.find(document.body.ownHash()); known != figures_.end()) {
    parts["figure"] = known->second;
  } else if (const BodyPtr figure = bodies.known(document.body.ownHash())) {
    put("figure", nullptr, [&] { return packFigure(*figure); });
  }
  for (const auto& [id, piece] : document.pattern.pieces) {
    put("piece " + std::to_string(id.value), piece, [&p = piece] { return packPiece(*p); });
    if (piece->form) put("form " + std::to_string(id.value), piece->form, [&p = piece] { return packForm(*p->form); });
  }
  for (std::size_t k = 0; k < document.drape.rested.size(); ++k)
    for (const auto& [id, form] : document.drape.rested[k].forms)
      put(restedPart(k, id), form, [&f = form] { return packForm(*f); });
  return parts;
}

void KeptParts::remember(const Document& document, const Parts& parts) {
  try {
    if (const auto figure = parts.find("figure"); figure != parts.end())
      figures_.insert_or_assign(document.body.ownHash(), figure->second);
    for (const auto& [id, piece] : document.pattern.pieces) {
      packed_.insert_or_assign(piece, parts.at("piece " + std::to_string(id.value)));
      if (piece->form) packed_.insert_or_assign(piece->form, parts.at("form " + std::to_string(id.value)));
    }
    for (std::size_t k = 0; k < document.drape.rested.size(); ++k)
      for (const auto& [id, form] : document.drape.rested[k].forms)
        packed_.insert_or_assign(form, parts.at(restedPart(k, id)));
  } catch (const std::bad_alloc&) {  // the step is kept; these parts are written once more with the next
  }
}

void KeptParts::forget() {
  std::erase_if(packed_, [](const auto& part) { return part.first.use_count() == 1; });
}

const std::string* KeptParts::figure(const std::string& hash) const {
  const auto at = figures_.find(hash);
  return at == figures_.end() ? nullptr : &at->second;
}

std::optional<std::string> KeptDocuments::bytes(const Parts& parts, const std::string& part) const {
  const auto at = parts.find(part);
  auto bytes = at == parts.end() ? Result<std::string>(notFound({})) : store_.blob(at->second);
  return bytes ? std::optional(*std::move(bytes)) : std::nullopt;
}

// Null where it is missing or damaged.
std::shared_ptr<const Form> KeptDocuments::form(const Parts& parts, const std::string& part) {
  const auto at = parts.find(part);
  if (at == parts.end()) return nullptr;
  if (const auto known = forms_.find(at->second); known != forms_.end()) return known->second;
  const auto packed = bytes(parts, part);
  auto form = packed ? unpackForm(*packed) : Result<std::shared_ptr<const Form>>(notFound({}));
  return form ? forms_[at->second] = *form : nullptr;
}

std::shared_ptr<const Piece> KeptDocuments::piece(const Parts& parts, const std::string& part) {
  const std::string formPart = "form " + part.substr(part.find(' ') + 1);
  const auto formAt = parts.find(formPart);
  const std::string key = parts.at(part) + (formAt == parts.end() ? "" : " " + formAt->second);
  if (const auto known = pieces_.find(key); known != pieces_.end()) return known->second;
  const auto packed = bytes(parts, part);
  auto piece = packed ? unpackPiece(*packed) : Result<Piece>(notFound({}));
  if (!piece) return nullptr;
  if (formAt != parts.end() && !(piece->form = form(parts, formPart))) return nullptr;
  return pieces_[key] = std::make_shared<const Piece>(*std::move(piece));
}

std::optional<Document> KeptDocuments::readAny(const Parts& parts) {
  const auto rest = bytes(parts, "rest");
  auto document = rest ? unpackRest(*rest) : Result<Document>(notFound({}));
  if (!document) return std::nullopt;
  for (const auto& [part, blob] : parts) {
    if (!part.starts_with("piece ")) continue;
    const auto own = piece(parts, part);
    if (!own || part != "piece " + std::to_string(own->id.value)) return std::nullopt;
    document->pattern.pieces[own->id] = own;
  }
  for (std::size_t k = 0; k < document->drape.rested.size(); ++k)
    for (auto& [id, shape] : document->drape.rested[k].forms)
      if (!(shape = form(parts, restedPart(k, id)))) return std::nullopt;
  return soundContent(*document) ? std::optional(*std::move(document)) : std::nullopt;
}

std::optional<Document> KeptDocuments::read(const Step& step, const Parts& parts) {
  auto document = readAny(parts);
  const bool same = document && document->operations == step.serial && hash(*document) == step.after &&
                    drapeHash(*document) == step.stand;
  return same ? std::move(document) : std::nullopt;
}

void KeptDocuments::forget() {
  std::erase_if(pieces_, [](const auto& piece) { return piece.second.use_count() == 1; });
  std::erase_if(forms_, [](const auto& form) { return form.second.use_count() == 1; });
}

}  // namespace karinui
