// A formula of Python while it is recorded: numbers that note what is done with them.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff::python {

/// One formula that is being recorded; its numbers are used only as long as it is.
struct Recording {
  explicit Recording(int inputs) : recorder(inputs) {}
  Recorder recorder;
  bool open = true;
};

/// A number of a recording: `_pfaff.Number`. A constant belongs to none.
struct Number {
  Recorded value;
  std::shared_ptr<Recording> recording{};
};

/// Raises TraceError, with the line of the user's code.
[[noreturn]] void refuse_traced(const std::string& message);

/// The number that a Python object is, a Number or a constant; nullopt where it is neither. TraceError for a
/// number whose recording has ended.
std::optional<Number> number_from(pybind11::handle object);

/// What two numbers, operands of one operation, belong to together. TraceError where one is of another
/// recording.
std::shared_ptr<Recording> recording_of(const Number& a, const Number& b);

}  // namespace pfaff::python
