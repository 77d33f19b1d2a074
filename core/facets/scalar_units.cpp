#include <pfaff/core/facets/scalar_units.hpp>

#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pfaff::detail {

namespace {

// By the names of the types: of a type in an unnamed namespace each unit has a std::type_info of its own.
struct CodeLeft {
  std::mutex mutex;
  std::map<std::pair<std::string_view, std::string_view>, AnyFunction> code;
};
CodeLeft& all() {
  static CodeLeft left;
  return left;
}

}  // namespace

void leave_code(const std::type_info& made_by, const std::type_info& scalar, AnyFunction code) {
  const std::lock_guard lock(all().mutex);
  const bool first = all().code.emplace(std::pair(made_by.name(), scalar.name()), code).second;
  // Units that share a type with a name of its own have the same code.
  if (!first && std::string_view(made_by.name()).find("_GLOBAL__N_") != std::string_view::npos)
    throw std::logic_error(std::string("two plug-ins have a type of the same name: ") + made_by.name());
}

AnyFunction code_left(const std::type_info& made_by, const std::type_info& scalar) {
  const std::lock_guard lock(all().mutex);
  const auto found = all().code.find({made_by.name(), scalar.name()});
  if (found == all().code.end())
    throw std::logic_error(std::string("no unit left code in ") + scalar.name() + " of " + made_by.name());
  return found->second;
}

}  // namespace pfaff::detail
