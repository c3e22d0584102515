#include "grade_rules.h"

#include <algorithm>
#include <cmath>

#include "exchange/names.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::size_t kLargestTable = 4 << 20, kMostRules = 20'000;
constexpr double kEnglishUnit = 0.0254;

double hundredths(double metres) { return std::round(metres * 1e5) / 1e5 + 0.0; }

std::vector<std::string> wordsIn(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text)
    if (c == ' ' || c == '\t' || c == ',' || c == '\r')
      words.emplace_back();
    else
      words.back() += c;
  std::erase(words, "");
  return words;
}

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

}  // namespace

std::vector<std::string> sizeWords(const std::vector<std::string>& sizes) {
  DistinctNames taken;
  std::vector<std::string> words;
  for (const std::string& size : sizes) {
    std::string word = oneWord(size, "size");
    for (char& c : word)
      if (c == ';' || c == ',' || c == '=' || c == '"') c = '_';
    words.push_back(taken.give(word.size() > 20 ? edgeWord(word).substr(0, 20) : word));
  }
  return words;
}

std::vector<std::string> asciiSizes(const std::vector<std::string>& sizes) {
  DistinctNames taken;
  std::vector<std::string> words;
  for (const std::string& size : sizes) {
    const std::string word = edgeWord(size);
    words.push_back(taken.give(word.empty() ? "SIZE" : word));
  }
  return words;
}

Result<Pattern> patternInSize(const Pattern& pattern, const Grading& grading, std::size_t size) {
  Pattern out = pattern;
  for (auto& [id, piece] : out.pieces) {
    auto made = inSize(*piece, grading, size);
    if (!made) return made.error();
    piece = std::make_shared<const Piece>(*std::move(made));
  }
  return out;
}

Result<RuleBook> ruleBook(const Pattern& pattern, const Grading& grading) {
  RuleBook book;
  const auto number = [&](std::vector<Flat> by) {
    for (Flat& p : by) p = {hundredths(p.u), hundredths(p.v)};
    auto at = std::find(book.rules.begin(), book.rules.end(), by);
    if (at == book.rules.end()) at = book.rules.insert(at, std::move(by));
    return static_cast<std::size_t>(at - book.rules.begin()) + 1;
  };
  for (const auto& [id, points] : grading.pieces) {
    const auto piece = pattern.pieces.find(id);
    if (piece == pattern.pieces.end()) continue;
    const Outline& outline = piece->second->outline;
    for (const Edge& edge : outline.edges) {
      std::vector<double> places{0};
      for (const GradePoint& point : points)
        if (point.edge == edge.name && point.at > 0) places.push_back(point.at);
      std::sort(places.begin(), places.end());
      for (const double at : places) {
        const auto by = differenceAt(outline, points, edge.name, at, grading.sizes.size());
        book.places[id].push_back({edge.curve.atFraction(at) - by[grading.standing], at == 0, number(by)});
      }
    }
  }
  return book;
}

// After the published readers and writers of such tables; none by a maker was at hand to compare with.
Result<std::string> writeGradeRules(const Pattern& pattern, const SheetSettings& settings) {
  const Grading& grading = settings.grading;
  if (grading.pieces.empty()) return refused(say("The pattern is not graded; there are no rules to write."));
  const auto book = ruleBook(pattern, grading);
  if (!book) return book.error();
  const std::vector<std::string> names = asciiSizes(grading.sizes);
  std::string sizes, out;
  for (const std::string& size : names) sizes += (sizes.empty() ? "" : " ") + size;
  const auto line = [&](const std::string& words) { out += words + "\r\n"; };
  line("ANSI/AAMA VERSION: 1.0.0");
  line("AUTHOR: KARINUI");
  line("UNITS: METRIC");
  line("GRADE RULE TABLE: " + edgeWord(settings.title));
  line("NUMBER OF SIZES: " + std::to_string(grading.sizes.size()));
  line("SIZE LIST: " + sizes);
  line("SAMPLE SIZE: " + names[grading.base]);
  for (std::size_t i = 0; i < book->rules.size(); ++i) {
    line("RULE: DELTA " + std::to_string(i + 1));
    std::string pairs;
    for (std::size_t size = 0; size < grading.sizes.size(); ++size) {
      const auto wide = [](std::string number, std::size_t width) {
        return std::string(width - std::min(width, number.size()), ' ') + number;
      };
      const Flat by = book->rules[i][size];
      pairs += wide(fixed(by.u * 1e3, 2), 10) + "," + wide(fixed(by.v * 1e3, 2), 9);
      if (size % 4 == 3 || size + 1 == grading.sizes.size())
        line(pairs), pairs.clear();
      else
        pairs += " ";
    }
  }
  return out;
}

Result<GradeRules> readGradeRules(std::string_view bytes, bool steps) {
  if (bytes.size() > kLargestTable) return badInput(say("The table of grade rules is larger than 4 MB."));
  GradeRules rules;
  std::string sample;
  double unit = 1e-3;
  std::optional<std::size_t> rule;
  std::map<std::size_t, std::vector<double>> numbers;
  std::size_t count = 0;
  while (!bytes.empty()) {
    const auto end = bytes.find('\n');
    const std::string_view line = trimmed(bytes.substr(0, end));
    bytes = end == std::string_view::npos ? std::string_view() : bytes.substr(end + 1);
    ++count;
    if (const auto colon = line.find(':'); colon != std::string_view::npos) {
      const std::string key = upper(trimmed(line.substr(0, colon)));
      const std::string_view value = trimmed(line.substr(colon + 1));
      rule.reset();
      if (key == "UNITS") unit = upper(value) == "ENGLISH" ? kEnglishUnit : 1e-3;
      if (key == "SAMPLE SIZE") sample = cleanText(value);
      if (key == "SIZE LIST")
        for (const std::string& size : wordsIn(value)) rules.sizes.push_back(cleanText(size));
      if (key == "RULE") {
        const auto words = wordsIn(value);
        const auto number = words.empty() ? std::nullopt : parseNumber(words.back());
        if (!number || !(*number >= 0 && *number <= 1e6) || numbers.size() >= kMostRules)
          return badInput(
              say("Line {0} of the table of grade rules: “{1}” is no rule’s number.", count, cleanText(value)));
        rule = static_cast<std::size_t>(*number);
        numbers[*rule].clear();
      }
    } else if (rule) {
      for (const std::string& word : wordsIn(line))
        if (const auto number = parseNumber(word); number && numbers[*rule].size() < 2 * kMostSizes)
          numbers[*rule].push_back(*number * unit);
    }
  }
  if (rules.sizes.size() < 2 || rules.sizes.size() > kMostSizes || numbers.empty())
    return badInput(say("This is no table of grade rules: it names no sizes (SIZE LIST) or no rule (RULE: DELTA 1)."));
  const auto at = std::find(rules.sizes.begin(), rules.sizes.end(), sample);
  if (at == rules.sizes.end())
    return badInput(say("The table of grade rules has the sample size “{0}”, which is none of its sizes.", sample));
  rules.base = static_cast<std::size_t>(at - rules.sizes.begin());
  for (const auto& [number, row] : numbers) {
    if (row.size() < 2 * rules.sizes.size())
      return badInput(say("Grade rule {0} has {1} numbers; {2} sizes need {3}.", number, row.size(), rules.sizes.size(),
                          2 * rules.sizes.size()));
    std::vector<Flat>& by = rules.rules[number];
    for (std::size_t i = 0; i < rules.sizes.size(); ++i) {
      by.push_back({row[2 * i], row[2 * i + 1]});
      if (!(length(by.back()) <= 1))
        return badInput(say("Grade rule {0} leads farther than 1 m in size {1}.", number, rules.sizes[i]));
    }
    if (steps) {
      by[rules.base] = {};
      for (std::size_t i = rules.base; i-- > 0;) by[i] += by[i + 1];
      for (std::size_t i = rules.base + 1; i < by.size(); ++i) by[i] += by[i - 1];
    }
    if (length(by[rules.base]) > 5e-6)
      return badInput(say("Grade rule {0} leads away from where the sample size {1} is.", number, sample));
    by[rules.base] = {};
  }
  return rules;
}

Done takeGradeRules(CadPattern& read, const GradeRules& rules) {
  if (rules.sizes[rules.base] != read.size)
    return badInput(
        say("The rules begin from size {0}; the pattern was read in size {1}.", rules.sizes[rules.base], read.size));
  if (read.rules.empty()) return badInput(say("No point of the file names a grade rule."));
  Grading grading;
  grading.sizes = sizeWords(rules.sizes);
  grading.base = grading.standing = rules.base;
  for (const CadPattern::RulePlace& place : read.rules) {
    const auto rule = rules.rules.find(place.rule);
    if (rule == rules.rules.end())
      return badInput(say("A point names grade rule {0}, which the table does not have.", place.rule));
    GradePoint point{place.edge, place.at, rule->second};
    if (place.fold)
      for (Flat& by : point.by) by = *place.fold * (2 * dot(by, *place.fold)) - by;
    GradePoints& points = grading.pieces[place.piece];
    if (std::none_of(points.begin(), points.end(),
                     [&](const GradePoint& other) { return other.edge == point.edge && other.at == point.at; }))
      points.push_back(std::move(point));
  }
  for (std::size_t size = 0; size < grading.sizes.size(); ++size)
    if (const auto made = patternInSize(read.pattern, grading, size); !made) return made.error();
  read.grading = std::move(grading);
  read.sizes = rules.sizes;
  return {};
}

}  // namespace karinui
