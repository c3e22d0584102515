#pragma once
// Everyone of a batch in the garment, side by side; whom it does not fit is marked, with where and by how much.
#include "../commands.h"
#include "karinui/view/picture.h"
#include "plan.h"

namespace karinui::app {

struct PeopleWish : PictureWords {
  PeopleWish() { size = "420x700"; }
  std::filesystem::path folder;
  bool misfits = false;                      // only whom it does not fit, the worst first
  std::vector<std::string> people, designs;  // only these; none: all
};
struct PeoplePicture {
  Image image;
  std::size_t garments = 0, misfits = 0;  // that are drawn
  std::size_t missing = 0;                // not done yet, and left out
};
Done checkPeople(const PeopleWish& wish);  // whether its words can be understood
// Garments are made again as their outcome was found, and kept in the batch's folder for the next picture: long.
Result<PeoplePicture> peoplePicture(Program& program, const PeopleWish& wish);

}  // namespace karinui::app
