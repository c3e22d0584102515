#include "bench/foreign.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "karinui/base/file.h"

namespace karinui::bench {
namespace {

std::vector<Vec3> pointsOf(const std::string& obj) {
  std::vector<Vec3> points;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("v ")) continue;
    char* end = line.data() + 2;
    Vec3 p;
    for (double* part : {&p.x, &p.y, &p.z}) *part = std::strtod(end, &end);  // reads nan and inf as well
    points.push_back(p);
  }
  return points;
}

Vec3 centreOf(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3 p : points) sum += p;
  return sum * (1.0 / static_cast<double>(points.size()));
}

}  // namespace

Result<std::string> startOf(const Workload& load) {
  const auto* capsules = dynamic_cast<const Capsules*>(load.collider.get());
  if (!capsules) return badInput(say("This scene has a body of its own and is not written for other programs."));
  const ClothLevel& finest = load.levels.back();
  const Fabric& fabric = finest.cloth.pieces.front().fabric;
  using Json = nlohmann::json;
  const auto place = [](Vec3 p) { return Json{p.x, p.y, p.z}; };
  Json scene = {{"scene", load.name},
                {"weight", fabric.weight},
                {"friction", fabric.frictionBody},
                {"pinned", finest.cloth.pinned},
                {"points", Json::array()},
                {"faces", Json::array()},
                {"seams", Json::array()},
                {"capsules", Json::array()}};
  for (const Vec3 p : finest.state.position) scene["points"].push_back(place(p));
  for (const ClothPiece& piece : finest.cloth.pieces)
    for (const Triangle& f : piece.lattice->faces)
      scene["faces"].push_back({piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]});
  for (const Tie& tie : finest.cloth.ties) scene["seams"].push_back({tie.a, tie.b});
  for (const Capsules::Capsule& c : capsules->all())
    scene["capsules"].push_back({{"a", place(c.a)}, {"b", place(c.b)}, {"radius", c.radius}});
  return scene.dump() + "\n";
}

Result<Judged> judge(Workload& load, const std::vector<std::filesystem::path>& frames) {
  Judged judged;
  std::vector<Vec3> first, before;
  for (const auto& file : frames) {
    const auto obj = readFile(file);
    if (!obj) return obj.error();
    std::vector<Vec3>& points = load.levels.back().state.position;
    points = pointsOf(*obj);
    const std::size_t wanted = load.levels.back().cloth.nodeCount;
    if (points.size() != wanted)
      return badInput(
          say("\"{0}\" has {1} {1|point|points}, the scene {2}. Give the scene's own points in their order.",
              file.string(), points.size(), wanted));
    for (std::size_t k = 0; k < before.size(); ++k)
      judged.topSpeed = std::fmax(judged.topSpeed, distance(points[k], before[k]) * 60);
    before = points;
    if (first.empty()) first = points;
  }
  judged.found = examine(load);
  judged.height = centreOf(before).y;
  judged.drift = distance(centreOf(before), centreOf(first));
  return judged;
}

}  // namespace karinui::bench
