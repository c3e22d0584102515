// Documents that come and go, files in and out.
#include "karinui/base/file.h"
#include "session/inside.h"

namespace karinui {

void Session::Inside::leave() {
  dropGesture();
  line.cancel(TaskLine::Kind::Preview);
  line.cancel(TaskLine::Kind::Glimpse);
  dropFigure();
  stopSettling();
  byItself.clear();
  amended.clear();
  ++documents;
}

void Session::Inside::longWork(std::function<Result<std::shared_ptr<Room>>(const Token&)> work, Message done) {
  leave();
  ++longWorks;
  line.add(TaskLine::Kind::Step, [this, work = std::move(work), done = std::move(done)](const Token& token) {
    Result<std::shared_ptr<Room>> made = work(token);
    const bool other = made && *made != room;
    if (other) room = *made;
    const auto fresh = std::make_shared<RoomState>(room->state(token));
    std::optional<Error> why;
    if (!made) why = made.error();
    return [this, other, why, fresh, done] {
      --longWorks;
      if (other) {
        ++documents;
        table = Table();
        selection = {};
        viewAsked = Command::ViewAll;
      }
      take(*fresh);
      if (why)
        tellError(*why);
      else
        tell(Notice::Kind::Said, done);
    };
  });
}

std::shared_ptr<Room> Session::Inside::roomOf(DocumentFile file, bool readOnly) {  // any thread
  auto made = std::make_shared<Room>(std::move(file), options, bodies, workers, readOnly);
  made->predicted = [this](FittingPtr fitting) {
    predicted.publish(std::move(fitting));
    if (options.wake) options.wake();
  };
  return made;
}

void Session::begin(DocumentFile file) {
  auto& in = *inside_;
  const auto made = in.roomOf(std::move(file), false);
  in.longWork([made](const Token&) -> Result<std::shared_ptr<Room>> { return made; }, {});
}

void Session::create(const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, path](const Token&) -> Result<std::shared_ptr<Room>> {
        auto file = DocumentFile::create(path);
        if (!file) return file.error();
        return in.roomOf(*std::move(file), false);
      },
      {});
}

void Session::open(const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, path](const Token& token) -> Result<std::shared_ptr<Room>> {
        // The one that is open here would refuse itself.
        if (std::error_code same;
            !in.room->file().path().empty() && std::filesystem::equivalent(in.room->file().path(), path, same))
          return in.room;
        MemoryBlobs none;
        Context how{*in.workers, token, none, *in.bodies, {}, {}};
        auto file = DocumentFile::open(path, &how);
        if (file) return in.roomOf(*std::move(file), false);
        if (file.error().kind != Error::Kind::Storage) return file.error();
        auto reading = DocumentFile::openForReading(path, &how);
        if (!reading) return file.error();
        return in.roomOf(*std::move(reading), true);
      },
      {});
}

void Session::saveAs(const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, path](const Token&) -> Result<std::shared_ptr<Room>> {
        if (const Done done = in.room->moveTo(path); !done) return done.error();
        return in.room;
      },
      say("Kept as “{0}”; every step is saved at once.", path.filename().string()));
}

void Session::replayOn(SetBody body, const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, body, path](const Token& token) -> Result<std::shared_ptr<Room>> {
        auto file = DocumentFile::create(path);
        if (!file) return file.error();
        const auto made = in.roomOf(*std::move(file), false);
        const auto give = [&](const Error& error) -> Result<std::shared_ptr<Room>> {
          made->file() = DocumentFile::inMemory();
          std::error_code trouble;
          std::filesystem::remove(path, trouble);
          return error;
        };
        if (const auto step = made->perform(body, token); !step) return give(step.error());
        const std::vector<Step> steps = in.room->file().steps();
        for (std::size_t i = 0; i < steps.size(); ++i) {
          token.progress(static_cast<double>(i) / static_cast<double>(steps.size()),
                         say("Sewing it for the new figure"));
          if (std::holds_alternative<SetBody>(steps[i].operation)) continue;
          if (const auto step = made->perform(steps[i].operation, token); !step)
            return give({step.error().kind, say("Step {0}: {1}", i + 1, step.error().what)});
        }
        return made;
      },
      say("Made again for the new figure, as “{0}”.", path.filename().string()));
}

void Session::importBody(const std::filesystem::path& file) {
  auto& in = *inside_;
  in.longWork(
      [&in, file](const Token& token) -> Result<std::shared_ptr<Room>> {
        std::vector<Message> notes;
        if (const Done done = importBodyInto(*in.room, file, token, notes); !done) return done.error();
        return in.room;
      },
      say("“{0}” was read.", file.filename().string()));
  in.viewAsked = Command::ViewAll;
}

void Session::importPattern(const std::filesystem::path& file) {
  auto& in = *inside_;
  in.longWork(
      [&in, file](const Token& token) -> Result<std::shared_ptr<Room>> {
        if (const Done done = importPatternInto(*in.room, file, token); !done) return done.error();
        return in.room;
      },
      say("“{0}” was read.", file.filename().string()));
}

void Session::exportTo(const std::filesystem::path& file, const ExportWish& wish) {
  auto& in = *inside_;
  in.line.add(TaskLine::Kind::Step,
              [this, fitting = in.state.fitting, steps = in.state.steps, file, wish](const Token&) -> TaskLine::Finish {
                const Result<std::string> bytes = exported(*fitting, steps, wish);
                const Done done = bytes ? writeFile(file, *bytes) : Done(bytes.error());
                return [this, done, file] {
                  if (done)
                    inside_->tell(Notice::Kind::Said, say("“{0}” was written.", file.string()));
                  else
                    inside_->tellError(done.error());
                };
              });
}

}  // namespace karinui
