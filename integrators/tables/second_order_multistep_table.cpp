// Tables of the kind "second-order-multistep": the polynomials `rho` and `sigma`, lowest coefficient first,
// of a linear multistep method for q'' = a(q, t),
//
//   sum_j rho_j q_{n+j} = h^2 sum_j sigma_j a(q_{n+j}, t_{n+j}),   j = 0, ..., k,   sigma_k = 0
//
// (hairer-norsett-wanner1993 III.10), on energies quadratic in p with a constant mass matrix, M a = f. Where
// both polynomials are symmetric and the roots of rho other than the double 1 are simple and on the unit
// circle, energies stay bounded over long times except at steps where resonances of the parasitic roots
// spoil that (quinlan-tremaine1990, hairer-lubich-wanner2006 XV).
//
// With rho = (x - 1)^2 r(x) the method is a recursion for the increments e_n = P_{n+1} - P_n of the mean
// momenta P_n of a step, M (q_{n+1} - q_n) / h:
//
//   sum_j r_j e_{n+j} = h sum_j sigma_j f_{n+j},   P_{n+1} = P_n + e_n,   q_{n+1} = q_n + h M^{-1} P_n,
//
// so that momenta and positions are sums of increments, which are compensated, and no rounding is divided by
// h^2. The momenta that a step returns do not enter the recursion: they are the mean momentum and an integral
// of the forces along the polynomial through the last k of them,
//
//   p_n = P_{n-1} + h sum_j c_j f_{n-j},   c_j = int_{-1}^0 (1 + s) l_j(s) ds.
//
// Forces are evaluated once a step. As long as there are fewer than k in a row, steps are those of Gauss
// collocation of at least the same order. The increments that start the recursion are, like the momenta,
// integrals of forces, e_n = h int_{-1}^1 (1 - |s|) f(t_{n+1} + s h) ds.
#include <algorithm>

#include <pfaff/core/facets/quadratic_energy.hpp>
#include <pfaff/core/numbers/gauss_legendre.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/integrators/tables/multistep_document.hpp>
#include <pfaff/integrators/tables/multistep_history.hpp>

namespace {
using namespace pfaff;

// Integrates weight(s) times each of the Lagrange polynomials of the places 0, ..., count - 1 from `begin` to
// begin + 1, exactly up to rounding, and adds the results to `sums`.
template <class Weight>
void add_integrals(std::vector<Quad>& sums, int begin, Weight weight) {
  const int count = static_cast<int>(sums.size());
  for (const QuadratureNode& node : gauss_legendre(count / 2 + 2)) {
    const Quad at = Quad(begin) + node.place.quad();
    for (int j = 0; j < count; ++j) {
      Quad polynomial(1);
      for (int i = 0; i < count; ++i)
        if (i != j) polynomial *= (at - Quad(i)) / Quad(j - i);
      sums[static_cast<std::size_t>(j)] += node.weight.quad() * weight(node.place.quad()) * polynomial;
    }
  }
}
// Weights of the forces of k states in a row, oldest first, in the newest momentum less the mean one before.
std::vector<Quad> momentum_weights(std::size_t k) {
  std::vector<Quad> sums(k, Quad(0));
  add_integrals(sums, static_cast<int>(k) - 2, [](const Quad& s) { return s; });
  return sums;
}
// The same in the increment between the mean momenta before and after state `middle`.
std::vector<Quad> increment_weights(std::size_t k, std::size_t middle) {
  std::vector<Quad> sums(k, Quad(0));
  add_integrals(sums, static_cast<int>(middle) - 1, [](const Quad& s) { return s; });
  add_integrals(sums, static_cast<int>(middle), [](const Quad& s) { return Quad(1) - s; });
  return sums;
}

// 1/m of every component of a problem whose velocities are momenta over masses; empty for other problems.
// Where velocities are linear in the momenta, those at generic momenta tell.
template <class P>
std::vector<Scalar<P>> inverse_masses(const P& p) {
  using T = Scalar<P>;
  const std::size_t half = p.size() / 2;
  std::vector<T> momentum(half, T(1)), inverse(half), velocity(half);
  p.velocity(T(0), momentum, inverse);
  for (std::size_t k = 0; k < half; ++k) momentum[k] = T(1) + sin(T(static_cast<double>(k + 1))) / T(2);
  p.velocity(T(0), momentum, velocity);
  for (std::size_t k = 0; k < half; ++k) {
    const Value<T> found = value_of(velocity[k]), expected = value_of(inverse[k] * momentum[k]);
    if (!(abs(found - expected) <= Value<T>(4) * unit_roundoff<T>() * abs(expected))) return {};
  }
  return inverse;
}

struct SecondOrderMultistepTable {
  static constexpr bool fixed_sizes = false;
  std::size_t steps = 2;      // k
  std::vector<Quad> numbers;  // r_0, ..., r_{k-2}, sigma_0, ..., sigma_{k-1}
  Collocation<> starter;
  bool compensated = true;

  static std::vector<Parameter> parameters() {
    return {parameter(&SecondOrderMultistepTable::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return numbers; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    // With masses that depend on time accelerations contain velocities.
    return quadratic_in_momenta(model) && steady_kinetic_energy(model)
               ? ""
               : "steps accelerations and needs a kinetic energy that is quadratic in "
                 "the momenta and does not depend on time";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> r, sigma;  // divided by r_{k-2}, so that the newest increment has the factor 1
    std::vector<T> momentum;  // the weights c_j, oldest first
    std::vector<std::vector<T>> starting_increments;
    MultistepHistory<T> forces, increments;  // of the last k states and k - 2 pairs of steps
    std::vector<T> sum, increment, mean, velocity, carry_position, carry_momentum;
    std::vector<T> inverse_mass;  // empty where velocities are not momenta over masses
    std::size_t known = 0;        // forces in a row
    Continuation<P> continuation;
    pfaff::Work<Collocation<>, P> starting;

    Work(const SecondOrderMultistepTable& method, const P& p)
        : forces(method.steps, p.size() / 2),
          increments(method.steps - 2, p.size() / 2),
          continuation(p),
          starting(method.starter, p) {
      const std::size_t k = method.steps, half = p.size() / 2;
      const T leading = T(Real(method.numbers[k - 2]));
      for (std::size_t j = 0; j + 1 < k; ++j) r.push_back(T(Real(method.numbers[j])) / leading);
      for (std::size_t j = 0; j < k; ++j) sigma.push_back(T(Real(method.numbers[k - 1 + j])) / leading);
      momentum = converted(momentum_weights(k));
      for (std::size_t j = 0; j + 2 < k; ++j)
        starting_increments.push_back(converted(increment_weights(k, j + 1)));
      for (std::vector<T>* row : {&sum, &increment, &mean, &velocity, &carry_position, &carry_momentum})
        row->assign(half, T(0));
      if constexpr (HasSeparable<P>) inverse_mass = inverse_masses(p);
    }
    static std::vector<T> converted(const std::vector<Quad>& numbers) {
      std::vector<T> list;
      for (const Quad& x : numbers) list.push_back(T(Real(x)));
      return list;
    }
  };

  template <HasSeparable P>
  requires HasVectorField<P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                         Work<P>& w)
  const {
    const std::size_t half = z.size() / 2;
    if (!w.continuation.holds(t, h, z)) {
      w.known = 0;
      w.starting.restart();
      add_force(p, t, z, w);
    }
    if (w.known < steps) {
      const Status status = starter.step(p, t, h, z, w.starting);
      if (status != Status::converged) {
        w.continuation.forget();
        return status;
      }
      add_force(p, t + h, z, w);
      if (w.known == steps) begin(h, z, w);
    } else {
      recur(p, h, z, w);
      add_force(p, t + h, z, w);
      w.forces.weighted(w.momentum, w.sum);
      for (std::size_t c = 0; c < half; ++c) z[half + c] = w.mean[c] + (w.carry_momentum[c] + h * w.sum[c]);
    }
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

 private:
  // The force at state z, which is the newest one from here on.
  template <class P>
  void add_force(const P& p, const Scalar<P>& t, const State<P>& z, Work<P>& w) const {
    const std::size_t half = z.size() / 2;
    p.force(t, In<Scalar<P>>(z.data(), half), w.forces.next());
    w.known = std::min(w.known + 1, steps);
  }

  // Mean momentum and increments of the first k states.
  template <class P>
  void begin(const Scalar<P>& h, const State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t half = z.size() / 2;
    w.forces.weighted(w.momentum, w.sum);
    for (std::size_t c = 0; c < half; ++c) {
      w.mean[c] = z[half + c] - h * w.sum[c];
      w.carry_position[c] = w.carry_momentum[c] = T(0);
    }
    for (std::size_t j = 0; j + 2 < steps; ++j) {
      w.forces.weighted(w.starting_increments[j], w.sum);
      for (std::size_t c = 0; c < half; ++c) w.increments[j][c] = h * w.sum[c];
    }
  }

  // The next mean momentum, and the positions it leads to.
  template <class P>
  void recur(const P& p, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t half = z.size() / 2;
    w.forces.weighted(w.sigma, w.sum);
    w.increments.weighted(w.r, w.increment);
    for (std::size_t c = 0; c < half; ++c) w.increment[c] = h * w.sum[c] - w.increment[c];
    if (!w.increments.empty()) std::copy(w.increment.begin(), w.increment.end(), w.increments.next().begin());
    for (std::size_t c = 0; c < half; ++c)
      add_to(w.mean[c], w.carry_momentum[c], w.increment[c], compensated);
    if (w.inverse_mass.empty())
      p.velocity(T(0), w.mean, w.velocity);
    else
      for (std::size_t c = 0; c < half; ++c) w.velocity[c] = w.inverse_mass[c] * w.mean[c];
    for (std::size_t c = 0; c < half; ++c) add_to(z[c], w.carry_position[c], h * w.velocity[c], compensated);
  }
};

MultistepPolynomials second_order_polynomials(const std::vector<Quad>& numbers) {
  const std::size_t k = (numbers.size() + 1) / 2;
  MultistepPolynomials method{std::vector<Quad>(k + 1, Quad(0)),
                              {numbers.begin() + static_cast<std::ptrdiff_t>(k) - 1, numbers.end()}};
  method.sigma.emplace_back(0);
  for (std::size_t j = 0; j + 1 < k; ++j) {
    method.rho[j] += numbers[j];
    method.rho[j + 1] -= Quad(2) * numbers[j];
    method.rho[j + 2] += numbers[j];
  }
  return method;
}

std::unique_ptr<const MethodTable> read_second_order_multistep_table(TableDocument& document,
                                                                     TableHead head) {
  const MultistepPolynomials method = read_multistep_polynomials(document, head, 3);
  if (method.sigma.back() != Quad(0))
    document.refuse("sigma", "the last number is not 0; expected an explicit method");
  document.finish();
  head.descriptor.family = "multistep";
  const int order = head.descriptor.order;
  require_order(document, head, second_order_multistep_conditions(method, order + 1));
  const std::vector<Quad> r = without_root_one(without_root_one(method.rho));
  if (r.size() > 1)
    if (const std::string reason = instability({r, {}}); !reason.empty())
      document.refuse("rho", "is not zero-stable: without its double root 1, " + reason);

  SecondOrderMultistepTable made;
  made.steps = method.rho.size() - 1;
  made.numbers = r;
  made.numbers.insert(made.numbers.end(), method.sigma.begin(), method.sigma.end() - 1);
  made.starter.tableau = gauss_coefficients((order + 1) / 2);
  OrderTheory theory = multistep_theory("second-order multistep", head, made.numbers, r.size());
  theory.conditions = [order](const std::vector<Quad>& numbers) {
    return second_order_multistep_conditions(second_order_polynomials(numbers), order);
  };
  return std::make_unique<TableOf<SecondOrderMultistepTable>>(head.descriptor, document, std::move(theory),
                                                              std::move(made));
}

const TableKind<SecondOrderMultistepTable> second_order_multistep_kind{{"second-order-multistep"},
                                                                       read_second_order_multistep_table};
}  // namespace
