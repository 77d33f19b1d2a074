// Tables of the kind "multistep": the polynomials `rho` and `sigma` of a linear multistep method, lowest
// coefficient first,
//
//   sum_j rho_j z_{n+j} = h sum_j sigma_j X(z_{n+j}, t_{n+j}),   j = 0, ..., k
//
// (hairer-norsett-wanner1993 III.2). With rho(x) = (x - 1) r(x) it is a recursion for the increments d_n =
// z_{n+1} - z_n, sum_j r_j d_{n+j} = h sum_j sigma_j X_{n+j}, so that the state is a sum of increments, which
// is compensated. Explicit methods (sigma_k = 0) evaluate the field once a step; implicit ones iterate to
// round-off, which converges where h times the field's Lipschitz constant is small. As long as there are
// fewer than k states in a row, steps are those of Gauss collocation of at least the same order. What is kept
// is not known: a multistep method is a map of k states, and nothing is claimed.
#include <algorithm>

#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/integrators/tables/multistep_document.hpp>
#include <pfaff/integrators/tables/multistep_history.hpp>

namespace {
using namespace pfaff;

struct MultistepTable {
  static constexpr bool fixed_sizes = false;
  std::size_t steps = 1;      // k
  std::vector<Quad> numbers;  // r_0, ..., r_{k-1}, sigma_0, ..., sigma_k
  Collocation<> starter;
  bool compensated = true;

  static std::vector<Parameter> parameters() {
    return {parameter(&MultistepTable::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return numbers; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> r, sigma;  // divided by r_{k-1}, so that the newest increment has the factor 1
    MultistepHistory<T> increments, rates;  // of the last k - 1 and k states
    std::vector<T> increment, rate;         // of the step that is made
    State<P> before, point, carry;
    std::size_t known = 0;                  // states in a row, of which the rates are kept
    Continuation<P> continuation, failure;  // where the last step ended, and one failed
    pfaff::Work<Collocation<>, P> starting;

    Work(const MultistepTable& method, const P& p)
        : increments(method.steps - 1, p.size()),
          rates(method.steps, p.size()),
          before(p.make_state()),
          point(p.make_state()),
          carry(p.make_state()),
          continuation(p),
          failure(p),
          starting(method.starter, p) {
      const std::size_t k = method.steps, n = p.size();
      const T leading = T(Real(method.numbers[k - 1]));
      for (std::size_t j = 0; j < k; ++j) r.push_back(T(Real(method.numbers[j])) / leading);
      for (std::size_t j = 0; j <= k; ++j) sigma.push_back(T(Real(method.numbers[k + j])) / leading);
      increment.assign(n, T(0));
      rate.assign(n, T(0));
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    // A step that has failed is tried once more without the past, and would be one of the method for the
    // start.
    if (w.failure.holds(t, h, z)) {
      w.failure.forget();
      return Status::not_converged;
    }
    if (!w.continuation.holds(t, h, z)) {
      w.known = 0;
      w.starting.restart();
      for (T& x : w.carry) x = T(0);
    }
    p.field(t, z, w.rates.next());
    w.known = std::min(w.known + 1, steps);
    for (std::size_t k = 0; k < n; ++k) w.before[k] = z[k];
    const Status status = w.known < steps ? starter.step(p, t, h, z, w.starting) : recur(p, t, h, z, w);
    if (status != Status::converged) {
      w.continuation.forget();
      if (w.known == steps && status == Status::not_converged) w.failure.remember(t, h, z);
      return status;
    }
    if (w.known < steps)
      for (std::size_t k = 0; k < n; ++k) w.increment[k] = z[k] - w.before[k];
    if (!w.increments.empty()) std::copy(w.increment.begin(), w.increment.end(), w.increments.next().begin());
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

 private:
  template <class P>
  Status recur(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    const std::size_t n = z.size();
    w.rates.weighted(w.sigma, w.rate);
    w.increments.weighted(w.r, w.increment);
    for (std::size_t k = 0; k < n; ++k) w.increment[k] = h * w.rate[k] - w.increment[k];
    if (!structurally_explicit())
      if (const Status status = solve(p, t, h, z, w); status != Status::converged) return status;
    for (std::size_t k = 0; k < n; ++k) add_to(z[k], w.carry[k], w.increment[k], compensated);
    return Status::converged;
  }

  [[nodiscard]] bool structurally_explicit() const { return numbers.back() == Quad(0); }

  // increment = (what is known of it) + h sigma_k X(z + increment, t + h), by iteration.
  template <class P>
  Status solve(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    const T factor = h * w.sigma[steps];
    // The newest rate predicts the one that is sought.
    const Out<T> newest = w.rates.newest();
    std::copy(newest.begin(), newest.end(), w.rate.begin());
    for (std::size_t k = 0; k < n; ++k) w.increment[k] = w.increment[k] + factor * w.rate[k];
    Convergence<T> convergence;
    do {
      for (std::size_t k = 0; k < n; ++k) {
        w.point[k] = z[k] + (w.increment[k] + w.carry[k]);
        w.before[k] = w.rate[k];
      }
      p.field(t + h, w.point, w.rate);
      convergence.begin_iteration();
      for (std::size_t k = 0; k < n; ++k) {
        const T correction = factor * (w.rate[k] - w.before[k]);
        w.increment[k] = w.increment[k] + correction;
        convergence.add(correction, z[k], w.increment[k]);
      }
      ++p.counters().iterations;
    } while (!convergence.finished(100));
    return convergence.status();
  }
};

MultistepPolynomials first_order_polynomials(const std::vector<Quad>& numbers) {
  const std::size_t k = numbers.size() / 2;
  MultistepPolynomials method{std::vector<Quad>(k + 1),
                              {numbers.begin() + static_cast<std::ptrdiff_t>(k), numbers.end()}};
  for (std::size_t j = 0; j < k; ++j) {
    method.rho[j] -= numbers[j];
    method.rho[j + 1] += numbers[j];
  }
  return method;
}

std::unique_ptr<const MethodTable> read_multistep_table(TableDocument& document, TableHead head) {
  const MultistepPolynomials method = read_multistep_polynomials(document, head, 2);
  document.finish();
  head.descriptor.family = "multistep";
  const int order = head.descriptor.order;
  require_order(document, head, multistep_conditions(method, order + 1));
  if (const std::string reason = instability(method); !reason.empty())
    document.refuse("rho", "is not zero-stable: " + reason);

  MultistepTable made;
  made.steps = method.rho.size() - 1;
  made.numbers = without_root_one(method.rho);  // r with rho(x) = (x - 1) r(x)
  made.numbers.insert(made.numbers.end(), method.sigma.begin(), method.sigma.end());
  made.starter.tableau = gauss_coefficients((order + 1) / 2);
  OrderTheory theory = multistep_theory("multistep", head, made.numbers, made.steps);
  theory.conditions = [order](const std::vector<Quad>& numbers) {
    return multistep_conditions(first_order_polynomials(numbers), order);
  };
  return std::make_unique<TableOf<MultistepTable>>(head.descriptor, document, std::move(theory),
                                                   std::move(made));
}

const TableKind<MultistepTable> multistep_kind{{"multistep"}, read_multistep_table};
}  // namespace
