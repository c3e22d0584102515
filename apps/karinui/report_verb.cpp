// report: how the garment fits, on paper: pictures, ease, strain, pressure, measures, cloth.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/design/notions.h"
#include "karinui/design/piece_label.h"
#include "karinui/design/sewing_order.h"
#include "karinui/design/step_words.h"
#include "karinui/design/truing_said.h"
#include "karinui/exchange/lay_sheet.h"
#include "karinui/exchange/report.h"
#include "karinui/pattern/truing.h"
#include "karinui/session/fit.h"
#include "karinui/session/fit_in_motion.h"
#include "karinui/view/picture.h"
#include "karinui/view/strain_scale.h"
#include "open_document.h"

namespace karinui::app {

namespace {

struct ReportOptions {
  std::string path, out, width = "150cm", language;
  std::vector<std::string> poses;
  bool pictures = true;
};

constexpr int kPictureWide = 700, kPictureHigh = 950;

Message words(const std::string& text) { return say("{0}", text); }
Message mmSaid(double metres) { return words(fixed(metres * 1000, 0) + " mm"); }
Message cmSaid(double metres) { return words(fixed(metres * 100, 1) + " cm"); }
Message percentSaid(double share) { return words(fixed(share * 100, 1) + " %"); }

struct Fitting {
  SnapshotPtr garment;
  std::vector<float> pressure;
  double pressureTop = 0;
};

// The garment from three sides, then where it is stretched and where it presses.
Result<std::vector<ReportPicture>> picturesOf(Program& program, const Fitting& fitting, Language language) {
  const auto picture = Picture::open();
  if (!picture) return picture.error();
  std::vector<ReportPicture> all;
  const auto add = [&](const SceneFrame& frame, View view, double top, const Message& caption) -> Done {
    PictureOptions options;
    options.view = view;
    options.width = kPictureWide, options.height = kPictureHigh;
    options.map = top > 0 ? Map::Strain : Map::None;
    options.mapTop = top;
    options.lettering = false;
    options.language = language;
    const Result<Image> image = (*picture)->draw(frame, options);
    if (!image) return image.error();
    for (const Message& note : (*picture)->notes()) program.console.note(note);
    all.push_back({caption, image->width, image->height, image->rgba});
    return {};
  };
  const SceneFrame& plain = fitting.garment->frame;
  for (const auto& [view, caption] : {std::pair(View::Front, say("from the front")),
                                      {View::Back, say("from the back")},
                                      {View::Left, say("from the left")}})
    if (const Done done = add(plain, view, 0, caption); !done) return done.error();
  // The top of the scale is the frame's own where none is named.
  const double top = strainTop(plain);
  if (top > 0)
    for (const auto& [view, caption] :
         {std::pair(View::Front, say("strain, front: bright is {0} %", fixed(top * 100, 1))),
          {View::Back, say("strain, back")}})
      if (const Done done = add(plain, view, top, caption); !done) return done.error();
  if (fitting.pressureTop > 0) {
    const SceneFrame pressed = pressureFrame(*fitting.garment, fitting.pressure);
    if (const Done done = add(pressed, View::Front, fitting.pressureTop,
                              say("pressure on the body: bright is {0} kPa", fixed(fitting.pressureTop / 1000, 2)));
        !done)
      return done.error();
  }
  return all;
}

ReportTable girthTable(const GarmentSnapshot& garment) {
  ReportTable table{say("Ease"), {Message(), say("body"), say("garment"), say("ease")}, {}};
  constexpr double kThere = 0.005;  // metres: so near it is that level
  for (const Girths& g : girthsOf(garment))
    table.rows.push_back({std::fabs(g.off) < kThere ? g.name
                          : g.off < 0               ? say("{0}, {1} below it", g.name, cmSaid(-g.off))
                                                    : say("{0}, {1} above it", g.name, cmSaid(g.off)),
                          cmSaid(g.body), cmSaid(g.garment), cmSaid(g.garment - g.body)});
  return table;
}

ReportTable clothTable(const Fitting& fitting) {
  ReportTable table{say("Cloth"), {}, {}};
  const auto& last = fitting.garment->document.drape.last;
  if (!last) {
    table.rows.push_back({say("at rest"), say("not draped yet")});
    return table;
  }
  table.rows = {{say("at rest"), last->settled ? say("yes") : say("no")},
                {say("stretch, on average"), percentSaid(last->strain.mean)},
                {say("99 % of the cloth is stretched less than"), percentSaid(last->strain.p99)},
                {say("stretch, at most"), percentSaid(last->strain.max)},
                {say("widest seam gap"), words(fixed(last->seamGap * 1000, 1) + " mm")},
                {say("deepest in the body"), words(fixed(last->penetration * 1000, 1) + " mm")}};
  if (const auto pressed = pressureReport(fitting.pressure)) {
    const auto kilo = [](double pascals) { return words(fixed(pascals / 1000, 2) + " kPa"); };
    table.rows.push_back({say("pressure where the cloth lies, on average"), kilo(pressed->mean)});
    table.rows.push_back({say("99 % of it is pressed less than"), kilo(pressed->p99)});
  }
  return table;
}

ReportTable fasteningTable(const GarmentSnapshot& garment) {
  ReportTable table{say("Fastenings"), {}, {}};
  for (const FasteningPull& pull : fasteningsOf(garment)) table.rows.push_back({fastenerSaid(pull), pulledSaid(pull)});
  return table;
}

// Pose beside pose, and as pictures.
Result<ReportTable> motionTable(OpenDocument& opened, const std::vector<std::string>& poses) {
  const auto fits = fitInMotion(opened.document(), poses, opened.context());
  if (!fits) return fits.error();
  ReportTable table{
      say("Fit in motion"), {say("Pose"), say("Stretch, mean"), say("99 %"), say("Pressure, mean"), say("99 %")}, {}};
  for (const OpenEdge edge : kOpenEdges) table.columns.push_back(openEdgeSaid(edge));
  const auto kilo = [](double pascals) { return words(fixed(pascals / 1000, 2) + " kPa"); };
  for (const FitInPose& fit : *fits) {
    if (fit.refused) {
      std::vector<Message> cells(table.columns.size(), words("–"));
      cells[0] = say("{0}: cannot be taken", fit.said);
      table.rows.push_back(std::move(cells));
      opened.program().console.note(*fit.refused);
      continue;
    }
    std::vector<Message> cells{fit.said, percentSaid(fit.strain.mean), percentSaid(fit.strain.p99),
                               fit.pressure ? kilo(fit.pressure->mean) : words("–"),
                               fit.pressure ? kilo(fit.pressure->p99) : words("–")};
    for (const auto& slid : fit.slid)
      cells.push_back(slid ? words((*slid >= 0.0005 ? "+" : "") + fixed(*slid * 1000, 0) + " mm") : words("–"));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

ReportTable measureTable(const Body& body) {
  ReportTable table{say("Figure"), {}, {}};
  for (const auto& [key, value] : measure(body.mesh(), body.bvh()).value)
    table.rows.push_back({identifierSaid(key).value_or(words(key)),
                          isAngle(key) ? words(fixed(value * 180 / std::numbers::pi, 1) + "°") : cmSaid(value)});
  return table;
}

ReportTable notionsTable(const Document& document) {
  ReportTable table{say("Notions"), {}, {}};
  for (const Message& one : notionsSaid(document.pattern, document.allowances, document.cutting))
    table.rows.push_back({one});
  return table;
}

ReportTable pieceTable(const Document& document) {
  ReportTable table{say("Pieces"), {Message(), say("across"), say("along"), say("fabric"), say("cut")}, {}};
  for (const auto& [id, piece] : document.pattern.pieces) {
    FlatBox upright;
    for (const Flat p : piece->outline.flattened(1e-4)) upright.include({cross(p, piece->grain), dot(p, piece->grain)});
    const auto cut = document.cutting.find(id);
    const int count = cut == document.cutting.end() ? 1 : cut->second.count;
    table.rows.push_back({nameSaid(piece->name), mmSaid(upright.size().u), mmSaid(upright.size().v),
                          nameSaid(piece->fabric), words(std::to_string(count))});
  }
  return table;
}

ReportTable orderTable(const Document& document) {
  ReportTable table{say("Order of sewing"), {Message(), Message()}, {}};  // a sentence takes both columns
  std::size_t count = 0;
  for (const SewingStep& step : sewingOrder(document)) table.rows.push_back({say("{0}. {1}", ++count, step.words)});
  return table;
}

ReportTable seamTable(const Document& document) {
  ReportTable table{say("Seams"), {}, {}};
  const TruingReport report = truing(document.pattern, document.eases);
  if (report.seams.empty()) return table;
  if (report.faults() == 0) table.rows.push_back({say("All sewn edges fit each other.")});
  for (const Message& fault : faultsSaid(document, report)) table.rows.push_back({fault});
  return table;
}

int runReport(Program& program, const ReportOptions& options) {
  const Done meant = unitMeant(options.width);
  const auto width = meant ? parseLength(options.width) : meant.error();
  if (!width) {
    program.console.refuse(width.error());
    return kWrongCall;
  }
  const Language language = options.language == "ja"   ? Language::Japanese
                            : options.language == "en" ? Language::English
                                                       : spokenHere();
  return withDocument(program, options.path, true, [&](OpenDocument& opened) -> int {
    const Document& document = opened.document();
    if (document.pattern.pieces.empty()) return program.console.refuse(refused(say("There is no piece to report on.")));
    BodyPtr body;
    if (document.body.chosen()) {
      auto found = bodyOf(document, opened.context());
      if (!found) return program.console.refuse(found.error());
      body = *std::move(found);
    }
    Fitting fitting{snapshotOf(document, body), {}, 0};
    if (body) fitting.pressure = pressureOnBody(*fitting.garment, opened.context().workers);
    if (!fitting.pressure.empty()) fitting.pressureTop = roundTop(fitting.pressure, kPressureLeast);
    LaySettings settings;
    settings.width = *width;
    settings.tries = 1000;
    Report report;
    report.title = std::filesystem::path(options.path).stem().string();
    report.under = ofItsSize(document.body) ? say("Fit report, size {0}", document.body.size) : say("Fit report");
    if (options.pictures) {
      auto pictures = picturesOf(program, fitting, language);
      if (pictures)
        report.pictures = *std::move(pictures);
      else
        program.console.note(pictures.error().what);  // the figures are worth having without them
    }
    if (body) report.tables.push_back(girthTable(*fitting.garment));
    report.tables.push_back(clothTable(fitting));
    if (ReportTable fastened = fasteningTable(*fitting.garment); !fastened.rows.empty())
      report.tables.push_back(std::move(fastened));
    if (!options.poses.empty()) {
      auto motion = motionTable(opened, options.poses);
      if (!motion) return program.console.refuse(motion.error());
      report.lists.push_back(*std::move(motion));
    }
    if (ReportTable order = orderTable(document); !order.rows.empty()) report.lists.push_back(std::move(order));
    ReportTable yards{say("Cloth to buy"), {}, {}};
    if (const auto plan = layPlan(document, settings, opened.context())) {
      for (const Message& lay : laySaid(*plan)) yards.rows.push_back({lay});
    } else {
      if (plan.error().kind == Error::Kind::Cancelled) return program.console.refuse(plan.error());
      yards.rows.push_back({plan.error().what});
    }
    report.tables.push_back(std::move(yards));
    report.tables.push_back(pieceTable(document));
    if (ReportTable notions = notionsTable(document); !notions.rows.empty())
      report.tables.push_back(std::move(notions));
    if (ReportTable seams = seamTable(document); !seams.rows.empty()) report.tables.push_back(std::move(seams));
    if (body) report.tables.push_back(measureTable(*body));
    const Result<std::string> bytes = writeReport(report, language);
    if (!bytes) return program.console.refuse(bytes.error());
    if (const Done done = writeFile(options.out, *bytes); !done) return program.console.refuse(done.error());
    program.console.answer({{"file", options.out}, {"bytes", bytes->size()}, {"pictures", report.pictures.size()}},
                           options.out);
    return kDone;
  });
}

}  // namespace

void addReportVerb(Program& program) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = program.verb(program.cli, "report",
                                help("Writes how the garment fits: pictures, ease, strain, pressure, cloth (PDF)"),
                                options, runReport);
  verb->add_option("document", options->path, help("The .karinui document"))->required();
  program.output(*verb, "-o,--output", options->out, help("The PDF file"), {"pdf"})->required();
  verb->add_option("--width", options->width, help("Of the cloth, laid open: 150cm"));
  verb->add_option("--language", options->language, help("en or ja; else the language spoken here"))
      ->transform(oneOf({"en", "ja"}));
  verb->add_option("--poses", options->poses, help("Fit in motion: at rest in these poses too, as T,forward,seated"))
      ->delimiter(',');
  verb->add_flag_callback(
      "--no-pictures", [options] { options->pictures = false; }, help("Only the figures"));
}

}  // namespace karinui::app
