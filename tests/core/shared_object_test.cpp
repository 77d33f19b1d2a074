// What loading changes of the process is put back: rounding, subnormals, locales, streams, the working
// directory, the mask of new files, signals.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cfenv>
#include <cfloat>
#include <clocale>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <locale>
#include <sstream>

#include <pfaff/core/process/shared_object.hpp>
#include <pfaff/core/registry/registry.hpp>

#include "../built.hpp"
#include "../comma_locale.hpp"

#ifdef __x86_64__
#include <xmmintrin.h>

namespace {

using pfaff::testing::test_plugin;

bool flushes_subnormals() {
  volatile double tiny = DBL_MIN;
  tiny = tiny / 4;
  return tiny == 0;
}

// In words, what the plug-in changes.
std::string process_in_words() {
  std::ostringstream words;
  words.imbue(std::locale::classic());
  const mode_t mask = umask(0);
  umask(mask);
  struct sigaction interrupt {
  }, pipe{};
  sigaction(SIGINT, nullptr, &interrupt);
  sigaction(SIGPIPE, nullptr, &pipe);
  sigset_t blocked;
  pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  std::ostringstream new_stream;
  new_stream << 1234567;
  words << std::setlocale(LC_ALL, nullptr) << ' ' << localeconv()->decimal_point << ' ' << new_stream.str()
        << " rounding " << std::fegetround() << " flushes " << flushes_subnormals() << " csr "
        << (_mm_getcsr() & ~0x3FU) << " mask " << mask << " in " << std::filesystem::current_path().string()
        << " interrupts " << (interrupt.sa_handler == SIG_DFL) << " pipes " << (pipe.sa_handler == SIG_IGN)
        << " blocked " << sigismember(&blocked, SIGINT) << " flags " << (std::cout.flags() & std::ios::hex)
        << ' ' << (std::cout.getloc() == std::locale::classic());
  return words.str();
}

TEST(SharedObject, LoadingLeavesTheProcessAsItWas) {
  const pfaff::testing::CommaLocale comma;
  const auto before_the_test = std::signal(SIGPIPE, SIG_IGN);
  const std::string before = process_in_words();
  pfaff::load_plugin(test_plugin("change-the-process"));
  EXPECT_EQ(process_in_words(), before);
  std::signal(SIGPIPE, before_the_test);
}

// A program of somebody else that loads a plug-in may have a locale of C and none of C++.
TEST(SharedObject, TheLocaleOfAHostStaysToo) {
  const pfaff::testing::CommaLocale comma;
  const pfaff::testing::TemporaryDirectory files;
  std::filesystem::copy_file(test_plugin("change-the-process"), files.path() / "copy.so");
  ASSERT_NE(std::setlocale(LC_NUMERIC, "comma"), nullptr);
  const std::string before = process_in_words();
  EXPECT_NE(before.find("LC_NUMERIC=comma"), std::string::npos) << before;
  ASSERT_NE(pfaff::load_shared_object(files / "copy.so", "a plug-in"), nullptr);
  EXPECT_EQ(process_in_words(), before);
  std::setlocale(LC_ALL, "C");
}

// A file is loaded once and runs its initialisers then, so that a copy is loaded, in a process of its own.
TEST(SharedObject, TheControlIsThatThePluginDoesChangeThem) {
  EXPECT_EXIT(
      {
        const pfaff::testing::CommaLocale comma;
        const auto copy =
            std::filesystem::temp_directory_path() / ("pfaff-changes-" + std::to_string(getpid()));
        std::filesystem::copy_file(test_plugin("change-the-process"), copy);
        const std::string before = process_in_words();
        const bool loaded = dlopen(copy.c_str(), RTLD_NOW | RTLD_LOCAL) != nullptr;
        std::filesystem::remove(copy);
        _exit(loaded && flushes_subnormals() && process_in_words() != before ? 7 : 1);
      },
      ::testing::ExitedWithCode(7), "");
}

}  // namespace
#endif
