#include <pfaff/bench/experiment/machine.hpp>

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include <sys/utsname.h>

#include <pfaff/core/process/input_file.hpp>

namespace pfaff {

namespace {
// What stands behind `key` and a separator in the first line of a file that begins with it, quotes left out.
std::string value_in(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t at = line.find(separator);
    if (!line.starts_with(key) || at == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
    const std::size_t end = line.find_last_not_of(" \t\"");
    return begin == std::string::npos ? std::string() : line.substr(begin, end - begin + 1);
  }
  return {};
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  std::array<char, 32> text{};
  gmtime_r(&now, &parts);
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts)};
}
}  // namespace

double load() {
  std::array<double, 1> mean{};
  return getloadavg(mean.data(), 1) == 1 ? mean[0] : -1;
}

std::string host_name() {
  utsname names{};
  return uname(&names) == 0 ? names.nodename : "";
}

bool is_machine(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  nlohmann::json found = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!found.is_object()) return false;
  const nlohmann::json like = machine(0, 0);
  for (const auto& [key, value] : like.items())
    if (found[key].is_string() != value.is_string() || found[key].is_number() != value.is_number() ||
        found[key].is_array() != value.is_array())
      return false;
  return true;
}

nlohmann::json machine(double load_before, double load_after) {
  utsname names{};
  const bool named = uname(&names) == 0;
  std::string system = value_in("/etc/os-release", "PRETTY_NAME", '=');
  if (named)
    system +=
        (system.empty() ? "" : ", ") + std::string(names.sysname) + " " + names.release + " " + names.machine;
  return {{"cpu", value_in("/proc/cpuinfo", "model name", ':')},
          {"processors", std::thread::hardware_concurrency()},
          {"system", system},
          {"host", host_name()},
          {"date", date()},
          {"load", {load_before, load_after}}};
}

}  // namespace pfaff
