#include <pfaff/bench/runner/terminal.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff {

std::string json_text(const nlohmann::json& document) {
  return document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string scientific(double x) { return formatted("%.3g", x); }

ProgressLine::ProgressLine(bool quiet)
    : terminal_(!quiet && isatty(STDERR_FILENO) != 0),
      begin_(std::chrono::steady_clock::now()),
      last_(begin_) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(const std::string& what, double fraction) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - begin_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  shown_ = true;
  // What passes the end of the line would be left on the screen.
  const int room = static_cast<int>(std::min<std::size_t>(terminal_columns(), 90)) - 10;
  std::fputs(formatted("\r\033[K%3.0f %%  %.*s", 100 * fraction, room, printable(what).c_str()).c_str(),
             stderr);
  std::fflush(stderr);
}

}  // namespace pfaff
