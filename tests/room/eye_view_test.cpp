// Where a known point falls in each eye's picture: by the matrices, by the closed form, and as it is drawn.
#include "eye_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "eye_pictures.h"

namespace karinui::room {
namespace {

using test::kEyesApart, test::kLeftFov, test::kRightFov;

// An eye turned outwards by `cant`, as headsets with canted screens have them.
Rigid cantedEye(const Rigid& head, bool right, double cant) {
  Rigid eye = after(head, turnAbout({0, 1, 0}, right ? -cant : cant));
  eye.carry = head({right ? kEyesApart / 2 : -kEyesApart / 2, 0, 0});
  return eye;
}

Vec3 inEye(const Rigid& eye, Vec3 p) {
  const Rigid back{eye.w, -eye.x, -eye.y, -eye.z, {}};
  return back.turned(p - eye.carry);
}

TEST(RoomEyes, MatricesAreTheClosedForm) {
  Rigid head = after(turnAbout({0, 1, 0}, 0.4), turnAbout({1, 0, 0}, -0.2));
  head.carry = {0.3, 1.5, 0.2};
  for (const bool right : {false, true}) {
    const FieldOfView fov = right ? kRightFov : kLeftFov;
    const Rigid pose = cantedEye(head, right, 0.07);
    const Eye eye = eyeOfFov(pose, fov, 0.05, 60);
    for (const Vec3 local : {Vec3{0, 0, -1}, {0.4, -0.3, -1.2}, {-0.6, 0.5, -0.9}, {0.02, 0.01, -0.06}}) {
      const OnPicture matrix = project(eye, pose(local), 1832, 1920), closed = onEyePicture(fov, local, 1832, 1920);
      EXPECT_NEAR(matrix.x, closed.x, 1e-8);
      EXPECT_NEAR(matrix.y, closed.y, 1e-8);
      EXPECT_NEAR(matrix.depth, closed.depth, 1e-9);
    }
  }
  // The edges of the view are the edges of the picture.
  EXPECT_NEAR(onEyePicture(kLeftFov, {std::tan(kLeftFov.left), 0, -1}, 800, 600).x, 0, 1e-9);
  EXPECT_NEAR(onEyePicture(kLeftFov, {std::tan(kLeftFov.right), 0, -1}, 800, 600).x, 800, 1e-9);
  EXPECT_NEAR(onEyePicture(kLeftFov, {0, std::tan(kLeftFov.up), -1}, 800, 600).y, 0, 1e-9);
  EXPECT_NEAR(onEyePicture(kLeftFov, {0, std::tan(kLeftFov.down), -1}, 800, 600).y, 600, 1e-9);
}

class RoomMarker : public test::EyePictures {
 protected:
  static constexpr int kSide = 1920, kFiner = 4, kTile = 384;  // a picture, and a part of it so many times as fine
  // The part of the picture round a place.
  static DrawArea areaRound(Flat place) {
    const double left = std::floor(place.u) - kTile / (2.0 * kFiner),
                 top = std::floor(place.v) - kTile / (2.0 * kFiner);
    const double side = 1.0 * kTile / kFiner / kSide;
    DrawArea area{.x = 0, .y = 0, .width = kTile, .height = kTile};
    area.left = left / kSide, area.right = area.left + side;
    area.top = 1 - top / kSide, area.bottom = area.top - side;
    area.pictureHeight = kSide * kFiner;
    return area;
  }
  // The middle of what differs between two such parts, in pixels of the whole picture.
  static Flat middleOfDifference(const Image& a, const Image& b, const DrawArea& area) {
    double sum = 0, x = 0, y = 0;
    for (int j = 0; j < a.height; ++j)
      for (int i = 0; i < a.width; ++i) {
        double d = 0;
        for (std::size_t c = 0; c < 3; ++c) d += std::fabs(1.0 * a.at(i, j)[c] - b.at(i, j)[c]);
        if (d < 40) continue;  // the grain of the backdrop
        sum += 1, x += i + 0.5, y += j + 0.5;
      }
    EXPECT_GT(sum, 400);
    return {area.left * kSide + x / sum / kFiner, (1 - area.top) * kSide + y / sum / kFiner};
  }
};

TEST_F(RoomMarker, IsDrawnWhereTheClosedFormHasItInBothEyes) {
  Session session;
  for (const Scale scale : {Scale::One, Scale::TableTop}) {
    RoomOptions options;
    options.scale = scale;
    options.posture.floor = 0;
    FittingRoom room(session, options);
    test::Person person;
    person.step(room);
    for (const Vec3 place : {Vec3{0.02, 1.62, -1.0}, {-0.15, 1.75, -0.8}, {0.12, 1.66, -2.5}}) {
      Flat drawn[2], closed[2];
      for (const bool right : {false, true}) {
        const FieldOfView fov = right ? kRightFov : kLeftFov;
        const Rigid eye = cantedEye(person.head, right, 0.07);
        const Vec3 there = room.placement().roomToFitting(place);
        const OnPicture on = onEyePicture(fov, inEye(eye, place), kSide, kSide);
        closed[right] = {on.x, on.y};
        const DrawArea area = areaRound(closed[right]);
        picture_->mark({});
        take(room, person);
        const Image without = tile(eye, fov, area);
        const double wideMm = 10.0 * -place.z / room.placement().scale;  // some ten pixels
        picture_->mark({{{there - Vec3{0, 1e-4, 0}, there + Vec3{0, 1e-4, 0}},
                         {0.9f, 0.02f, 0.02f},
                         static_cast<float>(wideMm),
                         false}});
        take(room, person);
        drawn[right] = middleOfDifference(tile(eye, fov, area), without, area);
        EXPECT_NEAR(drawn[right].u, closed[right].u, 0.1) << place.z << " " << right;
        EXPECT_NEAR(drawn[right].v, closed[right].v, 0.1) << place.z << " " << right;
      }
      EXPECT_NEAR(drawn[0].u - drawn[1].u, closed[0].u - closed[1].u, 0.1);
    }
  }
  picture_->mark({});
}

}  // namespace
}  // namespace karinui::room
