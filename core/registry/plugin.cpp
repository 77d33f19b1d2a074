#include <pfaff/core/registry/plugin.hpp>

namespace pfaff {

Plugin::Plugin(std::string name, std::vector<Parameter> parameters, const std::type_info& type,
               const std::source_location& where)
    : name_(std::move(name)),
      parameters_(std::move(parameters)),
      type_(type.name()),
      file_(where.file_name()) {}
Plugin::~Plugin() = default;

}  // namespace pfaff
