// The checksum of a text that comes in parts.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace pfaff {

/// The SHA-1 of all that was added, as sha1_of gives it of a whole text (core/process/checksum.hpp).
class RunningChecksum {
 public:
  RunningChecksum();
  ~RunningChecksum();
  RunningChecksum(const RunningChecksum&) = delete;
  RunningChecksum& operator=(const RunningChecksum&) = delete;
  void add(std::string_view text);
  [[nodiscard]] std::string digits() const;

 private:
  struct Sum;
  std::unique_ptr<Sum> sum_;
};

}  // namespace pfaff
