#include "body/anthropometry/anthropometry.h"
#include "karinui/body/body.h"

namespace karinui {

Measurements measure(const TriangleMesh& mesh, const Bvh&) {
  Measurements out;
  const Anthropometry measured = anthropometryOf(mesh);
  out.value = measured.value;
  // A mannequin made to these measures draws an ordinary front by itself.
  if (!measured.belly)
    for (const char* key : {"belly_girth", "belly_height"}) out.value.erase(key);
  const auto bust = out.value.find("bust_girth"), under = out.value.find("under_bust_girth");
  if (bust != out.value.end() && under != out.value.end())
    out.sex = (bust->second - under->second) / out.value["height"] > 0.055 ? Sex::Female : Sex::Male;
  return out;
}

}  // namespace karinui
