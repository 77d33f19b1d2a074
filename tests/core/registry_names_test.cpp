// Names of plug-ins and of their parameters are kebab-case; what is not is kept aside when it registers.
#include <gtest/gtest.h>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace {
using namespace pfaff;

TEST(RegistryNames, KebabCase) {
  for (const char* name : {"verlet", "rk4", "damped-pendulum", "odeint-dopri5", "a", "n-4"})
    EXPECT_TRUE(is_kebab_case(name)) << name;
  for (const char* name : {"", "-", "Verlet", "my system", "my_system", "-a", "a-", "a--b", "4a", "a.b",
                           "a=b", "a,b", "a(b)", "\xC3\xA9t\xC3\xA9", "a\n", "\033[31m"})
    EXPECT_FALSE(is_kebab_case(name)) << name;
}

class NamedPlugin : public Plugin {
 public:
  NamedPlugin(const std::string& name, std::vector<Parameter> parameters)
      : Plugin(name, std::move(parameters), typeid(NamedPlugin), std::source_location::current()) {}
};
struct Object {
  Real rate = 1;
};

TEST(RegistryNames, OthersAreKeptAside) {
  const NamedPlugin good("good", {}), spaced("two words", {}), alias("Alias", {}),
      parameter("fine", {pfaff::parameter(&Object::rate, "a rate", "", 0, 1)});
  Registry<NamedPlugin> registry;
  registry.add(&good);
  EXPECT_TRUE(registry.misnamed().empty());
  registry.add(&spaced);
  registry.add(&parameter);
  registry.add_alias(&alias);
  const NamedPlugin two("two", {pfaff::parameter(&Object::rate, "rate", "", 0, 1),
                                pfaff::parameter(&Object::rate, "rate", "", 0, 2)});
  Registry<NamedPlugin> others;
  others.add(&two);
  EXPECT_TRUE(others.all().empty());
  ASSERT_EQ(others.misnamed().size(), 1U);
  EXPECT_NE(others.misnamed()[0].find("the parameter 'rate'; expected names that differ"), std::string::npos);
  EXPECT_EQ(registry.all().size(), 1U);
  EXPECT_TRUE(registry.aliases().empty());
  ASSERT_EQ(registry.misnamed().size(), 3U);
  EXPECT_NE(registry.misnamed()[0].find("the name 'two words'; expected kebab-case"), std::string::npos);
  EXPECT_NE(registry.misnamed()[1].find("fine in "), std::string::npos);
  EXPECT_NE(registry.misnamed()[1].find("the parameter 'a rate'"), std::string::npos);
}

// What registers while the library is loaded; were one of the tree misnamed, it would be missing without a
// word.
TEST(RegistryNames, ThoseOfTheTreeAreFine) { EXPECT_EQ(misnamed(), std::vector<std::string>()); }

TEST(RegistryNames, WordsOfExceptions) {
  const auto words = [](auto thrown) {
    try {
      throw thrown;
    } catch (...) {
      return words_of_current_exception();
    }
  };
  EXPECT_EQ(words(std::logic_error("why")), "why");
  EXPECT_EQ(words(std::string("a text")), "a text");
  EXPECT_EQ(words("letters"), "letters");
  EXPECT_EQ(words(42), "an exception of type int");
  EXPECT_EQ(words(Object{}), "an exception of type (anonymous namespace)::Object");
}

TEST(RegistryNames, OnBehalfOfAPlugIn) {
  const auto what = [](auto thrown) -> std::string {
    try {
      on_behalf_of("system x", [&]() -> int { throw thrown; });
    } catch (const InputError& error) {
      return error.what();
    } catch (const RunError&) {
      return "a RunError";
    } catch (const std::bad_alloc&) {
      return "no memory";
    }
    return {};
  };
  EXPECT_EQ(what(42), "system x: an exception of type int");
  EXPECT_EQ(what(std::logic_error("why")), "system x: why");
  EXPECT_EQ(what(InputError("as it is")), "as it is");
  EXPECT_EQ(what(RunError("")), "a RunError");
  EXPECT_EQ(what(std::bad_alloc()), "no memory");
  EXPECT_EQ(on_behalf_of("x", [] { return 7; }), 7);
}

}  // namespace
