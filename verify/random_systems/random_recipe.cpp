// Draws recipes. Numbers come from the generator's own bits, since the distributions of the standard library
// differ between libraries.
#include <algorithm>
#include <random>

#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

namespace {

class Drawing {
 public:
  Drawing(SystemKind kind, std::uint64_t seed, int size)
      : random_(1000003U * seed + 101U * static_cast<std::uint64_t>(kind) + static_cast<std::uint64_t>(size)),
        size_(size) {
    recipe_.kind = kind;
  }

  Recipe draw() {
    switch (recipe_.kind) {
      case SystemKind::separable:
      case SystemKind::driven:
      case SystemKind::damped:
      case SystemKind::breathing:
        energies(degrees());
        break;
      case SystemKind::nonseparable:
        dimension(2 * degrees());
        recipe_.parts = {{oscillator(recipe_.dimension) + terms(recipe_.dimension, 2, 4, 2 + size_)}};
        break;
      case SystemKind::central:
        dimension(4);
        recipe_.parts = {{linear(1) + more_terms(1, 2)}, {linear(1) + more_terms(1, 3)}};
        break;
      case SystemKind::central_nonseparable:
        dimension(4);
        recipe_.parts = {{linear(2, 3) + terms(3, 1, 2, 1 + size_)}};
        break;
      case SystemKind::scaled_form:
      case SystemKind::sheared_form:
        action_form();
        break;
      case SystemKind::casimir_bracket:
      case SystemKind::metriplectic:
        dimension(3);
        recipe_.parts = {{squares(3)}, {squares(3)}};
        if (size_ > 0)
          for (auto& part : recipe_.parts) part[0] = part[0] + terms(3, 2, 3, size_);
        break;
      case SystemKind::concave_metriplectic:
        dimension(3);
        recipe_.parts = {{squares(3) + quartic(3)}, {squares(3) + more_terms(3, 3)}};
        break;
      case SystemKind::field:
      case SystemKind::skew_field:
        fields();
        break;
      case SystemKind::rods:
        rods();
        break;
      case SystemKind::transcendental:
        transcendental();
        break;
      default:
        constraints();
    }
    recipe_.rate = pick({Real::fraction(1, 5), Real::fraction(1, 2), 1});
    // What a method does to an entropy by itself shows beside a weak relaxation, which produces little.
    if ((recipe_.kind == SystemKind::metriplectic && below(2) == 0) ||
        recipe_.kind == SystemKind::concave_metriplectic)
      recipe_.rate = Real::fraction(1, 1000000000000);
    return recipe_;
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }
  Real pick(std::initializer_list<Real> values) { return *(values.begin() + below(values.size())); }
  Real coefficient() {
    const Real size = pick({1, 1, Real::fraction(1, 2), Real::fraction(1, 3), Real::fraction(2, 3),
                            Real::fraction(1, 4), Real::fraction(3, 4)});
    return below(2) == 0 ? size : -size;
  }
  std::size_t degrees() { return size_ == 0 ? 1 : 1 + below(2); }
  // A state with every component between 1/10 and 9/10 in size.
  void dimension(std::size_t n) {
    recipe_.dimension = n;
    for (std::size_t k = 0; k < n; ++k) {
      const Real x = Real::fraction(static_cast<std::int64_t>(1 + below(9)), 10);
      recipe_.state.push_back(below(3) == 0 ? -x : x);
    }
  }

  Powers powers_of(std::size_t variables, std::size_t low, std::size_t high) {
    Powers powers(variables + 1);
    for (std::size_t k = low + below(high - low + 1); k > 0; --k) ++powers[below(variables)];
    return powers;
  }
  // So many terms of degrees low ... high; with small coefficients where there are many.
  SparsePolynomial terms(std::size_t variables, std::size_t low, std::size_t high, int count) {
    SparsePolynomial sum(variables);
    for (int k = 0; k < count; ++k) {
      const Powers powers = powers_of(variables, low, high);
      sum.add(powers, coefficient() / Real(count > 2 ? 3 : 1));
    }
    return sum;
  }
  // The same with one term whose coefficient is c (t + t^2/4): a rule for its mean over a step that is wrong,
  // but right where it is linear, shows.
  SparsePolynomial driven(SparsePolynomial p, std::size_t low, std::size_t high) {
    Powers powers = powers_of(p.variables(), low, high);
    powers.back() = 1;
    const Real c = coefficient();
    p.add(powers, c);
    powers.back() = 2;
    p.add(powers, c / Real(4));
    return p;
  }
  // Terms of degrees 2 ... high beside the leading ones; none in the smallest size.
  SparsePolynomial more_terms(std::size_t variables, std::size_t high) {
    return size_ == 0 ? SparsePolynomial(variables) : terms(variables, 2, high, size_);
  }
  // The sum of the first `count` of so many variables.
  static SparsePolynomial linear(std::size_t count, std::size_t variables = 0) {
    SparsePolynomial sum(std::max(count, variables));
    for (std::size_t k = 0; k < count; ++k) sum = sum + SparsePolynomial::variable(sum.variables(), k);
    return sum;
  }
  static SparsePolynomial oscillator(std::size_t variables) {
    return detail::half_square(variables, 0, variables);
  }
  // A fourth power, which is convex, and which methods that keep squares do not keep.
  SparsePolynomial quartic(std::size_t variables) {
    SparsePolynomial power(variables);
    Powers powers(variables + 1);
    powers[below(variables)] = 4;
    power.add(powers, Real::fraction(1, 4));
    return power;
  }
  // Half squares with unequal positive coefficients.
  SparsePolynomial squares(std::size_t variables) {
    SparsePolynomial sum(variables);
    for (std::size_t k = 0; k < variables; ++k) {
      Powers powers(variables + 1);
      powers[k] = 2;
      sum.add(powers, Real::fraction(static_cast<std::int64_t>(1 + below(5)), 4));
    }
    return sum;
  }

  // A mass matrix that couples where there are two momenta, and powers of momenta beyond the second. Of half
  // of the systems with friction, drawn by chance, the forces depend on time.
  void energies(std::size_t d) {
    dimension(2 * d);
    SparsePolynomial kinetic = squares(d), potential = terms(d, 2, 4, 2 + size_);
    if (d > 1 && below(2) == 0) kinetic.add({1, 1, 0}, Real::fraction(1, 3));
    if (size_ > 0 && below(2) == 0) kinetic = kinetic + Real::fraction(1, 4) * terms(d, 3, 4, 1);
    const bool breathing = recipe_.kind == SystemKind::breathing;
    if (breathing) kinetic = driven(kinetic, 2, 3);
    const bool damped_and_driven = recipe_.kind == SystemKind::damped && below(2) == 0;
    if (breathing || damped_and_driven || recipe_.kind == SystemKind::driven)
      potential = driven(potential, 1, 3);
    recipe_.parts = {{kinetic}, {potential}};
  }
  // One function of a momentum and, with the size, more of positions, each in a term of its own beside those
  // that are drawn.
  void transcendental() {
    const std::size_t d = degrees();
    dimension(2 * d);
    for (const std::size_t count : {std::size_t{1}, static_cast<std::size_t>(1 + size_)}) {
      std::vector<AppliedFunction>& applied = recipe_.applied.emplace_back();
      SparsePolynomial sum(d + count);
      for (std::size_t k = 0; k < count; ++k) {
        applied.push_back({all_functions[below(all_functions.size())], below(d)});
        sum = sum + coefficient() * SparsePolynomial::variable(d + count, d + k);
      }
      if (recipe_.parts.empty()) {
        sum = Real::fraction(1, 2) * sum;
        for (std::size_t k = 0; k < d; ++k) sum = sum + detail::half_square(d + count, k, 1);
      } else {
        sum = sum + terms(d + count, 2, 3, 1 + size_);
      }
      recipe_.parts.push_back({sum});
    }
  }
  // Half of the forms, drawn by chance, depend on time.
  void action_form() {
    const std::size_t d = recipe_.kind == SystemKind::scaled_form ? 1 : 2, n = 2 * d;
    dimension(n);
    const bool moving = below(2) == 0;
    SparsePolynomial energy = oscillator(n) + Real::fraction(1, 2) * terms(n, 3, 3, 1 + size_);
    if (moving) energy = driven(energy, 1, 2);
    const SparsePolynomial gauge = size_ == 0 ? SparsePolynomial(n) : terms(n, 2, 3, size_);
    recipe_.parts = {{energy}, {gauge}, {}, {}};
    if (d == 1) {
      SparsePolynomial scale(1);
      scale.add({2, moving ? 1 : 0}, Real::fraction(1, 2));
      recipe_.parts[2] = {scale};
      recipe_.parts[3] = {size_ == 0 ? SparsePolynomial(1) : terms(1, 2, 3, 1)};
      return;
    }
    for (std::size_t i = 0; i < d; ++i) {
      const SparsePolynomial shear = Real::fraction(1, 2) * terms(d, 2, 2, 1);
      recipe_.parts[2].push_back(moving && i == 0 ? driven(shear, 2, 2) : shear);
      recipe_.parts[3].push_back(size_ == 0 ? SparsePolynomial(d) : Real::fraction(1, 2) * terms(d, 2, 2, 1));
    }
  }
  void fields() {
    const bool skew = recipe_.kind == SystemKind::skew_field;
    const std::size_t n = (skew ? 2 : 1) + (size_ == 0 ? 0 : below(3));
    dimension(n);
    recipe_.parts = {{}};
    for (std::size_t k = 0; k < (skew ? n * (n - 1) / 2 : n); ++k)
      recipe_.parts[0].push_back(skew ? SparsePolynomial::constant(n, 1) + terms(n, 1, 2, 1)
                                      : terms(n, 0, 3, 2 + size_));
  }
  // A tree of beads, whose first one is tied to the origin in half of the draws, and one rod more in half of
  // those with three beads, which are then a triangle. The beads start on a spiral.
  void rods() {
    const std::size_t beads = 2 + (size_ == 0 ? 0 : below(2));
    dimension(4 * beads);
    for (std::size_t k = 0; k < beads; ++k) {
      recipe_.state[2 * k] = Real(static_cast<int>(k + 1));
      recipe_.state[2 * k + 1] = Real(static_cast<int>((k * k) % 3));
      const Real mass = pick({1, 2, Real::fraction(1, 2)});
      recipe_.masses.insert(recipe_.masses.end(), 2, mass);
      if (k > 0) recipe_.rods.emplace_back(k, below(k));
    }
    if (beads == 3 && below(2) == 0) recipe_.rods = {{1, 0}, {2, 0}, {2, 1}};
    if (below(2) == 0) recipe_.rods.emplace_back(0, beads);
    recipe_.parts = {{linear(1) + Real::fraction(1, 10) * terms(1, 2, 2, 1)}};
  }
  void constraints() {
    if (recipe_.kind == SystemKind::second_class) {
      dimension(size_ == 0 ? 4 : 6);
      const std::size_t n = recipe_.dimension;
      recipe_.parts = {{oscillator(n) + terms(n, 3, 3, 1 + size_)}};
      for (int k = 0; k < 2; ++k) recipe_.parts.push_back({without_last_pair(n)});
      return;
    }
    const bool surfaces =
        recipe_.kind == SystemKind::surface || recipe_.kind == SystemKind::breathing_surface;
    const std::size_t d = surfaces && size_ == 0 ? 2 : 3;
    dimension(2 * d);
    for (std::size_t k = 0; k < d; ++k) recipe_.masses.push_back(pick({1, 2, Real::fraction(1, 2)}));
    if (surfaces) {
      recipe_.parts = {{terms(d, 1, 3, 2)}, {squares(d)}};
      SparsePolynomial& surface = recipe_.parts[1][0];
      surface = surface + Real::fraction(1, 3) * terms(d, 3, 3, 1 + size_);
      if (size_ > 1)
        recipe_.parts[1].push_back(SparsePolynomial::variable(d, d - 1) +
                                   Real::fraction(1, 4) * terms(d, 2, 2, 1));
    } else if (recipe_.kind == SystemKind::revolution) {
      recipe_.masses[1] = recipe_.masses[0];
      recipe_.parts = {{terms(2, 1, 2, 2)}, {linear(1, 2) + detail::half_square(2, 1, 1) + more_terms(2, 2)}};
    } else {
      recipe_.parts = {{terms(d, 1, 2, 2)}, {}};
      for (std::size_t k = 0; k < d; ++k)
        recipe_.parts[1].push_back(SparsePolynomial::constant(d, k == 0 ? 1 : 0) + terms(d, 1, 2, 1));
    }
  }
  // A polynomial of degrees 1 and 2 that contains neither the last position nor the last momentum.
  SparsePolynomial without_last_pair(std::size_t n) {
    SparsePolynomial sum(n);
    for (int k = 0; k < 1 + size_; ++k) {
      Powers powers(n + 1);
      for (std::size_t degree = 1 + below(2); degree > 0; --degree) {
        const std::size_t index = below(n / 2 - 1);
        ++powers[index + (below(2) == 0 ? 0 : n / 2)];
      }
      sum.add(powers, Real::fraction(1, 2) * coefficient());
    }
    return sum;
  }

  std::mt19937_64 random_;
  int size_;
  Recipe recipe_;
};

}  // namespace

Recipe random_recipe(SystemKind kind, std::uint64_t seed, int size) {
  return Drawing(kind, seed, size).draw();
}

}  // namespace pfaff
