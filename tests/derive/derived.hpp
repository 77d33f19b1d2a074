// What the tests of derived equations share: replays of tapes in exact rationals, and equations of motion of
// beads on rods written out by hand with dense algebra.
#pragma once

#include <stdexcept>
#include <vector>

#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/derive/derivation/derivation.hpp>
#include <pfaff/papers/printed/dense.hpp>
#include <pfaff/systems/bead_rod/description.hpp>

namespace pfaff {

// Rationals have no such functions; a tape that is replayed exactly has none of these operations.
inline Rational no_fraction() { throw std::domain_error("no fraction"); }
inline Rational sqrt(const Rational& /*x*/) { return no_fraction(); }
inline Rational special(SpecialFunction /*which*/, const Rational& /*x*/, const Rational& /*slope*/) {
  return no_fraction();
}
inline Rational exp(const Rational& /*x*/) { return no_fraction(); }
inline Rational log(const Rational& /*x*/) { return no_fraction(); }
inline Rational sin(const Rational& /*x*/) { return no_fraction(); }
inline Rational cos(const Rational& /*x*/) { return no_fraction(); }

namespace testing {

inline std::shared_ptr<const Model> model_of(const std::string& system, const Assignments& settings) {
  return systems().get(system, "system").make(settings);
}

/// Outputs of a tape at state z, with values of the parameters after it.
template <class T>
std::vector<T> rates_of(const Equations& equations, const T& t, std::vector<T> z) {
  for (const Real& x : equations.parameter_values) z.push_back(T(x));
  std::vector<T> out(equations.tape.outputs.size());
  Replay<T> replay({std::shared_ptr<const Tape>(), &equations.tape});
  replay(t, z.data(), out.data());
  return out;
}

inline BeadRodDescription description_of(const Model& model) {
  const auto constraints = model.holonomic_constraints<double>();
  return dynamic_cast<const DescribedByRods&>(*constraints).description();
}

/// Beads on rods under gravity alone: gradients by hand, brackets by their definition.
template <class T>
class DenseRods {
 public:
  DenseRods(const BeadRodDescription& d, const std::vector<T>& z)
      : d_(d), n_(d.beads() * d.axes()), slope_(2 * n_, T(0)) {
    for (std::size_t a = 0; a < n_; ++a) {
      if (!d.gravity.empty()) slope_[a] = -(mass(a) * T(d.gravity[a % d.axes()]));
      slope_[n_ + a] = z[n_ + a] / mass(a);
    }
    for (const Rod& rod : d.rods) {
      std::vector<T> row(2 * n_, T(0)), hidden(2 * n_, T(0));
      T square(0);
      for (std::size_t x = 0; x < d.axes(); ++x) {
        const std::size_t a = rod.first * d.axes() + x, b = rod.second * d.axes() + x;
        const bool moves = rod.second < d.beads();
        const T along = z[a] - (moves ? z[b] : T(d.coordinate(rod.second, x)));
        const T turning = slope_[n_ + a] - (moves ? slope_[n_ + b] : T(0));
        square = square + turning * turning;
        row[a] = along;
        hidden[a] = turning;
        hidden[n_ + a] = along / mass(a);
        if (!moves) continue;
        row[b] = -along;
        hidden[b] = -turning;
        hidden[n_ + b] = -(along / mass(b));
      }
      rows_.push_back(row);
      hidden_.push_back(hidden);
      squares_.push_back(square);
    }
  }

  /// (1.2) with the canonical bracket, and less the symmetric one with friction.
  [[nodiscard]] std::vector<T> dirac(bool friction) const {
    printed::Table<T> all = rows_;
    all.insert(all.end(), hidden_.begin(), hidden_.end());
    std::vector<T> rate = bracket(all, [&](const std::vector<T>& f) {
      std::vector<T> x(2 * n_);
      for (std::size_t a = 0; a < n_; ++a) {
        x[a] = f[n_ + a];
        x[n_ + a] = -f[a];
      }
      return x;
    });
    if (!friction) return rate;
    const std::vector<T> rubbed = bracket(hidden_, [&](const std::vector<T>& f) {
      std::vector<T> x(2 * n_, T(0));
      for (std::size_t a = 0; a < n_; ++a) x[n_ + a] = lambda(a) * f[n_ + a];
      return x;
    });
    for (std::size_t a = 0; a < 2 * n_; ++a) rate[a] = rate[a] - rubbed[a];
    return rate;
  }

  /// (A.5): q' = v, p' = F - B^T S^-1 (G + B M^-1 F), with Stokes's drag in F where there is friction.
  [[nodiscard]] std::vector<T> multipliers(bool friction) const {
    std::vector<T> rate(2 * n_), right;
    for (std::size_t a = 0; a < n_; ++a) {
      rate[a] = slope_[n_ + a];
      rate[n_ + a] = -slope_[a] - (friction ? lambda(a) * slope_[n_ + a] : T(0));
    }
    printed::Table<T> s = printed::zero_table<T>(rows_.size(), rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      T sum = squares_[i];
      for (std::size_t a = 0; a < n_; ++a) {
        sum = sum + rows_[i][a] * rate[n_ + a] / mass(a);
        for (std::size_t j = 0; j < rows_.size(); ++j)
          s[i][j] = s[i][j] + rows_[i][a] * rows_[j][a] / mass(a);
      }
      right.push_back(sum);
    }
    const std::vector<T> x = printed::product(printed::inverse(s), right);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t a = 0; a < n_; ++a) rate[n_ + a] = rate[n_ + a] - rows_[i][a] * x[i];
    return rate;
  }

 private:
  [[nodiscard]] T mass(std::size_t a) const { return T(d_.masses[a / d_.axes()]); }
  [[nodiscard]] T lambda(std::size_t a) const { return T(d_.friction[a / d_.axes()]); }

  template <class Sharp>
  [[nodiscard]] std::vector<T> bracket(const printed::Table<T>& gradients, const Sharp& sharp) const {
    const auto dot = [](const std::vector<T>& f, const std::vector<T>& x) {
      T sum(0);
      for (std::size_t a = 0; a < f.size(); ++a) sum = sum + f[a] * x[a];
      return sum;
    };
    printed::Table<T> vectors;
    for (const auto& row : gradients) vectors.push_back(sharp(row));
    std::vector<T> rate = sharp(slope_), right;
    printed::Table<T> w = printed::zero_table<T>(gradients.size(), gradients.size());
    for (std::size_t i = 0; i < gradients.size(); ++i) {
      right.push_back(dot(gradients[i], rate));
      for (std::size_t j = 0; j < gradients.size(); ++j) w[i][j] = dot(gradients[i], vectors[j]);
    }
    const std::vector<T> c = printed::product(printed::inverse(w), right);
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t a = 0; a < rate.size(); ++a) rate[a] = rate[a] - vectors[i][a] * c[i];
    return rate;
  }

  const BeadRodDescription& d_;
  std::size_t n_;
  std::vector<T> slope_;  // dH
  printed::Table<T> rows_, hidden_;
  std::vector<T> squares_;  // |V|^2
};

}  // namespace testing
}  // namespace pfaff
