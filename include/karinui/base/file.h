#pragma once
// Whole files, safely. A write is all or nothing: the bytes go to a new file beside the target, are forced to the disk
// and only then take the target's name, so a crash or a full disk leaves the old file as it was. Any thread.
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

inline constexpr std::size_t kLargestFile = std::size_t{256} << 20;  // bytes read at most, unless told otherwise

// Refuses what is not a plain file, cannot be read or is larger than `most` bytes.
Result<std::string> readFile(const std::filesystem::path& path, std::size_t most = kLargestFile);

// The name of a file within a folder, not of one elsewhere: what a stranger's file may name what is written for it.
inline bool isPlainName(std::string_view name) {
  return !name.empty() && name.size() <= 200 && name.front() != '.' &&
         name.find_first_of(std::string_view("/\\\0", 3)) == std::string_view::npos;
}

// Who may read a file that is new: everyone (0644), or the person alone, for what tells a body's measures.
// One that is there keeps its permissions.
enum class Readers { Usual, Owner };

// Refuses with Error::Kind::Storage, saying why and what to do; then nothing was changed.
Done writeFile(const std::filesystem::path& path, std::string_view bytes, Readers readers = Readers::Usual);

// The error with the file it is about named first; that the person stopped is no file's fault.
Error inFile(const std::filesystem::path& file, Error error);

}  // namespace karinui
