// Messages of the libraries in the words of Python.
#pragma once

#include <string>

namespace pfaff::python {

/// A message in which options of the command line, --step and --set initial=, are the arguments that they are
/// in Python, step and initial=.
std::string in_words_of_python(const std::string& message);

}  // namespace pfaff::python
