#include <pfaff/core/registry/trial_load.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <exception>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
// The exit statuses with which the child says how loading ended. They are unusual ones, so that an
// initialiser that ends the program by itself is hardly taken for them.
enum Ending { refused = 200, threw = 201, loaded = 202 };

int report = -1;  // the child's end of the pipe

[[noreturn]] void end_child(const std::string& words, Ending ending) {
  for (std::size_t sent = 0; sent < words.size();) {
    const ssize_t count = write(report, words.data() + sent, words.size() - sent);
    if (count <= 0) break;
    sent += static_cast<std::size_t>(count);
  }
  _exit(ending);
}

[[noreturn]] void load_in_child(const std::string& path, int pipe) {
  report = pipe;
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  std::set_terminate([] { end_child(words_of_current_exception(), threw); });
  // dlopen is declared as a function that never throws, and calls to it are compiled as such. What an
  // initialiser throws would then pass by the handler below, or end the program, as the optimiser pleases.
  // Called through a pointer that may point anywhere, it is a function like others.
  void* (*volatile const load)(const char*, int) = dlopen;
  try {
    if (load(path.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) end_child(dlerror(), refused);
  } catch (...) {
    end_child(words_of_current_exception(), threw);
  }
  _exit(loaded);
}

std::string all_of(int pipe) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t count = read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}
}  // namespace

std::string trial_load(const std::string& path) {
  std::array<int, 2> ends{};
  const auto fail = [] {
    throw RunError("cannot start a process to load plug-ins in: " + std::string(std::strerror(errno)));
  };
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail();
  const pid_t child = fork();
  if (child < 0) fail();
  if (child == 0) load_in_child(path, ends[1]);
  close(ends[1]);
  std::string words = all_of(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status))
    return std::string("ends the program while it is loaded: ") + strsignal(WTERMSIG(status));
  switch (WEXITSTATUS(status)) {
    case loaded:
      return {};
    case refused:
      return words;
    case threw:
      return "throws while it is loaded: " + words;
    default:
      return "ends the program while it is loaded, with exit status " + std::to_string(WEXITSTATUS(status));
  }
}

}  // namespace pfaff
