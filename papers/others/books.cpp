// Figures and statements of books and papers that print no digits of a run.
#include <array>
#include <cmath>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/papers/others/rows.hpp>

namespace pfaff::others {

namespace {

// Figures 2.2 and 2.3 of section I.2 in numbers: the energy error of symplectic methods on Kepler's ellipse
// is bounded and of the order of the method, that of others grows.
void kepler_energy(Rows& rows) {
  const std::string equation = "hairer-lubich-wanner2006 I.2.3";
  const auto largest = [](const std::string& method, const std::string& step, const std::string& time) {
    return energy_error<double>(resolved({"kepler", method, {{"eccentricity", "0.6"}}, step, time})).largest;
  };
  const auto order = [&](const std::string& method) {
    return std::log2(largest(method, "0.01", "25") / largest(method, "0.005", "25"));
  };
  rows.order(equation, "energy of symplectic Euler, power of h", 1, order("symplectic-euler"), 0.1);
  rows.order(equation, "energy of Stoermer-Verlet, power of h", 2, order("verlet"), 0.1);
  const double short_run = largest("verlet", "0.02", "25"), long_run = largest("verlet", "0.02", "100");
  const double control = largest("rk4", "0.05", "100") / largest("rk4", "0.05", "25");
  rows.qualitative(equation, "four times as long, Stoermer-Verlet",
                   {"no growth", "factor " + shown(long_run / short_run)},
                   {at_most(long_run / short_run, 1.1), at_least(control, 2)},
                   "the largest energy error does not grow; that of RK4, as a control, does");
}

// Figure I.2.4: the outer solar system over 200000 days. The energy is 3.2e-8 in these units.
void planets(Rows& rows) {
  const std::string equation = "hairer-lubich-wanner2006 I.2.4",
                    model = example("models/outer-solar-system.toml");
  const auto largest = [&](const std::string& method, const std::string& step, const std::string& time) {
    return energy_error<double>(resolved({model, method, {}, step, time})).largest;
  };
  for (const auto& [method, step] : {std::pair("symplectic-euler", "100"), std::pair("verlet", "200")}) {
    const double half = largest(method, step, "100000"), whole = largest(method, step, "200000");
    rows.qualitative(equation, std::string(method) + ", h = " + step + " days",
                     {"correct behaviour", "energy error " + shown(whole)},
                     {at_most(whole / half, 1.1), at_most(whole, 2e-9)},
                     "the energy error of the second hundred thousand days is that of the first, and below a "
                     "tenth of the energy");
  }
}

// Symmetric multistep methods have no secular error of energies: in 2740 years with steps of 25 days and one
// force each, errors relative to the energy of -3.2e-8 stay what they are after the first tenth of the time.
void long_steps(Rows& rows) {
  const std::string equation = "quinlan-tremaine1990";
  const double energy = 3.2155e-8;
  const auto largest = [&](const std::string& method, const std::string& time) {
    return energy_error<double>(resolved({"outer-solar-system", method, {}, "25", time})).largest / energy;
  };
  const double tenth = largest(example("tables/hairer-lubich-wanner-8.toml"), "100000"),
               whole = largest(example("tables/hairer-lubich-wanner-8.toml"), "1000000"),
               control = largest("verlet", "100000");
  rows.qualitative(
      equation, "outer planets, symmetric multistep method of order 8, h = 25 days",
      {"no secular error", "energy error " + shown(whole)},
      {at_most(whole, 7e-12), at_most(whole / tenth, 1.5), at_least(control, 1e-5)},
      "the relative energy error of a million days is that of the first hundred thousand; that of "
      "Stoermer-Verlet, as a control with as many forces, is " +
          shown(control));
}

// 15.6: r'' + nu r' + r = 0 from r = 1, r' = -1 over t <= 25 with steps of 0.2. Scheme (5.8) is the midpoint
// rule in a chart, its rival the midpoint rule in (r, r'). Compared is the largest error of r.
class Schemes {
 public:
  static double birkhoffian(double nu) {
    return largest_error("midpoint-darboux", example("models/turned-damped-oscillator.toml"), nu);
  }
  static double midpoint(double nu) { return largest_error("implicit-midpoint", "damped-oscillator", nu); }

 private:
  // r = e^{-nu t/2} (C + (nu/2 - 1) S) with C and S of the rate 1 - nu^2/4.
  static double exact(double nu, double t) {
    const double rate = 1 - nu * nu / 4, w = std::sqrt(std::abs(rate));
    const double c = rate > 0 ? std::cos(w * t) : std::cosh(w * t);
    const double s = w == 0 ? t : (rate > 0 ? std::sin(w * t) : std::sinh(w * t)) / w;
    return std::exp(-nu * t / 2) * (c + (nu / 2 - 1) * s);
  }
  static double largest_error(const std::string& method, const std::string& system, double nu) {
    double largest = 0;
    int step = 0;
    follow<double>(resolved({system, method, {{"nu", to_string(Quad(nu), 17)}}, "0.2", "25", {"1", "-1"}}),
                   [&](const std::vector<double>& z) {
                     largest = std::max(largest, std::abs(z[0] - exact(nu, 0.2 * step++)));
                   });
    return largest;
  }
};

void damped_oscillator(Rows& rows) {
  const std::string equation = "feng-qin2010 15.6";
  const double at_two = Schemes::birkhoffian(2);
  rows.qualitative(equation, "scheme (5.8) with nu = 2", {"exact", "error " + shown(at_two)},
                   {at_most(at_two, 1e-14), at_least(Schemes::midpoint(2), 1e-4)},
                   "the largest error is round-off; that of the midpoint rule is not");
  double ahead = 2, behind = 4;  // where (5.8) is ahead of the midpoint rule, and where it is behind
  while (behind - ahead > 1e-3) {
    const double nu = (ahead + behind) / 2;
    (Schemes::birkhoffian(nu) < Schemes::midpoint(nu) ? ahead : behind) = nu;
  }
  rows.published(equation, "upper nu where (5.8) falls behind the midpoint rule", {"2.85"}, {Quad(ahead)},
                 0.01);
}

// Reversible methods keep the energy of reversible nonholonomic systems over long times.
void nonholonomic(Rows& rows) {
  const auto growth = [](const std::string& method) {
    const auto largest = [&](const std::string& time) {
      return energy_error<double>(resolved({"contact-oscillator", method, {}, "0.1", time})).largest;
    };
    return largest("400") / largest("100");
  };
  const double reversible = growth("mclachlan-perlmutter"), control = growth("rk4");
  rows.qualitative(
      "mclachlan-perlmutter2006", "energy of the contact oscillator",
      {"no drift", "grows by " + shown(reversible)}, {at_most(reversible, 1.5), at_least(control, 2)},
      "from t = 100 to 400 the largest energy error hardly grows; that of RK4, as a control, does");
}

// The saddle at q = (0, 1), above whose energy orbits escape.
void galaxy(Rows& rows) {
  const auto model = systems().get("henon-heiles", "system").make({});
  const auto energy = make_evaluator<Quad>(model, Formula::invariants);
  const auto force = make_evaluator<Quad>(model, Formula::force);
  const std::array<Quad, 4> saddle{Quad(0), Quad(1), Quad(0), Quad(0)};
  std::array<Quad, 2> pull{};
  Quad value(0);
  energy.call(energy.context, Quad(0), saddle.data(), &value);
  force.call(force.context, Quad(0), saddle.data(), pull.data());
  rows.reproduced("henon-heiles1964", "energy of escape and the force there", {Quad(1) / 6, Quad(0), Quad(0)},
                  {value, pull[0], pull[1]});
}

}  // namespace

void book_rows(Rows& rows) {
  kepler_energy(rows);
  planets(rows);
  long_steps(rows);
  damped_oscillator(rows);
  nonholonomic(rows);
  galaxy(rows);
}

}  // namespace pfaff::others
