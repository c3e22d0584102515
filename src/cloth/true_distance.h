#pragma once
// How far a place is from the body's mesh itself: dear, exact, the same for every collider made of a body.
#include "karinui/cloth/settle.h"

namespace karinui {

// Beyond three cells of the body's field the field's own answer is enough.
Collider::Contact trueContact(const Body& body, Vec3 place);
Vec3 truePassage(const Body& body, const std::array<Vec3, 3>& face);  // as Collider::passesThrough

}  // namespace karinui
