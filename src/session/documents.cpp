// Documents that come and go, files in and out.
#include <algorithm>

#include "karinui/base/file.h"
#include "karinui/design/share.h"
#include "session/session_impl.h"

namespace karinui {

void Session::Impl::leave() {
  dropGesture();
  tasks.cancel(TaskQueue::Kind::Preview);
  tasks.cancel(TaskQueue::Kind::SnapshotAfter);
  dropFigure();
  stopSettling();
  schedule.forgetSteps();
  amended.clear();
  ++documents;
}

void Session::Impl::longWork(std::function<Result<std::shared_ptr<DocumentWorker>>(const Token&)> work, Message done,
                             std::shared_ptr<std::vector<Message>> notes, std::function<void(const Error&)> refused,
                             std::function<void()> taken) {
  leave();
  ++longWorks;
  tasks.add(TaskQueue::Kind::Step, [this, work = std::move(work), done = std::move(done), notes,
                                    refused = std::move(refused), taken = std::move(taken)](const Token& token) {
    Result<std::shared_ptr<DocumentWorker>> made = work(token);
    const bool other = made && *made != documentWorker;
    if (other) documentWorker = *made;
    const auto fresh = std::make_shared<DocumentState>(documentWorker->state(token));
    std::optional<Error> why;
    if (!made) why = made.error();
    std::vector<Message> remarks;
    if (other) remarks = documentWorker->file().remarks();
    return [this, other, why, fresh, done, remarks, notes, refused, taken] {
      --longWorks;
      if (other) {
        ++documents;
        table = TableLayout();
        selection = {};
        viewAsked = Command::ViewAll;
      }
      take(*fresh);
      if (why && refused) refused(*why);
      if (!why && taken) taken();
      if (why)
        tellError(*why);
      else
        tell(Notice::Kind::Said, done);
      if (!why && notes)
        for (const Message& note : *notes) tell(Notice::Kind::Said, note);
      for (const Message& remark : remarks) tell(Notice::Kind::Said, remark);
    };
  });
}

std::shared_ptr<DocumentWorker> Session::Impl::workerOf(DocumentFile file, bool readOnly) {  // any thread
  auto made = std::make_shared<DocumentWorker>(std::move(file), options, bodies, workers, readOnly);
  made->predicted = [this](SnapshotPtr snapshot) {
    predicted.publish(std::move(snapshot));
    if (options.wake) options.wake();
  };
  return made;
}

void Session::begin(DocumentFile file) {
  auto& in = *impl_;
  const auto made = in.workerOf(std::move(file), false);
  in.longWork([made](const Token&) -> Result<std::shared_ptr<DocumentWorker>> { return made; }, {});
}

void Session::create(const std::filesystem::path& path) {
  auto& in = *impl_;
  in.longWork(
      [&in, path](const Token&) -> Result<std::shared_ptr<DocumentWorker>> {
        auto file = DocumentFile::create(path);
        if (!file) return file.error();
        return in.workerOf(*std::move(file), false);
      },
      {});
}

void Session::open(const std::filesystem::path& path) {
  auto& in = *impl_;
  in.longWork(
      [&in, path](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        // The one that is open here would refuse itself.
        if (std::error_code same; !in.documentWorker->file().path().empty() &&
                                  std::filesystem::equivalent(in.documentWorker->file().path(), path, same))
          return in.documentWorker;
        MemoryBlobs none;
        Context how{*in.workers, token, none, *in.bodies, {}, {}};
        auto file = DocumentFile::open(path, &how);
        if (file) return in.workerOf(*std::move(file), false);
        if (file.error().kind != Error::Kind::Storage) return file.error();
        auto reading = DocumentFile::openForReading(path, &how);
        if (!reading) return file.error();
        return in.workerOf(*std::move(reading), true);
      },
      {}, {},
      [&in, path](const Error& why) {
        if (why.kind == Error::Kind::Damaged) in.damaged = path;
      });
}

std::optional<std::filesystem::path> Session::takeDamaged() { return std::exchange(impl_->damaged, std::nullopt); }

void Session::rescueTo(const std::filesystem::path& damaged, const std::filesystem::path& to) {
  auto& in = *impl_;
  const auto notes = std::make_shared<std::vector<Message>>();
  in.longWork(
      [&in, damaged, to, notes](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        token.progress(0, say("Saving what is whole"));
        MemoryBlobs none;
        Context how{*in.workers, token, none, *in.bodies, {}, {}};
        const auto rescued = rescue(damaged, to, how);
        if (!rescued) return rescued.error();
        notes->push_back(rescuedSaid(*rescued));
        notes->insert(notes->end(), rescued->remarks.begin(), rescued->remarks.end());
        auto file = DocumentFile::open(to, &how);
        if (!file) return file.error();
        return in.workerOf(*std::move(file), false);
      },
      say("“{0}” was written.", to.string()), notes);
}

void Session::saveAs(const std::filesystem::path& path) {
  auto& in = *impl_;
  in.longWork(
      [&in, path](const Token&) -> Result<std::shared_ptr<DocumentWorker>> {
        if (const Done done = in.documentWorker->moveTo(path); !done) return done.error();
        return in.documentWorker;
      },
      say("Kept as “{0}”; every step is saved at once.", path.filename().string()));
}

void Session::replayOn(SetBody body, const std::filesystem::path& path) {
  auto& in = *impl_;
  in.longWork(
      [&in, body, path](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        auto file = DocumentFile::create(path);
        if (!file) return file.error();
        const auto made = in.workerOf(*std::move(file), false);
        const auto give = [&](const Error& error) -> Result<std::shared_ptr<DocumentWorker>> {
          made->file() = DocumentFile::inMemory();
          std::error_code trouble;
          std::filesystem::remove(path, trouble);
          return error;
        };
        if (const auto step = made->perform(body, token); !step) return give(step.error());
        const std::vector<Step> steps = in.documentWorker->file().steps();
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

void Session::importBody(const std::filesystem::path& file, bool wrap) {
  auto& in = *impl_;
  const auto notes = std::make_shared<std::vector<Message>>();
  const auto open = std::make_shared<bool>(false);
  in.longWork(
      [&in, file, wrap, notes, open](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        BodyReadOptions options;
        options.wrap = wrap;
        options.open = open.get();
        if (const Done done = importBodyInto(*in.documentWorker, file, options, token, *notes); !done)
          return done.error();
        return in.documentWorker;
      },
      say("“{0}” was read.", file.filename().string()), notes,
      [&in, file, open](const Error&) {
        if (*open) in.openBody = file;
      });
  in.viewAsked = Command::ViewAll;
}

std::optional<std::filesystem::path> Session::takeOpenBody() { return std::exchange(impl_->openBody, std::nullopt); }

void Session::importPrint(const std::filesystem::path& file, SetLook look) {
  auto& in = *impl_;
  in.longWork(
      [&in, file, look](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        if (const Done done = importPrintInto(*in.documentWorker, file, look, token); !done) return done.error();
        return in.documentWorker;
      },
      say("“{0}” was read.", file.filename().string()));
}

namespace {

// Left of all that lies on the table, where no new piece comes to lie.
std::optional<Flat> besideAll(const Document& document, const TableLayout& table) {
  constexpr double kGap = 0.08;  // metres
  std::optional<Flat> corner;
  const auto add = [&](Flat place) {
    if (!corner) corner = place;
    corner = Flat{std::min(corner->u, place.u), std::max(corner->v, place.v)};
  };
  for (const auto& [id, piece] : document.pattern.pieces)
    for (const Flat place : piece->outline.flattened(1e-3)) add(place + table.at(id));
  for (const auto& [name, scan] : document.underlays)
    for (const Flat pixel : {Flat{0, 0}, Flat{double(scan.wide), 0}, Flat{double(scan.wide), double(scan.high)},
                             Flat{0, double(scan.high)}})
      add(scan.onTable(pixel));
  if (corner) corner->u -= kGap;
  return corner;
}

}  // namespace

void Session::importScan(const std::filesystem::path& file) {
  auto& in = *impl_;
  const std::optional<Flat> corner = besideAll(in.state.snapshot->document, in.table);
  const auto notes = std::make_shared<std::vector<Message>>();
  in.longWork(
      [&in, file, notes, corner](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        if (const Done done = importScanInto(*in.documentWorker, file, token, corner, *notes); !done)
          return done.error();
        return in.documentWorker;
      },
      say("“{0}” lies under the pattern. With the tool Trace, click two places on it and say how far apart they are.",
          file.filename().string()),
      notes);
}

void Session::importPattern(const std::filesystem::path& file) {
  auto& in = *impl_;
  const auto notes = std::make_shared<std::vector<Message>>();
  const auto guessed = std::make_shared<std::optional<GuessedUnit>>();
  in.longWork(
      [&in, file, notes, guessed](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        if (const Done done = importPatternInto(*in.documentWorker, file, token, *notes, guessed.get()); !done)
          return done.error();
        return in.documentWorker;
      },
      say("“{0}” was read.", file.filename().string()), notes, {}, [&in, guessed] { in.guessedUnit = *guessed; });
}

std::optional<GuessedUnit> Session::takeGuessedUnit() { return std::exchange(impl_->guessedUnit, std::nullopt); }

void Session::readAgain(const GuessedUnit& guessed, const std::string& unit) {
  auto& in = *impl_;
  const auto notes = std::make_shared<std::vector<Message>>();
  in.longWork(
      [&in, guessed, unit, notes](const Token& token) -> Result<std::shared_ptr<DocumentWorker>> {
        if (const Done done = readAgainIn(*in.documentWorker, guessed, unit, token, *notes); !done) return done.error();
        return in.documentWorker;
      },
      say("“{0}” was read.", guessed.file.filename().string()), notes);
}

void Session::exportTo(const std::filesystem::path& file, const ExportWish& wish) {
  auto& in = *impl_;
  in.tasks.add(
      TaskQueue::Kind::Step,
      [this, snapshot = in.state.snapshot, steps = in.state.steps, file, wish](const Token&) -> TaskQueue::Finish {
        const auto bytes = exportedTo(file, *snapshot, steps, wish);
        const Done done = bytes ? Done() : Done(bytes.error());
        return [this, done, file] {
          if (done)
            impl_->tell(Notice::Kind::Said, say("“{0}” was written.", file.string()));
          else
            impl_->tellError(done.error());
        };
      });
}

void Session::shareTo(const std::filesystem::path& file, SharedNames names) {
  auto& in = *impl_;
  in.tasks.add(TaskQueue::Kind::Step, [this, file, names](const Token& token) -> TaskQueue::Finish {
    MemoryBlobs none;
    Context how{*impl_->workers, token, none, *impl_->bodies, {}, {}};
    const auto shared = share(impl_->documentWorker->file(), file, how, names);
    return [this, shared, file] {
      if (!shared) return impl_->tellError(shared.error());
      impl_->tell(Notice::Kind::Said, say("“{0}” was written.", file.string()));
      impl_->tell(Notice::Kind::Said, sharedSaid(*shared));
      for (const Message& note : shared->notes) impl_->tell(Notice::Kind::Advice, note);
    };
  });
}

}  // namespace karinui
