#include "design/figure_files.h"

#include <cstdlib>
#include <filesystem>

#include "design/pack.h"
#include "karinui/base/file.h"
#include "karinui/base/version.h"
#include "karinui/design/apply.h"

namespace karinui {

namespace {

// Empty: none are kept.
std::filesystem::path fileOf(std::string_view madeFrom) {
  const char* folder = std::getenv("KARINUI_FIGURES");
  if (!folder || !*folder) return {};
  return std::filesystem::path(folder) / (blobName(std::string(version()).append(madeFrom)) + ".figure");
}

}  // namespace

BodyPtr readFigureFile(std::string_view madeFrom) {
  const std::filesystem::path file = fileOf(madeFrom);
  std::error_code none;
  if (file.empty() || !std::filesystem::exists(file, none)) return nullptr;
  const Result<std::string> bytes = readFile(file);
  if (!bytes) return nullptr;
  Reader r(*bytes);
  const std::string seal = r.text(), packed = r.text();
  if (!r.finished() || seal != blobName(packed)) return nullptr;
  Result<BodyPtr> body = unpackFigure(packed);
  return body ? *std::move(body) : nullptr;
}

void writeFigureFile(std::string_view madeFrom, const Body& body) {
  const std::filesystem::path file = fileOf(madeFrom);
  if (file.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  const std::string packed = packFigure(body);
  Writer w;
  w.add(blobName(packed)).add(packed);
  static_cast<void>(writeFile(file, w.taken(), Readers::Owner));
}

}  // namespace karinui
