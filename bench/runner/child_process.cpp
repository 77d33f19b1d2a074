#include <pfaff/bench/runner/child_process.hpp>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace pfaff {

namespace {
// What the child does until it is another program. Nothing here allocates, since other threads may have held
// a lock of the allocator when the process was copied.
[[noreturn]] void become(char* const* arguments, int output, pid_t parent) {
  constexpr int not_started = 127;
  // The signal comes when the parent ends; where it has ended already, there is another parent by now.
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent) _exit(not_started);
  if (dup2(output, STDOUT_FILENO) < 0 || dup2(output, STDERR_FILENO) < 0) _exit(not_started);
  (void)std::signal(SIGPIPE, SIG_DFL);
  execvp(arguments[0], arguments);
  _exit(not_started);
}
}  // namespace

ChildOutcome run_child(const std::vector<std::string>& command) {
  ChildOutcome outcome;
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return outcome;
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(arguments.data(), ends[1], parent);
  close(ends[1]);
  std::array<char, 4096> buffer{};
  for (ssize_t count = 0; child > 0;) {
    count = read(ends[0], buffer.data(), buffer.size());
    if (count == 0 || (count < 0 && errno != EINTR)) break;
    if (count > 0) outcome.output.append(buffer.data(), static_cast<std::size_t>(count));
  }
  close(ends[0]);
  int status = 0;
  if (child < 0) return outcome;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

}  // namespace pfaff
