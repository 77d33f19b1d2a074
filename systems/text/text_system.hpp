// Systems written as text: `--system FILE.toml` wherever the name of a system is taken.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pfaff/brackets/text/text_bracket.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/text/declaration.hpp>

namespace pfaff {

/// A system read from a file, with the brackets that it names. It is not registered, and found by the path of
/// its file. Models are made of what was read then.
class TextSystem final : public SystemPlugin {
 public:
  /// Reads a file. InputError, with the place in it, for whatever is wrong there, evaluated with the values
  /// that its parameters have by themselves.
  static std::unique_ptr<const TextSystem> read(const std::string& path);

  [[nodiscard]] bool constrained() const override { return declaration_.constrained(); }
  [[nodiscard]] bool constrains_velocities() const override {
    return !declaration_.velocity_constraints.empty();
  }
  [[nodiscard]] std::shared_ptr<const Model> make(const Assignments& assignments) const override;
  [[nodiscard]] std::vector<Assignments> instances(bool full) const override;
  /// The files that it was made of.
  [[nodiscard]] const text::FileContents& files() const { return files_; }
  /// The registered brackets that it names, with their settings.
  [[nodiscard]] std::vector<std::pair<const Plugin*, Assignments>> rests_on() const;

 private:
  TextSystem(SystemDescriptor descriptor, std::vector<Parameter> parameters,
             text::TextDeclaration declaration, text::FileContents files);

  text::TextDeclaration declaration_;
  text::FileContents files_;
};

/// The system of that name or, for the path of a file, the one that is read from it. A file is read once for
/// each of its contents, and the system lives until the program ends. InputError where there is none, and for
/// whatever is wrong in a file.
const SystemPlugin& system_named(const std::string& name);

}  // namespace pfaff
