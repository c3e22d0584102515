// A scene of `karinui bench --start` in Bullet's soft body: links, solved by position, self-collision by clusters.
//   bullet_cloth SCENE.json FOLDER CAP_SECONDS
// Runs until at rest or the processor time is spent, leaves the last eleven frames in FOLDER as 00.obj ... 10.obj, and
// says what it took as JSON.
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <ctime>
#include <deque>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

using Json = nlohmann::json;
using Frame = std::vector<btVector3>;

constexpr double kFrame = 1.0 / 60, kCalm = 0.005;  // seconds; m/s
constexpr int kCalmFrames = 10, kSewingFrames = 60;

btVector3 place(const Json& p) { return {p[0].get<btScalar>(), p[1].get<btScalar>(), p[2].get<btScalar>()}; }

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int main(int count, char** words) {
  // 80 rounds over the links a frame, in many short steps: 10 x 4 and 4 x 40 stretch three to eight times as far, one
  // round a step explodes.
  constexpr int substeps = 20, iterations = 4;
  if (count != 4) return 2;
  Json scene;
  std::ifstream(words[1]) >> scene;
  const std::string folder = words[2];
  const double cap = std::stod(words[3]);

  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btSoftBodyWorldInfo& info = world.getWorldInfo();
  info.m_sparsesdf.Initialize();
  info.m_sparsesdf.setDefaultVoxelsz(btScalar(0.02));  // 0.25 as it comes: the cloth sinks 60 mm into the ball
  info.m_sparsesdf.Reset();
  info.air_density = 0;

  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  for (const Json& c : scene["capsules"]) {
    const btVector3 a = place(c["a"]), b = place(c["b"]), along = b - a;
    const btScalar radius = c["radius"].get<btScalar>();
    btTransform pose(btQuaternion::getIdentity(), (a + b) / 2);
    if (along.length() > 0) {
      shapes.push_back(std::make_unique<btCapsuleShape>(radius, along.length()));  // along y
      pose.setRotation(shortestArcQuat({0, 1, 0}, along.normalized()));
    } else {
      shapes.push_back(std::make_unique<btSphereShape>(radius));
    }
    bodies.push_back(std::make_unique<btRigidBody>(0, nullptr, shapes.back().get()));
    bodies.back()->setWorldTransform(pose);
    bodies.back()->setFriction(1);  // times the cloth's own
    world.addRigidBody(bodies.back().get());
  }

  Frame start;
  for (const Json& p : scene["points"]) start.push_back(place(p));
  btSoftBody cloth(&info, static_cast<int>(start.size()), start.data(), nullptr);
  btSoftBody::Material* thread = cloth.m_materials[0];
  thread->m_kLST = 1;
  double area = 0;
  for (const Json& f : scene["faces"]) {
    const int a = f[0], b = f[1], c = f[2];
    cloth.appendFace(a, b, c);
    cloth.appendLink(a, b, thread, true);
    cloth.appendLink(b, c, thread, true);
    cloth.appendLink(c, a, thread, true);
    area += 0.5 * (start[b] - start[a]).cross(start[c] - start[a]).length();
  }
  btSoftBody::Material* bend = cloth.appendMaterial();
  bend->m_kLST = btScalar(0.01);
  cloth.generateBendingConstraints(2, bend);
  const int firstSeam = cloth.m_links.size();
  for (const Json& seam : scene["seams"]) cloth.appendLink(seam[0].get<int>(), seam[1].get<int>(), thread);
  std::vector<btScalar> open;
  for (int k = firstSeam; k < cloth.m_links.size(); ++k) open.push_back(cloth.m_links[k].m_rl);
  cloth.setTotalMass(btScalar(area * scene["weight"].get<double>()));
  for (const Json& k : scene["pinned"]) cloth.setMass(k.get<int>(), 0);
  cloth.m_cfg.piterations = iterations;
  cloth.m_cfg.kDF = scene["friction"].get<btScalar>();
  cloth.m_cfg.kCHR = cloth.m_cfg.kKHR = 1;
  cloth.getCollisionShape()->setMargin(btScalar(0.003));
  cloth.m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
  if (!scene["capsules"].empty()) {
    cloth.m_cfg.collisions |= btSoftBody::fCollision::CL_SELF;
    cloth.generateClusters(static_cast<int>(start.size() / 16));
  }
  world.addSoftBody(&cloth);
  const auto setWeight = [&](double g, double damping) {  // m/s2; part of the velocity taken off a second
    cloth.m_cfg.kDP = btScalar(damping * kFrame / substeps);
    world.setGravity({0, btScalar(g), 0});
    info.m_gravity = world.getGravity();
  };
  open.empty() ? setWeight(-9.81, 2) : setWeight(0, 20);

  std::deque<Frame> last{start};
  const double began = processorSeconds();
  int frames = 0, calm = 0;
  for (; calm < kCalmFrames && processorSeconds() - began < cap; ++frames) {
    for (std::size_t k = 0; k < open.size(); ++k) {  // drawn together during a second without weight
      btSoftBody::Link& seam = cloth.m_links[firstSeam + static_cast<int>(k)];
      seam.m_rl = open[k] * btScalar(std::fmax(0, 1 - frames / (0.75 * kSewingFrames)));
      seam.m_c1 = seam.m_rl * seam.m_rl;
    }
    if (frames == kSewingFrames) setWeight(-9.81, 2);
    world.stepSimulation(btScalar(kFrame), substeps, btScalar(kFrame / substeps));
    Frame now;
    double fastest = 0;
    for (int k = 0; k < cloth.m_nodes.size(); ++k) {
      now.push_back(cloth.m_nodes[k].m_x);
      fastest = std::fmax(fastest, (now.back() - last.back()[static_cast<std::size_t>(k)]).length() / kFrame);
    }
    calm = fastest < kCalm && (open.empty() || frames > kSewingFrames) ? calm + 1 : 0;
    last.push_back(std::move(now));
    if (last.size() > kCalmFrames + 1) last.pop_front();
  }
  const Json said = {{"cpu_s", processorSeconds() - began}, {"frames", frames}, {"settled", calm >= kCalmFrames}};

  for (std::size_t f = 0; f < last.size(); ++f) {
    std::ofstream obj(folder + "/" + (f < 10 ? "0" : "") + std::to_string(f) + ".obj");
    obj.precision(9);
    for (const btVector3& p : last[f]) obj << "v " << p.x() << " " << p.y() << " " << p.z() << "\n";
    if (f + 1 == last.size())
      for (const Json& face : scene["faces"])
        obj << "f " << face[0].get<int>() + 1 << " " << face[1].get<int>() + 1 << " " << face[2].get<int>() + 1 << "\n";
  }
  std::cout << said << "\n";
  world.removeSoftBody(&cloth);
  for (const auto& body : bodies) world.removeRigidBody(body.get());
}
