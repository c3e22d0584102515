#pragma once
// A limb that is taken in hand: which joint a place of the skin hangs on, and how that joint turns so that the place
// follows a pointer. Pure functions; any thread. Metres, radians, the body's space.
#include <optional>

#include "karinui/body/skeleton.h"

namespace karinui {

// The joint that moves what one takes hold of: hand and upper arm go about the shoulder, foot and thigh about the hip,
// so that the whole limb swings; forearm and shin about elbow and knee; the head about the neck. None: the trunk.
std::optional<Joint> jointHolding(const Body& body, const SurfacePoint& place);

// `from` with this joint turned so that the place of the skin is as near to the ray as the joint lets it come. The
// place moves on a sphere about the joint (on an arc about a hinge); the turn about the bone is kept. Within the
// joint's limits. Starts where the joint is and goes downhill (Levenberg, 1944; Marquardt, 1963), so it stays on the
// side of the sphere on which the place was. `direction` is a unit vector.
BodyPose reaching(const Skeleton& skeleton, const BodyPose& from, Joint joint, const SurfacePoint& place, Vec3 origin,
                  Vec3 direction);

}  // namespace karinui
