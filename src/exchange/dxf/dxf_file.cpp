#include "dxf_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "exchange/strict_json.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::size_t kLargest = std::size_t{64} << 20;  // bytes
constexpr std::size_t kMostEntities = 2'000'000;         // vertices among them
constexpr std::size_t kMostGroups = 6'000'000;           // of all entities

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::toupper(static_cast<unsigned char>(x)) == std::toupper(static_cast<unsigned char>(y));
  });
}

// Programs of some countries write 12,5.
std::optional<double> numberOf(std::string_view text) {
  auto value = parseNumber(text);
  if (const auto comma = text.find(','); !value && comma != std::string_view::npos) {
    std::string point(text.substr(0, 60));
    if (comma < point.size()) point[comma] = '.';
    value = parseNumber(point);
  }
  return value && std::abs(*value) < 1e9 ? value : std::nullopt;
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
      if (!*group) {
        if (whole_ && open_ && open_->is("ENDSEC")) return std::move(file_);  // only EOF is left out
        return badInput(say("The DXF file ends without its last line, EOF; it is not whole."));
      }
      if ((*group)->code != 0) {
        if (!open_) continue;
        if (++groups_ > kMostGroups)
          return badInput(say("The DXF file holds more than {0} groups; that is no garment.", kMostGroups));
        open_->groups.emplace_back((*group)->code, (*group)->value);
        continue;
      }
      if (const Done closed = close(); !closed) return closed.error();
      if (same((*group)->value, "EOF")) return std::move(file_);
      if (++count_ > kMostEntities)
        return badInput(say("The DXF file holds more than {0} entities; that is no garment.", kMostEntities));
      open_ = DxfEntity{(*group)->value, (*group)->line, {}, {}};
    }
  }

 private:
  // The entity before, now that all its groups are known.
  Done close() {
    if (!open_) return {};
    DxfEntity entity = *std::move(open_);
    open_.reset();
    if (entity.is("SECTION")) {
      section_ = entity.text(2);
      if (same(section_, "HEADER")) header(entity);
      whole_ = whole_ || same(section_, "ENTITIES");
      return {};
    }
    if (entity.is("ENDSEC")) return section_ = {}, inBlock_ = polyline_ = false, Done();
    const bool blocks = same(section_, "BLOCKS");
    if (entity.is("BLOCK")) {
      if (const Done good = numeric(entity); !good) return good;
      file_.named.emplace(entity.text(2), file_.blocks.size());
      file_.blocks.push_back({entity.text(2), entity.place().value_or(Flat{}), {}});
      inBlock_ = blocks, polyline_ = false;
      return {};
    }
    if (entity.is("ENDBLK")) return inBlock_ = polyline_ = false, Done();
    if (blocks ? !inBlock_ : !same(section_, "ENTITIES")) return {};
    if (const Done good = numeric(entity); !good) return good;
    auto& into = inBlock_ ? file_.blocks.back().entities : file_.entities;
    if (entity.is("VERTEX")) {
      const auto place = entity.place();
      // Of a line that was made a spline both are kept: 16 is a control point beside the curve.
      if (polyline_ && !into.empty() && place && (entity.flags() & 16) == 0)
        into.back().vertices.push_back({*place, entity.number(42).value_or(0)});
      return {};
    }
    if (entity.is("SEQEND")) return polyline_ = false, Done();
    polyline_ = entity.is("POLYLINE");
    if (entity.is("LWPOLYLINE"))
      for (const auto& [code, value] : entity.groups) {
        const double number = numberOf(value).value_or(0);
        if (code == 10) entity.vertices.push_back({{number, 0}, 0});
        if (entity.vertices.empty()) continue;
        if (code == 20) entity.vertices.back().place.v = number;
        if (code == 42) entity.vertices.back().bulge = number;
      }
    into.push_back(std::move(entity));
    return {};
  }

  // A place that cannot be read would move the line if it were left out.
  static Done numeric(const DxfEntity& entity) {
    std::size_t line = entity.line;
    for (const auto& [code, value] : entity.groups) {
      line += 2;
      if (code >= 10 && code <= 29 && !numberOf(value))
        return badInput(
            say("Near line {0} of the DXF file “{1}” stands where a coordinate should.", line, shown(value)));
    }
    return {};
  }

  void header(const DxfEntity& section) {
    std::string_view variable;
    for (const auto& [code, value] : section.groups) {
      if (code == 9) variable = value;
      if (code == 70 && variable == "$INSUNITS") file_.unitCode = static_cast<int>(numberOf(value).value_or(0));
      if (code == 3 && variable == "$DWGCODEPAGE") file_.codePage = value;
    }
  }

  DxfFile file_;
  std::optional<DxfEntity> open_;
  std::string_view section_;
  bool inBlock_ = false, polyline_ = false, whole_ = false;
  std::size_t count_ = 0, groups_ = 0;
};

}  // namespace

bool DxfEntity::is(std::string_view name) const { return same(type, name); }

std::string_view DxfEntity::text(int code) const {
  for (const auto& [c, value] : groups)
    if (c == code) return value;
  return {};
}

std::optional<double> DxfEntity::number(int code) const { return numberOf(text(code)); }

std::vector<double> DxfEntity::numbers(int code) const {
  std::vector<double> all;
  for (const auto& [c, value] : groups)
    if (const auto number = c == code ? numberOf(value) : std::nullopt) all.push_back(*number);
  return all;
}

std::vector<Flat> DxfEntity::places(int xCode) const {
  std::vector<Flat> all;
  bool open = false;
  for (const auto& [c, value] : groups) {
    const double number = c == xCode || c == xCode + 10 ? numberOf(value).value_or(0) : 0;
    if (c == xCode) all.push_back({number, 0}), open = true;
    if (c == xCode + 10 && open) all.back().v = number, open = false;
  }
  return all;
}

std::optional<Flat> DxfEntity::place(int xCode) const {
  const auto x = number(xCode), y = number(xCode + 10);
  return x && y ? std::optional(Flat{*x, *y}) : std::nullopt;
}

const DxfBlock* DxfFile::block(std::string_view name) const {
  const auto found = named.find(name);
  return found == named.end() ? nullptr : &blocks[found->second];
}

int layerNumber(std::string_view name) {
  for (const std::string_view word : {"LAYER", "AAMA", "ASTM", "L"})
    if (same(name.substr(0, word.size()), word)) {
      name.remove_prefix(word.size());
      while (!name.empty() && (name[0] == ' ' || name[0] == '_' || name[0] == '-')) name.remove_prefix(1);
      break;
    }
  const auto value = parseNumber(name);
  return value && *value >= 0 && *value < 1000 ? static_cast<int>(*value) : -1;
}

Result<DxfFile> parseDxf(std::string_view bytes) {
  if (bytes.size() > kLargest) return badInput(say("The DXF file is larger than 64 MB; that is no garment."));
  if (bytes.starts_with("AutoCAD Binary DXF"))
    return badInput(say("This is a binary DXF. Write it anew as an ASCII DXF, release R12."));
  if (bytes.starts_with("AC10") || bytes.starts_with("AC1."))
    return badInput(say("This is a DWG drawing, not a DXF. Write it anew as an ASCII DXF, release R12."));
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // how some editors begin UTF-8
  return FileReader().read(bytes);
}

}  // namespace karinui
