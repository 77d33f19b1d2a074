// What text plug-ins of every kind have in common: parameters, coordinates, definitions, and their names.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/text/document.hpp>
#include <pfaff/core/text/scope.hpp>

namespace pfaff::text {

struct TextParameter {
  std::string name, unit, meaning;
  Real value;
  double minimum = 0, maximum = 0;
};

/// A coordinate or, with a count, several: name[1], name[2], ...
struct TextCoordinate {
  std::string name, unit;
  std::optional<Expression> count{};
  Source place;
  Range range = unbounded;
};

/// A name for an expression, or for a list of them.
struct TextDefinition {
  std::string name;
  std::vector<Expression> expressions;
  bool is_list = false;
};

/// The names that are taken so far, each with what it is.
class TakenNames {
 public:
  /// Takes a name; TextError where it is none, or has a meaning already.
  void take(const Source& place, const std::string& name, const std::string& what);

 private:
  std::vector<std::pair<std::string, std::string>> taken_;
};

/// The parameters of a plug-in, the value of its key `parameters`: NAME = number, or NAME = { value, unit,
/// range = [smallest, largest], meaning }.
std::vector<TextParameter> read_parameters(const Item& value, TakenNames& names);
/// The coordinates: a list of names, or of { name, unit }, or a table NAME = count, NAME = { count, unit }.
std::vector<TextCoordinate> read_coordinates(const Item& value, TakenNames& names);
/// The definitions, the value of the key `let`.
std::vector<TextDefinition> read_definitions(const Item& value, TakenNames& names);
/// A text that files and tables hold as it is; TextError where it has control characters, quotation marks or
/// commas.
std::string label_of(const Item& value, const std::string& what);

/// The values that parameters have by themselves.
std::vector<Real> default_values(const std::vector<TextParameter>& parameters);
/// Parameters of a plug-in whose object is the std::vector<Real> of their values.
std::vector<Parameter> plugin_parameters(const std::vector<TextParameter>& parameters);
/// Makes parameters and definitions known to a scope.
void define(Scope& scope, const std::vector<TextParameter>& parameters, const std::vector<Real>& values,
            const std::vector<TextDefinition>& definitions);
/// How many coordinates one declaration makes; TextError where it is not a number in 1 .. 100000.
std::size_t count_of(const TextCoordinate& coordinate, const Scope& scope);

/// True where the text is the path of a text plug-in rather than a name: it ends in ".toml".
bool is_text_file(std::string_view name);
/// The path of a file that another one names: from the folder of that one, unless it is absolute.
std::string beside(const std::string& file, const std::string& other);

}  // namespace pfaff::text
