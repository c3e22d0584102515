#pragma once
// The part of XML that drawings and measurement files use: elements with attributes, comments, character data, in any
// encoding (code_pages.h). A DOCTYPE is passed over: nothing that it names is opened, and no entity of a file's own is
// put in. At most 64 levels, each name closed by its own.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"

namespace karinui {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;  // entities resolved
  std::size_t depth = 0;                          // 0: the root
  std::string text = {};                          // before its first child; empty where that is damaged
  const std::string* find(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? nullptr : &found->second;
  }
};

// All elements in the order in which they begin.
Result<std::vector<XmlElement>> parseXml(std::string_view text);

}  // namespace karinui
