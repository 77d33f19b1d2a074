// Parameters whose value is another plug-in: their text, the settings within it, and what is refused. Also
// names and aliases in a registry.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace {
using namespace pfaff;

// Plug-ins that can be chosen: springs in springs.
const std::vector<std::string> spring_names{"coil", "stiff"};

struct NestedSpring {
  Real stiffness = 1_r;
  std::vector<Real> lengths;
  PluginValue inner{"coil"};
  static std::vector<Parameter> parameters();
};

void require_known(const std::string& name) {
  if (std::find(spring_names.begin(), spring_names.end(), name) == spring_names.end())
    throw InputError(unknown_name("spring", name, spring_names));
}

PluginChoice springs() {
  return {.kind = "spring",
          .names = [] { return spring_names; },
          .parameters =
              [](const std::string& name) {
                require_known(name);
                return name == "coil" ? std::vector<Parameter>{} : NestedSpring::parameters();
              },
          .resolve =
              [](const PluginValue& value) {
                require_known(value.name);
                NestedSpring spring;
                const auto parameters =
                    value.name == "coil" ? std::vector<Parameter>{} : NestedSpring::parameters();
                assign_all(parameters, &spring, value.settings, "spring " + value.name);
                return resolved(parameters, &spring);
              }};
}

std::vector<Parameter> NestedSpring::parameters() {
  return {parameter(&NestedSpring::stiffness, "stiffness", "N/m", 0, 10),
          parameter(&NestedSpring::lengths, "lengths", "m", 0, 10),
          parameter(&NestedSpring::inner, "inner", springs(), "the spring within")};
}

// What `inner` is after the assignments.
std::string inner(const Assignments& assignments) {
  NestedSpring spring;
  assign_all(NestedSpring::parameters(), &spring, assignments, "spring outermost");
  return to_string(spring.inner);
}
std::string choice_refusal(const Assignments& assignments) {
  try {
    return "accepted as " + inner(assignments);
  } catch (const InputError& error) {
    return error.what();
  }
}

const std::string plain = "stiff(stiffness=1, lengths=, inner=coil)";

TEST(PluginParameter, TextsAreParsedAndWritten) {
  EXPECT_EQ(inner({}), "coil");
  EXPECT_EQ(inner({{"inner", "coil()"}}), "coil");
  EXPECT_EQ(inner({{"inner", "stiff"}}), plain);
  EXPECT_EQ(inner({{"inner", " stiff ( stiffness = 1/3 , inner=stiff(lengths=1,2, stiffness=2)) "}}),
            "stiff(stiffness=1/3, lengths=, inner=stiff(stiffness=2, lengths=1,2, inner=coil))");
  // A comma within a list of numbers is none between settings.
  EXPECT_EQ(inner({{"inner", "stiff(lengths=1,1/3,3)"}}), "stiff(stiffness=1, lengths=1,1/3,3, inner=coil)");
}

TEST(PluginParameter, WhatIsWrittenIsReadBack) {
  for (const char* text : {"coil", "stiff", "stiff(lengths=1,2,inner=stiff(inner=stiff(stiffness=2/7)))"}) {
    const std::string once = inner({{"inner", text}});
    EXPECT_EQ(inner({{"inner", once}}), once);
  }
}

TEST(PluginParameter, SettingsWithinAreNamedByDots) {
  EXPECT_EQ(inner({{"inner", "stiff"}, {"inner.stiffness", "3"}}),
            "stiff(stiffness=3, lengths=, inner=coil)");
  // Whatever the order: they belong to the plug-in that is chosen.
  EXPECT_EQ(inner({{"inner.stiffness", "3"}, {"inner", "stiff"}}),
            "stiff(stiffness=3, lengths=, inner=coil)");
  EXPECT_EQ(inner({{"inner.inner.stiffness", "5"}, {"inner.inner", "stiff"}, {"inner", "stiff"}}),
            "stiff(stiffness=1, lengths=, inner=stiff(stiffness=5, lengths=, inner=coil))");
  // The last of several counts, and the rest of the plug-in's settings stays.
  EXPECT_EQ(inner({{"inner", "stiff(lengths=4)"}, {"inner.stiffness", "3"}, {"inner.stiffness", "2"}}),
            "stiff(stiffness=2, lengths=4, inner=coil)");
}

TEST(PluginParameter, RefusalsSayWhatWasExpected) {
  for (const char* text : {"", "(", "coil(", "coil)", "(coil)", "stiff(stiffness)", "stiff(=1)", "stiff(,)",
                           "stiff(stiffness=1", "stiff(stiffness=1))", "stiff(stiffness=1)x", "two words",
                           "stiff(stiffness=1,)", "stiff()(inner=coil)"})
    EXPECT_EQ(choice_refusal({{"inner", text}}),
              std::string("parameter 'inner' of spring outermost, of kind "
                          "spring: expected NAME or NAME(key=value, key=value), "
                          "got '") +
                  text + "'");
  EXPECT_EQ(choice_refusal({{"inner", "coli"}}), "unknown spring 'coli'; did you mean 'coil'?");
  EXPECT_EQ(choice_refusal({{"inner", "stiff(stifness=1)"}}),
            "unknown parameter 'stifness'; did you mean 'stiffness'? (of spring stiff)");
  EXPECT_EQ(choice_refusal({{"inner", "stiff"}, {"inner.stifness", "1"}}),
            "unknown parameter 'stifness'; did you mean 'stiffness'? (of spring stiff)");
  EXPECT_EQ(choice_refusal({{"inner", "stiff(inner=stiff(stiffness=11))"}}),
            "parameter 'stiffness' of spring stiff: expected a number in 0 .. 10 N/m, got '11'");
  EXPECT_EQ(choice_refusal({{"iner.stiffness", "1"}}).substr(0, 36), "unknown parameter 'iner.stiffness'; ");
  EXPECT_NE(choice_refusal({{"stiffness.x", "1"}}).find("unknown parameter 'stiffness.x'"),
            std::string::npos);
}

TEST(PluginParameter, ItsRangeIsWhatCanBeChosen) {
  EXPECT_EQ(range_of(NestedSpring::parameters()[2]), "coil|stiff");
}

// Plug-ins of a registry of their own.
struct BarePlugin {
  std::string name_, file_;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& file() const { return file_; }
};

TEST(Registry, AliasesAreFoundAndNotListed) {
  const BarePlugin verlet{"verlet", "a.cpp"}, leap{"leap", "a.cpp"}, other{"stormer", "a.cpp"};
  Registry<BarePlugin> registry;
  registry.add_alias(&other);
  registry.add(&verlet);
  registry.add(&leap);
  EXPECT_EQ(registry.names(), (std::vector<std::string>{"leap", "verlet"}));
  EXPECT_EQ(registry.names_and_aliases(), (std::vector<std::string>{"leap", "verlet", "stormer"}));
  EXPECT_EQ(&registry.get("stormer", "method"), &other);
  EXPECT_EQ(registry.find("storm"), nullptr);
  EXPECT_TRUE(registry.duplicates().empty());
  const auto said = [&](const char* name) {
    try {
      (void)registry.get(name, "method");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said("stormre"), "unknown method 'stormre'; did you mean 'stormer'?");
  EXPECT_EQ(said("something-else"), "unknown method 'something-else'; expected one of: leap, verlet");
}

TEST(Registry, AnAliasAndAPlugInOfOneNameAreReported) {
  const BarePlugin first{"verlet", "a.cpp"}, second{"verlet", "b.cpp"}, third{"verlet", "c.cpp"};
  Registry<BarePlugin> registry;
  registry.add_alias(&first);
  registry.add(&second);
  registry.add_alias(&third);
  EXPECT_EQ(registry.duplicates(),
            (std::vector<std::string>{"verlet in a.cpp and b.cpp", "verlet in a.cpp and c.cpp"}));
  EXPECT_EQ(registry.find("verlet"), &first);
}

}  // namespace
