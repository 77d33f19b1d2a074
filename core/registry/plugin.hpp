// What every plug-in has: names, documentation, where it was registered.
#pragma once

#include <source_location>
#include <string>
#include <typeinfo>
#include <vector>

#include <pfaff/core/registry/abi.hpp>
#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// The part of a descriptor that all kinds of plug-in share.
class Plugin {
 public:
  Plugin(std::string name, std::vector<Parameter> parameters, const std::type_info& type,
         const std::source_location& where);
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;
  virtual ~Plugin();

  [[nodiscard]] const std::string& name() const { return name_; }
  /// What can be set. Virtual for aliases, which leave out what they set themselves.
  [[nodiscard]] virtual const std::vector<Parameter>& parameters() const { return parameters_; }
  /// The source file of the registration.
  [[nodiscard]] const std::string& file() const { return file_; }
  /// True when the plug-in's type has internal linkage, so that two files cannot silently share one name.
  [[nodiscard]] bool in_anonymous_namespace() const { return type_.find("_GLOBAL__N_") != std::string::npos; }

 private:
  std::string name_;
  std::vector<Parameter> parameters_;
  std::string type_;
  std::string file_;
};

}  // namespace pfaff
