#include "design/formula/stated.h"

#include <algorithm>
#include <map>

#include "karinui/body/sizes.h"
#include "karinui/design/formula.h"
#include "karinui/design/glossary.h"
#include "karinui/design/variables.h"

namespace karinui {

namespace {

class StatedNames : public FormulaNames {
 public:
  explicit StatedNames(const SetBody& body) : body_(body) {
    if (const auto size = builtInSize(body.size)) size_ = *size;
  }
  Result<Quantity> named(const std::string& name) override {
    const auto key = measureCalled(name);
    if (!key) return measurementKey(name).error();
    return valueOf(*key);
  }
  Result<Quantity> valueOf(const std::string& key) {
    if (const auto at = known_.find(key); at != known_.end()) return at->second;
    const Dimension dimension = isAngle(key) ? kAngle : kLength;
    const auto own = std::find_if(body_.set.begin(), body_.set.end(), [&](const Stated& s) {
      const auto said = measurementKey(s.key);
      return said && *said == key;
    });
    if (own == body_.set.end()) {
      if (const auto sized = size_.value.find(key); sized != size_.value.end())
        return Quantity{sized->second, dimension};
      return refused(
          say("{0} is not typed for this figure, and what it will measure is not known yet; type it too.", key));
    }
    if (own->formula.empty()) return Quantity{own->value.metres, dimension};
    if (std::find(asking_.begin(), asking_.end(), key) != asking_.end()) return formulaCircle(asking_, key);
    const auto formula = Formula::parse(own->formula);
    if (!formula) return formula.error();
    asking_.push_back(key);
    auto value = evaluate(*formula, *this);
    asking_.pop_back();
    if (value && value->dimension != dimension)
      return refused(
          say("“{0}” is {1}; here goes {2}.", own->formula, dimensionSaid(value->dimension), dimensionSaid(dimension)));
    if (value) known_[key] = *value;
    return value;
  }
  Result<double> edgeLength(const EdgeRef&, bool) override {
    return refused(say("A figure's measures depend on each other, not on the garment's edges."));
  }

 private:
  const SetBody& body_;
  Measurements size_;
  std::map<std::string, Quantity> known_;
  std::vector<std::string> asking_;
};

}  // namespace

Error formulaCircle(const std::vector<std::string>& asking, const std::string& name) {
  auto at = std::find(asking.begin(), asking.end(), name);
  constexpr std::ptrdiff_t kMostSaid = 12;
  Message all = say("{0}", name);
  if (asking.end() - at > kMostSaid) all = say("{0} → {1}", all, "…"), at = asking.end() - kMostSaid;
  while (at != asking.end() && ++at != asking.end()) all = say("{0} → {1}", all, *at);
  return refused(
      say("This goes round in a circle: {0}. Give one of them a value of its own.", say("{0} → {1}", all, name)));
}

std::optional<std::string> measureCalled(std::string_view name) {
  if (auto key = measurementKey(name)) return *std::move(key);
  if (const auto said = identifierOf(name))
    if (auto key = measurementKey(*said)) return *std::move(key);
  return std::nullopt;
}

Done workOutStated(SetBody& body) {
  for (Stated& s : body.set) {  // in canonical form, measures by their keys: the record reads back as itself
    if (s.formula.empty()) continue;
    const auto read = Formula::parse(s.formula);
    if (!read) return read.error();
    const auto known = read->changed([](FormulaTerm& term) -> Done {
      if (term.kind == FormulaTerm::Kind::Name) term.word = measureCalled(term.word).value_or(term.word);
      return {};
    });
    s.formula = known->text();
  }
  StatedNames names(body);
  std::vector<double> values;
  for (const Stated& s : body.set) {
    const auto key = measurementKey(s.key);
    if (!key) return key.error();
    const auto value = names.valueOf(*key);
    if (!value) return value.error();
    values.push_back(value->value);
  }
  for (std::size_t i = 0; i < values.size(); ++i) body.set[i].value = {values[i]};
  return {};
}

}  // namespace karinui
