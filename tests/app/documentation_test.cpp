// The code that a page shows is code that is compiled: each block stands, as it is, in a file of
// examples/templates, which other tests build and run.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace {

const std::string source = PFAFF_GOLDEN "/../..";

std::string contents(const std::string& file) {
  std::ifstream in(source + "/" + file);
  EXPECT_TRUE(in) << file;
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}
std::vector<std::string> blocks(const std::string& page) {
  const std::string open = "```cpp\n", close = "```";
  std::vector<std::string> found;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const std::size_t end = page.find(close, at);
    found.push_back(page.substr(at, end - at));
    at = end + close.size();
  }
  return found;
}

TEST(Documentation, CodeOfGeneratingFunctionsIsCompiled) {
  const std::string compiled =
      contents("examples/templates/birkhoffian_system.cpp") + contents("examples/templates/alpha.hpp");
  const auto shown = blocks(contents("docs/generating-functions.md"));
  ASSERT_EQ(shown.size(), 2U);
  for (const std::string& block : shown) {
    EXPECT_GT(block.size(), 200U);
    EXPECT_NE(compiled.find(block), std::string::npos) << block;
  }
  std::string changed = shown[0];  // control: one character
  changed[changed.find('4')] = '5';
  EXPECT_EQ(compiled.find(changed), std::string::npos);
}

TEST(Documentation, CodeOfConstraintsIsCompiled) {
  const auto shown = blocks(contents("docs/constraints.md"));
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_NE(contents("examples/templates/tests/bracket_test.cpp").find(shown[0]), std::string::npos) << shown[0];
}

}  // namespace
