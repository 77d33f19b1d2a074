// The test that authors of brackets start from, as it is.
#include "../../examples/templates/bracket_test.cpp"
