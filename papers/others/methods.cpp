// Errors that are printed of a method on a problem.
#include <array>
#include <cmath>

#include <pfaff/papers/others/rows.hpp>

namespace pfaff::others {

namespace {

const std::string mclachlan_4 = "tables/mclachlan-atela-4.toml";

// The size of the energy error after 50 units of time with drifts in the places of kicks and the other way
// round. Written out by hand, with the digits that are published.
double exchanged_roles() {
  constexpr std::array drift{0.1344961992774310892, -0.2248198030794208058, 0.7563200005156682911,
                             0.3340036032863214255},
      kick{0.5153528374311229364, -0.085782019412973646, 0.4415830236164665242, 0.1288461583653841854};
  std::array<double, 2> q{0.4, 0}, p{0, 2};
  for (int step = 0; step < 500; ++step)
    for (std::size_t k = 0; k < kick.size(); ++k) {
      const double square = q[0] * q[0] + q[1] * q[1], pull = 0.1 * kick[k] / (square * std::sqrt(square));
      for (std::size_t i = 0; i < 2; ++i) p[i] -= pull * q[i];
      for (std::size_t i = 0; i < 2; ++i) q[i] += 0.1 * drift[k] * p[i];
    }
  return std::abs((p[0] * p[0] + p[1] * p[1]) / 2 - 1 / std::hypot(q[0], q[1]) + 0.5);
}

// Kepler's problem with e = 0.6 over t <= 50, in the example of ARKODE: McLachlan's method with four stages.
void arkode(Rows& rows) {
  const std::string equation = "reynolds-gardner-woodward-chinomona2023 Kepler";
  const ResolvedRun run = resolved(
      {"kepler", example(mclachlan_4), {{"compensated", "no"}, {"eccentricity", "0.6"}}, "0.1", "50"});
  // H is a sum of numbers about 1, each rounded to 1e-16, of 500 steps that are rounded in another order.
  rows.published(equation, "H - H0 at the end, McLachlan 4 with h = 0.1", {"-5.3723049984188975e-06"},
                 {energy_error<double>(run).last}, 1e-13);
  const double exchanged = exchanged_roles();
  rows.qualitative(equation, "control: kicks and drifts exchanged", {"-", shown(exchanged)},
                   {at_least(exchanged, 1e-3)},
                   "kicks go first with the numbers of kicks; exchanged, the error is of order 1");
}

// The largest error of the energy, 120, of the quadrupole boson over t <= 100 with h = 0.01. What is printed
// is the round-off of sums in double: the methods' own errors are what they are in quad, where the energy
// error is bounded, so that a hundredth of the time shows it.
void boson(Rows& rows) {
  const auto row = [&](const std::string& method, const std::string& integrator, const Assignments& set,
                       double printed, double own, double of_double) {
    const double in_double =
        energy_error<double>(resolved({"quadrupole-boson", integrator, set, "0.01", "100"})).largest;
    const double in_quad =
        energy_error<Quad>(resolved({"quadrupole-boson", integrator, set, "0.01", "1"})).largest;
    rows.qualitative(
        "rackauckas-nie2017 quadrupole boson", "largest energy error, " + method,
        {shown(printed), shown(in_double) + " (quad " + shown(in_quad) + ")"},
        {at_most(in_quad, own), at_most(in_double, of_double), at_least(printed, 10 * own)},
        "printed as the error of the method, and round-off of double: the method's own, in quad, is " +
            shown(in_quad));
  };
  // Plain sums here, compensated ones below.
  row("Kahan and Li 8", "composition",
      {{"scheme", "kahan-li"}, {"order", "8"}, {"base", "verlet(compensated=no)"}}, 5.57e-12, 2e-13, 1.2e-11);
  row("Sofroniou and Spaletta 10", example("tables/sofroniou-spaletta-10.toml"), {}, 3.84e-12, 1e-15, 1e-12);
}

}  // namespace

void method_rows(Rows& rows) {
  arkode(rows);
  boson(rows);
}

}  // namespace pfaff::others
