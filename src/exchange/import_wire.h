#pragma once
// What goes between the program and karinui-import: plain bytes, every length checked by whoever reads them.
//   to the child (descriptor 0):   for each file: u64 name length, name, u64 size, bytes; the body's file comes first
//   from the child (descriptor 1): Reply, then by kind
//     Mesh:   points x 3 doubles, faces x 3 u32
//     Needs:  points x (u64 length, bytes): names of side files; the child is started again with them
//     Picture: points x faces (width x height) pixels of three bytes, rows from the top
//     Refused: nothing; `reason` says why, `points` in which line of the file, or 0
#include <cstdint>

namespace karinui::wire {

inline constexpr std::uint64_t kMagic = 0x31304853454d4b4bull;

enum class Kind : std::uint32_t { Mesh = 1, Needs = 2, Refused = 3, Picture = 4 };
enum class Reason : std::uint32_t { None, Unreadable, NoSurface, TooLarge, Memory, TooDeep, Unsupported, Index, Cut };

struct Reply {
  std::uint64_t magic = kMagic;
  Kind kind = Kind::Refused;
  Reason reason = Reason::None;
  std::uint64_t points = 0, faces = 0;
};
static_assert(sizeof(Reply) == 32);

inline constexpr std::uint64_t kMostSideFiles = 64, kLongestName = 255;

}  // namespace karinui::wire
