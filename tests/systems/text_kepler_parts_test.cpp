// parts = "kepler" of text models: against the same parts in C++, and against Wisdom and Holman's map and the
// motion of three planets as computed with 50 digits.
#include <gtest/gtest.h>

#include <filesystem>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/planetary_splitting.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../formula_values.hpp"
#include "taylor_flow.hpp"
#include "written_models.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

std::shared_ptr<const Model> example_model(const std::string& name, const Assignments& set = {}) {
  return system_named((std::filesystem::path(PFAFF_GOLDEN) / "../../examples/models" / name).string())
      .make(set);
}

// The largest difference of the changes in a time h, each relative to its own size in the second model.
template <class T>
double flow_difference(const Model& a, const Model& b, const T& h) {
  const auto first = a.exact_flows<T>(), second = b.exact_flows<T>();
  const std::vector<Quad> start = initial_state(b);
  const std::vector<T> z(start.begin(), start.end());
  double worst = 0;
  for (std::size_t part = 0; part < 2; ++part) {
    std::vector<T> x(z.size()), y(z.size());
    EXPECT_EQ(first->change(part, h, z, x), Status::converged);
    EXPECT_EQ(second->change(part, h, z, y), Status::converged);
    for (std::size_t k = 0; k < z.size(); ++k)
      if (y[k] != T(0)) worst = std::max(worst, static_cast<double>(abs((x[k] - y[k]) / y[k])));
  }
  return worst;
}

TEST(TextKeplerParts, AreThoseOfTheirTwin) {
  const auto text = example_model("outer-solar-system.toml"),
             code = systems().get("outer-solar-system", "system").make({});
  EXPECT_EQ(text->part_names(), code->part_names());
  EXPECT_EQ(text->small_part(), code->small_part());
  // The masses are the same numbers, and G is by some roundings in quad, so that in double it is the same.
  EXPECT_EQ(flow_difference<double>(*text, *code, 100.0), 0);
  EXPECT_LT(flow_difference<Quad>(*text, *code, Quad(100)), 1e-31);
  const auto heavier = example_model("outer-solar-system.toml", {{"pluto", "7.7e-9"}});  // control
  EXPECT_GT(flow_difference<double>(*heavier, *code, 100.0), 1e-4);
}

// One step A(h/2) B(h) A(h/2) with h = 0.05, by mpmath: Jacobi's coordinates from sums over the bodies,
// orbits by their eccentric anomalies, the interaction as the difference of Newton's force and that of
// Kepler's problems.
template <class T>
double off_the_map(const std::shared_ptr<const Model>& model) {
  const std::array expected{
      "0.0000432471491142535731867616415516296224",  "0.95109792787995382483201776877002895",
      "-1.61107093089509668187552571284027125",      "0.119524045486432130877566070608456039",
      "0.00000593512837063056490056582113412372765", "0.314770930193751510987090475768060282",
      "-0.0463895522230861072288631305916972728",    "2.91921614205087512562005284550650344",
      "0.00171162914990574104312934815110926091",    "-0.00193825649483451238042134435502026827",
      "0.0000474588049562403665024768685968206257",  "-0.000180831460027469029210480664685813262",
      "0.000334827060908973326931222763750570827",   "0.00608760927510572497138539607758666247",
      "-0.00148086788869159805146101607667616012",   "0.0000134315526768997531443972353389268183",
  };
  const auto flows = model->exact_flows<T>();
  const T h(Real::fraction(1, 20));
  std::vector<T> z, change(16);
  for (const Quad& x : initial_state(*model)) z.push_back(T(x));
  for (const std::size_t part : {planetary::kepler, planetary::interaction, planetary::kepler}) {
    EXPECT_EQ(flows->change(part, part == planetary::kepler ? T(h / 2) : h, z, change), Status::converged);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + change[k];
  }
  double worst = 0;
  for (std::size_t k = 0; k < z.size(); ++k)
    worst = std::max(worst, static_cast<double>(abs(Quad(z[k]) - Real::parse(expected[k])->quad())));
  return worst;
}
TEST(TextKeplerParts, MakeTheMapOfWisdomAndHolman) {
  const auto model = example_model("own-planets.toml");
  // Positions of up to three, after some tens of roundings.
  EXPECT_LT(off_the_map<double>(model), 1e-14);
  EXPECT_LT(off_the_map<Quad>(model), 1e-32);
  EXPECT_GT(off_the_map<double>(example_model("own-planets.toml", {{"middle", "0.000301"}})),
            1e-9);  // control
}

// The state after a year, by mpmath: Gragg's extrapolated midpoint rule of order 36 with 50 digits.
TEST(TextKeplerParts, BelongToTheMotionOfThePlanets) {
  const auto model = example_model("own-planets.toml");
  const std::array expected{
      "-0.0011035750015649616058891723978992433",  "0.936530799941255285006076179388041107",
      "1.58192931947407990540713638599811648",     "-2.65069188437035301478089394576465504",
      "0.00552499203207759973455565518263650589",  "-0.347212795627216239650577313256240169",
      "-0.277361765754109332091750410233747884",   "1.30858586551698609444894507379717297",
      "-0.00272674202543386716890810736850831443", "0.00217831273841262582206026986934643868",
      "0.000265064186403147154465535252171486482", "-0.0000766348993819058076176977530096107347",
      "-0.00235270704375485116596653228848094065", "0.00600430448666793259411547126899022123",
      "0.00146514429434451195968416286549019921",  "-0.000161741737257593387833101845999479798",
  };
  std::vector<Quad> state;
  for (const char* number : expected) state.push_back(Real::parse(number)->quad());
  const std::vector<Quad> end =
      taylor_flow(model->tape(Formula::field), Quad(0), initial_state(*model), Quad(1));
  EXPECT_LT(distance(end, state), 1e-29);  // a turn of the inner planet multiplies roundings by some tens
}

// Bodies of these masses with this potential between each two, where m is the product of the masses and r2
// the square of their distance.
std::string bodies_of(const std::string& masses, std::size_t count, const std::string& pair,
                      bool in_space = false) {
  const std::string n = std::to_string(count);
  const auto blocks = [&](const std::string& prefix) {
    return prefix + "x = " + n + ", " + prefix + "y = " + n + (in_space ? ", " + prefix + "z = " + n : "");
  };
  const std::string z = in_space ? " + (z[i] - z[j])^2" : "", pz = in_space ? " + pz[i]^2" : "";
  return "coordinates = { " + blocks("") + ", " + blocks("p") + " }\n" + "let = { m = [" + masses + "] }\n" +
         "kinetic = \"sum(i, 1, " + n + ", (px[i]^2 + py[i]^2" + pz + ")/(2*m[i]))\"\n" +
         "potential = \"sum(i, 2, " + n + ", sum(j, 1, i - 1, " + pair + "))\"\nparts = \"kepler\"\n";
}
const std::string plane_square = "((x[i] - x[j])^2 + (y[i] - y[j])^2)";

TEST(TextKeplerParts, AreFoundInAPlaneAndInSpace) {
  EXPECT_EQ(refusal_written(bodies_of("5, 1, 2", 3, "-3*m[i]*m[j]/sqrt" + plane_square)), "accepted");
  // Masses that are equal tell nothing of the dimension: six coordinates are three bodies in a plane or two
  // in space.
  EXPECT_EQ(refusal_written(bodies_of("1, 1, 1", 3, "-m[i]*m[j]/sqrt" + plane_square)), "accepted");
  const std::string space_square = "((x[i] - x[j])^2 + (y[i] - y[j])^2 + (z[i] - z[j])^2)";
  EXPECT_EQ(refusal_written(bodies_of("1, 1", 2, "-m[i]*m[j]/sqrt" + space_square, true)), "accepted");
  EXPECT_EQ(refusal_written(bodies_of("1, 1", 2, "-m[i]*m[j]*" + space_square + "^(-1/2) + 3", true)),
            "accepted");
}

TEST(TextKeplerParts, OfOtherEnergiesAreRefused) {
  const auto expect_message = [](const std::string& text, const std::string& expected) {
    EXPECT_NE(refusal_written(text).find(expected), std::string::npos)
        << refusal_written(text) << "\nnot: " << expected;
  };
  const std::string newton = "-m[i]*m[j]/sqrt" + plane_square;
  // Softened, a heavier pair and a law of another power: the force differs, on this body and by so much.
  expect_message(bodies_of("5, 1, 2", 3, "-m[i]*m[j]/sqrt(1e-12 + " + plane_square + ")"),
                 "model.toml:5:10: parts: potential: expected -G*sum(m_i*m_j/|q_i - q_j|) of points");
  expect_message(bodies_of("5, 1, 2", 3, newton + "*(1 + 1e-20*(i - 1)*(j - 1))"), "is off by ");
  expect_message(bodies_of("5, 1, 2", 3, "-m[i]*m[j]*log" + plane_square), "with G >= 0; the pull of");
  expect_message(bodies_of("5, 1, 2", 3, "m[i]*m[j]/sqrt" + plane_square), "says G = -1");
  expect_message(bodies_of("5, 1, 2", 3, newton + "*(1 + t)"), "potential reads the time");
  expect_message(bodies_of("5, -1, 2", 3, newton),
                 "with masses m > 0 (what has no mass is a probe of restricted-n-body)");
  expect_message(bodies_of("5", 1, newton), "kinetic: expected at least two bodies");
  const std::string pair = "potential = \"-6/sqrt((x1 - x2)^2 + (y1 - y2)^2)\"\nparts = \"kepler\"\n";
  const std::string by_direction =
      "coordinates = [\"x1\", \"x2\", \"y1\", \"y2\", \"u1\", \"u2\", \"v1\", \"v2\"]\n";
  const std::string by_body =
      "coordinates = [\"x1\", \"y1\", \"x2\", \"y2\", \"u1\", \"v1\", \"u2\", \"v2\"]\n";
  const std::string kinetic = "kinetic = \"(u1^2 + v1^2)/6 + (u2^2 + v2^2)/4\"\n";
  EXPECT_EQ(refusal_written(by_direction + kinetic + pair), "accepted");
  expect_message(by_body + kinetic + pair,
                 "coordinates by direction: x of every body, then y, and in space z");
  expect_message(by_direction + "kinetic = \"(u1^2 + v1^2)/6 + (u2^2 + v2^2 + u2*v2)/4\"\n" + pair,
                 "kinetic: expected sum p^2/(2*m) of all momenta");
  expect_message(
      by_direction + "hamiltonian = \"u1^2 + x1^2\"\nparts = \"kepler\"\n",
      "model.toml:3:1: parts = \"kepler\" is written beside kinetic and potential, or a lagrangian, "
      "without damping");
  expect_message(by_direction + kinetic + pair + "damping = 0.1\n", "without damping");
  expect_message(by_direction + kinetic + "potential = 0\nparts = \"keppler\"\n",
                 "model.toml:4:10: unknown splitting 'keppler'; did you mean 'kepler'?");
}

}  // namespace
