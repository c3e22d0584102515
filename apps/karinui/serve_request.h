#pragma once
// What `karinui serve` is asked: one line of JSON, a stranger's bytes. Any thread.
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "karinui/base/result.h"
#include "shallow_json.h"

namespace karinui::app {

inline constexpr const char* kRequestExample = R"({"id": 1, "do": "open", "file": "coat.karinui"})";

Error notARequest();  // the refusal of what is no object of JSON
// The object that the line holds. Refused where it is none, or nested too deep.
Result<Json> parseRequest(std::string_view line);

// The fields of a request: each is asked for by its kind, and what nobody asked for is a mistake.
class Fields {
 public:
  explicit Fields(const Json& request) : request_(request) {}

  std::string text(const char* name, const std::string& usual = {});
  std::string needed(const char* name);
  bool flag(const char* name);
  std::optional<double> number(const char* name, double least, double most);
  // What is wrong with the request, once everything was asked for.
  Done checked() const;

 private:
  const Json* find(const char* name);
  void wrong(Message what);
  const Json& request_;
  std::set<std::string> asked_{"id", "do"};
  std::optional<Error> fault_;
};

}  // namespace karinui::app
