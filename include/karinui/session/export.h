#pragma once
// The garment of a session written as any of exportFormats(). Pure; any thread.
#include <vector>

#include "karinui/design/history.h"
#include "karinui/exchange/formats.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

struct ExportWish {
  const FileFormat* format = &fileFormat("pdf-a4");  // of exportFormats(); never null
  SheetSettings sheet;                               // of paper: title, allowance, language
};
// The garment as shapes for other programs, as it is drawn: colours, prints and all.
SpatialGarment spatialOf(const Document& document, const SceneFrame& frame);
Result<std::string> exported(const GarmentSnapshot& snapshot, const std::vector<Step>& steps, const ExportWish& wish);
// The same as a file, with those that stand beside it; how many bytes it has.
Result<std::size_t> exportedTo(const std::filesystem::path& file, const GarmentSnapshot& snapshot,
                               const std::vector<Step>& steps, const ExportWish& wish);
// The paper of a wish for a sheet.
Result<PaperPages> paperOf(const GarmentSnapshot& snapshot, const ExportWish& wish);

}  // namespace karinui
