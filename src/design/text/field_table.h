#pragma once
// The fields of every operation as tables, grown from the operations' own field lists. Text, help, JSON and formulas
// work on these tables: only field_table.cpp is compiled for each operation and each kind of value.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/script.h"

namespace karinui {

// What is done with a value of one type.
struct ValueForm {
  std::string kind;  // kindOf()
  std::string (*write)(const void* value);
  // Reads a value; one that is null is only tried. What cannot be read changes nothing.
  Done (*read)(std::string_view text, void* value);
};

// A field of one operation, which must outlive it.
struct FieldOf {
  std::string_view name, help;
  Need need;
  const ValueForm* form;
  void* value;
};

struct OperationForm {
  std::string_view name, help;
  Operation (*make)();                                                      // with its defaults
  std::vector<FieldOf> (*fields)(PlainOperation& operation);                // of this kind
  std::vector<std::string> usual;                                           // the fields' defaults as text
  std::string_view kindField;                                               // see OperationHelp
  std::vector<std::string> (*kindsWith)(std::string_view field) = nullptr;  // see FieldHelp::kinds
};

// In the order of the variant; made once.
const std::vector<OperationForm>& operationForms();

inline const OperationForm& formOf(const PlainOperation& operation) { return operationForms()[operation.index()]; }
inline std::vector<FieldOf> fieldsOf(PlainOperation& operation) { return formOf(operation).fields(operation); }

}  // namespace karinui
