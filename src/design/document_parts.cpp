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

std::optional<Document> unpackedDocument(const Store& store, const Step& s, const Parts& parts) {
  const auto bytesOf = [&](const std::string& part) {
    const auto at = parts.find(part);
    auto bytes = at == parts.end() ? Result<std::string>(notFound({})) : store.blob(at->second);
    return bytes ? std::optional(*std::move(bytes)) : std::nullopt;
  };
  const auto rest = bytesOf("rest");
  auto document = rest ? unpackRest(*rest) : Result<Document>(notFound({}));
  if (!document) return std::nullopt;
  for (const auto& [part, blob] : parts) {
    if (!part.starts_with("piece ")) continue;
    const auto bytes = bytesOf(part);
    auto piece = bytes ? unpackPiece(*bytes) : Result<Piece>(notFound({}));
    if (!piece || part != "piece " + std::to_string(piece->id.value)) return std::nullopt;
    if (const auto form = "form " + std::to_string(piece->id.value); parts.contains(form)) {
      const auto formBytes = bytesOf(form);
      auto shape = formBytes ? unpackForm(*formBytes) : Result<std::shared_ptr<const Form>>(notFound({}));
      if (!shape) return std::nullopt;
      piece->form = *shape;
    }
    document->pattern.pieces[piece->id] = std::make_shared<const Piece>(*piece);
  }
  for (std::size_t k = 0; k < document->drape.rested.size(); ++k)
    for (auto& [id, form] : document->drape.rested[k].forms) {
      const auto bytes = bytesOf(restedPart(k, id));
      auto shape = bytes ? unpackForm(*bytes) : Result<std::shared_ptr<const Form>>(notFound({}));
      if (!shape) return std::nullopt;
      form = *shape;
    }
  if (document->operations != s.serial || hash(*document) != s.after || drapeHash(*document) != s.stand ||
      !soundContent(*document))
    return std::nullopt;
  return *document;
}

}  // namespace karinui
