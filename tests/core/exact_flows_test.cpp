// Systems split into parts that are solved exactly: what a system that writes them offers, and how a method
// asks for it.
#include <gtest/gtest.h>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

const SystemDescriptor spring_descriptor{.name = "spring", .title = "", .reference = ""};

// q' = p, p' = -q as a drift and a kick, or with no parts at all.
struct SpringInParts {
  static constexpr int dimension = 2;
  int parts = 2;
  [[nodiscard]] int part_count() const { return parts; }
  static constexpr std::size_t small_part = 0;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
  }
  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    change[part] = part == 0 ? T(h * z[1]) : T(-(h * z[0]));
    change[1 - part] = T(0);
    return value_of(h) > Value<T>(10) ? Status::not_converged : Status::converged;
  }
};
struct NamedSpring : SpringInParts {
  static std::vector<std::string> part_names() { return {"drift", "kick"}; }
};
// A step that needs flows and nothing else.
struct Lie {
  template <HasExactFlows P>
  Status step(const P& p, const Scalar<P>& /*t*/, const Scalar<P>& h, State<P>& z, NoWork& /*work*/) const {
    State<P> change = p.make_state();
    for (std::size_t part = 0; part < p.parts(); ++part) {
      const Status status = p.part_flow(part, h, z, change);
      if (status != Status::converged) return status;
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + change[k];
    }
    return Status::converged;
  }
};

TEST(ExactFlows, AreOfferedWhereTheyAreWritten) {
  const auto model = make_model(spring_descriptor, SpringInParts());
  EXPECT_EQ(model->facets(), facets(Facet::vector_field, Facet::exact_flows));
  EXPECT_EQ(model->part_names(), (std::vector<std::string>{"part-1", "part-2"}));
  EXPECT_EQ(model->small_part(), std::optional<std::size_t>(0));
  EXPECT_EQ(make_model(spring_descriptor, NamedSpring())->part_names(),
            (std::vector<std::string>{"drift", "kick"}));
}

TEST(ExactFlows, AreNotOfferedByACountOfZero) {
  SpringInParts spring;
  spring.parts = 0;
  const auto model = make_model(spring_descriptor, spring);
  EXPECT_EQ(model->facets(), facets(Facet::vector_field));
  EXPECT_EQ(model->small_part(), std::nullopt);
  EXPECT_THROW((void)model->exact_flows<double>(), std::logic_error);
}

TEST(ExactFlows, AreNeededByWhoeverAsksForThem) { EXPECT_EQ(needs_of<Lie>(), facets(Facet::exact_flows)); }

template <class T>
void flows_are_those_written() {
  const Problem<T> problem(make_model(spring_descriptor, SpringInParts()));
  EXPECT_EQ(problem.parts(), 2U);
  EXPECT_EQ(problem.perturbation(), 0U);
  std::vector<T> z{T(3), T(5)}, change(2);
  EXPECT_EQ(problem.part_flow(0, T(2), z, change), Status::converged);
  EXPECT_TRUE(change[0] == T(10) && change[1] == T(0));
  EXPECT_EQ(problem.part_flow(1, T(2), z, change), Status::converged);
  EXPECT_TRUE(change[0] == T(0) && change[1] == T(-6));
  EXPECT_EQ(problem.part_flow(1, T(20), z, change), Status::not_converged);
  EXPECT_EQ(problem.counters().fields, 1);  // the small part alone
}
TEST(ExactFlows, AreThoseWrittenInEveryScalar) {
  flows_are_those_written<double>();
  flows_are_those_written<Quad>();
}

// A particle held at the origin of one axis: the flow of its free motion is not its motion.
struct Held {
  static constexpr int dimension = 4, constraint_count = 2, part_count = 1;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[2] * z[2] + z[3] * z[3]) / 2;
  }
  template <class T>
  void constraints(const T& /*t*/, In<T> z, Out<T> phi) const {
    phi[0] = z[0];
    phi[1] = z[2];
  }
  template <class T>
  Status part_flow(std::size_t /*part*/, const T& h, In<T> z, Out<T> change) const {
    for (std::size_t k = 0; k < 4; ++k) change[k] = k < 2 ? T(h * z[2 + k]) : T(0);
    return Status::converged;
  }
};
TEST(ExactFlows, AreHiddenByConstraints) {
  const auto model = make_model(spring_descriptor, Held());
  EXPECT_TRUE(model->content().has(Facet::exact_flows));
  EXPECT_FALSE(model->facets().has(Facet::exact_flows));
}

}  // namespace
