#pragma once
// Pictures hung in space, over what a Renderer has drawn: menus, sentences, numbers; and the vignette round an eye's
// picture. Needs OpenGL 3.3 core. Every call, and the end of its life, belongs to the thread in which its context is
// current; it leaves the GL state of its caller changed but never the framebuffer binding.
#include <memory>
#include <vector>

#include "karinui/view/camera.h"
#include "karinui/view/image.h"
#include "karinui/view/renderer.h"

namespace karinui {

struct Board {
  std::shared_ptr<const Image> image;  // the same pointer: the same picture, which is not uploaded again
  Vec3 corner, across, upward;         // its lower left corner, the whole width and height as vectors
  bool overAll = false;                // seen through whatever stands before it
};

class Boards {
 public:
  static Result<std::unique_ptr<Boards>> make();
  ~Boards();
  Boards(const Boards&) = delete;
  Boards& operator=(const Boards&) = delete;

  // Takes them in; they are drawn in this order. Boards without a picture are left out.
  void show(std::vector<Board> boards);
  // Over a picture (and its depths) that is there for the same eye.
  void draw(const Eye& eye, const DrawArea& area) const;
  // Darkens what lies off the eye's axis: `strength` 0 (nothing) to 1. A narrower view while the surroundings move
  // lessens motion sickness (A. Fernandes and S. Feiner, "Combating VR sickness through subtle dynamic field-of-view
  // modification", IEEE 3DUI 2016).
  void vignette(const Eye& eye, const DrawArea& area, double strength) const;

 private:
  Boards();
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace karinui
