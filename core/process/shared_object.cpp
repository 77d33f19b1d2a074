#include <pfaff/core/process/shared_object.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <locale>
#include <mutex>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
// What loading may change, as it is when this is made, and again when it ends.
class ProcessState {
 public:
  ProcessState() : directory_(open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)), new_files_(umask(0077)) {
    umask(new_files_);
    std::fegetenv(&arithmetic_);
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked_);
    for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], nullptr, &actions_[k]);
    for (std::size_t k = 0; k < streams_.size(); ++k) formats_[k].copyfmt(*streams_[k]);
  }
  ~ProcessState() {
    for (std::size_t k = 0; k < streams_.size(); ++k) streams_[k]->copyfmt(formats_[k]);
    // The global locale of C++ sets that of C, which therefore comes second.
    if (std::locale() != of_cpp_) std::locale::global(of_cpp_);
    std::setlocale(LC_ALL, of_c_.c_str());
    uselocale(of_thread_);
    for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &actions_[k], nullptr);
    pthread_sigmask(SIG_SETMASK, &blocked_, nullptr);
    umask(new_files_);
    [[maybe_unused]] const int ignored = fchdir(directory_);  // fails where nobody may enter it any more
    close(directory_);
    std::fesetenv(&arithmetic_);
  }
  ProcessState(const ProcessState&) = delete;
  ProcessState& operator=(const ProcessState&) = delete;

 private:
  static constexpr std::array signals{SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGALRM, SIGTERM, SIGCHLD};
  const std::array<std::ostream*, 3> streams_{&std::cout, &std::cerr, &std::clog};
  int directory_;
  mode_t new_files_;
  std::fenv_t arithmetic_{};
  sigset_t blocked_{};
  std::array<struct sigaction, signals.size()> actions_{};
  std::array<std::ios, 3> formats_{std::ios(nullptr), std::ios(nullptr), std::ios(nullptr)};
  const std::locale of_cpp_;
  const std::string of_c_ = std::setlocale(LC_ALL, nullptr);
  const locale_t of_thread_ = uselocale(nullptr);
};

// Whose code is being loaded; empty while none is.
std::string& loading() {
  static std::string who;
  return who;
}

[[noreturn]] void end_with(const std::string& what) {
  const std::string line = "pfaff: " + on_one_line(loading() + ": " + what) + "\n";
  if (write(STDERR_FILENO, line.data(), line.size()) < 0) _exit(1);
  _exit(2);
}

// Runs when the program ends, whoever ended it.
void complain_of_end() {
  if (!loading().empty()) end_with("ends the program while it is loaded");
}
}  // namespace

void* load_shared_object(const std::string& path, const std::string& who) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  loading();  // made before, and so destroyed after, what runs at the end
  static const bool watched = std::atexit(complain_of_end) == 0 && std::at_quick_exit(complain_of_end) == 0;
  if (!watched) throw RunError("cannot watch what ends the program while " + who + " is loaded");
  const ProcessState state;
  const pid_t process = getpid();
  const std::terminate_handler before =
      std::set_terminate([] { end_with("throws while it is loaded: " + words_of_current_exception()); });
  loading() = who;
  // dlopen is declared as a function that never throws, and calls to it are compiled as such. Called through
  // a pointer that may point anywhere, it is a function like others, behind which what an initialiser throws
  // is caught. The loader's state is lost with it, so that the program cannot go on.
  void* (*volatile const load)(const char*, int) = dlopen;
  void* handle = nullptr;
  try {
    handle = load(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  } catch (...) {
    end_with("throws while it is loaded: " + words_of_current_exception());
  }
  if (getpid() != process) _exit(0);  // a second process comes back; the program is to go on once
  loading().clear();
  std::set_terminate(before);
  return handle;
}

}  // namespace pfaff
