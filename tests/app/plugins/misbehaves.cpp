// A shared object whose initialiser does what no plug-in should: MISBEHAVES names one of the functions below.
// Before it does, it leaves the number of its process in the file PFAFF_WITNESS.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <locale>
#include <stdexcept>

#include <pfaff/core/registry/abi.hpp>

namespace {

// True where it has been loaded before, on trial.
[[maybe_unused]] bool loaded_before() {
  const char* file = std::getenv("PFAFF_WITNESS");
  const bool before = file != nullptr && std::filesystem::exists(file);
  if (file != nullptr) std::ofstream(std::string(file) + ".new") << getpid() << '\n';
  if (file != nullptr) std::filesystem::rename(std::string(file) + ".new", file);
  return before;
}

[[maybe_unused]] void hang() {
  (void)loaded_before();
  for (;;) pause();
}
[[maybe_unused]] void come_back_twice() { (void)(fork() + 1); }
[[maybe_unused]] void leave_a_process() {
  if (fork() == 0) hang();
}
[[maybe_unused]] void exit_later() {
  if (loaded_before()) std::exit(0);
}
[[maybe_unused]] void exit_quickly_later() {
  if (loaded_before()) std::quick_exit(0);
}
[[maybe_unused]] void throw_later() {
  if (loaded_before()) throw std::runtime_error("not twice");
}
[[maybe_unused]] void fork_later() {
  if (loaded_before()) come_back_twice();
}

struct Commas : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};
locale_t comma_locale = nullptr;
// Everything that a program may have one of.
[[maybe_unused]] void change_the_process() {
  const std::locale commas(std::locale::classic(), new Commas);
  std::locale::global(commas);
  std::cout.imbue(commas);
  std::cout << std::hex << std::showbase;
  if (std::setlocale(LC_NUMERIC, "comma") == nullptr) std::abort();
  comma_locale = duplocale(LC_GLOBAL_LOCALE);  // newlocale would leak where it looks for locales, LOCPATH
  uselocale(comma_locale);
  std::fesetround(FE_TOWARDZERO);
  _mm_setcsr(_mm_getcsr() | 0x8040U);  // subnormals are flushed to zero, and taken for zero
  umask(0);
  if (chdir("/") != 0) std::abort();
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGPIPE, SIG_DFL);
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, nullptr);
}

struct Initialiser {
  Initialiser() { MISBEHAVES(); }
  Initialiser(const Initialiser&) = delete;
  Initialiser& operator=(const Initialiser&) = delete;
  ~Initialiser() {
    if (comma_locale != nullptr) freelocale(comma_locale);
  }
};
const Initialiser initialiser;
}  // namespace
