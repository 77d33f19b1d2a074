// The extension module pfaff._machine, which holds nothing: it is imported, or refuses to be, on a machine
// that lacks instructions which the libraries are compiled for. It is not linked with them.
#include <Python.h>

#include <pfaff/core/registry/instructions.hpp>

namespace {
PyModuleDef definition = {PyModuleDef_HEAD_INIT,
                          "_machine",
                          "Is there where the machine has the instructions that pfaff is built for.",
                          0,
                          nullptr,
                          nullptr,
                          nullptr,
                          nullptr,
                          nullptr};
}  // namespace

// The name is Python's.
PyMODINIT_FUNC PyInit__machine() {  // NOLINT(bugprone-reserved-identifier)
  if (const char* const lacking = pfaff::lacking_instructions())
    return PyErr_Format(
        PyExc_ImportError,
        "pfaff is built for machines with the instructions %s, which this one lacks; build it "
        "here, or anywhere with the preset portable",
        lacking);
  return PyModule_Create(&definition);
}
