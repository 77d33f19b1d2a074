#include <pfaff/derive/derivation/generating_coefficients.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/derive/derivation/explicit_solves.hpp>

namespace pfaff {

namespace {

using Numbers = std::vector<Recorded>;

/// A power series in tau with recorded coefficients, up to a degree that is the same for all series of one
/// expansion. Constants have one coefficient and no degree.
class RecordedSeries {
 public:
  RecordedSeries() = default;
  RecordedSeries(int value) : c_{Recorded(value)} {}  // NOLINT(google-explicit-constructor)
  explicit RecordedSeries(const Real& value) : c_{Recorded(value)} {}
  RecordedSeries(Numbers coefficients, std::size_t degree) : c_(std::move(coefficients)), degree_(degree) {}

  /// The coefficient of tau^k.
  [[nodiscard]] Recorded operator[](std::size_t k) const { return k < c_.size() ? c_[k] : Recorded(0); }

  friend RecordedSeries operator-(const RecordedSeries& a) {
    return made(a, a, [&](std::size_t l, const Numbers&) { return -a[l]; });
  }
  friend RecordedSeries operator+(const RecordedSeries& a, const RecordedSeries& b) {
    return made(a, b, [&](std::size_t l, const Numbers&) { return a[l] + b[l]; });
  }
  friend RecordedSeries operator-(const RecordedSeries& a, const RecordedSeries& b) {
    return made(a, b, [&](std::size_t l, const Numbers&) { return a[l] - b[l]; });
  }
  friend RecordedSeries operator*(const RecordedSeries& a, const RecordedSeries& b) {
    return made(a, b, [&](std::size_t l, const Numbers&) {
      Recorded sum(0);
      for (std::size_t i = 0; i <= l; ++i) sum = sum + a[i] * b[l - i];
      return sum;
    });
  }
  friend RecordedSeries operator/(const RecordedSeries& a, const RecordedSeries& b) {
    return made(a, b, [&](std::size_t l, const Numbers& q) {
      Recorded sum = a[l];
      for (std::size_t i = 1; i <= l; ++i) sum = sum - b[i] * q[l - i];
      return sum / b[0];
    });
  }
  friend RecordedSeries special(SpecialFunction which, const RecordedSeries& a, const RecordedSeries& slope) {
    return made(a, slope, [&](std::size_t l, const Numbers& /*before*/) {
      if (l == 0) return special(which, a[0], slope[0]);
      Recorded sum(0);
      for (std::size_t i = 1; i <= l; ++i) sum = sum + weight(i, l) * a[i] * slope[l - i];
      return sum;
    });
  }
  friend RecordedSeries sqrt(const RecordedSeries& a) {
    return made(a, a, [&](std::size_t l, const Numbers& r) {
      if (l == 0) return sqrt(a[0]);
      Recorded sum = a[l];
      for (std::size_t i = 1; i < l; ++i) sum = sum - r[i] * r[l - i];
      return sum / (Recorded(2) * r[0]);
    });
  }
  friend RecordedSeries exp(const RecordedSeries& a) {
    return made(a, a, [&](std::size_t l, const Numbers& e) { return l == 0 ? exp(a[0]) : along(a, e, l); });
  }
  friend RecordedSeries log(const RecordedSeries& a) {
    return made(a, a, [&](std::size_t l, const Numbers& g) {
      if (l == 0) return log(a[0]);
      Recorded sum(0);
      for (std::size_t i = 1; i < l; ++i) sum = sum + weight(i, l) * g[i] * a[l - i];
      return (a[l] - sum) / a[0];
    });
  }
  friend RecordedSeries sin(const RecordedSeries& a) { return circular(a).first; }
  friend RecordedSeries cos(const RecordedSeries& a) { return circular(a).second; }
  friend RecordedSeries pow(const RecordedSeries& a, const Real& y) {
    return made(a, a, [&](std::size_t l, const Numbers&) { return power_coefficient(a, y, l); });
  }
  /// The branch that is taken at tau = 0.
  friend RecordedSeries select(const RecordedSeries& condition, const RecordedSeries& positive,
                               const RecordedSeries& otherwise) {
    return made(positive, otherwise, [&](std::size_t l, const Numbers&) {
      return select(condition[0], positive[l], otherwise[l]);
    });
  }

 private:
  // Coefficient l of a^y, from those of a^(y - 1), without a division by a_0, which may be 0.
  static Recorded power_coefficient(const RecordedSeries& a, const Real& y, std::size_t l) {
    if (l == 0) return pow(a[0], y);
    Recorded sum(0);
    for (std::size_t i = 1; i <= l; ++i)
      sum = sum + y * weight(i, l) * a[i] * power_coefficient(a, y - Real(1), l - i);
    return sum;
  }
  // The series whose coefficient l is rule(l, those before it).
  template <class Rule>
  static RecordedSeries made(const RecordedSeries& a, const RecordedSeries& b, Rule&& rule) {
    RecordedSeries result;
    result.degree_ = std::max(a.degree_, b.degree_);
    for (std::size_t l = 0; l <= result.degree_; ++l) {
      const Recorded next = rule(l, result.c_);
      result.c_.push_back(next);
    }
    return result;
  }
  static Recorded weight(std::size_t i, std::size_t l) {
    return Recorded(Real::fraction(static_cast<std::int64_t>(i), static_cast<std::int64_t>(l)));
  }
  // (1/l) sum_i i a_i e_(l-i), coefficient l of the integral of a' e.
  static Recorded along(const RecordedSeries& a, const Numbers& e, std::size_t l) {
    Recorded sum(0);
    for (std::size_t i = 1; i <= l; ++i) sum = sum + weight(i, l) * a[i] * e[l - i];
    return sum;
  }
  static std::pair<RecordedSeries, RecordedSeries> circular(const RecordedSeries& a) {
    Numbers sine{sin(a[0])}, cosine{cos(a[0])};
    for (std::size_t l = 1; l <= a.degree_; ++l) {
      const Recorded s = along(a, cosine, l), c = -along(a, sine, l);
      sine.push_back(s);
      cosine.push_back(c);
    }
    return {RecordedSeries(std::move(sine), a.degree_), RecordedSeries(std::move(cosine), a.degree_)};
  }

  Numbers c_;
  std::size_t degree_ = 0;
};

}  // namespace

/// There are none: linear systems have been written out.
template <>
class TapeSolver<RecordedSeries> {
 public:
  explicit TapeSolver(int /*size*/) {}
  void operator()(const LinearSystem& /*system*/, std::vector<RecordedSeries>& /*slots*/,
                  std::size_t /*first*/) const {
    throw std::logic_error("a linear system in a series of recorded numbers");
  }
};

namespace {

// (-phi_p, phi_q) of a gradient.
Numbers turned(const Numbers& slope) {
  const std::size_t half = slope.size() / 2;
  Numbers result;
  for (std::size_t k = 0; k < half; ++k) result.push_back(-slope[half + k]);
  for (std::size_t k = 0; k < half; ++k) result.push_back(slope[k]);
  return result;
}

// phi^(k+1) from phi^(1), .., phi^(k).
Tape next_coefficient(const std::shared_ptr<const Tape>& hamiltonian, const std::vector<Tape>& before) {
  const std::size_t k = before.size();
  return record(hamiltonian->inputs, 1, [&](const Recorded& t0, In<Recorded> w, Out<Recorded> out) {
    std::vector<Numbers> levels{Numbers(w.begin(), w.end())};
    for (const Tape& phi : before) levels.push_back(turned(gradient(phi, t0, w, Numbers{Recorded(1)})));
    std::vector<RecordedSeries> z;
    for (std::size_t i = 0; i < w.size(); ++i) {
      Numbers coefficients;
      for (std::size_t l = 0; l <= k; ++l)
        coefficients.push_back(l == 0 ? levels[0][i] : levels[l][i] / Recorded(2));
      z.emplace_back(std::move(coefficients), k);
    }
    RecordedSeries energy;
    Replay<RecordedSeries> replay(hamiltonian);
    replay(RecordedSeries({t0, Recorded(1)}, k), z.data(), &energy);
    out[0] = -energy[k] / Recorded(static_cast<int>(k) + 1);
  });
}

}  // namespace

bool has_chart_hamiltonian(const Model& model) {
  if (!model.facets().has(Facet::darboux_chart)) return false;
  return model.given(Formula::chart) ? model.given(Formula::chart_hamiltonian)
                                     : model.canonical() && model.facets().has(Facet::hamiltonian);
}

void expand_generating_function(const Model& model, int degree, Equations& equations) {
  if (degree < 1 || degree > largest_derived_degree)
    throw InputError("method generating-function: order: expected 1 .. " +
                     std::to_string(largest_derived_degree) + ", got " + std::to_string(degree));
  const bool own = !model.given(Formula::chart);
  const auto hamiltonian = std::make_shared<const Tape>(explicit_solves(
      *model.tape(own ? Formula::hamiltonian : Formula::chart_hamiltonian), "system " + model.name()));
  if (!own) {
    equations.coordinates.clear();
    for (int k = 1; k <= model.dimension(); ++k)
      equations.coordinates.push_back({"y" + std::to_string(k), ""});
  }
  std::vector<Tape> terms;
  for (int k = 1; k <= degree; ++k) {
    terms.push_back(next_coefficient(hamiltonian, terms));
    equations.further_outputs.push_back("phi" + std::to_string(k));
  }
  equations.tape = record(hamiltonian->inputs, hamiltonian->inputs + degree,
                          [&](const Recorded& t0, In<Recorded> w, Out<Recorded> out) {
                            const Numbers slope =
                                turned(gradient(*hamiltonian, t0, w, Numbers{Recorded(-1)}));
                            std::copy(slope.begin(), slope.end(), out.begin());
                            for (std::size_t k = 0; k < terms.size(); ++k)
                              out[w.size() + k] = evaluate(terms[k], t0, w)[0];
                          });
}

}  // namespace pfaff
