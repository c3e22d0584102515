#include "serve_request.h"

namespace karinui::app {

Error notARequest() { return badInput(say("A request is one line with one JSON object, like {0}", kRequestExample)); }

Result<Json> parseRequest(std::string_view line) {
  bool deep = false;
  auto request = shallowJson(line, &deep);
  if (deep) return badInput(say("The JSON is nested more than {0} levels deep.", kDeepestJson));
  if (!request || !request->is_object()) return notARequest();
  return *std::move(request);
}

std::string Fields::text(const char* name, const std::string& usual) {
  const Json* value = find(name);
  if (!value) return usual;
  if (!value->is_string()) return wrong(say("“{0}” must be text.", name)), usual;
  return value->get<std::string>();
}

std::string Fields::needed(const char* name) {
  const std::string value = text(name);
  if (value.empty()) wrong(say("The request needs “{0}”.", name));
  return value;
}

bool Fields::flag(const char* name) {
  const Json* value = find(name);
  if (value && !value->is_boolean()) wrong(say("“{0}” must be true or false.", name));
  return value && value->is_boolean() && value->get<bool>();
}

std::optional<double> Fields::number(const char* name, double least, double most) {
  const Json* value = find(name);
  if (!value) return std::nullopt;
  const double given = value->is_number() ? value->get<double>() : most + 1;
  if (!(given >= least && given <= most))
    return wrong(say("“{0}” must be a number from {1} to {2}.", name, least, most)), std::nullopt;
  return given;
}

Done Fields::checked() const {
  if (fault_) return *fault_;
  for (const auto& [name, value] : request_.items()) {
    if (asked_.contains(name)) continue;
    std::string known;
    for (const std::string& field : asked_) known += (known.empty() ? "" : ", ") + field;
    return badInput(say("This request has no field “{0}”; it knows: {1}.", name, known));
  }
  return {};
}

const Json* Fields::find(const char* name) {
  asked_.insert(name);
  const auto at = request_.find(name);
  return at == request_.end() || at->is_null() ? nullptr : &*at;
}

void Fields::wrong(Message what) {
  if (!fault_) fault_ = badInput(std::move(what));
}

}  // namespace karinui::app
