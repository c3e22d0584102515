#pragma once
// A choice of the built-in sizes: their names in words; the data of an item is the size as a script writes it.
#include <string>
#include <string_view>

#include "karinui/body/sizes.h"

class QComboBox;

namespace karinui::studio {

void addSizes(QComboBox& box);  // after what it has, a line between two series
void chooseSize(QComboBox& box, std::string_view size);
std::string chosenSize(const QComboBox& box);  // empty for an item that is no size

}  // namespace karinui::studio
