#include <pfaff/core/registry/trial_load.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/child_program.hpp>
#include <pfaff/core/registry/shipped_plugins.hpp>

namespace pfaff {

namespace {
// The exit statuses with which the trial says how loading ended. They are unusual ones, so that an
// initialiser that ends the program by itself is hardly taken for them.
enum Ending { refused = 200, threw = 201, loaded = 202, multiplied = 203 };

int report = -1;  // where the trial writes

[[noreturn]] void end_trial(const std::string& words, Ending ending) {
  for (std::size_t sent = 0; sent < words.size();) {
    const ssize_t count = write(report, words.data() + sent, words.size() - sent);
    if (count <= 0) break;
    sent += static_cast<std::size_t>(count);
  }
  _exit(ending);
}

// True where another process was started and not waited for. Orphans come back to the trial.
bool left_a_process() { return waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD; }

// The program that stands beside the library.
std::string trial_program() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&trial_load), &library) == 0 || library.dli_fname == nullptr)
    throw RunError("plug-ins are tried before they are loaded, and the library's own path is not known");
  const auto path = std::filesystem::absolute(library.dli_fname).parent_path() / "pfaff-trial-load";
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw RunError(
        "plug-ins are tried before they are loaded, and the program for it is missing; expected '" +
        path.string() + "'");
  return path.string();
}
}  // namespace

void load_on_trial(const char* path) {
  load_shipped_plugins();
  report = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  std::set_terminate([] { end_trial(words_of_current_exception(), threw); });
  const pid_t process = getpid();
  // dlopen is declared as a function that never throws, and calls to it are compiled as such. What an
  // initialiser throws would then pass by the handler below, or end the program, as the optimiser pleases.
  // Called through a pointer that may point anywhere, it is a function like others.
  void* (*volatile const load)(const char*, int) = dlopen;
  try {
    if (load(path, RTLD_NOW | RTLD_LOCAL) == nullptr) end_trial(dlerror(), refused);
  } catch (...) {
    end_trial(words_of_current_exception(), threw);
  }
  if (getpid() != process) _exit(multiplied);
  _exit(left_a_process() ? multiplied : loaded);
}

std::string trial_load(const std::string& path, std::chrono::milliseconds limit) {
  const ChildEnding ending = run_program({.words = {trial_program(), path}, .limit = limit});
  switch (ending.kind) {
    case ChildEnding::Kind::timed_out:
      return "does not end to be loaded within " + std::to_string(limit.count()) + " ms";
    case ChildEnding::Kind::not_started:
      throw RunError("cannot start '" + trial_program() + "': " + std::strerror(ending.status));
    case ChildEnding::Kind::signalled:
      return std::string("ends the program while it is loaded: ") + strsignal(ending.status);
    default:
      break;
  }
  switch (ending.status) {
    case loaded:
      return {};
    case refused:
      return ending.output;
    case threw:
      return "throws while it is loaded: " + ending.output;
    case multiplied:
      return "leaves another process behind while it is loaded";
    default:
      return "ends the program while it is loaded, with exit status " + std::to_string(ending.status);
  }
}

}  // namespace pfaff
