// Reading files whose paths come from outside: from a user, a configuration, another program.
//
// Only regular files are read. Whoever opens a pipe without a writer waits for one, a device may never end,
// and opening some devices already does something. A file may still be endless for its size alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace pfaff {

/// The longest input that is read: 256 MiB, which a state of a million coordinates in quad precision is far
/// below.
constexpr std::uint64_t longest_input = std::uint64_t{256} << 20U;

/// The bytes of a regular file, or of what a link to one names. InputError, "cannot read PATH: why", for what
/// is no regular file, cannot be read, or has more bytes than `longest`.
std::string read_file(const std::filesystem::path& path, std::uint64_t longest = longest_input);

}  // namespace pfaff
