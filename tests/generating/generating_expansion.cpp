#include <pfaff/tests/generating/generating_expansion.hpp>

#include <functional>
#include <map>
#include <utility>

#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {

using SeriesIn = std::span<const Recorded>;
using SeriesOut = std::span<Recorded>;
using Formulas = std::vector<Recorded>;

Real factorial(int k) {
  Real product(1);
  for (int i = 2; i <= k; ++i) product = product * Real(i);
  return product;
}
Real binomial(int n, int k) { return factorial(n) / (factorial(k) * factorial(n - k)); }

void append(Formulas& list, std::span<const Recorded> more) {
  list.insert(list.end(), more.begin(), more.end());
}

Tape time_derivative_tape(const Tape& tape) {
  return record(tape.inputs, static_cast<int>(tape.outputs.size()),
                [&](const Recorded& t, SeriesIn z, SeriesOut out) {
                  const auto rate = time_derivative(tape, t, z);
                  std::copy(rate.begin(), rate.end(), out.begin());
                });
}

// [tau^k] of a tape whose time is tau.
Formulas taylor_coefficient(Tape tape, int k, SeriesIn z) {
  for (int i = 0; i < k; ++i) tape = time_derivative_tape(tape);
  auto value = evaluate(tape, Recorded(0), z);
  for (Recorded& x : value) x = x / Recorded(factorial(k));
  return value;
}

// Derivatives of a of any order: d^m/dt^m, then one direction of u = (X, w, Y, t0) after another.
class Derivatives {
 public:
  explicit Derivatives(const Tape& tape) : inputs_(tape.inputs) { tapes_.emplace(Key{0, 0}, tape); }

  // d_t^m a(u; direction_1, ..), where `arguments` is u with the directions behind it.
  Formulas operator()(int m, int directions, const Recorded& t, SeriesIn arguments) {
    return evaluate(tape(m, directions), t, arguments);
  }

 private:
  using Key = std::pair<int, int>;
  const Tape& tape(int m, int directions) {
    if (const auto found = tapes_.find({m, directions}); found != tapes_.end()) return found->second;
    if (directions == 0) return tapes_[{m, 0}] = time_derivative_tape(tape(m - 1, 0));
    const Tape& below = tape(m, directions - 1);
    return tapes_[{m, directions}] =
               record(below.inputs + inputs_, static_cast<int>(below.outputs.size()),
                      [&](const Recorded& t, SeriesIn z, SeriesOut out) {
                        const auto all = static_cast<std::size_t>(below.inputs);
                        Formulas direction(z.begin() + static_cast<std::ptrdiff_t>(all), z.end());
                        direction.resize(all);
                        const auto d = directional_derivative(below, t, Recorded(0), z.first(all), direction);
                        std::copy(d.begin(), d.end(), out.begin());
                      });
  }

  int inputs_;
  std::map<Key, Tape> tapes_;
};

// Calls take(parts) for every way to write `total` as an ordered sum of `count` positive parts.
void compositions(int total, int count, std::vector<int>& parts,
                  const std::function<void(const std::vector<int>&)>& take) {
  if (count == 0) {
    if (total == 0) take(parts);
    return;
  }
  for (int part = 1; part <= total - (count - 1); ++part) {
    parts.push_back(part);
    compositions(total - part, count - 1, parts, take);
    parts.pop_back();
  }
}

// Everything that [tau^k] a is made of at one recorded point.
class Expansion {
 public:
  Expansion(Derivatives& derivatives, const std::vector<Tape>& gradients, const Recorded& t0, SeriesIn w)
      : derivatives_(derivatives), n_(w.size()), t0_(t0) {
    for (const Tape& tape : gradients) {
      gradient_.push_back(evaluate(tape, t0, w));
      hessian_.push_back(jacobian(tape, t0, w));
    }
    append(base_, gradient_[0]);
    append(base_, w);
    append(base_, hessian_[0]);
    base_.push_back(t0);
  }

  Formulas multilinear(int k) {
    Formulas sum(n_);
    for (int m = 0; m <= k; ++m)
      for (int n = 0; n <= k - m; ++n)
        for (int l = 0; n + l <= k - m; ++l)
          add_compositions(sum, m, n, l, k - m, Real(1) / (factorial(m) * factorial(n) * factorial(l)));
    return sum;
  }

  // D_t^k a/k! with D_t^k as (77) or (78) print it at t = t0, sums and weights included. The third term has
  // phi_ww in (77) and phi_w in (78). The last line of (78) contracts the n-th derivative in phi_w with l of
  // them and the l-th in phi_ww with n, which has a meaning up to k = 2 only; from there on the lengths of
  // (77) are taken.
  Formulas as_printed(int k, bool third_in_hessian) {
    Formulas sum(n_);
    if (k == 0) return derivatives_(0, 0, t0_, base_);
    add(sum, Real(1), 0, {k}, {});
    add(sum, Real(1), 0, {}, {k});
    if (third_in_hessian) {
      add(sum, Real(1), 1, {}, {k - 1});
    } else {
      add(sum, Real(1), 1, {k - 1}, {});
    }
    for (int m = 0; m <= k; ++m)
      for (int n = 1; n <= k - m; ++n)
        for (int l = 1; l <= k - m - n; ++l)
          add_compositions(sum, m, n, l, k - m, binomial(k, m) * binomial(k - m, n));
    for (Recorded& x : sum) x = x / Recorded(factorial(k));
    return sum;
  }

 private:
  void add_compositions(Formulas& sum, int m, int n, int l, int total, const Real& weight) {
    std::vector<int> parts;
    compositions(total, n + l, parts, [&](const std::vector<int>& found) {
      add(sum, weight, m, {found.begin(), found.begin() + n}, {found.begin() + n, found.end()});
    });
  }
  // sum += weight d_X^n d_Y^l d_t^m a in the directions phi_w^(h), phi_ww^(j).
  void add(Formulas& sum, const Real& weight, int m, const std::vector<int>& h, const std::vector<int>& j) {
    Formulas arguments = base_;
    for (const int degree : h) {
      append(arguments, gradient_[static_cast<std::size_t>(degree)]);
      arguments.resize(arguments.size() + n_ + n_ * n_ + 1);
    }
    for (const int degree : j) {
      arguments.resize(arguments.size() + 2 * n_);
      append(arguments, hessian_[static_cast<std::size_t>(degree)]);
      arguments.resize(arguments.size() + 1);
    }
    const auto term = derivatives_(m, static_cast<int>(h.size() + j.size()), t0_, arguments);
    for (std::size_t i = 0; i < n_; ++i) sum[i] = sum[i] + Recorded(weight) * term[i];
  }

  Derivatives& derivatives_;
  std::size_t n_;
  Recorded t0_;
  std::vector<Formulas> gradient_, hessian_;
  Formulas base_;
};

// sum_i tau^i terms_i.
Formulas polynomial(const std::vector<Formulas>& terms, const Recorded& tau) {
  Formulas sum = terms.back();
  for (std::size_t i = terms.size() - 1; i-- > 0;)
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = sum[k] * tau + terms[i][k];
  return sum;
}

Tape zero(int inputs, int outputs) {
  return record(inputs, outputs, [](const Recorded&, SeriesIn, SeriesOut) {});
}

}  // namespace

std::vector<Tape> expand_gradient(const Tape& evolution, int dimension, int degree, ExpansionRule rule) {
  std::vector<Tape> terms{zero(dimension, dimension)};
  Derivatives derivatives(evolution);
  for (int k = 0; k < degree; ++k) {
    const Tape along = record(dimension + 1, dimension, [&](const Recorded& tau, SeriesIn x, SeriesOut out) {
      const Recorded& t0 = x.back();
      const SeriesIn w = x.first(x.size() - 1);
      std::vector<Formulas> gradients, hessians;
      for (const Tape& term : terms) {
        gradients.push_back(evaluate(term, t0, w));
        hessians.push_back(jacobian(term, t0, w));
      }
      Formulas u = polynomial(gradients, tau);
      append(u, w);
      append(u, polynomial(hessians, tau));
      u.push_back(t0);
      const auto value = evaluate(evolution, t0 + tau, u);
      std::copy(value.begin(), value.end(), out.begin());
    });
    terms.push_back(record(dimension, dimension, [&](const Recorded& t0, SeriesIn w, SeriesOut out) {
      Formulas value;
      if (rule == ExpansionRule::total_derivative) {
        Formulas x(w.begin(), w.end());
        x.push_back(t0);
        value = taylor_coefficient(along, k, x);
      } else {
        Expansion expansion(derivatives, terms, t0, w);
        value = rule == ExpansionRule::multilinear
                    ? expansion.multilinear(k)
                    : expansion.as_printed(k, rule == ExpansionRule::printed_77);
      }
      for (std::size_t i = 0; i < value.size(); ++i) out[i] = value[i] / Recorded(k + 1);
    }));
  }
  return terms;
}

std::vector<Tape> expand_scalar(const Tape& scalar_evolution, int dimension, int degree) {
  std::vector<Tape> terms{zero(dimension, 1)};
  for (int k = 0; k < degree; ++k) {
    const Tape along = record(dimension + 1, 1, [&](const Recorded& tau, SeriesIn x, SeriesOut out) {
      const Recorded& t0 = x.back();
      const SeriesIn w = x.first(x.size() - 1);
      std::vector<Formulas> gradients;
      for (const Tape& term : terms) gradients.push_back(gradient(term, t0, w, Formulas{Recorded(1)}));
      Formulas u = polynomial(gradients, tau);
      append(u, w);
      u.push_back(t0);
      out[0] = evaluate(scalar_evolution, t0 + tau, u)[0];
    });
    terms.push_back(record(dimension, 1, [&](const Recorded& t0, SeriesIn w, SeriesOut out) {
      Formulas x(w.begin(), w.end());
      x.push_back(t0);
      out[0] = taylor_coefficient(along, k, x)[0] / Recorded(k + 1);
    }));
  }
  return terms;
}

}  // namespace pfaff
