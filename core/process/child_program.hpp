// Programs that are started and waited for: compilers, the scripts of reports, plug-ins on trial.
//
// Nothing goes through a shell. A child reads nothing, dies when the thread that waits for it does, so that
// nothing goes on writing when its starter was killed, and leaves no file of ours open.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfaff {

/// What is started, and how.
struct ChildProgram {
  std::vector<std::string> words;  // the program, looked for in PATH where it has no '/', and its arguments
  std::vector<std::string> without{};  // beginnings of environment variables that it does not get
  std::vector<std::string> with{};     // and, NAME=value, those that it gets besides ours
  std::filesystem::path directory{};   // where it works; empty: where we do
  // Then it and all that it started is killed. Such a program has a process group of its own.
  std::optional<std::chrono::milliseconds> limit{};
};

/// How it ended.
struct ChildEnding {
  enum class Kind { exited, signalled, timed_out, not_started } kind = Kind::not_started;
  int status = 0;      // the exit status, the signal, or errno of what was not started
  std::string output;  // of both streams, in the order of writing

  [[nodiscard]] bool succeeded() const { return kind == Kind::exited && status == 0; }
  /// "ended with status 1", "was ended by: Killed", "could not be run: No such file or directory".
  [[nodiscard]] std::string in_words() const;
};

/// Runs the program to its end. RunError where no process can be started. Where the budget of this thread can
/// be stopped, and is, the program and all that it started is killed, with BudgetSpent; it then has a process
/// group of its own too.
ChildEnding run_program(const ChildProgram& program);

}  // namespace pfaff
