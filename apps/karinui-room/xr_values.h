#pragma once
// Lists and names as OpenXR's calls take and give them.
#include <openxr/openxr.h>

#include <cstring>
#include <vector>

namespace karinui::room {

// Asks for the count, then for the items, each of which begins as `like`. Empty where a call fails.
template <class Item, class Call>
XrResult list(std::vector<Item>& items, const Item& like, Call&& call) {
  std::uint32_t count = 0;
  if (const XrResult r = call(0, &count, static_cast<Item*>(nullptr)); XR_FAILED(r)) return r;
  items.assign(count, like);
  if (count == 0) return XR_SUCCESS;
  const XrResult r = call(count, &count, items.data());
  items.resize(XR_FAILED(r) ? 0 : count);
  return r;
}

// Into a struct's array; what is too long is cut off.
template <std::size_t Size>
void putText(char (&into)[Size], const char* text) {
  std::strncpy(into, text, Size - 1);
  into[Size - 1] = 0;
}

}  // namespace karinui::room
