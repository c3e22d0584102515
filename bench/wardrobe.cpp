#include "bench/wardrobe.h"

#include <algorithm>
#include <ctime>

#include "karinui/base/file.h"
#include "karinui/design/drape.h"
#include "karinui/design/script.h"

namespace karinui::bench {
namespace {

namespace fs = std::filesystem;

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The time of one garment. A drape is stopped where it is once the time is up; what cannot be stopped so (a pull) is
// cancelled.
class Deadline {
 public:
  Deadline(double seconds, const Token& outer) : seconds_(seconds), outer_(outer) {}
  double spent() const { return processorSeconds() - start_; }
  bool passed() const { return passed_; }
  const Token& token() const { return token_; }
  StopRequest& stop() { return stop_; }
  bool outerCancelled() const { return outer_.cancelled(); }
  void stoppable(bool drapes) { stoppable_ = drapes; }

 private:
  void look(double fraction, const Message& doing) {
    outer_.progress(fraction, doing);
    if (outer_.cancelled()) token_.cancel();
    if (spent() < seconds_) return;
    passed_ = true;
    if (stoppable_)
      stop_.ask();
    else
      token_.cancel();
  }
  double seconds_, start_ = processorSeconds();
  const Token& outer_;
  bool passed_ = false, stoppable_ = false;
  StopRequest stop_;
  Token token_{[this](double fraction, const Message& doing) { look(fraction, doing); }};
};

struct Draping {
  WardrobeGarment& garment;
  Deadline& deadline;
  bool continued = false;

  Result<DrapeOutcome> operator()(const Document& document, const DrapePieces& drape, Context& context) const {
    deadline.stoppable(true);
    auto outcome = drapeOnBody(document, drape, context, {}, continued);
    deadline.stoppable(false);
    if (outcome) add(outcome->report);
    return outcome;
  }
  Result<DrapeOutcome> operator()(const Document& document, const PullCloth& pull, Context& context) const {
    auto outcome = pullOnBody(document, pull, context);
    if (outcome) add(outcome->report);
    return outcome;
  }
  void add(const SettleReport& report) const {
    ++garment.drapes;
    garment.steps += report.steps;
    garment.cpuSeconds += report.cpuSeconds;
    garment.report = report;
  }
};

Result<Document> drafted(const std::string& script, Context& context) {
  const auto lines = parseScript(script);
  if (!lines) return lines.error();
  Document document;
  for (const ScriptLine& line : *lines) {
    auto after = apply(document, line.operation, context);
    if (!after) return Error{after.error().kind, say("Line {0}: {1}", line.number, after.error().what)};
    document = *std::move(after);
  }
  return document;
}

}  // namespace

Result<std::vector<fs::path>> scriptsIn(const fs::path& folder) {
  std::error_code trouble;
  std::vector<fs::path> scripts;
  for (fs::directory_iterator at(folder, trouble), end; !trouble && at != end; at.increment(trouble))
    if (at->path().extension() == ".ops") scripts.push_back(at->path());
  if (trouble)
    return notFound(say("The folder “{0}” of garments cannot be read: {1}. Say another by --scripts.", folder.string(),
                        trouble.message()));
  if (scripts.empty())
    return notFound(say("No script (.ops) lies in “{0}”. Say another folder by --scripts.", folder.string()));
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

Result<WardrobeGarment> drapeScript(const fs::path& script, const WardrobeSettings& settings, Workers& workers,
                                    const Token& token) {
  WardrobeGarment garment;
  garment.name = script.stem().string();
  const auto text = readFile(script.string());
  if (!text) return text.error();
  Deadline deadline(settings.seconds, token);
  MemoryBlobs blobs;
  Bodies bodies;
  Draping draping{garment, deadline};
  Context context{workers, deadline.token(), blobs, bodies, draping, draping};
  context.stop = &deadline.stop();
  const auto refused = [&](const Error& why) -> Result<WardrobeGarment> {
    if (deadline.outerCancelled()) return why;
    garment.outOfTime = deadline.passed();
    garment.refused = garment.outOfTime ? say("Not drafted in {0} s of processor time.", settings.seconds) : why.what;
    return garment;
  };
  auto document = drafted(*text, context);
  if (!document) return refused(document.error());
  const bool atRest = document->atRest();
  garment.draftSeconds = deadline.spent() - garment.cpuSeconds;
  garment.outOfTime = deadline.passed();
  if (!atRest && !deadline.passed()) {
    draping.continued = settings.continued;
    context.drape = draping;
    document = apply(*document, DrapePieces{}, context);
    if (!document) return refused(document.error());
    garment.outOfTime = garment.report.stoppedAfter > 0;
  }
  garment.settled = garment.report.settled && document->drape.dirty.empty();
  const auto found = examined(*document, context);
  if (!found) return refused(found.error());
  garment.check = *found;
  return garment;
}

}  // namespace karinui::bench
