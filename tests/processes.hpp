// Processes that tests look for.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace pfaff::testing {

/// The process whose number stands in a file, which is waited for, for ten seconds; -1 where none appears.
inline pid_t process_in(const std::string& file) {
  for (int attempt = 0; attempt < 500; ++attempt) {
    pid_t number = -1;
    if (std::ifstream(file) >> number) return number;
    usleep(20000);
  }
  return -1;
}

/// True once the process has ended, which is waited for, for ten seconds.
inline bool gone(pid_t process) {
  if (process <= 0) return false;
  for (int attempt = 0; attempt < 500; ++attempt) {
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string number, name, state;
    // Nobody may have asked for its status yet.
    if (!(status >> number >> name >> state) || state == "Z" || state == "X") return true;
    usleep(20000);
  }
  return false;
}

}  // namespace pfaff::testing
