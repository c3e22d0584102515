// Formulas read by recursive descent. The depth of the descent is that of brackets, signs and powers, and is bounded.
#include <charconv>
#include <utility>

#include "design/formula/words.h"
#include "design/text/value_text.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::size_t kMostBytes = 1000, kMostTerms = 400;
constexpr int kMostDepth = 60;

using Kind = FormulaTerm::Kind;

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

// The signs that people type or paste, as the grammar has them.
std::string plainSigns(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> kSigns[]{
      {"×", "*"},  {"·", "*"},  {"÷", "/"},  {"−", "-"},  {"°", "deg"}, {"　", " "},  {"＋", "+"}, {"－", "-"},
      {"＊", "*"}, {"／", "/"}, {"（", "("}, {"）", ")"}, {"．", "."},  {"\"", "in"}, {"″", "in"}, {"”", "in"}};
  std::string out;
  bool named = false, counted = false;  // in a name, whose digits may be of any width; in a number and its unit
  while (!text.empty()) {
    bool found = false;
    for (const auto& [typed, plain] : kSigns)
      if (text.starts_with(typed)) {
        counted = counted && plain == ".", named = false;
        out += plain, text.remove_prefix(typed.size()), found = true;
        break;
      }
    if (found) continue;
    constexpr std::size_t kWide = 3;  // bytes of a character of full width
    const std::string one = text.size() >= kWide ? halfWidth(text.substr(0, kWide)) : std::string();
    if (one.size() == 1 && !named && (digit(one[0]) || (counted && letter(one[0])))) {
      out += one, text.remove_prefix(kWide), counted = true;
      continue;
    }
    named = letter(text[0]) || (named && digit(text[0]));
    counted = !named && (digit(text[0]) || (counted && text[0] == '.'));
    out += text[0], text.remove_prefix(1);
  }
  return out;
}

class Reading {
 public:
  explicit Reading(std::string_view text) : text_(text) {}

  Result<std::vector<FormulaTerm>> all() {
    if (Done done = sum(); !done) return done.error();
    skip();
    if (at_ < text_.size()) return unexpected();
    return std::move(terms_);
  }

 private:
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  char peek() { return skip(), at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(char c) { return peek() == c ? (++at_, true) : false; }
  std::string_view before() const { return text_.substr(at_ > 40 ? at_ - 40 : 0, std::min<std::size_t>(at_, 40)); }
  Error unexpected() {
    skip();
    if (at_ == text_.size())
      return badInput(say("The formula “{0}” ends too soon: a number, a measure, a variable or an edge is missing.",
                          text_.substr(0, 80)));
    return badInput(say("The formula cannot go on with “{1}” after “{0}”.", before(), text_.substr(at_, 20)));
  }
  Done put(FormulaTerm term) {
    if (terms_.size() == kMostTerms) return badInput(say("This formula is too long."));
    terms_.push_back(std::move(term));
    return {};
  }
  Done put(Kind kind) { return put(FormulaTerm{kind}); }

  Done sum() {
    if (Done done = product(); !done) return done;
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      ++at_;
      if (Done done = product(); !done) return done;
      if (Done done = put(c == '+' ? Kind::Add : Kind::Subtract); !done) return done;
    }
    return {};
  }
  Done product() {
    if (Done done = factor(); !done) return done;
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      ++at_;
      if (Done done = factor(); !done) return done;
      if (Done done = put(c == '*' ? Kind::Multiply : Kind::Divide); !done) return done;
    }
    return {};
  }
  Done factor() {
    if (depth_ >= kMostDepth) return badInput(say("This formula is nested too deep."));
    ++depth_;
    Done done = signedOperand();
    --depth_;
    return done;
  }
  Done signedOperand() {
    if (take('-')) {
      if (Done done = factor(); !done) return done;
      return put(Kind::Negate);
    }
    if (take('+')) return factor();
    if (Done done = operand(); !done) return done;
    if (!take('^')) return {};
    if (Done done = factor(); !done) return done;
    return put(Kind::Power);
  }
  Done operand() {
    const char c = peek();
    if (digit(c) || c == '.') return number();
    if (c == '[') return bracketedEdge();
    if (letter(c)) return word();
    if (!take('(')) return unexpected();
    if (Done done = sum(); !done) return done;
    return take(')') ? Done() : unexpected();
  }
  std::string_view letters() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (letter(text_[at_]) || digit(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  Done number() {
    FormulaTerm term;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), term.number);
    if (error != std::errc()) return unexpected();
    at_ += static_cast<std::size_t>(end - begin);
    if (takeInches(term)) return put(std::move(term));
    const std::size_t behind = at_;
    skip();
    if (at_ < text_.size() && text_[at_] == '%') {
      ++at_, term.word = "%";
    } else if (at_ < text_.size() && letter(text_[at_])) {
      const std::string_view unit = letters();
      if (!formulaUnit(unit))
        return badInput(say("“{0}” is no unit; there are mm, cm, m, in, deg, rad and %.", unit.substr(0, 40)));
      term.word = unit;
    } else {
      at_ = behind;
    }
    return put(std::move(term));
  }
  // The fraction behind a number of inches, as in 27 1/2in. A fraction alone, 1/2in, is one through two inches.
  bool takeInches(FormulaTerm& term) {
    std::size_t end = at_;
    const auto run = [&](auto&& belongs) {
      const std::size_t begin = end;
      while (end < text_.size() && belongs(text_[end])) ++end;
      return text_.substr(begin, end - begin);
    };
    const auto blank = [](char c) { return c == ' '; };
    if (run(blank).empty()) return false;
    const auto part = parseNumber(run(digit));
    if (!part || end == text_.size() || text_[end++] != '/') return false;
    const auto of = parseNumber(run(digit));
    run(blank);
    if (!of || *part >= *of || run(letter) != "in") return false;
    term.number += *part / *of, term.word = "in", at_ = end;
    return true;
  }
  Result<EdgeRef> edge(std::string_view text) {
    EdgeRef read;
    if (Done done = readValue(text, read); !done) return done.error();
    return read;
  }
  Done putEdge(std::string_view text) {
    auto read = edge(text);
    if (!read) return read.error();
    FormulaTerm term{Kind::Edge};
    term.edge = *std::move(read);
    return put(std::move(term));
  }
  Done bracketedEdge() {
    const std::size_t end = text_.find(']', at_);
    if (end == std::string_view::npos)
      return badInput(say("The bracket before “{0}” is never closed.", text_.substr(at_ + 1, 40)));
    const std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return putEdge(inside);
  }
  Done word() {
    const std::size_t begin = at_;
    const std::string_view name = letters();
    bool dotted = false;
    while (at_ + 1 < text_.size() && text_[at_] == '.' && (letter(text_[at_ + 1]) || digit(text_[at_ + 1])))
      ++at_, letters(), dotted = true;
    if (dotted) return putEdge(text_.substr(begin, at_ - begin));
    if (take('(')) return call(name);
    if (name == "nan" || name == "inf" || name == "infinity") return badInput(say("“{0}” is no number.", name));
    return put(FormulaTerm{Kind::Name, 0, std::string(name)});
  }
  Done call(std::string_view name) {
    const FormulaFunction* function = formulaFunction(name);
    if (!function && name != kMirror)
      return badInput(say("There is no function “{0}”; there are: {1}.", name.substr(0, 40), formulaFunctions()));
    const std::size_t first = terms_.size();
    FormulaTerm term{Kind::Call, 0, std::string(name)};
    do {
      if (Done done = sum(); !done) return done;
      ++term.arguments;
    } while (take(','));
    if (!take(')')) return unexpected();
    if (!function) {
      if (terms_.size() != first + 1 || terms_[first].kind != Kind::Edge || terms_[first].mirrored)
        return badInput(say("mirror() wants one edge, like mirror(front.side_left)."));
      terms_[first].mirrored = true;
      return {};
    }
    if (term.arguments < function->least || term.arguments > function->most)
      return badInput(function->least == 1
                          ? say("{0}() wants one value.", name)
                          : say("{0}() wants {1} values, with commas between.", name, function->least));
    return put(std::move(term));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<FormulaTerm> terms_;
};

}  // namespace

Result<Formula> Formula::parse(std::string_view text) {
  if (text.size() > kMostBytes) return badInput(say("This formula is too long."));
  const std::string plain = plainSigns(text);
  auto terms = Reading(plain).all();
  if (!terms) return terms.error();
  return Formula(*std::move(terms));
}

}  // namespace karinui
