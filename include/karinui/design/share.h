#pragma once
// The pattern of a document for others: a new document that tells nothing of the person it was made for. In it are the
// pieces as they are now, flat and in a row, their sizes, seams, allowances, fabrics, looks and settings. Left out are
// the figure and its measurements, the shapes the cloth took on it, variables and formulas, pins, all steps and
// branches that led there, and every blob but the photographs that are printed on the cloth now.
// One thread; long where there are many pieces.
#include <filesystem>
#include <string>
#include <vector>

#include "karinui/design/history.h"

namespace karinui {

struct Shared {
  std::vector<std::string> names;  // that stay, of pieces, seams, fabrics, fastenings, sizes, lines, notches and edges:
                                   // people gave them, and others will read them. Empty: all are neutral
  std::vector<Message> notes;      // what is otherwise than in the document
};

// A maker needs to read which piece is the front: names stay, unless they are asked to be piece1, seam2, edge3.
enum class SharedNames { Kept, Neutral };

// The names that people gave in a pattern: each once, in the order above. Pure.
std::vector<std::string> namesIn(const Document& document);

// What was left out, and the names that stay.
Message sharedSaid(const Shared& shared);

// Writes it to `to`, all or nothing; a file that is there is replaced, but `from` itself is refused.
Result<Shared> share(DocumentFile& from, const std::filesystem::path& to, Context& context,
                     SharedNames names = SharedNames::Kept);

// The steps that make such a document, from nothing. Pure.
std::vector<Operation> sharedSteps(const Document& document);

}  // namespace karinui
