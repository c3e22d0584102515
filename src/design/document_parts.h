#pragma once
// A document taken apart into the blobs that the file keeps beside a step, and put together again.
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "design/file/store.h"
#include "karinui/design/history.h"

namespace karinui {

// Knows which parts are in the file already, so that a step costs what it changed. One owner, one thread at a time.
class KeptParts {
 public:
  // Only what the file does not have yet comes into `fresh`, by its blob's name.
  Parts pack(const Document& document, const Bodies& bodies, std::map<std::string, std::string>& fresh) const;
  void remember(const Document& document, const Parts& parts);  // they are in the file now; as far as there is memory
  void forget();                                                // those that no document holds any more
  const std::string* figure(const std::string& hash) const;     // its blob; null: not in the file
  void lost(const std::string& figure) { figures_.erase(figure); }

 private:
  // Holding the part keeps its address from being used again.
  std::map<std::shared_ptr<const void>, std::string> packed_;
  std::map<std::string, std::string> figures_;  // by Body::hash()
};

// Reads the documents kept beside steps. Pieces and forms that documents share are read once. It must not outlive the
// store.
class KeptDocuments {
 public:
  explicit KeptDocuments(const Store& store) : store_(store) {}
  // Nothing if it is not whole, not sound, or does not match the step's hashes.
  std::optional<Document> read(const Step& step, const Parts& parts);
  // Nothing if it is not whole or not sound; of whatever step it was kept.
  std::optional<Document> readAny(const Parts& parts);
  void forget();  // what no document holds any more

 private:
  std::optional<std::string> bytes(const Parts& parts, const std::string& part) const;
  std::shared_ptr<const Form> form(const Parts& parts, const std::string& part);
  std::shared_ptr<const Piece> piece(const Parts& parts, const std::string& part);

  const Store& store_;
  std::map<std::string, std::shared_ptr<const Form>> forms_;    // by blob
  std::map<std::string, std::shared_ptr<const Piece>> pieces_;  // by the blobs of piece and form
};

}  // namespace karinui
