// The test that authors of brackets start from, as it is.
#include "../../examples/templates/tests/bracket_test.cpp"
