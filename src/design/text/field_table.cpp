#include "design/text/field_table.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "design/text/value_text.h"

namespace karinui {

namespace {

template <class Value>
std::string writeAny(const void* value) {
  return writeValue(*static_cast<const Value*>(value));
}

template <class Value>
Done readAny(std::string_view text, void* value) {
  Value read = value ? *static_cast<const Value*>(value) : Value{};
  Done done = readValue(text, read);
  if (done && value) *static_cast<Value*>(value) = std::move(read);
  return done;
}

template <class Value>
const ValueForm* valueForm(const Value* none) {
  static const ValueForm form{kindOf(none), writeAny<Value>, readAny<Value>};
  return &form;
}

template <class Op>
std::vector<FieldOf> fields(PlainOperation& operation) {
  std::vector<FieldOf> all;
  Op::fields(std::get<Op>(operation), [&](std::string_view name, auto& value, std::string_view help, Need need) {
    all.push_back({name, help, need, valueForm(&value), &value});
  });
  return all;
}

template <class Op>
Operation make() {
  return Op();
}

template <class Value>
struct KindWithin {
  using Kind = Value;
};
template <class Value>
struct KindWithin<std::optional<Value>> {
  using Kind = Value;
};

// Of an operation whose kind says what else it has: which kinds have a field; none where all do.
template <class Op>
std::vector<std::string> kindsWith(std::string_view field) {
  using Kind = typename KindWithin<decltype(Op::kind)>::Kind;
  std::vector<std::string> having;
  const std::string words = kindOf(static_cast<const Kind*>(nullptr));
  std::size_t all = 0;
  for (std::size_t from = 0; from <= words.size(); ++all) {
    const std::size_t end = std::min(words.find('|', from), words.size());
    std::string word = words.substr(from, end - from);
    from = end + 1;
    Kind kind{};
    if (readValue(word, kind) && Op::has(kind, field)) having.push_back(std::move(word));
  }
  if (having.size() == all) having.clear();
  return having;
}

template <class Op>
OperationForm operationForm() {
  OperationForm form{Op::kName, Op::kHelp, make<Op>, fields<Op>, {}, {}};
  Operation usual = form.make();
  for (const FieldOf& field : form.fields(usual)) form.usual.push_back(field.form->write(field.value));
  if constexpr (requires { Op::kKindField; }) {
    form.kindField = Op::kKindField;
    form.kindsWith = kindsWith<Op>;
  }
  return form;
}

template <std::size_t... i>
std::vector<OperationForm> allForms(std::index_sequence<i...>) {
  return {operationForm<std::variant_alternative_t<i, PlainOperation>>()...};
}

}  // namespace

const std::vector<OperationForm>& operationForms() {
  static const std::vector<OperationForm> forms =
      allForms(std::make_index_sequence<std::variant_size_v<PlainOperation>>());
  return forms;
}

}  // namespace karinui
