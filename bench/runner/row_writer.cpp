#include <pfaff/bench/runner/row_writer.hpp>

#include <algorithm>
#include <utility>

namespace pfaff {

namespace {
constexpr std::size_t buffer_size = std::size_t{1} << 18U;
constexpr std::chrono::milliseconds longest_wait{200};
}  // namespace

RowWriter::RowWriter(Destination destination)
    : destination_(std::move(destination)),
      buffer_(buffer_size),
      end_(buffer_.data()),
      whole_(buffer_.data()) {}

RowWriter::~RowWriter() {
  try {
    flush();
  } catch (...) {  // NOLINT(bugprone-empty-catch): whoever ends the table before its time has another reason
  }
}

void RowWriter::text(std::string_view cell) {
  begin_cell(cell.size());
  end_ = std::copy(cell.begin(), cell.end(), end_);
}

void RowWriter::end_row() {
  make_room(1);
  *end_++ = '\n';
  whole_ = end_;
  in_row_ = false;
  if (Clock::now() - flushed_ > longest_wait) flush();
}

void RowWriter::flush() {
  const std::string_view rows(buffer_.data(), static_cast<std::size_t>(whole_ - buffer_.data()));
  // Rows are passed on once, also where that fails.
  const std::vector<char> rest(whole_, end_);
  whole_ = buffer_.data();
  end_ = buffer_.data() + rest.size();
  if (!rows.empty()) destination_(rows);
  std::copy(rest.begin(), rest.end(), buffer_.data());
  flushed_ = Clock::now();
}

void RowWriter::begin_cell(std::size_t size) {
  make_room(size + 1);
  if (in_row_) *end_++ = ',';
  in_row_ = true;
}

void RowWriter::make_room(std::size_t size) {
  const auto room = [&] { return static_cast<std::size_t>(buffer_.data() + buffer_.size() - end_); };
  if (room() < size) flush();
  if (room() >= size) return;
  const auto held = static_cast<std::size_t>(end_ - buffer_.data());  // a row that is longer than the buffer
  buffer_.resize(2 * buffer_.size() + size);
  whole_ = buffer_.data();
  end_ = buffer_.data() + held;
}

}  // namespace pfaff
