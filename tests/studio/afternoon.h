#pragma once
// A first garment from no file to the paper: chapters, played by whatever hand. Between two chapters all has come to
// rest. Drawn, sewn and typed places are the same for every hand, so the garment is the same to the bit.
#include <array>
#include <functional>
#include <utility>

#include "studio/person.h"

namespace karinui::studio {

enum Board { kGarment, kBody, kFabric, kFit };  // tabs beside the views, in their order

class Afternoon {
 public:
  explicit Afternoon(Window& window) : w(window), person(window) {}
  virtual ~Afternoon() = default;

  struct Chapter {
    const char* name;  // of its picture
    void (Afternoon::*play)();
  };
  static const std::vector<Chapter>& chapters();
  // Those from `first` on, before `end`; `after` is called after each, with its number.
  void play(const std::function<void(std::size_t)>& after, std::size_t first = 0, std::size_t end = 11);

  virtual void figure() = 0;  // eight typed measures
  virtual void front() = 0;   // each half drawn, the other follows
  virtual void back() = 0;
  virtual void sewing() = 0;  // sides and shoulders
  virtual void drape() = 0;
  virtual void fit() = 0;     // the ease is read,
  virtual void takeIn() = 0;  // and the sides taken in by a centimetre
  virtual void collar() = 0;  // as long as the neckline
  virtual void dart() = 0;
  virtual void stripes() = 0;
  virtual void paper() = 0;  // into pdf()

  fs::path pdf() const { return folder_.path / "top.pdf"; }

  Window& w;
  Person person;
  bool pictures = false;  // for the guide

 protected:
  // As asked for on the board, in centimetres.
  static constexpr std::array<const char*, 8> kMeasures{"162", "86", "74", "68", "93", "38.5", "53", "73"};
  const Piece& piece(const char* name) const;
  Flat along(const char* piece, const char* edge, double share) const;  // on its paper

 private:
  Folder folder_;
};

// With the mouse, as a newcomer does; lengths are typed.
class AfternoonByMouse : public Afternoon {
 public:
  using Afternoon::Afternoon;
  void figure() override;
  void front() override;
  void back() override;
  void sewing() override;
  void drape() override;
  void fit() override;
  void takeIn() override;
  void collar() override;
  void dart() override;
  void stripes() override;
  void paper() override;

 private:
  struct Leg {  // of a line of the body, from one place near it to another
    const char* line;
    const char *from, *to;
    double by = 0;  // of a ring: which way round, +1 or -1 with the line; 0: the shorter
  };
  std::vector<QPointF> stroke(const std::vector<Leg>& legs);
  std::vector<QPointF> run(const char* piece, const char* edge, double from, double to);
};

// With keys alone.
class AfternoonByKeys : public Afternoon {
 public:
  using Afternoon::Afternoon;
  void figure() override;
  void front() override;
  void back() override;
  void sewing() override;
  void drape() override;
  void fit() override;
  void takeIn() override;
  void collar() override;
  void dart() override;
  void stripes() override;
  void paper() override;

 private:
  void go(QWidget& part);  // of the window
  void board(int which);
  void tabTo(QWidget& widget);
  void skinTo(Vec3 place);
  void edgeTo(const char* piece, const char* edge);
  // From corner to corner: landmarks, or where two lines of the body cross ("side_left*hip").
  // each after some keys for the view.
  void half(const std::vector<std::pair<std::vector<Qt::Key>, std::string>>& corners);
};

}  // namespace karinui::studio
