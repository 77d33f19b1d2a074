#include <pfaff/bench/runner/checksum.hpp>

#include <array>
#include <boost/uuid/detail/sha1.hpp>
#include <cstdio>

namespace pfaff {

std::string sha1_of(std::string_view text) {
  boost::uuids::detail::sha1 sum;
  sum.process_bytes(text.data(), text.size());
  unsigned int digest[5];  // NOLINT(modernize-avoid-c-arrays): the library's type
  sum.get_digest(digest);
  std::string digits;
  for (const unsigned int word : digest) {
    std::array<char, 9> eight{};
    std::snprintf(eight.data(), eight.size(), "%08x", word);
    digits += eight.data();
  }
  return digits;
}

}  // namespace pfaff
