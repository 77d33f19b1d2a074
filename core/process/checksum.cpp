#include <pfaff/core/process/checksum.hpp>

#include <boost/uuid/detail/sha1.hpp>

#include <pfaff/core/process/running_checksum.hpp>

namespace pfaff {

struct RunningChecksum::Sum {
  boost::uuids::detail::sha1 sum;
};

RunningChecksum::RunningChecksum() : sum_(std::make_unique<Sum>()) {}
RunningChecksum::~RunningChecksum() = default;

void RunningChecksum::add(std::string_view text) { sum_->sum.process_bytes(text.data(), text.size()); }

std::string RunningChecksum::digits() const {
  boost::uuids::detail::sha1 sum = sum_->sum;  // what ends it is added to a copy
  unsigned int digest[5];                      // NOLINT(modernize-avoid-c-arrays): the library's type
  sum.get_digest(digest);
  constexpr std::string_view hexadecimal = "0123456789abcdef";
  std::string digits;
  for (const unsigned int word : digest)
    for (int shift = 28; shift >= 0; shift -= 4) digits += hexadecimal[(word >> shift) & 15U];
  return digits;
}

std::string sha1_of(std::string_view text) {
  RunningChecksum sum;
  sum.add(text);
  return sum.digits();
}

}  // namespace pfaff
