// Names in emitted text: the user's own where a language allows them, and never two the same.
#include <gtest/gtest.h>

#include <set>

#include <pfaff/core/emit/cpp_function.hpp>
#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/core/emit/latex_names.hpp>
#include <pfaff/core/emit/names.hpp>

namespace {
using namespace pfaff;
using namespace pfaff::emit;

const std::vector<std::string> awkward{"q1",  "q_1",   "q__1",   "q 1", "q-1", "q1_", "1q",
                                       "x1q", "class", "class_", "",    "x",   "θ",   "_",
                                       "x_2", "v1",    "sin",    "t",   "int", "x2",  "x 2"};

TEST(EmittedNames, AllowedNamesStayAndOthersNeverMeet) {
  Names names({"_", cpp_reserved, &with_underscore});
  EXPECT_EQ(names("q1"), "q1");
  EXPECT_EQ(names("theta_dot"), "theta_dot");
  EXPECT_EQ(names("class"), "class_");
  EXPECT_EQ(names("p-x"), "p_x");
  EXPECT_EQ(names("p x"), "p_x_");
  EXPECT_EQ(names("p.x"), "p_x_2");
  EXPECT_EQ(names("2nd"), "x2nd");
}

TEST(EmittedNames, TheMapOfNamesIsInjective) {
  Names code({"_", cpp_reserved, &with_underscore});
  LatexNames latex;
  std::set<std::string> given, written;
  for (const std::string& name : awkward) {
    const std::string mine = code(name);
    EXPECT_TRUE(given.insert(mine).second) << name;
    EXPECT_EQ(mine.find("__"), std::string::npos) << mine << " is reserved in C++";
    EXPECT_TRUE(std::isalpha(static_cast<unsigned char>(mine.front()))) << mine;
    EXPECT_TRUE(written.insert(latex(name).text()).second) << name;
  }
}

TEST(EmittedNames, LatexHasGreekLettersAndSubscripts) {
  LatexNames names;
  EXPECT_EQ(names("theta1").text(), "\\theta_{1}");
  EXPECT_EQ(names("p_phi").dotted(), "\\dot{p}_{\\phi}");
  EXPECT_EQ(names("x12_z").text(), "x_{12,z}");
  EXPECT_EQ(names("length").text(), "\\mathit{length}");
  EXPECT_EQ(names("q_max").text(), "q_{\\mathrm{max}}");
  EXPECT_EQ(latex_words("kg m^-2/s_0"), "kg m$^{-2}$/s\\_0");
}

TEST(EmittedNames, EveryLanguageIsThereOnce) {
  std::set<std::string_view> names;
  for (const Emitter& emitter : emitters()) {
    EXPECT_TRUE(names.insert(emitter.name).second);
    EXPECT_FALSE(emitter.description.empty());
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"cpp", "julia", "latex", "mathematica", "sympy"}));
}

}  // namespace
