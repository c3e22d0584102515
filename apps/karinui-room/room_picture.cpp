// One picture for both eyes: the headset's poses in, the garment drawn, the pictures handed over.
// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include <cstdio>

#include "room_program.h"

namespace karinui::room {

// What recorded poses ask of the program up to this picture.
void RoomProgram::playEvents() {
  if (!options_.script) return;
  const auto& events = options_.script->events;
  for (; played_ < events.size() && events[played_].picture <= pictures_; ++played_) {
    const std::string& what = events[played_].what;
    if (what == "wait on" || what == "wait off") waits_ = what == "wait on";
    if (what.starts_with("picture ")) wanted_.push_back(what.substr(8));
  }
  if (pictures_ >= options_.script->end() && !ending_) {
    ending_ = true;
    wanted_.emplace_back("end");
  }
}

bool RoomProgram::leavePictures(const std::string& name) {
  if (!options_.headless) return true;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const auto path = *options_.headless / (name + (eye == 0 ? "_left.png" : "_right.png"));
    if (const Done done = writePng(path.string(), eyes_[eye]->image()); !done) {
      tell(done.error().what);
      return false;
    }
  }
  return true;
}

bool RoomProgram::makePicture() {
  const double asked = monotonicSeconds();
  const auto frame = headset_->begin();
  if (!frame) return false;
  report_.waited.add(1000 * (monotonicSeconds() - asked));
  if (!began_) began_ = frame->time;
  playEvents();
  // Recorded poses have a clock of their own, so that a slow machine plays the same.
  const double before = seconds_;
  seconds_ = options_.script ? static_cast<double>(pictures_) / kScriptRate
                             : static_cast<double>(frame->time - *began_) * 1e-9;
  seconds_ = std::max(seconds_, before);

  const double sampled = monotonicSeconds();
  auto hands = controllers_->read(frame->time);
  auto views = headset_->views(frame->time);
  const auto tracked = headset_->head(frame->time);
  if (tracked) head_ = *tracked, seen_ = true;
  if (options_.script) {
    if (const auto head = options_.script->headAt(pictures_)) {
      head_ = *head, seen_ = true;
      if (views && tracked)  // the eyes go with the recorded head
        for (Headset::View& view : *views) view.eye = after(*head, after(inverseOf(*tracked), view.eye));
    }
    if (options_.script->hasHands())
      for (std::size_t side = 0; side < 2; ++side) hands[side] = options_.script->handAt(side, pictures_);
  }
  ++pictures_;
  const bool played = options_.script && options_.script->hasHands();
  if (waits_) session_.finish();
  if (!seen_) {
    session_.update();  // nobody is there yet
  } else if (headset_->focused() || played) {
    focused_ = true;
    room_.step(head_, hands, seconds_);
  } else {
    if (std::exchange(focused_, false)) room_.dropHands();
    session_.update();
  }
  if (waits_) session_.finish(), session_.update();
  const auto pulses = room_.takeHapticPulses();
  for (std::size_t side = 0; side < 2; ++side)
    for (const HapticPulse& pulse : pulses[side]) controllers_->vibrate(side, pulse), ++report_.pulses;
  report_.input.add(1000 * (monotonicSeconds() - sampled));

  bool drawn = false;
  if (frame->draw && views && seen_) {
    graphics_->makeCurrent();
    picture_->take(room_, head_, seconds_);
    report_.taken.add(1000 * (monotonicSeconds() - sampled));
    drawn = true;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const auto texture = headset_->acquire(eye);
      if (!texture) {
        drawn = false;
        continue;
      }
      eyes_[eye]->bind();
      picture_->draw((*views)[eye].eye, (*views)[eye].fov,
                     {.x = 0, .y = 0, .width = eyes_[eye]->width(), .height = eyes_[eye]->height()});
      eyes_[eye]->copyTo(*texture, headset_->format());
      glFlush();
      headset_->release(eye);
    }
    report_.drawn.add(1000 * (monotonicSeconds() - sampled));
  }
  headset_->end(*frame, drawn);
  report_.submitted.add(1000 * (monotonicSeconds() - sampled));
  ++report_.pictures;
  if (!drawn) ++report_.undrawn;
  if (session_.busy().settling) ++report_.whileDraping;
  graphics_->makeCurrent();
  if (drawn)
    for (const std::string& name : std::exchange(wanted_, {})) leavePictures(name);
  graphics_->mirror(drawn ? eyes_[0].get() : nullptr, title_);
  return true;
}

}  // namespace karinui::room
