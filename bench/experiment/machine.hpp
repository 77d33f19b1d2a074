// On which machine timings were taken.
#pragma once

#include <filesystem>
#include <string>

#include <pfaff/bench/runner/json.hpp>

namespace pfaff {

/// True where the file holds what machine() gives.
bool is_machine(const std::filesystem::path& file);

/// The processes that were ready to run, as a mean over the last minute; negative where it is not known.
double load();

/// The name of this machine; empty where it has none.
std::string host_name();

/// Processor, number of processors, operating system, host and date (UTC), and the loads before and after the
/// timings, as machine.json has them.
nlohmann::json machine(double load_before, double load_after);

}  // namespace pfaff
