// Brackets written as text: a tensor Pi_ij(z, t) in a file, used by a text model or verified by itself.
//
//   name, title, reference, description
//   parameters  = { a = 1 }
//   coordinates = ["x", "y", "z"]
//   let         = { r = "x^2 + y^2" }
//   tensor      = [["0", "z", "-y"], ["-z", "0", "x"], ["y", "-x", "0"]]
//   symmetry    = "skew" or "symmetric",  jacobi = true,  semimetric = true
//   casimirs    = ["x^2 + y^2 + z^2"]
#pragma once

#include <memory>

#include <pfaff/core/bracket.hpp>
#include <pfaff/core/text/plugin_files.hpp>
#include <pfaff/core/text/vocabulary.hpp>

namespace pfaff {

/// A bracket read from a file. It is not registered, and found by the path of its file.
class TextBracket final : public BracketPlugin {
 public:
  /// Reads a file. InputError, with the place in it, for whatever is wrong there.
  static std::unique_ptr<const TextBracket> read(const std::string& path);
  [[nodiscard]] BracketInstance make(const Assignments& assignments) const override;
  /// The absolute path of the file, and what it contained.
  [[nodiscard]] const text::FileContents& files() const { return declaration_.files; }

 private:
  struct Declaration {
    text::FileContents files;
    std::vector<text::TextParameter> parameters;
    std::vector<text::TextCoordinate> coordinates;
    std::vector<text::TextDefinition> definitions;
    std::vector<text::Expression> tensor, casimirs;
    text::Source tensor_place;
  };
  TextBracket(BracketDescriptor descriptor, std::vector<Parameter> parameters, Declaration declaration);
  [[nodiscard]] BracketInstance made(const std::vector<Real>& values) const;

  Declaration declaration_;
};

/// True where the file has a tensor of its own, and so is a bracket rather than a system. InputError where it
/// cannot be read or is not TOML.
bool is_text_bracket(const std::string& path);

/// The bracket of that name or, for the path of a file, the one that is read from it and then lives until the
/// program ends. InputError where there is none, and for whatever is wrong in a file.
const BracketPlugin& bracket_named(const std::string& name);

/// A bracket that a text has chosen, with its settings, and what they make of it.
struct ChosenBracket {
  const BracketPlugin* plugin = nullptr;
  Assignments settings{};
  BracketInstance instance{};
};

/// Why the tensor of a bracket cannot be recorded for a system of so many coordinates, as a phrase; empty
/// where it can.
std::string tensor_refused(const BracketInstance& bracket, std::size_t dimension);
/// Its tensor as a tape, recorded column by column from what it makes of unit covectors, row by row.
std::shared_ptr<const Tape> recorded_tensor(const BracketInstance& bracket);

/// The bracket of the text NAME, NAME(key=value, ...) or FILE.toml, from the folder of the file `of` that
/// names it.
ChosenBracket chosen_bracket(const std::string& text, const std::string& of);

}  // namespace pfaff
