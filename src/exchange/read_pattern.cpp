#include "karinui/exchange/read_pattern.h"

#include <algorithm>

#include "exchange/code_pages.h"
#include "exchange/names.h"
#include "karinui/base/file.h"

namespace karinui {

namespace {

// The table of rules told, or that stands beside a file of one size.
Done takeRules(const std::filesystem::path& file, const RulesFile& rules, CadPattern& read) {
  std::filesystem::path table = rules.file;
  for (const char* ending : {".rul", ".RUL", ".Rul"}) {
    if (!table.empty() || read.rules.empty() || !read.grading.empty()) break;
    std::filesystem::path beside = file;
    std::error_code none;
    if (beside.replace_extension(ending); std::filesystem::is_regular_file(beside, none)) table = beside;
  }
  if (table.empty()) return {};
  const Result<std::string> bytes = readFile(table);
  if (!bytes) return bytes.error();
  const auto known = readGradeRules(*bytes, rules.steps);
  if (!known) return inFile(table, known.error());
  if (const Done done = takeGradeRules(read, *known); !done) {
    if (!rules.file.empty()) return inFile(table, done.error());
    read.notes.push_back(inFile(table, done.error()).what);  // nobody asked for it
  }
  return {};
}

// Metres; 0: nothing was said.
Result<double> fileUnit(std::string_view said) {
  if (said.empty()) return 0.0;
  for (const auto& [name, metres] :
       {std::pair<std::string_view, double>{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}, {"pt", 0.0254 / 72}})
    if (said == name) return metres;
  return badInput(say("“{0}” is not one of: {1}.", cleanText(said), "mm, cm, m, in, pt"));
}

}  // namespace

Result<CadPattern> readPatternSize(const std::filesystem::path& file, std::string_view size, FormatTable table,
                                   const RulesFile& rules, std::string_view unit) {
  std::vector<const FileFormat*> formats = formatsReading(file, table);
  std::erase_if(formats, [](const FileFormat* format) { return format->in != FileContent::Pattern; });
  if (formats.empty()) return unreadable(file, {FileContent::Pattern}, table);
  const Result<double> metres = fileUnit(unit);
  if (!metres) return metres.error();
  Result<std::string> bytes = readFile(file);
  if (!bytes) return bytes.error();
  bytes = withoutUtf16(*std::move(bytes));
  const FileFormat& format = **std::find_if(formats.begin(), formats.end() - 1, [&](const FileFormat* one) {
    return !one->recognises || one->recognises(*bytes);
  });
  if (format.readSize) {
    auto read = format.readSize(*bytes, size, *metres);
    if (!read) return inFile(file, read.error());
    if (const Done done = takeRules(file, rules, *read); !done) return done.error();
    return read;
  }
  if (!rules.file.empty()) return inFile(file, badInput(say("No point of the file names a grade rule.")));
  if (!size.empty()) return inFile(file, badInput(say("Such a file holds one size only.")));
  if (!unit.empty()) return inFile(file, badInput(unitIsTold()));
  auto pattern = format.readPattern(*bytes);
  if (!pattern) return inFile(file, pattern.error());
  CadPattern whole;
  whole.pattern = *std::move(pattern);
  return whole;
}

Message unitIsTold() { return say("Such a file tells what a unit is; leave out what you said of it."); }

Result<Pattern> readPattern(const std::filesystem::path& file, FormatTable table) {
  auto read = readPatternSize(file, {}, table);
  if (!read) return read.error();
  return std::move(read->pattern);
}

}  // namespace karinui
