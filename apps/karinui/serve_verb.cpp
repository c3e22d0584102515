// serve: one document after another, worked on by another program over lines of JSON (docs/format/serve.md). Requests
// come on stdin, answers and progress go out on stdout; nothing else is listened to.
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <thread>
#include <utility>

#include "examination.h"
#include "json_answers.h"
#include "karinui/base/error_name.h"
#include "karinui/base/file.h"
#include "karinui/design/drape.h"
#include "karinui/design/script.h"
#include "karinui/exchange/formats.h"
#include "karinui/pattern/truing.h"
#include "outputs.h"
#include "pictures.h"
#include "serve_request.h"
#include "written_files.h"

namespace karinui::app {

namespace {

struct ServeOptions {};

constexpr std::size_t kLongestLine = 16 << 20;             // bytes of one request
constexpr auto kBetween = std::chrono::milliseconds(100);  // two lines of progress

// The lines of stdin. A line that is too long is left out, and told as nothing.
class InputLines {
 public:
  // False at the end of the input. `line` is empty where it was too long.
  bool next(std::optional<std::string>& line) {
    line.emplace();
    for (;;) {
      const std::size_t end = have_.find('\n');
      if (line) line->append(have_, 0, end);
      if (line && line->size() > kLongestLine) line.reset();
      if (end != std::string::npos) return have_.erase(0, end + 1), true;
      const bool begun = !line || !line->empty();
      have_.resize(1 << 16);
      ssize_t got = 0;
      do got = ::read(STDIN_FILENO, have_.data(), have_.size());
      while (got < 0 && errno == EINTR);
      have_.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
      if (got <= 0) return begun;
    }
  }

 private:
  std::string have_;
};

class Server {
 public:
  explicit Server(Program& program) : program_(program) {
    program_.console.keepNotes([this](const Message& note) { notes_.push_back(program_.console.said(note)); });
  }

  int run() {
    std::thread reader([this] { read(); });
    while (const std::optional<Result<Json>> request = next()) answer(*request);
    reader.join();
    return kDone;
  }

 private:
  // --- the reading thread: requests are queued, but for stop, which is about the one under way
  void read() {
    InputLines lines;
    for (std::optional<std::string> line; lines.next(line);) {
      if (line && line->find_first_not_of(" \t\r") == std::string::npos) continue;
      Result<Json> request = line ? parseRequest(*line) : notARequest();
      if (request && request->value("do", Json()) == "stop") {
        write({{"id", request->value("id", Json())}, {"stopping", stopNow()}});
        continue;
      }
      const std::lock_guard lock(mutex_);
      queue_.push_back(std::move(request));
      some_.notify_one();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    some_.notify_one();
  }
  bool stopNow() {
    const std::lock_guard lock(mutex_);
    if (!token_) return stopsNext_ = taken_ || !queue_.empty();  // it has not begun yet
    if (!stop_ || !stop_->ask()) token_->cancel();
    return true;
  }

  // --- the working thread
  std::optional<Result<Json>> next() {
    std::unique_lock lock(mutex_);
    some_.wait(lock, [this] { return ended_ || !queue_.empty(); });
    if (queue_.empty()) return std::nullopt;
    Result<Json> request = std::move(queue_.front());
    queue_.pop_front();
    taken_ = true;
    return request;
  }

  void write(const Json& object) {
    const std::string line = object.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    const std::lock_guard lock(writing_);
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fflush(stdout);
  }

  void answer(const Result<Json>& request) {
    const Json id = request ? request->value("id", Json()) : Json();
    auto told = std::chrono::steady_clock::time_point();
    Token token([&](double fraction, const Message& doing) {
      const auto now = std::chrono::steady_clock::now();
      if (now - told < kBetween) return;
      told = now;
      write({{"id", id}, {"progress", fraction}, {"doing", program_.console.said(doing)}});
    });
    StopRequest stop;
    notes_.clear();
    underWay(&token, &stop);
    Result<Json> done = request ? perform(*request, token, stop) : request.error();
    underWay(nullptr, nullptr);
    if (opened_) opened_->tellRemarks();
    Json line = {{"id", id}};
    if (done)
      line.update(*done);
    else
      line["error"] = program_.console.said(done.error().what), line["kind"] = errorName(done.error().kind);
    if (!notes_.empty()) line["notes"] = notes_;
    write(line);
  }
  void underWay(Token* token, StopRequest* stop) {
    const std::lock_guard lock(mutex_);
    token_ = token, stop_ = stop, taken_ = false;
    if (token && std::exchange(stopsNext_, false) && !stop->ask()) token->cancel();
  }
  Result<Json> perform(const Json& request, const Token& token, StopRequest& stop) {
    Fields fields(request);
    const std::string what = fields.needed("do");
    if (opened_) opened_->listenTo(token);
    if (what == "open") return open(fields, token);
    if (what == "create") return create(fields, token);
    const auto row =
        std::find_if(std::begin(kRequests), std::end(kRequests), [&](const Request& r) { return r.name == what; });
    if (row == std::end(kRequests)) {
      if (const Done fit = fields.checked(); !fit && what.empty()) return fit.error();
      std::string all = "open, create, stop";
      for (const Request& r : kRequests) all += ", " + std::string(r.name);
      return badInput(say("There is no request “{0}”; there are: {1}.", what, all));
    }
    if (!opened_) return refused(say("No document is open; begin with {0}", kRequestExample));
    return (this->*row->work)(fields, stop);
  }

  Result<Json> begin(Result<DocumentFile> file, const Token& token) {
    if (!file) return file.error();
    opened_.emplace(program_, *std::move(file));
    opened_->listenTo(token);
    return state();
  }
  Result<Json> open(Fields& fields, const Token& token) {
    const std::string path = fields.needed("file");
    const bool reading = fields.flag("reading");
    if (const Done fit = fields.checked(); !fit) return fit.error();
    // A refused request leaves what is open; only the very same file is closed first, for it is locked.
    std::error_code trouble;
    if (opened_ && std::filesystem::equivalent(opened_->file().path(), path, trouble)) opened_.reset();
    return begin(reading ? DocumentFile::openForReading(path) : DocumentFile::open(path), token);
  }
  Result<Json> create(Fields& fields, const Token& token) {
    const std::string path = fields.text("file");
    if (const Done fit = fields.checked(); !fit) return fit.error();
    return begin(path.empty() ? DocumentFile::inMemory() : DocumentFile::create(path), token);
  }
  Json state() {
    const Document& document = opened_->document();
    return {{"document", opened_->file().path().string()},
            {"operations", document.operations},
            {"undone", opened_->file().undone().size()},
            {"hash", hash(document)},
            {"drape_hash", drapeHash(document)}};
  }

  Result<Json> operation(Fields& fields, StopRequest& stop) {
    const std::string line = fields.needed("operation");
    if (const Done fit = fields.checked(); !fit) return fit.error();
    Result<Operation> operation = parseOperation(line);
    if (!operation) return operation.error();
    opened_->context().stop = &stop;
    const Result<Step> step = opened_->perform(*std::move(operation));
    opened_->context().stop = nullptr;
    return step ? Result<Json>(stepJson(*step, opened_->document())) : step.error();
  }
  template <Result<Step> (DocumentFile::*turn)(Context&)>
  Result<Json> turned(Fields& fields, StopRequest&) {
    if (const Done fit = fields.checked(); !fit) return fit.error();
    const Result<Step> step = (opened_->file().*turn)(opened_->context());
    if (!step) return step.error();
    Json answer = state();
    answer["operation"] = text(step->operation);
    return answer;
  }
  Result<Json> amended(Fields& fields, StopRequest&) {
    const auto which = fields.number("step", 1, 1e6);
    const std::string line = fields.needed("operation");
    if (const Done fit = fields.checked(); !fit) return fit.error();
    auto operation = parseOperation(line);
    if (!operation) return operation.error();
    const Done done = opened_->amend(static_cast<std::size_t>(which.value_or(0)), *std::move(operation));
    return done ? Result<Json>(state()) : done.error();
  }
  Result<Json> settle(Fields& fields, StopRequest& stop) {
    const bool again = fields.flag("again");
    if (const Done fit = fields.checked(); !fit) return fit.error();
    const Result<Settled> settled = app::settle(*opened_, stop, again);
    if (!settled) return settled.error();
    Json answer = settleJson(*opened_->document().drape.last, settled->check, program_.console);
    answer["kept"] = settled->kept;
    return answer;
  }
  Result<Json> check(Fields& fields, StopRequest&) {
    if (const Done fit = fields.checked(); !fit) return fit.error();
    const Result<Examination> found = examined(opened_->document(), opened_->context());
    if (!found) return found.error();
    Json answer = checkJson(*found, opened_->document(), program_.console);
    const Json prints = printsJson(opened_->document(), photosIn(opened_->file().blobs()));
    if (!prints.empty()) answer["prints"] = prints;
    return answer;
  }
  Result<Json> info(Fields& fields, StopRequest&) {
    if (const Done fit = fields.checked(); !fit) return fit.error();
    return infoJson(opened_->document());
  }
  Result<Json> truing(Fields& fields, StopRequest&) {
    if (const Done fit = fields.checked(); !fit) return fit.error();
    const Document& document = opened_->document();
    return truingJson(document, karinui::truing(document.pattern, document.eases));
  }
  Result<Json> log(Fields& fields, StopRequest&) {
    if (const Done fit = fields.checked(); !fit) return fit.error();
    return Json{{"log", opened_->file().log()}};
  }
  Result<Json> measure(Fields& fields, StopRequest&) {
    if (const Done fit = fields.checked(); !fit) return fit.error();
    const Result<BodyPtr> body = bodyOf(opened_->document(), opened_->context());
    if (!body) return body.error();
    return bodyJson((*body)->measured(), inspect((*body)->mesh()));  // in its own pose
  }
  Result<Json> fit(Fields& fields, StopRequest&) {
    if (const Done asked = fields.checked(); !asked) return asked.error();
    const Result<Fit> found = fitOf(*opened_);
    return found ? Result<Json>(fitJson(found->girths, found->pressure)) : found.error();
  }
  Result<Json> exported(Fields& fields, StopRequest&) {
    ExportRequest request;
    request.out = fields.needed("file");
    request.paper = fields.text("paper");
    request.format = fields.text("format");
    request.date = fields.text("date");
    request.poses = fields.text("poses");
    request.nest = fields.flag("nest");
    request.pairsOnce = fields.flag("pairs_once");
    request.allowanceMm = fields.number("allowance_mm", 0, 100);
    request.overlapMm = fields.number("overlap_mm", 5, 30);
    if (const Done fit = fields.checked(); !fit) return fit.error();
    if (const Done may = mayWrite(request.out, endingsWritten(), {opened_->file().path().string()}); !may)
      return may.error();
    const Result<std::size_t> bytes = exportFile(*opened_, request);
    if (!bytes) return bytes.error();
    return Json{{"file", request.out}, {"bytes", *bytes}};
  }
  Result<Json> picture(Fields& fields, StopRequest&) {
    PictureRequest request;
    const std::string out = fields.needed("file");
    request.view = fields.text("view", request.view);
    request.map = fields.text("map", request.map);
    request.eyes = fields.text("eyes", request.eyes);
    request.size = fields.text("size", request.size);
    request.hide = fields.text("hide");
    request.section = fields.text("section");
    request.table = fields.flag("table");
    request.nest = fields.flag("nest");
    request.scans = fields.flag("scans");
    request.compare.sizes = fields.flag("sizes");
    request.compare.fabrics = fields.text("fabrics");
    const std::string beside = fields.text("beside");
    if (!beside.empty()) request.compare.beside = {beside};
    if (const auto turns = fields.number("turns", 2, 36)) request.turns = static_cast<int>(*turns);
    if (const Done fit = fields.checked(); !fit) return fit.error();
    if (const Done may = mayWrite(out, {"png"}, {opened_->file().path().string(), beside}); !may) return may.error();
    const Result<Image> image = pictureOf(*opened_, request);
    if (!image) return image.error();
    if (const Done done = writePng(out, *image); !done) return done.error();
    return Json{{"file", out}, {"width", image->width}, {"height", image->height}};
  }
  Result<Json> close(Fields& fields, StopRequest&) {
    if (const Done fit = fields.checked(); !fit) return fit.error();
    opened_.reset();
    return Json{{"closed", true}};
  }

  struct Request {
    std::string_view name;
    Result<Json> (Server::*work)(Fields&, StopRequest&);
  };
  static const Request kRequests[14];

  Program& program_;
  std::optional<OpenDocument> opened_;
  std::vector<std::string> notes_;  // of the request under way
  std::mutex writing_;              // guards stdout

  std::mutex mutex_;  // guards all below
  std::condition_variable some_;
  std::deque<Result<Json>> queue_;
  bool ended_ = false;
  Token* token_ = nullptr;  // of the request under way
  StopRequest* stop_ = nullptr;
  bool taken_ = false, stopsNext_ = false;  // a request is about to be worked at; it is to be stopped
};

const Server::Request Server::kRequests[14] = {{"perform", &Server::operation},
                                               {"undo", &Server::turned<&DocumentFile::undo>},
                                               {"redo", &Server::turned<&DocumentFile::redo>},
                                               {"amend", &Server::amended},
                                               {"settle", &Server::settle},
                                               {"check", &Server::check},
                                               {"info", &Server::info},
                                               {"truing", &Server::truing},
                                               {"log", &Server::log},
                                               {"measure", &Server::measure},
                                               {"fit", &Server::fit},
                                               {"export", &Server::exported},
                                               {"picture", &Server::picture},
                                               {"close", &Server::close}};

int runServe(Program& program, const ServeOptions&) { return Server(program).run(); }

}  // namespace

void addServeVerb(Program& program) {
  auto options = std::make_shared<ServeOptions>();
  CLI::App* verb = Program::word(
      program.cli, "serve", help("Answers requests of another program: lines of JSON, in on stdin, out on stdout"));
  verb->callback([&program, options] { program.exit = runServe(program, *options); });
  verb->footer(help("Requests and answers: docs/format/serve.md"));
}

}  // namespace karinui::app
