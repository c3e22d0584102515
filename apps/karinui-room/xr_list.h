#pragma once
// The lists of OpenXR.
#include <openxr/openxr.h>

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

}  // namespace karinui::room
