// Errors that reach the user, each one line: what, where, what was expected.
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pfaff {

/// The text with a space for every line break, which may stand in what it quotes of the user's input.
std::string on_one_line(std::string_view text);

/// Wrong usage or input (exit status 2): found before work starts.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string_view text) : std::runtime_error(on_one_line(text)) {}
};

/// What the code of a plug-in throws that is no error of this kind: wrong is the plug-in, whoever asks for
/// it.
class PluginError : public InputError {
 public:
  using InputError::InputError;
};

/// Something went wrong while working (exit status 1), such as a disk that is full.
class RunError : public std::runtime_error {
 public:
  explicit RunError(std::string_view text) : std::runtime_error(on_one_line(text)) {}
};

/// The exception that is being handled, in words: what it says or, where it is none of the standard
/// library's, its type. To be called in a catch clause only.
std::string words_of_current_exception();

/// Returns work(). What it throws, of whatever type, becomes a PluginError that begins with `who`, the
/// plug-in whose code is run, a text or what makes it where it is needed; an InputError, a RunError and a
/// lack of memory pass as they are.
template <class Who, class Work>
auto on_behalf_of(const Who& who, Work&& work) {
  try {
    return work();
  } catch (const InputError&) {
    throw;
  } catch (const RunError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    const std::string words = words_of_current_exception();
    if constexpr (std::is_invocable_v<const Who&>) {
      throw PluginError(who() + ": " + words);
    } else {
      throw PluginError(std::string(who) + ": " + words);
    }
  }
}

/// The candidate closest to `name` by edit distance; empty when none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

/// "unknown system 'damped-oscilator'; did you mean 'damped-oscillator'?" or with the list of valid names.
std::string unknown_name(std::string_view kind, std::string_view name,
                         const std::vector<std::string>& candidates);

}  // namespace pfaff
