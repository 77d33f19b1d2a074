// A locale of the C library in which decimals have a comma: "comma", of numbers alone. It is the machine's
// C.utf8 with the point changed, because no other locale is installed everywhere.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "temporary_directory.hpp"

namespace pfaff::testing {

/// As long as it lives, setlocale(LC_NUMERIC, "comma") works here and in programs that are started.
class CommaLocale {
 public:
  CommaLocale() {
    std::ifstream point("/usr/lib/locale/C.utf8/LC_NUMERIC", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(point), {}};
    const std::size_t at = bytes.find('.');
    if (at == std::string::npos) throw std::runtime_error("expected the locale C.utf8 in /usr/lib/locale");
    bytes[at] = ',';
    fs::create_directory(files_.path() / "comma");
    std::ofstream(files_.path() / "comma/LC_NUMERIC", std::ios::binary) << bytes;
    setenv("LOCPATH", files_.path().c_str(), 1);
  }
  ~CommaLocale() { unsetenv("LOCPATH"); }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

 private:
  TemporaryDirectory files_;
};

}  // namespace pfaff::testing
