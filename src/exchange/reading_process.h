#pragma once
// Runs karinui-import over one file and brings back a mesh that has been checked: finite, indices in range, within
// limits.
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "karinui/design/print_image.h"
#include "karinui/exchange/read_body.h"

namespace karinui {

// format: "obj", "ply", "gltf" or "glb".
Result<TriangleMesh> readInOtherProcess(const std::filesystem::path& path, const std::string& format,
                                        const std::filesystem::path& helper, const BodyReadLimits& limits,
                                        const Token& token);

// The pixels of a photograph, so many at the most.
Result<PrintPixels> readPictureInOtherProcess(const std::filesystem::path& path, const std::filesystem::path& helper,
                                              std::size_t mostPixels, const Token& token);

// What karinui-import said. It has read a stranger's bytes, so nothing it says is believed unseen.
// A mesh: finite, indices in range, within limits. Or names of files beside the body's, without folders.
using MeshReply = std::variant<TriangleMesh, std::vector<std::string>>;
Result<MeshReply> meshReply(std::string_view said, const BodyReadLimits& limits);
Result<PrintPixels> pictureReply(std::string_view said, std::size_t mostPixels);

// What readBody() makes of a mesh that was read.
Result<ImportedBody> importedBody(const TriangleMesh& read, const std::string& format, const BodyReadOptions& options,
                                  Workers& workers, const Token& token);

// karinui-import: as asked for, else beside the running program.
Result<std::filesystem::path> importHelper(const std::filesystem::path& asked);

// The first limit.fileBytes of a plain file, or why not.
Result<std::string> readPlainFile(const std::filesystem::path& path, std::size_t atMost, bool followLinks);

}  // namespace karinui
