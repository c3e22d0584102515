#include <algorithm>
#include <cmath>

#include "bench/workload.h"
#include "karinui/base/file.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/exchange/read_body.h"

namespace karinui::bench {
namespace {

constexpr double kUsualSpacing = 0.01;  // metres

double areaOf(const Pattern& pattern) {
  double area = 0;
  for (const auto& [id, piece] : pattern.pieces) area += std::fabs(piece->outline.area());
  return area;
}

Result<ClothLevel> levelOf(const Pattern& pattern, double spacing) {
  const auto laid = lay(pattern, spacing);
  if (!laid) return laid.error();
  auto cloth = assemble(pattern, *laid, {}, {});
  if (!cloth) return cloth.error();
  ClothState state = standing(pattern, *cloth);
  return ClothLevel{std::move(*cloth), std::move(state)};
}

}  // namespace

Result<Workload> garment(std::string name, const GarmentFiles& files, std::size_t vertices, Workers& workers,
                         const Token& token) {
  const auto text = readFile(files.pattern.string());
  if (!text) return text.error();
  const auto pattern = readGarmentCode(*text);
  if (!pattern) return pattern.error();
  auto read = readBody(files.body, {}, workers, token);
  if (!read) return read.error();
  Body::Parts parts;
  parts.name = files.body.stem().string();
  parts.mesh = std::move(read->mesh);
  const auto body = Body::make(std::move(parts));
  if (!body) return body.error();
  if (const Done ready = (*body)->prepareField(workers, token); !ready) return ready.error();
  const double spacing = vertices == 0 ? kUsualSpacing : std::sqrt(areaOf(*pattern) / static_cast<double>(vertices));
  Workload load{std::move(name), {}, fieldCollider(*body), *body};
  for (const double coarser : {4.0, 2.0, 1.0}) {
    auto level = levelOf(*pattern, coarser * spacing);
    if (level)
      load.levels.push_back(std::move(*level));
    else if (coarser == 1.0)
      return level.error();
  }
  return load;
}

}  // namespace karinui::bench
