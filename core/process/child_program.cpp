#include <pfaff/core/process/child_program.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
using Clock = std::chrono::steady_clock;

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_of(const ChildProgram& program) {
  std::vector<std::string> beginnings = program.without, kept = program.with;
  for (const std::string& entry : program.with) beginnings.push_back(entry.substr(0, entry.find('=') + 1));
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry)
    if (std::none_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& b) { return std::string_view(*entry).starts_with(b); }))
      kept.emplace_back(*entry);
  return kept;
}

// Both ends of a pipe, closed when it ends.
struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw RunError("cannot start a process: " + std::string(std::strerror(errno)));
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_end(std::size_t which) {
    if (ends[which] >= 0) close(ends[which]);
    ends[which] = -1;
  }
};

[[noreturn]] void give_up(int failure) {
  const int reason = errno;
  if (write(failure, &reason, sizeof reason) < 0) _exit(126);
  _exit(127);
}

// What the child does between fork and exec, where the memory may be that of a process with other threads:
// system calls only.
[[noreturn]] void become(char* const* words, char* const* environment, const char* directory, pid_t parent,
                         bool grouped, int output, int failure) {
  if (grouped && setpgid(0, 0) != 0) give_up(failure);
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) give_up(failure);
  if (getppid() != parent) _exit(127);  // it had died before
  if (directory != nullptr && chdir(directory) != 0) give_up(failure);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0 ||
      dup2(output, STDERR_FILENO) < 0)
    give_up(failure);
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);  // what others opened without saying so
  signal(SIGPIPE, SIG_DFL);
  environ = const_cast<char**>(environment);  // NOLINT: execvp takes this one
  execvp(words[0], words);
  give_up(failure);
}

// Appends what there is to be read; false once there is no more to come.
bool take(int pipe, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t count = read(pipe, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
}

// True once the child has ended; it is still to be waited for.
bool has_ended(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == child;
}

enum class Waited { ended, timed_out, stopped };

// Reads the output until the child has ended. The pipe may end before, where the child closes it, and may not
// end with the child, where another process holds it. Says whether the time was up before, or `stop` was set.
Waited read_to_its_end(pid_t child, int pipe, std::string& output, std::optional<Clock::time_point> end,
                       const std::atomic<bool>* stop) {
  constexpr int between = 20;  // milliseconds between two looks at a child that writes nothing
  bool open = true;
  while (!has_ended(child)) {
    if (end && Clock::now() > *end) return Waited::timed_out;
    if (stop != nullptr && stop->load()) return Waited::stopped;
    pollfd stream{open ? pipe : -1, POLLIN, 0};
    // Behind the end of its output a child has only its own end left to do.
    if (poll(&stream, 1, open ? between : 1) > 0) open = take(pipe, output);
  }
  pollfd stream{pipe, POLLIN, 0};
  while (open && poll(&stream, 1, 0) > 0) open = take(pipe, output);
  return Waited::ended;
}
}  // namespace

std::string ChildEnding::in_words() const {
  switch (kind) {
    case Kind::exited:
      return "ended with status " + std::to_string(status);
    case Kind::signalled:
      return std::string("was ended by: ") + strsignal(status);
    case Kind::timed_out:
      return "did not end in time";
    default:
      return std::string("could not be run: ") + std::strerror(status);
  }
}

ChildEnding run_program(const ChildProgram& program) {
  std::vector<std::string> words = program.words, variables = environment_of(program);
  const std::vector<char*> arguments = pointers_to(words), environment = pointers_to(variables);
  const char* directory = program.directory.empty() ? nullptr : program.directory.c_str();
  const Budget* const budget = Budget::current();
  const std::atomic<bool>* const stop = budget != nullptr ? budget->stop() : nullptr;
  const bool grouped = program.limit || stop != nullptr;  // it may have to be killed with all that it started
  Pipe output, failure;
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw RunError("cannot start a process: " + std::string(std::strerror(errno)));
  if (child == 0)
    become(arguments.data(), environment.data(), directory, parent, grouped, output.ends[1], failure.ends[1]);
  output.close_end(1);
  failure.close_end(1);
  ChildEnding ending;
  const auto end = program.limit ? std::optional(Clock::now() + *program.limit) : std::nullopt;
  const Waited waited = read_to_its_end(child, output.ends[0], ending.output, end, stop);
  // As long as the child is not waited for, its number is that of its group and nobody else's.
  if (grouped) kill(-child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (waited == Waited::stopped) throw BudgetSpent(BudgetSpent::Reason::stop, 0);
  if (waited == Waited::timed_out) {
    ending.kind = ChildEnding::Kind::timed_out;
  } else if (read(failure.ends[0], &ending.status, sizeof ending.status) == sizeof ending.status) {
    ending.kind = ChildEnding::Kind::not_started;
  } else if (WIFSIGNALED(status)) {
    ending.kind = ChildEnding::Kind::signalled;
    ending.status = WTERMSIG(status);
  } else {
    ending.kind = ChildEnding::Kind::exited;
    ending.status = WEXITSTATUS(status);
  }
  return ending;
}

}  // namespace pfaff
