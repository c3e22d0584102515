#pragma once
// A paper pattern from elsewhere as the operations that make it here, for importers. Pure; any thread.
#include <map>
#include <string>
#include <vector>

#include "karinui/design/apply.h"

namespace karinui {

// What a file tells of pieces beside their paper, by the pattern's ids.
struct CuttingNotes {
  std::map<PieceId, Cutting> quantities;
  Allowances allowances;  // widths of edges
};
SetFabric stepOf(const Fabric& fabric);  // gives a fabric of this name all its values

// Fabrics that the pattern names and that neither the shop nor `into` knows. A pattern tells no more of them.
std::vector<std::string> unknownFabrics(const Pattern& pattern, const Document& into);
// To the person, for each of them.
std::vector<Message> unknownFabricsSaid(const Pattern& pattern, const Document& into,
                                        const std::map<std::string, Fabric>& told = {});

// The fabrics that are not known, each with the values that are `told` of it, else like the usual one; each piece under
// a usable name that is free in `into` and among themselves, then its sizes where `into` has none, then each seam, how
// often pieces are cut and how wide their allowances are. `grading`: its size that stands is the base. `bent`: where
// the pieces' forms are put, which are left out without it.
std::vector<Operation> stepsOf(const Pattern& pattern, const Document& into, const Grading& grading = {},
                               const CuttingNotes& cutting = {}, Blobs* bent = nullptr,
                               const std::map<std::string, Fabric>& told = {});

}  // namespace karinui
