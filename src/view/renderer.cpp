#include "karinui/view/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <random>

#include "karinui/view/strain_scale.h"
#include "view/gl_objects.h"
#include "view/ribbons.h"
#include "view/shaders.h"
#include "view/surface.h"

namespace karinui {
namespace {

constexpr double kFloorShare = 2.4;  // radius of the floor over that of the scene's footprint
constexpr double kAlike = 0.03;      // by so much a scene may grow before the kept soft light would look wrong

void set(GLuint program, const char* name, const Matrix4& m) {
  glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, m.floats().data());
}
void set(GLuint program, const char* name, int v) { glUniform1i(glGetUniformLocation(program, name), v); }

void attribute(GLuint at, int count, std::size_t stride, std::size_t offset) {
  glEnableVertexAttribArray(at);
  glVertexAttribPointer(at, count, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
}

template <class T>
void upload(GLenum target, GLuint buffer, const std::vector<T>& values) {
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), GL_STATIC_DRAW);
}

// A parallel light that takes in a ball about the origin; unit vectors right, up, towards the light.
struct Beam {
  Vec3 right, towards;
  Matrix4 toLight;
};
Beam beamFrom(Vec3 towards, double radius) {
  const Vec3 right = normalized(cross(std::fabs(towards.y) < 0.99 ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, towards));
  const Vec3 up = cross(towards, right);
  const double k = 1 / radius;
  Beam beam{right, towards, {}};
  beam.toLight.m = {right.x * k,
                    up.x * k,
                    -towards.x * k,
                    0,
                    right.y * k,
                    up.y * k,
                    -towards.y * k,
                    0,
                    right.z * k,
                    up.z * k,
                    -towards.z * k,
                    0,
                    0,
                    0,
                    0,
                    1};
  return beam;
}

// Directions spread evenly over the upper half of the sky (Fibonacci spiral), never quite level.
std::vector<Vec3> spread(int count) {
  std::vector<Vec3> all;
  for (int i = 0; i < count; ++i) {
    const double y = (i + 0.5) / count, r = std::sqrt(1 - y * y), turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    all.push_back({r * std::cos(turn), y, r * std::sin(turn)});
  }
  return all;
}

struct ShadowMap {
  GlTexture depth;
  GlTarget target;
  int side = 0;

  explicit ShadowMap(int pixels) : depth(newTexture()), target(newTarget()), side(pixels) {
    glBindTexture(GL_TEXTURE_2D, depth);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, side, side, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  }
};

// Puts the caller's framebuffer and viewport back.
struct KeepTarget {
  GLint draw = 0, read = 0, box[4] = {};
  KeepTarget() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
    glGetIntegerv(GL_VIEWPORT, box);
  }
  ~KeepTarget() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read));
    glViewport(box[0], box[1], box[2], box[3]);
  }
};

}  // namespace

struct Renderer::Parts {
  Studio studio;
  GlProgram depth, sky, backdrop, ribbon;
  struct Lit {  // the programs of one quality
    GlProgram solid, floor;
  } fine, quick;
  GlArrays solidArrays, noArrays;
  GlBuffer solidVertices, solidCorners;
  struct Lines {
    GlArrays arrays;
    GlBuffer vertices, corners;
    std::size_t count = 0;
    void make();
    void take(const Ribbons& ribbons);
    void draw(GLuint program, const Eye& eye, const DrawArea& area) const;  // the program is in use
  };
  Lines ribbons, over;
  GlTexture skyPlaces, skyNormals, softLight, strainTable, yarns;
  GlTarget softTarget;
  std::unique_ptr<ShadowMap> keyMap, skyMap;

  struct Run {
    int kind = 0;
    int weave = -1;
    ClothLook look;
    std::size_t first = 0, count = 0;  // corners
  };
  std::vector<Run> runs;
  std::vector<KeptMesh> kept;           // one for each body
  std::size_t bodies = 0, casting = 0;  // corners: those of bodies come first
  std::size_t castingVertices = 0;
  struct {
    std::size_t vertices = 0;
    double radius = 0;
  } lit;  // what the soft light was worked out for
  Vec3 origin;
  double radius = 1, strainTop = 0;
  Beam key;
  Vec3 fill{0, 0, 1};
  std::vector<Message> notes;

  std::map<std::shared_ptr<const PrintImage>, GlTexture> photos;  // those of the frame that is shown
  void keepPhotos(const SceneFrame& frame);
  void tellLook(const Run& run, const GlProgram& solid) const;  // to a solid program, which is in use
  void castShadow(const ShadowMap& map, const Beam& beam) const;
  void gatherSky(const std::vector<SurfaceVertex>& all, int skyDirections);
};

void Renderer::Parts::Lines::make() {
  arrays = newArrays();
  vertices = newBuffer(), corners = newBuffer();
  glBindVertexArray(arrays);
  glBindBuffer(GL_ARRAY_BUFFER, vertices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners);
  constexpr std::size_t kRibbon = sizeof(RibbonVertex);
  attribute(0, 3, kRibbon, offsetof(RibbonVertex, from));
  attribute(1, 3, kRibbon, offsetof(RibbonVertex, to));
  attribute(2, 2, kRibbon, offsetof(RibbonVertex, place));
  attribute(3, 2, kRibbon, offsetof(RibbonVertex, halfWidth));
  attribute(4, 2, kRibbon, offsetof(RibbonVertex, along));
  attribute(5, 3, kRibbon, offsetof(RibbonVertex, colour));
  attribute(6, 1, kRibbon, offsetof(RibbonVertex, lift));
  attribute(7, 2, kRibbon, offsetof(RibbonVertex, stitch));
}

void Renderer::Parts::Lines::take(const Ribbons& fresh) {
  count = fresh.corners.size();
  glBindVertexArray(0);
  upload(GL_ARRAY_BUFFER, vertices, fresh.vertices);
  upload(GL_ARRAY_BUFFER, corners, fresh.corners);
}

void Renderer::Parts::Lines::draw(GLuint program, const Eye& eye, const DrawArea& area) const {
  if (count == 0) return;
  const double pixels = area.pictureHeight > 0 ? area.pictureHeight : area.height;
  set(program, "pixelsPerMetre", pixels / 2 * eye.projection.m[5]);
  set(program, "leastPixels", std::max(1.0, pixels / 2400));
  glBindVertexArray(arrays);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT, nullptr);
}

Renderer::Renderer() : parts_(std::make_unique<Parts>()) {}
Renderer::~Renderer() = default;
const std::vector<Message>& Renderer::notes() const { return parts_->notes; }

Result<std::unique_ptr<Renderer>> Renderer::make(const Studio& studio) {
  std::unique_ptr<Renderer> made(new Renderer);
  Parts& p = *made->parts_;
  p.studio = studio;
  const struct {
    GlProgram& program;
    const std::string& vertex;
    std::string fragment;
  } wanted[] = {{p.depth, glsl::kDepthVertex, {}},
                {p.sky, glsl::kWholeVertex, glsl::kSkyFragment},
                {p.backdrop, glsl::kWholeVertex, glsl::kBackdropFragment},
                {p.fine.solid, glsl::kSolidVertex, glsl::kFine + glsl::kSolidFragment},
                {p.fine.floor, glsl::kSolidVertex, glsl::kFine + glsl::kFloorFragment},
                {p.quick.solid, glsl::kSolidVertex, glsl::kQuick + glsl::kSolidFragment},
                {p.quick.floor, glsl::kSolidVertex, glsl::kQuick + glsl::kFloorFragment},
                {p.ribbon, glsl::kRibbonVertex, glsl::kRibbonFragment}};
  for (const auto& w : wanted) {
    auto program = makeProgram(w.vertex, w.fragment);
    if (!program) return program.error();
    w.program = std::move(*program);
  }
  const KeepTarget keep;
  p.noArrays = newArrays();
  p.solidArrays = newArrays();
  p.solidVertices = newBuffer(), p.solidCorners = newBuffer();
  glBindVertexArray(p.solidArrays);
  glBindBuffer(GL_ARRAY_BUFFER, p.solidVertices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, p.solidCorners);
  constexpr std::size_t kSolid = sizeof(SurfaceVertex);
  attribute(0, 3, kSolid, offsetof(SurfaceVertex, place));
  attribute(1, 3, kSolid, offsetof(SurfaceVertex, normal));
  attribute(2, 3, kSolid, offsetof(SurfaceVertex, colour));
  attribute(3, 2, kSolid, offsetof(SurfaceVertex, flat));
  attribute(4, 2, kSolid, offsetof(SurfaceVertex, cavity));  // and strain, which follows it
  p.ribbons.make(), p.over.make();
  p.keyMap = std::make_unique<ShadowMap>(std::clamp(studio.keyMap, 16, 8192));
  p.skyMap = std::make_unique<ShadowMap>(std::clamp(studio.skyMap, 16, 4096));

  std::vector<float> table;
  for (int i = 0; i < 256; ++i)
    for (const float c : strainColour(i / 255.0)) table.push_back(c);
  p.strainTable = newTexture();
  glBindTexture(GL_TEXTURE_2D, p.strainTable);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, 256, 1, 0, GL_RGB, GL_FLOAT, table.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  p.yarns = newTexture();
  glBindTexture(GL_TEXTURE_2D, p.yarns);
  std::vector<std::uint8_t> uneven(glsl::kYarnSide * glsl::kYarnSide);
  std::minstd_rand lot;
  for (std::uint8_t& u : uneven) u = static_cast<std::uint8_t>(lot() >> 16);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, glsl::kYarnSide, glsl::kYarnSide, 0, GL_RED, GL_UNSIGNED_BYTE, uneven.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  p.skyPlaces = newTexture(), p.skyNormals = newTexture();
  p.softLight = newTexture();
  p.softTarget = newTarget();
  if (glGetError() == GL_OUT_OF_MEMORY)
    return notFound(say("There is not enough graphics memory for the studio's shadows."));
  made->show({});
  made->light({});
  return made;
}

void Renderer::Parts::castShadow(const ShadowMap& map, const Beam& beam) const {
  glBindFramebuffer(GL_FRAMEBUFFER, map.target);
  glViewport(0, 0, map.side, map.side);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
  if (casting == 0) return;
  glUseProgram(depth);
  set(depth, "toLight", beam.toLight);
  glBindVertexArray(solidArrays);
  glEnable(GL_CULL_FACE);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(bodies), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(casting - bodies), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(bodies * sizeof(std::uint32_t)));
}

// How much of the sky each vertex sees, on both sides of its surface: a shadow map from each direction, added up in a
// table with a texel for each vertex. It belongs to the scene, not to a view, so both eyes and all sides share it.
void Renderer::Parts::gatherSky(const std::vector<SurfaceVertex>& all, int skyDirections) {
  const int wide = glsl::kSkyWide, high = std::max<int>(1, static_cast<int>((all.size() + wide - 1) / wide));
  const auto table = [&](const GlTexture& texture, GLint inside, GLenum format, const float* values) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, inside, wide, high, 0, format, GL_FLOAT, values);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  };
  const std::size_t texels = static_cast<std::size_t>(wide) * static_cast<std::size_t>(high);
  std::vector<float> places(3 * texels), normals(3 * texels);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::copy_n(all[i].place, 3, &places[3 * i]);
    std::copy_n(all[i].normal, 3, &normals[3 * i]);
  }
  table(skyPlaces, GL_RGB32F, GL_RGB, places.data());
  table(skyNormals, GL_RGB32F, GL_RGB, normals.data());
  table(softLight, GL_RG32F, GL_RG, nullptr);
  lit = {all.size(), radius};

  glBindFramebuffer(GL_FRAMEBUFFER, softTarget);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, softLight, 0);
  glDisable(GL_SCISSOR_TEST);
  const bool shaded = skyDirections > 0 && casting > 0;
  const float open = shaded ? 0.0f : casting > 0 ? 0.5f : 1.0f;  // nothing keeps the sky from an empty floor
  glClearColor(open, open, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  if (!shaded) return;
  const double texel = 2 * radius / skyMap->side;
  const std::vector<Vec3> directions = spread(std::min(skyDirections, 512));
  double upward = 0;
  for (const Vec3 d : directions) upward += d.y;
  for (const Vec3 d : directions) {
    const Beam beam = beamFrom(d, radius);
    castShadow(*skyMap, beam);
    glBindFramebuffer(GL_FRAMEBUFFER, softTarget);
    glViewport(0, 0, wide, high);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(sky);
    set(sky, "toLight", beam.toLight);
    set(sky, "towards", d);
    set(sky, "weight", 1 / upward);  // open ground gets 1
    set(sky, "lift", 1.2 * texel);
    set(sky, "spread", 0.045 * radius);
    set(sky, "wide", wide);
    set(sky, "floorFrom", static_cast<int>(castingVertices));
    set(sky, "map", 0), set(sky, "places", 1), set(sky, "normals", 2);
    const GLuint textures[] = {skyMap->depth, skyPlaces, skyNormals};
    for (unsigned i = 0; i < 3; ++i) glActiveTexture(GL_TEXTURE0 + i), glBindTexture(GL_TEXTURE_2D, textures[i]);
    glBindVertexArray(noArrays);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
  }
  glActiveTexture(GL_TEXTURE0);
}

void Renderer::Parts::keepPhotos(const SceneFrame& frame) {
  std::map<std::shared_ptr<const PrintImage>, GlTexture> kept1;
  for (const SceneCloth& cloth : frame.cloths) {
    const auto& photo = cloth.look.photo;
    if (!photo || kept1.contains(photo) || photo->width < 1 || photo->height < 1 ||
        photo->rgb.size() !=
            std::size_t{3} * static_cast<std::size_t>(photo->width) * static_cast<std::size_t>(photo->height))
      continue;
    if (const auto had = photos.find(photo); had != photos.end()) {
      kept1.emplace(photo, std::move(had->second));
      continue;
    }
    GlTexture texture = newTexture();
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, photo->width, photo->height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 photo->rgb.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    kept1.emplace(photo, std::move(texture));
  }
  photos = std::move(kept1);
}

void Renderer::Parts::tellLook(const Run& run, const GlProgram& solid) const {
  const ClothLook& look = run.look;
  const auto axes = [&](const char* name, const std::array<Flat, 2>& two) {
    glUniform4f(glGetUniformLocation(solid, name), static_cast<float>(two[0].u), static_cast<float>(two[0].v),
                static_cast<float>(two[1].u), static_cast<float>(two[1].v));
  };
  ClothLook straight = look;
  straight.turn = 0;
  axes("weaveAxes", printAxes(straight)), axes("printAxes", printAxes(look));
  set(solid, "weave", run.weave);
  const std::pair<const char*, float> numbers[] = {{"threads", look.threads}, {"relief", look.relief},
                                                   {"gloss", look.gloss},     {"sharpness", look.sharpness},
                                                   {"fuzz", look.fuzz},       {"cover", look.cover}};
  for (const auto& [name, value] : numbers) set(solid, name, static_cast<double>(value));
  const auto photo = photos.find(look.photo);
  const bool printed = run.weave >= 0 && (look.print != ClothLook::Print::Photo || photo != photos.end());
  set(solid, "print", printed ? static_cast<int>(look.print) : 0);
  glUniform3f(glGetUniformLocation(solid, "ink"), look.ink[0], look.ink[1], look.ink[2]);
  const ClothLook::Wrong wrong = look.wrong.value_or(ClothLook::Wrong());
  set(solid, "ownWrong", look.wrong ? 1 : 0);
  set(solid, "wrongPrint",
      run.weave >= 0 && (wrong.print != ClothLook::Print::Photo || photo != photos.end())
          ? static_cast<int>(wrong.print)
          : 0);
  glUniform3f(glGetUniformLocation(solid, "wrongColour"), wrong.colour[0], wrong.colour[1], wrong.colour[2]);
  glUniform3f(glGetUniformLocation(solid, "wrongInk"), wrong.ink[0], wrong.ink[1], wrong.ink[2]);
  glUniform2f(glGetUniformLocation(solid, "printOrigin"), static_cast<float>(look.origin.u),
              static_cast<float>(look.origin.v));
  double high = look.repeat;
  const bool photographed = look.print == ClothLook::Print::Photo || wrong.print == ClothLook::Print::Photo;
  if (photographed && photo != photos.end()) {
    high = look.repeat * look.photo->height / look.photo->width;
    glActiveTexture(GL_TEXTURE4);
    glBindTexture(GL_TEXTURE_2D, photo->second);
    glActiveTexture(GL_TEXTURE0);
  }
  glUniform2f(glGetUniformLocation(solid, "repeat"), static_cast<float>(look.repeat), static_cast<float>(high));
}

void Renderer::show(const SceneFrame& frame, double strainTop, SoftLight softLight) {
  Parts& p = *parts_;
  const KeepTarget keep;
  p.notes.clear();
  p.runs.clear();
  p.strainTop = strainTop;
  Box box = extent(frame);
  const bool nothing = box.empty();
  if (nothing) box = {{-0.4, 0, -0.4}, {0.4, 1.7, 0.4}};
  p.origin = box.centre();

  Surface surface;
  const auto run = [&](int kind, const SceneCloth* cloth, auto&& add) {
    const std::size_t first = surface.corners.size();
    add();
    Parts::Run made;
    made.kind = kind, made.first = first, made.count = surface.corners.size() - first;
    if (cloth) made.look = cloth->look;
    if (cloth && cloth->flat.size() == cloth->mesh.points.size()) made.weave = static_cast<int>(cloth->look.weave);
    p.runs.push_back(std::move(made));
  };
  const bool roughly = softLight == SoftLight::Carried;
  p.kept.resize(frame.bodies.size());
  for (std::size_t b = 0; b < frame.bodies.size(); ++b)
    run(0, nullptr, [&] { p.kept[b].add(surface, frame.bodies[b].mesh, p.origin, frame.bodies[b].colour, roughly); });
  p.bodies = surface.corners.size();
  for (const SceneCloth& cloth : frame.cloths) {
    run(1, &cloth, [&] {
      addMesh(surface, cloth.mesh, p.origin, cloth.colour, cloth.flat, cloth.strain);
      addEdges(surface, cloth, p.origin);
    });
    if (!cloth.trims.empty())
      run(1, nullptr, [&] {
        for (const SceneTrim& trim : cloth.trims) addMesh(surface, meshOf(trim, cloth.mesh), p.origin, trim.colour);
      });
  }
  p.keepPhotos(frame);
  p.casting = surface.corners.size();
  p.castingVertices = surface.vertices.size();
  // Feet stand on the floor; cloth without a body hangs a little above it.
  const double footprint = std::max({box.size().x, box.size().z, 0.25 * box.size().y, 1e-3}) / 2;
  const double ground = frame.bodies.empty() ? box.low.y - 0.02 * length(box.size()) : std::min(box.low.y, 0.0) - 5e-4;
  const double floor = kFloorShare * footprint;
  // The beams take in the scene and the floor its shadows fall on.
  p.radius = std::max(length(box.size()) / 2 * 1.02, 1e-3);
  if (p.studio.ground) {
    run(2, nullptr, [&] { addFloor(surface, Vec3{0, ground - p.origin.y, 0}, floor); });
    p.radius = std::max(p.radius, std::hypot(floor * 0.8, p.origin.y - ground));
  }
  const Ribbons ribbons = ribbonsOf(frame, p.origin);
  glBindVertexArray(0);
  upload(GL_ARRAY_BUFFER, p.solidVertices, surface.vertices);
  upload(GL_ARRAY_BUFFER, p.solidCorners, surface.corners);
  p.ribbons.take(ribbons);
  const bool alike =
      p.lit.vertices == surface.vertices.size() && (roughly || std::fabs(p.lit.radius / p.radius - 1) < kAlike);
  if (softLight == SoftLight::Anew)
    p.gatherSky(surface.vertices, p.studio.skyDirections);
  else if (!alike)
    p.gatherSky(surface.vertices, p.studio.skyDirections / 3);

  if (surface.leftOut + ribbons.leftOut > 0)
    p.notes.push_back(
        say("{0} {0|triangle|triangles} and {1} {1|bit|bits} of line are left out of the picture: their points are no "
            "numbers, too far away "
            "or not there.",
            surface.leftOut, ribbons.leftOut));
  if (nothing) p.notes.push_back(say("There is nothing to see: no body, no cloth and no line."));
}

void Renderer::overlay(const std::vector<SceneLine>& lines) {
  SceneFrame frame;
  frame.lines = lines;
  parts_->over.take(ribbonsOf(frame, parts_->origin));
}

void Renderer::light(const Camera& camera) {
  Parts& p = *parts_;
  const KeepTarget keep;
  // The lamps go round with the one who looks, as in a photographer's studio, but stay level with the floor.
  Vec3 back = camera.eye - camera.target;
  back.y = 0;
  back = length(back) > 1e-9 ? normalized(back) : Vec3{0, 0, 1};
  const Vec3 right = cross(Vec3{0, 1, 0}, back);
  p.key = beamFrom(normalized(back * 0.62 - right * 0.62 + Vec3{0, 0.72, 0}), p.radius);
  p.fill = normalized(back * 0.75 + right * 0.8 + Vec3{0, 0.15, 0});
  p.castShadow(*p.keyMap, p.key);
}

namespace {

// What every program of one picture is told.
struct Sitting {
  Matrix4 toClip;
  Vec3 seenFrom;
  Vec3 backdrop;
  const DrawArea& area;
  bool allRound;
  Vec3 lookRight, lookUp, lookAhead;  // the way a place of the picture is seen along, of its clip coordinates
  Sitting(const Eye& eye, const DrawArea& a, Vec3 origin, const Studio& studio)
      : seenFrom(eye.place - origin),
        backdrop{studio.backdrop[0], studio.backdrop[1], studio.backdrop[2]},
        area(a),
        allRound(studio.allRound) {
    const auto &v = eye.view.m, &p = eye.projection.m;
    lookRight = Vec3{v[0], v[4], v[8]} * (1 / p[0]);
    lookUp = Vec3{v[1], v[5], v[9]} * (1 / p[5]);
    lookAhead = lookRight * p[8] + lookUp * p[9] - Vec3{v[2], v[6], v[10]};
    Matrix4 fromOrigin;
    fromOrigin.m[12] = origin.x, fromOrigin.m[13] = origin.y, fromOrigin.m[14] = origin.z;
    toClip = area.crop() * eye.projection * eye.view * fromOrigin;
  }
  void tell(GLuint program) const {
    glUseProgram(program);
    set(program, "backdrop", backdrop);
    glUniform4f(glGetUniformLocation(program, "areaInPicture"), static_cast<float>(area.left),
                static_cast<float>(area.bottom), static_cast<float>(area.right - area.left),
                static_cast<float>(area.top - area.bottom));
    glUniform4f(glGetUniformLocation(program, "areaInPixels"), static_cast<float>(area.x), static_cast<float>(area.y),
                static_cast<float>(area.width), static_cast<float>(area.height));
    set(program, "toClip", toClip);
    set(program, "eye", seenFrom);
    set(program, "allRound", allRound ? 1 : 0);
    set(program, "lookRight", lookRight), set(program, "lookUp", lookUp), set(program, "lookAhead", lookAhead);
  }
};

}  // namespace

Matrix4 DrawArea::crop() const {
  const double wide = right - left, high = top - bottom;
  Matrix4 crop;
  crop.m[0] = 1 / wide, crop.m[5] = 1 / high;
  crop.m[12] = -(left + right - 1) / wide, crop.m[13] = -(bottom + top - 1) / high;
  return crop;
}

void Renderer::draw(const Eye& eye, const DrawArea& area, Onto onto, DrawQuality quality) const {
  const Parts& p = *parts_;
  const Parts::Lit& programs = quality == DrawQuality::Fine ? p.fine : p.quick;
  glViewport(area.x, area.y, area.width, area.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(area.x, area.y, area.width, area.height);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  const Sitting sitting(eye, area, p.origin, p.studio);
  const auto common = [&](GLuint program) { sitting.tell(program); };
  if (onto == Onto::Cleared) {
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST);
    common(p.backdrop);
    glBindVertexArray(p.noArrays);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  const GLuint textures[] = {p.softLight, p.keyMap->depth, p.strainTable, p.yarns};
  for (unsigned i = 0; i < 4; ++i) glActiveTexture(GL_TEXTURE0 + i), glBindTexture(GL_TEXTURE_2D, textures[i]);
  for (const GlProgram* program : {&programs.solid, &programs.floor}) {
    common(*program);
    set(*program, "keyTowards", p.key.towards);
    set(*program, "keyRight", p.key.right);
    set(*program, "fillTowards", p.fill);
    set(*program, "toKey", p.key.toLight);
    set(*program, "keyTexel", 2 * p.radius / p.keyMap->side);
    set(*program, "scaleTop", p.strainTop);
    set(*program, "skyWide", glsl::kSkyWide);
    set(*program, "sky", 0), set(*program, "keyMap", 1), set(*program, "strainTable", 2), set(*program, "yarnTable", 3),
        set(*program, "photo", 4);
  }
  glBindVertexArray(p.solidArrays);
  // Cloth before skin: the nearer surface first saves shading the one behind it.
  // What is seen through comes last, over everything that is behind it: its inner sides, which the far half of a
  // garment shows, then its outer ones.
  constexpr int kInner = 3, kOuter = 4;
  const auto sheer = [&](const Parts::Run& run) { return run.kind == 1 && run.look.cover < 1 && p.strainTop == 0; };
  for (const int kind : {1, 0, 2, kInner, kOuter})
    for (const Parts::Run& run : p.runs) {
      if ((sheer(run) ? kind < kInner : run.kind != kind) || run.count == 0 || (kind == 2 && onto == Onto::Picture))
        continue;
      const GlProgram& program = kind == 2 ? programs.floor : programs.solid;
      glUseProgram(program);
      set(program, "cloth", run.kind == 1 ? 1 : 0);
      if (run.kind != 2) p.tellLook(run, program);
      if (sheer(run)) glEnable(GL_BLEND), glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
      glCullFace(kind == kInner ? GL_FRONT : GL_BACK);
      set(program, "pushBack", kind == 0 ? 0.0025 : 0.0);
      (run.kind == 1 && !sheer(run) ? glDisable : glEnable)(GL_CULL_FACE);  // only cloth has an inner side
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.count), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(run.first * sizeof(std::uint32_t)));
    }
  glDisable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glDisable(GL_BLEND);
  common(p.ribbon);
  p.ribbons.draw(p.ribbon, eye, area);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::drawOver(const Eye& eye, const DrawArea& area) const {
  const Parts& p = *parts_;
  if (p.over.count == 0) return;
  glViewport(area.x, area.y, area.width, area.height);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  Sitting(eye, area, p.origin, p.studio).tell(p.ribbon);
  p.over.draw(p.ribbon, eye, area);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace karinui
