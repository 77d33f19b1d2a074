// Solutions that are printed to sixteen digits: the problems of DETEST at t = 20 (enright-pryce1987), stars
// at t = 3 (mazzia-magherini2008), and the pendulum that is released at a right angle.
#include <pfaff/papers/others/rows.hpp>

namespace pfaff::others {

namespace {
// Printed with sixteen digits, of which the last may be off by one or two.
constexpr double sixteen_digits = 3e-15;
// Printed likewise, but computed by stepping in sixteen digits, which loses the last one.
constexpr double fifteen_digits = 1e-14;

struct Orbit {
  const char *name, *eccentricity;
  std::vector<std::string> printed;  // q and p
};

// Problems D1 to D5 start at the pericentre, as the system does.
void kepler_orbits(Rows& rows) {
  const std::vector<Orbit> orbits{
      {"D1",
       "0.1",
       {"0.2198835352008397", "0.9427076846341813", "-0.9787659841058176", "0.3287977990962036"}},
      {"D2",
       "0.3",
       {"-0.1777027357140412", "0.9467784719905892", "-1.030294163192969", "0.1211074890053952"}},
      {"D3",
       "0.5",
       {"-0.5780432953035361", "0.8633840009194193", "-0.9595083730380727", "-0.06504915126712089"}},
      {"D4",
       "0.7",
       {"-0.9538990293416394", "0.6907409024219432", "-0.8212674270877433", "-0.1539574259125825"}},
      {"D5",
       "0.9",
       {"-1.295266250987574", "0.4003938963792321", "-0.6775390924707566", "-0.1270838154278686"}}};
  for (const Orbit& orbit : orbits)
    rows.published(
        "enright-pryce1987 " + std::string(orbit.name),
        "Kepler, e = " + std::string(orbit.eccentricity) + ", at t = 20", orbit.printed,
        solution_at_end(resolved({"kepler", "rk4", {{"eccentricity", orbit.eccentricity}}, "1", "20"})),
        sixteen_digits);
}

void predators(Rows& rows) {
  const Assignments rates{{"alpha", "2"}, {"beta", "2"}, {"gamma", "1"}, {"delta", "1"}};
  rows.published(
      "enright-pryce1987 B1", "Lotka and Volterra at t = 20", {"0.6761876008576667", "0.1860816099640036"},
      solution_at_end(resolved({"lotka-volterra", "rk4", rates, "1", "20", {"1", "3"}})), fifteen_digits);
}

// y1' = y2 y3, y2' = -y1 y3, y3' = -0.51 y1 y2 are Euler's equations of a body with the reciprocal moments
// 1, 1 - 0.51/r and 1 - 0.51/r + r, r = sqrt 1.51, for y = (z1/r, z2, z3).
void body(Rows& rows) {
  const Quad r = sqrt(Quad(151) / 100), k = Quad(51) / 100;
  const Assignments moments{
      {"i1", "1"}, {"i2", to_string(1 / (1 - k / r), 36)}, {"i3", to_string(1 / (1 - k / r + r), 36)}};
  Numbers z = solution_at_end(resolved({"free-rigid-body", "rk4", moments, "1", "20", {"0", "1", "1"}}));
  z[0] /= r;
  rows.published("enright-pryce1987 B5", "Euler's rigid body at t = 20",
                 {"-0.9396570798729192", "-0.3421177754000779", "0.7414126596199957"}, z, fifteen_digits);
}

// Close approaches amplify round-off: extrapolation in double is left with an error of 1e-10. Taylor series
// in quad, which take two seconds, agree with all printed digits to 2e-15.
void stars(Rows& rows) {
  Numbers z = state_at_end(example("models/pleiades.toml"), "odeint-bulirsch-stoer", "1e-14", "3");
  for (std::size_t k = 0; k < 14; ++k) z[14 + k] /= static_cast<int>(k % 7 + 1);  // velocities of momenta
  rows.published("mazzia-magherini2008 Pleiades", "seven stars at t = 3",
                 {"0.3706139143970502",  "3.237284092057233",   "-3.222559032418324",  "0.6597091455775310",
                  "0.3425581707156584",  "1.562172101400631",   "-0.7003092922212495", "-3.943437585517392",
                  "-3.271380973972550",  "5.225081843456543",   "-2.590612434977470",  "1.198213693392275",
                  "-0.2429682344935824", "1.091449240428980",   "3.417003806314313",   "1.354584501625501",
                  "-2.590065597810775",  "2.025053734714242",   "-1.155815100160448",  "-0.8072988170223021",
                  "0.5952396354208710",  "-3.741244961234010",  "0.3773459685750630",  "0.9386858869551073",
                  "0.3667922227200571",  "-0.3474046353808490", "2.344915448180937",   "-1.947020434263292"},
                 z, 1e-8);
}

// A quarter of the period is K(1/sqrt 2) = 1.854074677301372; the rod then hangs down. The time at which it
// does is found by collocation with steps of a sixteenth of it and one step of Newton's.
void pendulum(Rows& rows) {
  const Quad step = Quad(115879667) / 1000000000;  // a sixteenth of the quarter, to nine digits
  const ResolvedRun run = resolved({"pendulum",
                                    "gauss",
                                    {{"stages", "8"}},
                                    "0.115879667",
                                    "1.854074672",
                                    {"1.57079632679489661923132169163975144", "0"}});
  Numbers z;
  follow<Quad>(run, [&](const std::vector<Quad>& state) { z = state; });
  rows.published("abramowitz-stegun1964 17.3", "pendulum, quarter period from a right angle",
                 {"1.854074677301372"}, {16 * step - z[0] / z[1]}, sixteen_digits);
}

}  // namespace

void solution_rows(Rows& rows) {
  kepler_orbits(rows);
  predators(rows);
  body(rows);
  stars(rows);
  pendulum(rows);
}

}  // namespace pfaff::others
