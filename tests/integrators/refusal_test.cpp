// When a method refuses its parameters or a model, the message contains the name of the method once, and what
// was expected.
#include <gtest/gtest.h>

#include <string>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

const MethodPlugin& plugin(const char* name) { return integrators().get(name, "integrator"); }

std::string refused(const MethodPlugin& method, const Assignments& parameters) {
  try {
    (void)method.make(parameters);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Refusal, OfParametersNamesTheMethod) {
  EXPECT_EQ(
      refused(plugin("generating-function"), {{"order", "3"}, {"variant", "S"}}),
      "integrator generating-function: variant S needs an even order, got order 3; expected variant P or "
      "an even order");
  EXPECT_EQ(refused(plugin("generating-function"), {{"order", "4"}, {"variant", "S"}}), "accepted");
}

TEST(Refusal, OfAModelNamesTheMethod) {
  const auto model = systems().get("damped-pendulum", "system").make({});
  const auto refusal = [&](const char* normal) {
    return plugin("generating-function").make({{"form", "normal"}, {"normal", normal}})->refuses(*model);
  };
  EXPECT_EQ(refusal("0.1,0.2,0.3"),
            "generating-function has a matrix of 3 entries; damped-pendulum takes 4 or 4");
  EXPECT_EQ(refusal("1,0,0,1").find("generating-function has a matrix V that is not in sp(2): "), 0U)
      << refusal("1,0,0,1");
  EXPECT_EQ(refusal("0.2,0.1,-0.3,-0.2"), "");
}
}  // namespace
