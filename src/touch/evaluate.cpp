#include "karinui/touch/evaluate.h"

#include <algorithm>

namespace karinui {

namespace {

// What pulls, and the energy it holds.
Vec3 pullForce(const Grab& grab, PullLaw law, Vec3 device, double steepest, double& stored) {
  switch (law) {
    case PullLaw::None:
      break;
    case PullLaw::Springs: {
      // Springs beside each other add up: together they are no stiffer than the device allows.
      const double sum = grab.springStiffness * static_cast<double>(grab.neighbours.size());
      const double stiffness = sum > steepest ? grab.springStiffness * steepest / sum : grab.springStiffness;
      Vec3 force;
      for (const Grab::Neighbour& one : grab.neighbours) {
        force += springTension(device, one.place, one.natural, stiffness);
        const double longer = std::max(0.0, distance(device, one.place) - one.natural);
        stored += stiffness * longer * longer / 2;
      }
      return force;
    }
    case PullLaw::Curve: {
      const Vec3 way = grab.anchor - device;
      const double longer = length(way) - grab.natural;
      if (!(longer > 0)) break;
      stored += storedEnergy(grab.curve, longer, steepest);
      return normalized(way) * tension(grab.curve, longer, steepest);
    }
    case PullLaw::Tangent: {
      const Vec3 step = device - grab.place;
      const double size = grab.stiffness.size();
      Vec3 change = grab.stiffness * step * (size > steepest ? steepest / size : 1.0);
      if (dot(change, step) < 0) change = {};  // no spring
      const Vec3 force = grab.force - change;
      const double stiff = std::min(size, steepest);
      if (stiff > 0) stored += squaredLength(force) / (2 * stiff);
      return force;
    }
  }
  return {};
}

}  // namespace

TouchForces TouchEvaluator::evaluate(const TouchScene& scene, const DeviceRecord& record, const TouchLaws& laws,
                                     Vec3 device, Vec3 velocity) {
  TouchForces forces;
  const double stiffness = std::min(scene.stiffness, record.stiffness);
  const double damping = std::min(scene.damping, record.damping);
  forces.known = scene.facets.empty() || distance(device, scene.centre) <= scene.radius;
  const Proxy::Contact contact = proxy_.follow(device, scene, laws.friction ? scene.friction : 0.0);
  forces.proxy = contact.proxy;
  if (laws.weight && scene.carriedMass > 0) forces.weight = weightForce(scene.carriedMass);
  if (scene.changing) return forces;
  if (laws.contact && contact.touching && forces.known) {
    forces.touching = true;
    forces.contact = contactForce(contact.normal * -contact.depth, contact.normal, stiffness);
    if (laws.weave && scene.weave) forces.contact = forces.contact * (1 + weaveShare(*scene.weave, contact.proxy));
    forces.contact += contact.normal * (-damping * dot(velocity, contact.normal));
    forces.stored += stiffness * contact.depth * contact.depth / 2;
  }
  if (scene.grab) {
    const double steepest = kCouplingShare * record.stiffness;
    forces.pull = pullForce(*scene.grab, laws.pull, device, steepest, forces.stored);
    if (squaredLength(forces.pull) > 0) {
      const Vec3 way = normalized(forces.pull);
      forces.pull += way * (-damping * dot(velocity, way));
    }
  }
  if (laws.cutting && scene.cutting > 0) forces.cut = cuttingForce(scene.cutting, velocity);
  return forces;
}

}  // namespace karinui
