// The module for Python. Thin: documents, operations as text, answers as dictionaries, arrays without copies. Work is
// done without Python's lock; a document does one thing at a time, whichever threads ask.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>

#include "karinui/base/error_name.h"
#include "karinui/base/file.h"
#include "karinui/base/threads.h"
#include "karinui/base/version.h"
#include "karinui/design/drape.h"
#include "karinui/design/dump.h"
#include "karinui/design/lay_plan.h"
#include "karinui/design/make_up.h"
#include "karinui/design/script.h"
#include "karinui/design/share.h"
#include "karinui/design/steps_of.h"
#include "karinui/exchange/lay_sheet.h"
#include "karinui/exchange/read_pattern.h"
#include "karinui/session/animation.h"
#include "karinui/session/export.h"
#include "karinui/session/fit_in_motion.h"
#include "karinui/session/fit_over_bodies.h"
#include "karinui/session/table_frame_of.h"
#include "karinui/session/view_cut.h"
#include "karinui/view/line_up.h"
#include "karinui/view/table_picture.h"
#include "values.h"

namespace py = pybind11;

namespace {

using namespace karinui;

// As karinui export is asked, in metres.
struct PaperAsked {
  std::string format, paper, date;
  std::optional<double> overlap, allowance;
  bool nest = false, pairsOnce = false;
};

// What was asked of a file belongs to its ending.
Done fits(const PaperAsked& asked, const std::vector<std::string>& poses, const FileFormat& format,
          const std::string& file) {
  const bool sheet = format.out == FileContent::Sheet, pages = format.id.starts_with("pdf");
  const bool cut = sheet || format.id == "karinui" || format.id.starts_with("dxf");
  if (!asked.format.empty() && format.id != asked.format)
    return badInput(say("“{0}” is no format of {1}.", asked.format, file));
  if (!poses.empty() && format.id != "glb") return badInput(say("Only a GLB goes through poses."));
  for (const auto& [name, given, holds] : {std::tuple("paper", !asked.paper.empty(), pages),
                                           {"overlap", asked.overlap.has_value(), pages},
                                           {"date", !asked.date.empty(), sheet},
                                           {"nest", asked.nest, sheet},
                                           {"pairs_once", asked.pairsOnce, isPaper(format)},
                                           {"allowance", asked.allowance.has_value(), cut}})
    if (given && !holds)
      return badInput(say("{0} says nothing of “{1}”; leave it out, or choose another ending.", name, file));
  const auto within = [](std::optional<double> length, double least, double most) {
    return !length || (*length >= least && *length <= most);
  };
  if (!within(asked.overlap, 0.005, 0.03)) return badInput(say("Pages overlap by 5 to 30 mm: 0.005 to 0.03."));
  if (!within(asked.allowance, 0, 0.1)) return badInput(say("A seam allowance is 0 to 100 mm: 0 to 0.1."));
  return {};
}

// As karinui picture is asked.
struct PictureWish : PictureWords {
  std::string hide, section;
  bool table = false, nest = false, scans = false;
  int turns = 0;
};

struct PythonForm {
  std::shared_ptr<const Form> form;
};
struct PythonPiece {
  std::shared_ptr<const Piece> piece;
  bool draped = false;
};
struct PythonBody {
  BodyPtr body;
};

class PythonDocument {
 public:
  PythonDocument(DocumentFile file, int threads)
      : file_(std::move(file)), workers_(threads > 0 ? threads : usualThreads()) {}

  // Does `work` on the document, without Python's lock; nobody else works on it meanwhile.
  template <class Work>
  auto alone(Work&& work, const py::object& progress = py::none()) {
    std::exception_ptr raised;
    Token* mine = nullptr;
    Token token([&](double fraction, const Message& doing) {
      const py::gil_scoped_acquire lock;
      if (raised) return;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // Ctrl-C
        if (!progress.is_none()) progress(fraction, text(doing));
      } catch (py::error_already_set&) {
        raised = std::current_exception();
        mine->cancel();
      }
    });
    mine = &token;
    const auto done = [&] {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      if (closed_) throw Failure{refused(say("This document is closed; open it again with Document.open."))};
      Context context{workers_, token, file_.blobs(), bodies_, {}, {}};
      context.advise = [this](const Advice& advice) { notes_.push_back(text(advice.what)); };
      return work(file_, context);
    }();
    if (raised) std::rethrow_exception(raised);
    return good(done);
  }

  py::dict perform(const std::string& line, const py::object& progress) {
    const Step step = alone(
        [&](DocumentFile& file, Context& context) -> Result<Step> {
          notes_.clear();
          auto operation = parseOperation(line);
          return operation ? file.perform(*std::move(operation), context) : operation.error();
        },
        progress);
    return stepDict(step);
  }
  void amend(std::size_t which, const std::string& line, const py::object& progress) {
    alone(
        [&](DocumentFile& file, Context& context) -> Result<bool> {
          notes_.clear();
          auto operation = parseOperation(line);
          if (!operation) return operation.error();
          const Done done = file.amend(which, *std::move(operation), context);
          return done ? Result<bool>(true) : done.error();
        },
        progress);
  }
  std::size_t play(const std::string& script, const py::object& progress) {
    return alone(
        [&](DocumentFile& file, Context& context) -> Result<std::size_t> {
          notes_.clear();
          const auto lines = parseScript(script);
          if (!lines) return lines.error();
          for (const ScriptLine& line : *lines)
            if (const auto step = file.perform(line.operation, context); !step)
              return Error{step.error().kind, say("Line {0}: {1}", line.number, step.error().what)};
          return lines->size();
        },
        progress);
  }
  template <Result<Step> (DocumentFile::*turn)(Context&)>
  py::dict turned() {
    return stepDict(alone([](DocumentFile& file, Context& context) { return (file.*turn)(context); }));
  }
  py::dict settle(bool again, const py::object& progress) {
    using Found = std::tuple<SettleReport, ClothCheck, bool>;
    const auto [report, check, kept] = alone(
        [&](DocumentFile& file, Context& context) -> Result<Found> {
          const bool rests = file.document().atRest() && !again;
          if (!rests)
            if (const auto step = file.perform(DrapePieces{}, context); !step) return step.error();
          const auto found = examined(file.document(), context);
          return found ? Result<Found>(Found(*file.document().drape.last, *found, rests)) : found.error();
        },
        progress);
    py::dict d = checkDict(check);
    d["settled"] = report.settled, d["why"] = text(report.why), d["residual"] = report.residual;
    d["steps"] = report.steps, d["solves"] = report.solves, d["kept"] = kept;
    return d;
  }
  py::dict check() {
    using Found = std::tuple<Examination, std::optional<SettleReport>, bool>;
    const auto [found, last, rests] = alone([](DocumentFile& file, Context& context) -> Result<Found> {
      auto examination = examined(file.document(), context);
      if (!examination) return examination.error();
      const Document& document = file.document();
      return Found(*std::move(examination), document.drape.last, document.atRest());
    });
    py::dict d = checkDict(found);
    d["at_rest"] = rests;
    if (last) d["settled"] = last->settled, d["why"] = text(last->why);
    d["fastenings"] = fasteningsList(found);
    return d;
  }
  py::dict fit() {
    using Found = std::pair<std::vector<Girths>, std::optional<PressureReport>>;
    const auto [girths, pressure] = alone([](DocumentFile& file, Context& context) -> Result<Found> {
      const auto body = bodyOf(file.document(), context);
      if (!body) return body.error();
      const SnapshotPtr garment = snapshotOf(file.document(), *body);
      return Found(girthsOf(*garment), pressureReport(pressureOnBody(*garment, context.workers)));
    });
    py::dict d;
    d["girths"] = girthsDict(girths);
    if (pressure) d["pressure_mean_pa"] = pressure->mean, d["pressure_p99_pa"] = pressure->p99;
    return d;
  }
  py::list motion(const std::vector<std::string>& poses, const py::object& progress) {
    const auto fits = alone(
        [&](DocumentFile& file, Context& context) { return fitInMotion(file.document(), poses, context); }, progress);
    static constexpr std::array<const char*, kOpenEdges.size()> kEdges{"neck_m", "waist_m", "hem_m", "cuff_m"};
    py::list all;
    for (const FitInPose& fit : fits) {
      py::dict d, slid;
      d["pose"] = fit.name, d["settled"] = fit.settled;
      if (fit.refused) {
        d["refused"] = text(*fit.refused);
        all.append(d);
        continue;
      }
      d["strain"] = strainDict(fit.strain);
      if (fit.pressure) d["pressure_mean_pa"] = fit.pressure->mean, d["pressure_p99_pa"] = fit.pressure->p99;
      for (std::size_t k = 0; k < fit.slid.size(); ++k)
        if (fit.slid[k]) slid[kEdges[k]] = *fit.slid[k];
      d["slid"] = slid;
      all.append(d);
    }
    return all;
  }
  py::list fitOver(const py::object& figures, const py::object& progress) {
    const std::vector<GarmentWearer> wearers = wearersIn(figures);
    const auto fits = alone(
        [&](DocumentFile& file, Context& context) -> Result<std::vector<FitOnBody>> {
          const auto recipe = recipeOf(file, context);
          return recipe ? fitOverBodies(**recipe, wearers, context) : recipe.error();
        },
        progress);
    py::list all;
    for (const FitOnBody& fit : fits) {
      py::dict d;
      d["name"] = fit.name, d["fits"] = fit.fits(), d["said"] = text(faultSaid(fit));
      d["where"] = text(fit.where), d["by"] = fit.by, d["why"] = text(fit.why);
      if (fit.fault != FitFault::Refused) d["strain"] = strainDict(fit.strain);
      if (fit.pressure) d["pressure_mean_pa"] = fit.pressure->mean, d["pressure_p99_pa"] = fit.pressure->p99;
      d["girths"] = girthsDict(fit.girths);
      all.append(d);
    }
    return all;
  }
  std::map<std::string, double> measure() {
    return alone([](DocumentFile& file, Context& context) -> Result<std::map<std::string, double>> {
      const auto body = bodyOf(file.document(), context);
      if (!body) return body.error();
      return (*body)->measured().value;  // in its own pose
    });
  }
  std::size_t exportTo(const std::filesystem::path& out, const PaperAsked& asked, const std::vector<std::string>& poses,
                       const py::object& progress) {
    const auto work = [&](DocumentFile& file, Context& context) -> Result<std::size_t> {
      ExportWish wish;
      const auto formats = formatsWriting(out);
      if (formats.empty()) return unwritable(out);
      wish.format = formats.front();
      const std::string paper = asked.paper == "sheet" ? "pdf" : "pdf-" + asked.paper;
      for (const FileFormat* one : formats)
        if (one->id == asked.format || (!asked.paper.empty() && one->id == paper)) wish.format = one;
      if (const Done fit = fits(asked, poses, *wish.format, out.filename().string()); !fit) return fit.error();
      if (!asked.paper.empty() && wish.format->id != paper)
        return badInput(
            say("There is no paper “{0}”; there are: {1}.", asked.paper, "sheet, a4, letter, a3, a0, 36in"));
      if (!poses.empty()) return writeAnimation(out, file.document(), poses, context, prints(file));
      wish.sheet.title = file.path().stem().string();
      wish.sheet.language = spokenHere();
      wish.sheet.date = asked.date, wish.sheet.nest = asked.nest, wish.sheet.allowance = asked.allowance;
      if (asked.overlap) wish.sheet.overlap = *asked.overlap;
      wish.sheet.pairsOnce = asked.pairsOnce;
      const auto garment = seen(file, context);
      return garment ? exportedTo(out, **garment, file.steps(), wish) : garment.error();
    };
    return alone(work, progress);
  }
  // The steps that make the pattern of a file; none, where one of them cannot be done.
  std::size_t readPattern(const std::filesystem::path& path, const std::string& size, const py::object& progress,
                          const std::string& unit) {
    const auto work = [&](DocumentFile& file, Context& context) -> Result<std::size_t> {
      notes_.clear();
      auto drawn = readPatternSize(path, size, fileFormats(), {}, unit);
      if (!drawn) return drawn.error();
      for (const Message& note : drawn->notes) notes_.push_back(text(note));
      if (file.document().body.chosen()) {
        const auto body = bodyOf(file.document(), context);
        if (!body) return body.error();
        drawn->pattern = raisedTo(**body, std::move(drawn->pattern)).pattern;
      }
      for (const Message& note : unknownFabricsSaid(drawn->pattern, file.document(), drawn->fabrics))
        notes_.push_back(text(note));
      std::size_t count = 0;
      for (Operation& operation :
           stepsOf(drawn->pattern, file.document(), drawn->grading, drawn->cutting, &file.blobs(), drawn->fabrics)) {
        if (const auto step = file.perform(std::move(operation), context); !step) {
          for (; count > 0; --count)
            if (const auto back = file.undo(context); !back) return back.error();
          return step.error();
        }
        ++count;
      }
      return count;
    };
    return alone(work, progress);
  }
  // How the pieces lie on the cloth, a dictionary for each fabric; drawn into a file where one is named.
  py::list layout(const LaySettings& settings, const std::filesystem::path& out, const py::object& progress) {
    const LayPlan plan = alone(
        [&](DocumentFile& file, Context& context) -> Result<LayPlan> {
          notes_.clear();
          auto laid = layPlan(file.document(), settings, context);
          if (!laid) return laid.error();
          for (const Message& note : laid->notes) notes_.push_back(text(note));
          if (out.empty()) return laid;
          std::string ending = out.extension().string();
          for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
          if (std::none_of(std::begin(kLayEndings), std::end(kLayEndings),
                           [&](std::string_view one) { return "." + std::string(one) == ending; }))
            return badInput(say("“{0}” has none of the endings that are written: {1}.", out.filename().string(),
                                ".pdf, .svg, .dxf, .plt"));
          LayPaper paper;
          paper.title = file.path().stem().string(), paper.language = spokenHere();
          const auto bytes = writeLay(*laid, ending.substr(1), paper);
          if (!bytes) return bytes.error();
          if (const Done done = writeFile(out, *bytes); !done) return done.error();
          return laid;
        },
        progress);
    py::list all;
    for (const FabricLay& lay : plan.fabrics) {
      py::dict d;
      d["fabric"] = lay.fabric, d["length_m"] = lay.length, d["width_m"] = plan.settings.width;
      d["area_m2"] = lay.area, d["use"] = lay.use, d["pieces"] = lay.pieces.size();
      all.append(d);
    }
    return all;
  }
  std::pair<int, int> picture(const std::filesystem::path& out, const PictureWish& wish) {
    return alone([&](DocumentFile& file, Context& context) -> Result<std::pair<int, int>> {
      notes_.clear();
      std::string ending = out.extension().string();
      for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      if (ending != ".png")
        return badInput(say("“{0}” has none of the endings that are written: {1}.", out.filename().string(), ".png"));
      std::vector<Message> notes;
      const Result<Image> image = drawn(file, context, wish, notes);
      if (!image) return image.error();
      for (const Message& note : notes) notes_.push_back(text(note));
      if (const Done done = writePng(out.string(), *image); !done) return done.error();
      return std::pair(image->width, image->height);
    });
  }
  // How far each point of the cloth is drawn out, by piece.
  py::list strain() {
    const SnapshotPtr garment = alone([this](DocumentFile& file, Context& context) { return seen(file, context); });
    py::list all;
    for (const SceneCloth& cloth : garment->frame.cloths) {
      py::dict d;
      d["piece"] = cloth.name;
      d["flat"] = arrayOf<double>(cloth.flat), d["space"] = arrayOf<double>(cloth.mesh.points);
      d["faces"] = arrayOf<std::uint32_t>(cloth.mesh.faces);
      d["strain"] = py::array_t<float>(static_cast<py::ssize_t>(cloth.strain.size()), cloth.strain.data());
      all.append(d);
    }
    return all;
  }
  // How hard the garment presses on each point of the figure.
  py::array_t<float> pressure() {
    std::vector<float> values = alone([this](DocumentFile& file, Context& context) -> Result<std::vector<float>> {
      if (const auto body = bodyOf(file.document(), context); !body) return body.error();
      const auto garment = seen(file, context);
      if (!garment) return garment.error();
      return pressureOnBody(**garment, context.workers);
    });
    for (float& value : values)
      if (value < 0) value = std::numeric_limits<float>::quiet_NaN();
    return py::array_t<float>(static_cast<py::ssize_t>(values.size()), values.data());
  }
  std::vector<std::string> shareTo(const std::filesystem::path& out, bool neutral) {
    const SharedNames names = neutral ? SharedNames::Neutral : SharedNames::Kept;
    return alone([&](DocumentFile& file, Context& context) { return share(file, out, context, names); }).names;
  }

  PythonBody body() {
    return {alone([](DocumentFile& file, Context& context) { return bodyOf(file.document(), context); })};
  }
  std::vector<PythonPiece> pieces() {
    const Document document = now();
    std::vector<PythonPiece> all;
    for (const auto& [id, piece] : document.pattern.pieces)
      all.push_back({piece, piece->form && !document.drape.dirty.contains(id)});
    return all;
  }
  Document now() {
    return alone([](DocumentFile& file, Context&) { return Result<Document>(file.document()); });
  }
  std::string log() {
    return alone([](DocumentFile& file, Context&) { return Result<std::string>(file.log()); });
  }
  std::vector<std::string> remarks() {
    return alone([](DocumentFile& file, Context&) {
      std::vector<std::string> all;
      for (const Message& remark : file.remarks()) all.push_back(text(remark));
      return Result<std::vector<std::string>>(std::move(all));
    });
  }
  std::vector<std::string> notes() {
    return alone([this](DocumentFile&, Context&) { return Result<std::vector<std::string>>(notes_); });
  }
  void close() {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    if (!closed_) file_ = DocumentFile::inMemory();
    closed_ = true;
  }
  std::string path() {
    return alone([](DocumentFile& file, Context&) { return Result<std::string>(file.path().string()); });
  }

 private:
  Result<SnapshotPtr> seen(DocumentFile& file, Context& context) {
    BodyPtr body;
    if (file.document().body.chosen()) {
      auto found = bodyOf(file.document(), context);
      if (!found) return found.error();
      body = *std::move(found);
    }
    return snapshotOf(file.document(), body, prints(file));
  }
  Prints prints(DocumentFile& file) {
    return [&](const std::string& photo) { return shelf_.find(photo, file.blobs()); };
  }
  Result<Image> drawn(DocumentFile& file, Context& context, const PictureWish& wish, std::vector<Message>& notes) {
    auto options = pictureOptions(wish, wish.turns > 0);
    if (!options) return options.error();
    if (wish.turns != 0 && (wish.turns < 2 || wish.turns > 36)) return badInput(say("A whole turn has 2 to 36 sides."));
    const auto cut = viewCutNamed(wish.hide, wish.section);
    if (!cut) return cut.error();
    const auto garment = seen(file, context);
    if (!garment) return garment.error();
    if (wish.table) {
      if ((*garment)->worn.empty()) return refused(say("There is no piece yet; draw one on the body."));
      TableLayout layout;
      layout.arrange(**garment);
      TableFrameOptions shown;
      shown.language = options->language;
      shown.nest = wish.nest, shown.scans = wish.scans;
      return drawTable(tableFrameOf(**garment, layout, {}, shown), {options->width, options->height, options->language},
                       &notes);
    }
    SceneFrame frame = (*garment)->frame;
    if (options->map == Map::Pressure) {
      auto pressed = pressedFrame(**garment, context.workers);
      if (!pressed) return pressed.error();
      frame = std::move(pressed->frame), options->mapTop = pressed->top;
    }
    if (cut->any()) VisibleParts(*cut, (*garment)->body).cut(frame);
    if (extent(frame).empty()) return refused(say("There is nothing to see: no body, no cloth and no line."));
    if (wish.turns == 0) {
      const auto picture = Picture::open();
      if (!picture) return picture.error();
      Result<Image> image = (*picture)->draw(frame, *options);
      notes = (*picture)->notes();
      return image;
    }
    LineUp lineUp({{}}, {&frame, 1}, *options);
    Result<Image> image = lineUp.turns(wish.turns, context.token);
    notes = lineUp.notes();
    return image;
  }
  py::dict stepDict(const Step& step) {
    const Document document = now();
    py::dict d;
    d["operation"] = withShortLengths(text(step.operation)), d["operations"] = document.operations,
    d["hash"] = hash(document);
    const bool pulled = std::holds_alternative<PullCloth>(step.operation);
    if (const auto& last = document.drape.last; last && (pulled || std::holds_alternative<DrapePieces>(step.operation)))
      d["settled"] = last->settled, d["why"] = text(last->why);
    if (pulled) {
      double most = 0;
      for (const Vec3& force : document.drape.force) most = std::max(most, length(force));
      d["max_force_n"] = most;
    }
    return d;
  }
  std::mutex mutex_;  // guards all below
  DocumentFile file_;
  Workers workers_;
  Bodies bodies_;
  PrintShelf shelf_;
  bool closed_ = false;
  std::vector<std::string> notes_;  // of what was done last
};

std::unique_ptr<PythonDocument> created(const std::filesystem::path& path, int threads) {
  return std::make_unique<PythonDocument>(path.empty() ? DocumentFile::inMemory() : good(DocumentFile::create(path)),
                                          threads);
}
std::unique_ptr<PythonDocument> opened(const std::filesystem::path& path, bool reading, int threads) {
  const py::gil_scoped_release release;
  return std::make_unique<PythonDocument>(good(reading ? DocumentFile::openForReading(path) : DocumentFile::open(path)),
                                          threads);
}

}  // namespace

PYBIND11_MODULE(karinui, m) {
  m.doc() = "Karinui: made-to-measure clothes, designed on a body, draped, and printed as true-size patterns.";
  m.attr("__version__") = std::string(version());
  static py::exception<Failure> failure(m, "Error");
  failure.doc() =
      "What cannot be done, as a sentence. It has changed nothing. `kind` is one of bad_input, refused, not_found, "
      "storage, damaged, out_of_memory, stopped.";
  py::register_exception_translator([](std::exception_ptr raised) {
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const Failure& why) {
      py::object object = py::reinterpret_borrow<py::object>(failure)(text(why.error.what));
      object.attr("kind") = errorName(why.error.kind);
      PyErr_SetObject(failure.ptr(), object.ptr());
    }
  });

  py::class_<PythonForm>(m, "Form",
                         "The shape a piece holds in space. Arrays look into the document's memory and are read-only.")
      .def_property_readonly(
          "flat", [](const py::object& self) { return viewOf<double>(self.cast<PythonForm&>().form->flat, self); },
          "places on paper, metres, (n, 2)")
      .def_property_readonly(
          "space", [](const py::object& self) { return viewOf<double>(self.cast<PythonForm&>().form->space, self); },
          "the same places in space before the piece's pose, metres, y up, (n, 3)")
      .def_property_readonly(
          "faces",
          [](const py::object& self) { return viewOf<std::uint32_t>(self.cast<PythonForm&>().form->faces, self); },
          "triangles, (m, 3)");
  py::class_<PythonPiece>(m, "Piece", "A piece of the paper pattern, as it was when it was asked for.")
      .def_property_readonly("id", [](const PythonPiece& p) { return text(p.piece->id); })
      .def_property_readonly("name", [](const PythonPiece& p) { return p.piece->name; })
      .def_property_readonly("fabric", [](const PythonPiece& p) { return p.piece->fabric; })
      .def_property_readonly("layer", [](const PythonPiece& p) { return p.piece->layer; })
      .def_property_readonly(
          "draped", [](const PythonPiece& p) { return p.draped; }, "brought to rest, and not changed since")
      .def_property_readonly(
          "area", [](const PythonPiece& p) { return p.piece->outline.area(); }, "square metres, holes not taken off")
      .def_property_readonly(
          "edges",
          [](const PythonPiece& p) {
            py::dict lengths;
            for (const Edge& edge : p.piece->outline.edges) lengths[py::str(edge.name)] = edge.curve.length();
            return lengths;
          },
          "lengths in metres by name, in the outline's order")
      .def(
          "outline",
          [](const PythonPiece& p, double miss) {
            if (!(miss > 0)) throw py::value_error("miss must be above 0");
            const Ring ring = p.piece->outline.flattened(miss);
            py::array_t<double> points({static_cast<py::ssize_t>(ring.size()), py::ssize_t{2}});
            std::copy_n(reinterpret_cast<const double*>(ring.data()), 2 * ring.size(), points.mutable_data());
            return points;
          },
          py::arg("miss") = 1e-4, "the outline as a polygon that misses it by no more than `miss` metres, (n, 2)")
      .def_property_readonly(
          "pose",
          [](const PythonPiece& p) {
            const Rigid& r = p.piece->pose;
            return py::make_tuple(py::make_tuple(r.w, r.x, r.y, r.z), py::make_tuple(r.carry.x, r.carry.y, r.carry.z));
          },
          "the turn as a unit quaternion w, x, y, z, and the carry in metres")
      .def_property_readonly(
          "form",
          [](const PythonPiece& p) -> std::optional<PythonForm> {
            return p.piece->form ? std::optional(PythonForm{p.piece->form}) : std::nullopt;
          },
          "None: flat");
  py::class_<PythonBody>(m, "Body", "The figure. Arrays look into its memory and are read-only.")
      .def_property_readonly(
          "points",
          [](const py::object& self) { return viewOf<double>(self.cast<PythonBody&>().body->mesh().points, self); },
          "metres, y up, (n, 3)")
      .def_property_readonly(
          "faces",
          [](const py::object& self) {
            return viewOf<std::uint32_t>(self.cast<PythonBody&>().body->mesh().faces, self);
          },
          "triangles, (m, 3)");

  using D = PythonDocument;
  py::class_<D>(m, "Document", "One garment, with all that led to it.")
      .def_static("create", &created, py::arg("path") = "", py::arg("threads") = 0,
                  "a new document; without a path it is kept in memory only")
      .def_static("open", &opened, py::arg("path"), py::arg("reading") = false, py::arg("threads") = 0)
      .def("perform", &D::perform, py::arg("operation"), py::arg("progress") = py::none(),
           "does one operation, a line of docs/format/operations.md; progress(fraction, doing) is called meanwhile. "
           "Gives what was recorded; of a drape or pull whether it rests, of a pull the greatest force (max_force_n)")
      .def("play", &D::play, py::arg("script"), py::arg("progress") = py::none(),
           "does a script of operations; how many")
      .def("amend", &D::amend, py::arg("step"), py::arg("operation"), py::arg("progress") = py::none(),
           "makes a step (from 1, as log tells) another operation; those after it are played again")
      .def("undo", &D::turned<&DocumentFile::undo>)
      .def("redo", &D::turned<&DocumentFile::redo>)
      .def("settle", &D::settle, py::arg("again") = false, py::arg("progress") = py::none(),
           "brings the cloth to rest on the body")
      .def("check", &D::check, "examines the cloth, independently of the solver")
      .def("fit", &D::fit, "girths of garment and body at the levels that are covered, and pressure")
      .def("motion", &D::motion, py::arg("poses"), py::arg("progress") = py::none(),
           "fit in motion: a copy brought to rest as it stands and in each pose; stretch, pressure, how far edges slid")
      .def("fit_over", &D::fitOver, py::arg("figures"), py::arg("progress") = py::none(),
           "the garment made to each figure (sizes, dicts of measures in metres, or a table's path), and whom it does "
           "not fit, where and by how much")
      .def("measure", &D::measure, "the body as a tape measures it: metres, and radians")
      .def(
          "export",
          [](D& d, const std::filesystem::path& path, const std::string& format, const std::vector<std::string>& poses,
             const py::object& progress, const std::string& paper, std::optional<double> allowance,
             std::optional<double> overlap, const std::string& date, bool nest, bool pairsOnce) {
            return d.exportTo(path, {format, paper, date, overlap, allowance, nest, pairsOnce}, poses, progress);
          },
          py::arg("path"), py::arg("format") = "", py::arg("poses") = std::vector<std::string>(),
          py::arg("progress") = py::none(), py::arg("paper") = "", py::arg("allowance") = py::none(),
          py::arg("overlap") = py::none(), py::arg("date") = "", py::arg("nest") = false, py::arg("pairs_once") = false,
          "writes a file; its ending says what; how many bytes. `format`: of .json and .dxf which, as karinui export. "
          "`poses`: a GLB is an animation through them. Of paper: `paper` (a4, letter, a3, a0, 36in, or sheet for one; "
          "a PDF is on a4 where it is not said), `allowance` and `overlap` in metres, `date`, `nest`, `pairs_once`")
      .def("read_pattern", &D::readPattern, py::arg("path"), py::arg("size") = "", py::arg("progress") = py::none(),
           py::arg("unit") = "",
           "does the steps that make the pattern of a file (.dxf, .svg, .json), of several sizes with `size` standing; "
           "how many. `unit`: mm, cm, m, in or pt, where the file does not tell it. What was found is in `notes`")
      .def(
          "layout",
          [](D& d, double width, bool fold, double gap, bool nap, double stripes, double rows,
             const std::string& fabric, std::optional<double> allowance, int tries, std::uint64_t seed,
             const std::filesystem::path& path, const py::object& progress) {
            return d.layout({width, fold, gap, nap, stripes, rows, allowance, fabric, tries, seed}, path, progress);
          },
          py::arg("width") = 1.5, py::arg("fold") = false, py::arg("gap") = 0.005, py::arg("nap") = false,
          py::arg("stripes") = 0.0, py::arg("rows") = 0.0, py::arg("fabric") = "", py::arg("allowance") = py::none(),
          py::arg("tries") = LaySettings().tries, py::arg("seed") = 1, py::arg("path") = "",
          py::arg("progress") = py::none(),
          "how the pieces lie on the cloth, as karinui layout, in metres: for each fabric its length and the share of "
          "it that is used; `path`: the plan is drawn there (.pdf, .svg, .dxf, .plt)")
      .def(
          "picture",
          [](D& d, const std::filesystem::path& path, const std::string& view, const std::string& size,
             const std::string& map, const std::string& eyes, const std::string& hide, const std::string& section,
             bool table, bool nest, bool scans, int turns) {
            return d.picture(path, {{view, map, eyes, size}, hide, section, table, nest, scans, turns});
          },
          py::arg("path"), py::arg("view") = "front", py::arg("size") = "", py::arg("map") = "none",
          py::arg("eyes") = "mono", py::arg("hide") = "", py::arg("section") = "", py::arg("table") = false,
          py::arg("nest") = false, py::arg("scans") = false, py::arg("turns") = 0,
          "draws the garment on its body, or with `table` its flat pattern, as a PNG; the words are those of karinui "
          "picture; width and height")
      .def("strain", &D::strain,
           "how far the cloth is stretched: for each piece its name, and for each of its points the place on paper "
           "(flat) and in space, metres, and |l/L - 1| (strain, empty where the cloth cannot be laid); faces are "
           "triangles of points")
      .def("pressure", &D::pressure,
           "how hard the garment presses on each of body().points, pascals; nan where no cloth lies, empty where none "
           "can be laid")
      .def("share", &D::shareTo, py::arg("path"), py::arg("unnamed") = false,
           "writes the pattern without the person; the names that stay, none where all are made neutral (`unnamed`)")
      .def("pieces", &D::pieces)
      .def("body", &D::body)
      .def("log", &D::log, "the operations, one a line")
      .def("close", &D::close)
      .def_property_readonly("path", &D::path)
      .def_property_readonly(
          "hash", [](D& d) { return hash(d.now()); }, "of the paper pattern")
      .def_property_readonly(
          "drape_hash", [](D& d) { return drapeHash(d.now()); }, "of where the cloth stands")
      .def_property_readonly("operations", [](D& d) { return d.now().operations; })
      .def_property_readonly("remarks", &D::remarks, "what was found in the file that a person should know")
      .def_property_readonly("notes", &D::notes, "advice on what was done last")
      .def(
          "__enter__", [](D& d) -> D& { return d.path(), d; }, py::return_value_policy::reference)
      .def("__exit__", [](D& d, const py::args&) { d.close(); });
  m.def(
      "dump",
      [](const std::filesystem::path& document) {
        const py::gil_scoped_release release;
        return good(dumped(document));
      },
      py::arg("document"), "the whole document as text");
  m.def(
      "load",
      [](const std::string& dump, const std::filesystem::path& path) {
        const py::gil_scoped_release release;
        good(loadDump(dump, path));
      },
      py::arg("dump"), py::arg("path"), "makes a document of what dump() gave");
}
