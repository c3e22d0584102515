#pragma once
// Draws a SceneFrame as a fitting in a tailor's studio, into whatever framebuffer is current: off-screen, a window's or
// a headset's. Needs OpenGL 3.3 core. Every call, and the end of its life, belongs to the thread in which its context
// is current; it leaves the GL state of its caller changed (bind anew what you need) but never the framebuffer binding.
#include <memory>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/scene/scene_frame.h"
#include "karinui/view/camera.h"

namespace karinui {

// The studio. The defaults alone give the house's picture.
struct Studio {
  Colour backdrop{0.83f, 0.79f, 0.735f};  // linear RGB in the middle of the picture; falls off to the corners
  bool ground = true;                     // floor with shadows
  // The backdrop lies all round, by where one looks, as for someone who turns the head; else it belongs to the picture.
  bool allRound = false;
  int skyDirections = 32;           // directions soft light comes from; 0: none of it is shadowed
  int skyMap = 512, keyMap = 2048;  // side of the shadow maps, pixels
};

// Part of the current framebuffer, in GL's way (from the bottom left), and which part of the whole picture it shows:
// fractions from the bottom left. Large pictures are drawn in tiles.
struct DrawArea {
  int x = 0, y = 0, width = 0, height = 0;
  double left = 0, bottom = 0, right = 1, top = 1;
  double pictureHeight = 0;  // pixels of the whole picture, for thin lines; 0: height
  Matrix4 crop() const;      // leads from the clip space of the whole picture to that of the part
};

enum class SoftLight { Anew, Kept, Carried };
enum class Onto { Cleared, Picture };
enum class DrawQuality { Fine, Quick };

class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> make(const Studio& studio = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Takes a frame in: copies it to the graphics memory and works out the soft light. strainTop > 0 shows the strain map
  // up to that strain instead of the cloth's colours. Parts that cannot be drawn (places that are no numbers or too far
  // away, corners that do not exist) are left out and told by notes().
  // `SoftLight::Kept`, while things move: the soft light stays that of the last picture with as many points, or is
  // worked out roughly where there is none. `SoftLight::Carried`, while a body moves too: it also stays where the scene
  // grows, and shading of the body is rough.
  void show(const SceneFrame& frame, double strainTop = 0, SoftLight softLight = SoftLight::Anew);
  const std::vector<Message>& notes() const;

  // Lines over what is shown (a stroke, an arrow, what is chosen): cheap, for every move of the hand.
  void overlay(const std::vector<SceneLine>& lines);

  // Sets up the key light and its shadow for someone looking from this camera. Once per view, not per eye.
  void light(const Camera& camera);

  // Draws into the area, without the overlay. `Onto::Cleared`: clears it first; `Onto::Picture`: adds to a picture (and
  // its depths) that another renderer left there for the same eye, without backdrop and floor. `DrawQuality::Quick`,
  // while things move and the processor draws: shadows with a rough rim, and no weave.
  void draw(const Eye& eye, const DrawArea& area, Onto onto = Onto::Cleared,
            DrawQuality quality = DrawQuality::Fine) const;
  // The overlay alone, over a picture (and its depths) that draw() left there.
  void drawOver(const Eye& eye, const DrawArea& area) const;

 private:
  Renderer();
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace karinui
