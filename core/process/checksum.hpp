// Checksums, by which contents of files are told apart.
#pragma once

#include <string>
#include <string_view>

namespace pfaff {

/// The SHA-1 of a text in 40 hexadecimal digits, as `sha1sum` prints it. It tells contents apart; it is no
/// protection from somebody who wants two contents to look the same.
std::string sha1_of(std::string_view text);

}  // namespace pfaff
