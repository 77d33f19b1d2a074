// What a struct offers as a system: its formulas are found by name whatever their signature, and each must
// write all of its results and nothing beyond them.
#include <gtest/gtest.h>

#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Fits {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
  }
};
struct NoTime {
  template <class T>
  void field(In<T> z, Out<T> rate) const {
    rate[0] = z[0];
  }
};
struct NotConst {
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) {
    rate[0] = z[0];
  }
};
struct DoublesOnly {
  static void field(double /*t*/, In<double> z, Out<double> rate) { rate[0] = z[0]; }
};
struct NotATemplate {
  void field(double t, In<double> z, Out<double> rate) const { rate[0] = t * z[0]; }
};
class PrivateField {
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[0];
  }
};
struct OverloadedField {
  template <class T>
  void field(In<T> z) const;
  template <class T>
  void field(In<T> z, int k) const;
};
struct Inherits : NoTime {};
struct DataOfTheName {
  Real field = 1;
};
struct StaticDataOfTheName {
  static constexpr int field = 1;
};
struct ReturnsNothing {
  template <class T>
  void kinetic(const T& /*t*/, In<T> /*p*/) const {}
};

TEST(SystemFormulas, NamesAreFoundWhateverTheirSignature) {
  using namespace pfaff::detail;
  EXPECT_TRUE((names<Fits, Formula::field> && writes<Fits, Formula::field>));
  EXPECT_TRUE((names<NoTime, Formula::field> && !writes<NoTime, Formula::field>));
  EXPECT_TRUE((names<NotConst, Formula::field> && !writes<NotConst, Formula::field>));
  EXPECT_TRUE((names<DoublesOnly, Formula::field> && !writes<DoublesOnly, Formula::field>));
  EXPECT_TRUE((names<NotATemplate, Formula::field> && !writes<NotATemplate, Formula::field>));
  EXPECT_TRUE((names<PrivateField, Formula::field> && !writes<PrivateField, Formula::field>));
  EXPECT_TRUE((names<OverloadedField, Formula::field> && !writes<OverloadedField, Formula::field>));
  EXPECT_TRUE((names<Inherits, Formula::field> && !writes<Inherits, Formula::field>));
  EXPECT_TRUE((names<ReturnsNothing, Formula::kinetic> && !writes<ReturnsNothing, Formula::kinetic>));
  EXPECT_FALSE((names<DataOfTheName, Formula::field> || names<StaticDataOfTheName, Formula::field>));
  EXPECT_FALSE((names<Fits, Formula::kinetic>));
}

// An oscillator whose formulas write as many results as they are told to, through pointers, since a span with
// checks would stop at its end.
struct Writes {
  static constexpr int dimension = 2;
  int fields = 2, values = 1, starts = 2;
  static std::vector<Parameter> parameters() { return {}; }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T all[] = {z[1], -z[0], z[0], z[1]};
    for (std::size_t k = 0; k < static_cast<std::size_t>(fields); ++k) rate.data()[k] = all[k];
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> out) const {
    for (int k = 0; k < values; ++k) out.data()[k] = (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void initial(Out<T> z) const {
    for (int k = 0; k < starts; ++k) z.data()[k] = T(k);
  }
};

std::string complaint(const Writes& system, int listed) {
  SystemDescriptor descriptor{.name = "writes", .title = "", .reference = ""};
  for (int k = 0; k < listed; ++k) descriptor.invariants.push_back(conserved("energy", "J"));
  try {
    (void)make_model(descriptor, system);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SystemFormulas, EveryResultIsWrittenAndNoMore) {
  EXPECT_EQ(complaint({}, 1), "");
  EXPECT_EQ(complaint({}, 0),
            "system writes: invariants(t, z, values) writes 1 results; expected 0, as many as the descriptor "
            "lists");
  EXPECT_EQ(complaint({.values = 3}, 1),
            "system writes: invariants(t, z, values) writes 3 results; expected 1, as many as the descriptor "
            "lists");
  EXPECT_EQ(complaint({.values = 1}, 2),
            "system writes: invariants(t, z, values) does not write result 2; expected 2, as many as the "
            "descriptor "
            "lists");
  EXPECT_EQ(complaint({.fields = 3}, 1), "system writes: field(t, z, rate) writes 3 results; expected 2");
  EXPECT_EQ(complaint({.fields = 1}, 1),
            "system writes: field(t, z, rate) does not write result 2; expected 2");
  EXPECT_EQ(complaint({.starts = 3}, 1), "system writes: initial(z) writes 3 results; expected 2");
  // An initial state need not write its zeros.
  EXPECT_EQ(complaint({.starts = 1}, 1), "");
}

TEST(SystemFormulas, InvariantsThatAreListedMustBeWritten) {
  const SystemDescriptor descriptor{
      .name = "fits", .title = "", .reference = "", .invariants = {conserved("energy", "J")}};
  try {
    (void)make_model(descriptor, Fits{});
    FAIL() << "a list without a formula was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "system fits: the descriptor lists the invariant energy; expected invariants(t, z, values)");
  }
}

}  // namespace
