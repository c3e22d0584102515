#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <charconv>
#include <string_view>
#include <vector>

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

// What is wrong with an OBJ and in which line, which the library does not tell: it says only that it is wrong, or
// leaves out what was cut off.
class ObjLines {
 public:
  explicit ObjLines(std::string_view bytes) {
    for (std::string_view rest = bytes; !rest.empty() && wrong_ == wire::Reason::None;) {
      const std::size_t end = rest.find('\n');
      ++line_;
      take(rest.substr(0, end), end == std::string_view::npos);
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    for (const auto& [index, line] : ahead_)
      if (wrong_ == wire::Reason::None && index > points_) wrong_ = wire::Reason::Index, line_ = line;
  }
  wire::Reason wrong() const { return wrong_; }  // None: nothing
  std::uint64_t line() const { return line_; }   // where it is, else the last one
  bool anyFace() const { return faces_; }

 private:
  static std::string_view word(std::string_view& rest) {
    constexpr std::string_view kBlank = " \t\r";
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size()));
    const std::string_view first = rest.substr(0, rest.find_first_of(kBlank));
    rest.remove_prefix(first.size());
    return first;
  }
  void take(std::string_view line, bool last) {
    const std::string_view kind = word(line);
    if (kind != "v" && kind != "f") return;
    std::size_t words = 0;
    bool goesOn = false;  // on the next line
    for (std::string_view one = word(line); !one.empty(); one = word(line), ++words) {
      if (one.front() == '#') break;
      goesOn = one == "\\";
      if (kind == "f" && !goesOn && !point(one)) wrong_ = wire::Reason::Index;
    }
    if (kind == "v") ++points_;
    faces_ = faces_ || kind == "f";
    if (last && words < 3 && !goesOn) wrong_ = wire::Reason::Cut;
  }
  // Counted from 1, or back from the newest; "12/3/4" begins with it.
  bool point(std::string_view corner) {
    long long index = 0;
    const auto [end, trouble] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
    if (trouble != std::errc() || index == 0) return false;
    if (index < 0) return static_cast<std::uint64_t>(-(index + 1)) < points_;
    if (static_cast<std::uint64_t>(index) > points_ && ahead_.size() < kMostAhead)
      ahead_.emplace_back(static_cast<std::uint64_t>(index), line_);  // may still come
    return true;
  }

  static constexpr std::size_t kMostAhead = 100'000;
  std::uint64_t line_ = 0, points_ = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ahead_;
  bool faces_ = false;
  wire::Reason wrong_ = wire::Reason::None;
};

}  // namespace

Reading readPolygons(const std::string& bytes, const std::string& format, const Limits& limits) {
  if (format == "ply" && !headerEnds(bytes)) return {wire::Reason::Unreadable, {}, {}};
  std::uint64_t pointsOnly = 0;  // of an OBJ without faces: its last line
  if (format == "obj") {
    const ObjLines lines(bytes);
    if (lines.wrong() != wire::Reason::None) return {lines.wrong(), {}, {}, lines.line()};
    if (!lines.anyFace()) pointsOnly = lines.line();
  }
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // owned by the importer
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, format.c_str());
  Reading reading;
  if (!scene && pointsOnly > 0) return {wire::Reason::NoSurface, {}, {}, pointsOnly};
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
  if (reading.mesh.faces.empty()) reading.refused = wire::Reason::NoSurface, reading.line = pointsOnly;
  return reading;
}

}  // namespace karinui::import
