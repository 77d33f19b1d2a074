// What is done with an input: the same parsers and checks that the program runs before it starts to work.
#pragma once

#include <filesystem>
#include <string>

#include "grammar.hpp"

namespace pfaff::fuzz {

/// How far an input came. `refused`: by the parser; `parsed`: the parser took it, and it was refused later;
/// `resolved`: everything is ready to start.
enum class Reached { refused, parsed, resolved };

/// Reads the file, which is in this language, and resolves what it says. Steps are taken where there are few
/// of them. A message that is not one line, and anything thrown but InputError, is a fault: std::logic_error,
/// or whatever was thrown.
Reached read_and_resolve(Language language, const std::filesystem::path& file);

}  // namespace pfaff::fuzz
