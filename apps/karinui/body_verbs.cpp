// body make, body measure: figures without a document.
#include "answers_in_words.h"
#include "commands.h"
#include "figure.h"
#include "json_answers.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/body/sizes.h"
#include "karinui/design/glossary.h"
#include "karinui/design/script.h"
#include "karinui/exchange/formats.h"
#include "word_table.h"

namespace karinui::app {

namespace {

struct MakeOptions {
  std::string size, measures, sex, out;
  std::vector<std::string> set;
  bool form = false;
};

struct MeasureOptions {
  std::string path, out;
  bool wrap = false;
};

Result<Measurements> wanted(Program& program, const MakeOptions& options) {
  Measurements measurements;
  if (!options.size.empty()) {
    Result<Measurements> size = builtInSize(options.size);
    if (!size) return size.error();
    measurements = std::move(*size);
  }
  std::map<std::string, double> own;
  if (!options.measures.empty()) {
    Result<Measurements> read = readFigureMeasures(program, options.measures);
    if (!read) return read.error();
    measurements.sex = read->sex;
    own = std::move(read->value);
  }
  if (!options.sex.empty()) measurements.sex = *sexNamed(options.sex);
  for (const std::string& stated : options.set) {
    const std::size_t is = stated.find('=');
    if (is == std::string::npos) {
      return badInput(say("“{0}” states no measurement; write it like bust_girth=88cm.", stated));
    }
    const Result<std::string> key = measurementKey(stated.substr(0, is));
    if (!key) return key.error();
    const std::string number = stated.substr(is + 1);
    if (const Done meant = isAngle(*key) ? Done() : unitMeant(number); !meant) return meant.error();
    const Result<double> value = isAngle(*key) ? parseAngle(number) : parseLength(number);
    if (!value) return value.error();
    own[*key] = *value;
  }
  measurements = withOwn(std::move(measurements), own);
  if (measurements.value.empty()) {
    return badInput(say("Say which body: --size jis9ar, --size eu38, --size eu50, or --set bust_girth=88cm …"));
  }
  return measurements;
}

int runMake(Program& program, const MakeOptions& options) {
  const Result<Measurements> measurements = wanted(program, options);
  if (!measurements) return program.console.refuse(measurements.error());
  Workers workers(program.threads);
  const Result<BodyPtr> body = makeMannequin(*measurements, workers, program.console.token(),
                                             options.form ? MannequinEnds::DressForm : MannequinEnds::Modelled);
  if (!body) return program.console.refuse(body.error());
  const Result<std::string> obj = writeObj((*body)->mesh(), "body");
  if (!obj) return program.console.refuse(obj.error());
  if (const Done done = writeFile(options.out, *obj); !done) return program.console.refuse(done.error());
  // A form has no arms and legs to find the trunk by: it measures as the figure it was cut from.
  const Measurements measured = options.form ? (*body)->measured() : measure((*body)->mesh(), (*body)->bvh());
  const MeshReport report = inspect((*body)->mesh());
  Json object = bodyJson(measured, report);
  object["file"] = options.out;
  program.console.answer(object, options.out + "\n" + bodyWords(measured, report, program.console));
  return kDone;
}

int runMeasure(Program& program, const MeasureOptions& options) {
  Workers workers(program.threads);
  const Result<Body::Parts> figure = readFigure(program, workers, options.path, options.wrap);
  if (!figure) return program.console.refuse(figure.error());
  const Measurements measured = measure(figure->mesh, Bvh(figure->mesh));
  const MeshReport report = inspect(figure->mesh);
  if (!options.out.empty()) {
    const Result<std::string> written = writtenMeasures(options.out, measured);
    if (!written) return program.console.refuse(written.error());
    if (const Done done = writeFile(options.out, *written); !done) return program.console.refuse(done.error());
  }
  program.console.answer(bodyJson(measured, report), bodyWords(measured, report, program.console));
  return kDone;
}

struct SizesOptions {};

int runSizes(Program& program, const SizesOptions&) {
  Json all = Json::array();
  WordTable table;
  const auto said = [&](const Message& words) { return program.console.said(words); };
  table.row({said(say("Size")), "", said(say("Bust girth")), said(say("Waist girth")), said(say("Hip girth")),
             said(say("Body height"))});
  const auto centimetres = [](double metres) { return fixed(metres * 100, 1); };
  for (const SizeSeries& series : sizeSeries())
    for (const BuiltInSize& size : series.sizes) {
      table.row({std::string(size.name), said(termSaid(Term::Size, size.name).value_or(say("{0}", size.label))),
                 centimetres(size.bust), centimetres(size.waist), centimetres(size.hip), centimetres(size.height)});
      all.push_back({{"name", size.name},
                     {"sex", sexName(series.sex)},
                     {"bust_girth", size.bust},
                     {"waist_girth", size.waist},
                     {"hip_girth", size.hip},
                     {"height", size.height}});
    }
  program.console.answer({{"sizes", all}}, table.words(0));
  return kDone;
}

}  // namespace

void addBodyVerbs(Program& program) {
  CLI::App* body = Program::word(program.cli, "body", help("Makes and measures bodies"));
  body->require_subcommand(1);

  auto make = std::make_shared<MakeOptions>();
  CLI::App* verb = program.verb(*body, "make", help("Makes a mannequin from measurements"), make, runMake);
  verb->add_option("--size", make->size,
                   help("A built-in size: jis9ar, eu38, eu50, child128 …; body sizes lists them"));
  verb->add_option("--measures", make->measures,
                   help(say("A file of measures: {0}, .json", listed(endingsRead({FileContent::Measures})))));
  verb->add_option("--set", make->set, help("Measurements: bust_girth=88cm …"));
  verb->add_option("--sex", make->sex, help("female, male or child: which family of shapes"))
      ->transform(oneOf({"female", "male", "child"}));
  verb->add_flag("--form", make->form, help("A dress form on a stand instead of a whole figure"));
  program.output(*verb, "-o,--output", make->out, help("The OBJ file"), {"obj"})->required();

  auto measured = std::make_shared<MeasureOptions>();
  verb = program.verb(*body, "measure", help("Measures a body as a tape does"), measured, runMeasure);
  verb->add_option("body", measured->path, help(say("A body: {0}", listed(endingsRead({FileContent::Body})))))
      ->required();
  program.output(*verb, "-o,--output", measured->out,
                 help(say("A file that the measures are written to: {0}", listed(measureEndingsWritten()))),
                 measureEndingsWritten());
  verb->add_flag("--wrap", measured->wrap, help("Close a scan's holes first"));

  program.verb(*body, "sizes", help("Lists the built-in sizes, in centimetres"), std::make_shared<SizesOptions>(),
               runSizes);
}

}  // namespace karinui::app
