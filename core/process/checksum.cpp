#include <pfaff/core/process/checksum.hpp>

#include <boost/uuid/detail/sha1.hpp>

namespace pfaff {

std::string sha1_of(std::string_view text) {
  boost::uuids::detail::sha1 sum;
  sum.process_bytes(text.data(), text.size());
  unsigned int digest[5];  // NOLINT(modernize-avoid-c-arrays): the library's type
  sum.get_digest(digest);
  constexpr std::string_view hexadecimal = "0123456789abcdef";
  std::string digits;
  for (const unsigned int word : digest)
    for (int shift = 28; shift >= 0; shift -= 4) digits += hexadecimal[(word >> shift) & 15U];
  return digits;
}

}  // namespace pfaff
