// Compiles and runs, unchanged, the template of a test that authors of brackets start from.
#include "../../examples/templates/tests/bracket_test.cpp"
