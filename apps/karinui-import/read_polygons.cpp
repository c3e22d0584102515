#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include "reader.h"

namespace karinui::import {
namespace {

// The library asks for materials and other files by any path it finds; here there are none.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

// Of a PLY's header without an end the library reads on for ever, until the cell's time is up.
bool headerEnds(const std::string& bytes) {
  constexpr std::string_view kEnd = "\nend_header";
  const std::size_t at = bytes.find(kEnd);
  return at != std::string::npos && at + kEnd.size() < bytes.size() &&
         std::string_view(" \t\r\n").find(bytes[at + kEnd.size()]) != std::string_view::npos;
}

}  // namespace

Reading readPolygons(const std::string& bytes, const std::string& format, const Limits& limits) {
  if (format == "ply" && !headerEnds(bytes)) return {wire::Reason::Unreadable, {}, {}};
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // owned by the importer
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, format.c_str());
  Reading reading;
  if (!scene) return {wire::Reason::Unreadable, {}, {}};
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const std::uint64_t base = reading.mesh.points.size();
    if (base + part.mNumVertices > limits.points || reading.mesh.faces.size() + part.mNumFaces > limits.triangles)
      return {wire::Reason::TooLarge, {}, {}};
    if (!part.mVertices || !part.mFaces) continue;
    for (unsigned i = 0; i < part.mNumVertices; ++i)
      reading.mesh.points.push_back({part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z});
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      Triangle t;
      for (int k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= part.mNumVertices) return {wire::Reason::Unreadable, {}, {}};
        t[k] = static_cast<std::uint32_t>(base + face.mIndices[k]);
      }
      reading.mesh.faces.push_back(t);
    }
  }
  if (reading.mesh.faces.empty()) reading.refused = wire::Reason::NoSurface;
  return reading;
}

}  // namespace karinui::import
