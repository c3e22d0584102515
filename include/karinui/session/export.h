#pragma once
// Everything a garment can be written as, told once: what a dialog offers, what a file's ending means, the bytes.
// Pure; any thread.
#include <filesystem>
#include <span>
#include <vector>

#include "karinui/design/history.h"
#include "karinui/exchange/sheet.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

enum class ExportKind { PdfSheet, PdfA4, Svg, Glb, Obj, Json, GarmentCode, Steps };
struct ExportInfo {
  ExportKind kind;
  std::string_view ending;  // "pdf"
  Message label, about;     // a few words; whom it is for
  enum class Shows { Paper, Space, Text } shows;
};
std::span<const ExportInfo> exportKinds();
const ExportInfo& info(ExportKind kind);

struct ExportWish {
  ExportKind kind = ExportKind::PdfA4;
  SheetSettings sheet;  // of paper: title, allowance, language
};
Result<std::string> exported(const GarmentSnapshot& snapshot, const std::vector<Step>& steps, const ExportWish& wish);
// The paper of a wish whose kind shows paper.
Result<PaperPages> paperOf(const GarmentSnapshot& snapshot, const ExportWish& wish);

}  // namespace karinui
