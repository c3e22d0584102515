#include "dxf_file.h"

#include <cmath>

#include "exchange/strict_json.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::size_t kLargest = std::size_t{64} << 20;  // bytes
constexpr std::size_t kMostEntities = 2'000'000;         // vertices among them
constexpr std::size_t kMostGroups = 200;                 // of one entity that is kept

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
}

// One line after the other, ended by LF, CR LF or CR.
class Lines {
 public:
  explicit Lines(std::string_view bytes) : rest_(bytes) {}
  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    const auto end = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, end);
    if (end == std::string_view::npos)
      rest_ = {};
    else
      rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
    ++count_;
    return line;
  }
  std::size_t count() const { return count_; }

 private:
  std::string_view rest_;
  std::size_t count_ = 0;
};

struct Group {
  int code = 0;
  std::string_view value;
  std::size_t line = 0;
};

class Groups {
 public:
  explicit Groups(std::string_view bytes) : lines_(bytes) {}
  // Nothing: the end.
  Result<std::optional<Group>> next() {
    std::optional<std::string_view> code;
    do {  // writers leave empty lines between groups
      code = lines_.next();
      if (!code) return std::optional<Group>();
    } while (trimmed(*code).empty());
    const auto number = parseNumber(trimmed(*code));
    if (!number || *number != std::floor(*number) || std::abs(*number) > 10000)
      return badInput(say("This is no DXF text: line {0} holds “{1}” where the code of a group should stand.",
                          lines_.count(), shown(trimmed(*code))));
    const auto value = lines_.next();
    if (!value) return badInput(say("The DXF file ends in the middle of a group, at line {0}.", lines_.count()));
    return std::optional(Group{static_cast<int>(*number), trimmed(*value), lines_.count()});
  }

 private:
  Lines lines_;
};

class FileReader {
 public:
  Result<DxfFile> read(std::string_view bytes) {
    Groups groups(bytes);
    for (;;) {
      const auto group = groups.next();
      if (!group) return group.error();
      if (!*group) return badInput(say("The DXF file ends without its last line, EOF; it is not whole."));
      if ((*group)->code != 0) {
        if (open_ && open_->groups.size() < kMostGroups) open_->groups.emplace_back((*group)->code, (*group)->value);
        continue;
      }
      close();
      if ((*group)->value == "EOF") return std::move(file_);
      if (++count_ > kMostEntities)
        return badInput(say("The DXF file holds more than {0} entities; that is no garment.", kMostEntities));
      open_ = DxfEntity{(*group)->value, (*group)->line, {}, {}};
    }
  }

 private:
  // The entity before, now that all its groups are known.
  void close() {
    if (!open_) return;
    DxfEntity entity = *std::move(open_);
    open_.reset();
    if (entity.type == "SECTION") return void(section_ = entity.text(2));
    if (entity.type == "ENDSEC") return void(section_ = {});
    if (entity.type == "BLOCK") {
      file_.blocks.push_back({entity.text(2), {}});
      return void(inBlock_ = section_ == "BLOCKS");
    }
    if (entity.type == "ENDBLK") return void(inBlock_ = false);
    if (section_ != "BLOCKS" && section_ != "ENTITIES") return;
    if (section_ == "BLOCKS" && !inBlock_) return;
    auto& into = inBlock_ ? file_.blocks.back().entities : file_.entities;
    if (entity.type == "VERTEX") {
      if (polyline_ && !into.empty())
        if (const auto place = entity.place()) into.back().vertices.push_back(*place);
      return;
    }
    if (entity.type == "SEQEND") return void(polyline_ = false);
    polyline_ = entity.type == "POLYLINE";
    if (entity.type == "LWPOLYLINE") {
      std::optional<double> x;
      for (const auto& [code, value] : entity.groups) {
        const auto number = parseNumber(value);
        if (code == 10) x = number;
        if (code == 20 && x && number) entity.vertices.push_back({*x, *number});
      }
    }
    into.push_back(std::move(entity));
  }

  DxfFile file_;
  std::optional<DxfEntity> open_;
  std::string_view section_;
  bool inBlock_ = false, polyline_ = false;
  std::size_t count_ = 0;
};

}  // namespace

std::string_view DxfEntity::text(int code) const {
  for (const auto& [c, value] : groups)
    if (c == code) return value;
  return {};
}

std::optional<double> DxfEntity::number(int code) const {
  const auto value = parseNumber(text(code));
  return value && std::abs(*value) < 1e9 ? value : std::nullopt;
}

std::optional<Flat> DxfEntity::place(int xCode) const {
  const auto x = number(xCode), y = number(xCode + 10);
  return x && y ? std::optional(Flat{*x, *y}) : std::nullopt;
}

int DxfEntity::layer() const {
  const auto value = parseNumber(text(8));
  return value && *value >= 0 && *value < 1000 ? static_cast<int>(*value) : -1;
}

Result<DxfFile> parseDxf(std::string_view bytes) {
  if (bytes.size() > kLargest) return badInput(say("The DXF file is larger than 64 MB; that is no garment."));
  return FileReader().read(bytes);
}

}  // namespace karinui
