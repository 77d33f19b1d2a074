// The Dirac bracket as a ratio of determinants (nguyen-turski (3.6), (3.7)), and of Pfaffians for skew
// brackets, which gives the sign that (3.18), an equation of squares, loses:
//   eta_D(f, g) = det [[W, eta(phi, g)], [eta(f, phi), eta(f, g)]] / det W,
//   {f, g}_D = Pf W(phi_1 .. phi_K, f, g) / Pf W(phi_1 .. phi_K),   Pf [[0, a], [-a, 0]] = a.
// They are references for the other solvers and cost one determinant for each coordinate, O(n K^3).
//
// Determinants and Pfaffians are polynomials in their entries. Where formulas are recorded they are computed
// without divisions and without pivots (Berkowitz's method; the expansion of the Pfaffian over pairings, for
// at most 12 constraints), so that the recorded formula holds wherever W is regular.
#pragma once

#include <cstdint>

#include <pfaff/brackets/dirac/dirac_data.hpp>

namespace pfaff {

/// det A without divisions (Berkowitz 1984): O(n^4), for any commutative ring.
template <class T>
T berkowitz_determinant(const Matrix<T>& a) {
  const std::size_t n = a.rows();
  std::vector<T> polynomial{T(1)};  // of the trailing principal block, highest power first
  for (std::size_t k = n; k-- > 0;) {
    const std::size_t size = n - k;  // the block from k on
    // Toeplitz column: 1, -a_kk, -R C, -R M C, -R M^2 C, ...
    std::vector<T> column{T(1), -a(k, k)};
    std::vector<T> power(size - 1);
    for (std::size_t i = 0; i + 1 < size; ++i) power[i] = a(k + 1 + i, k);
    for (std::size_t m = 1; m < size; ++m) {
      T sum(0);
      for (std::size_t i = 0; i + 1 < size; ++i) sum = sum + a(k, k + 1 + i) * power[i];
      column.push_back(-sum);
      std::vector<T> next(size - 1);
      for (std::size_t i = 0; i + 1 < size; ++i)
        for (std::size_t j = 0; j + 1 < size; ++j) next[i] = next[i] + a(k + 1 + i, k + 1 + j) * power[j];
      power = std::move(next);
    }
    std::vector<T> product(polynomial.size() + 1, T(0));
    for (std::size_t i = 0; i < product.size(); ++i)
      for (std::size_t j = 0; j <= i && j < polynomial.size(); ++j)
        product[i] = product[i] + column[i - j] * polynomial[j];
    polynomial = std::move(product);
  }
  return n % 2 == 0 ? polynomial.back() : -polynomial.back();
}

/// The determinant by whichever method the scalar allows.
template <class T>
T determinant_of(const Matrix<T>& a) {
  if constexpr (detail::has_numbers<T>) {
    return determinant(a);
  } else {
    return berkowitz_determinant(a);
  }
}

/// Pf A by expansion over pairings, each sub-Pfaffian once: 2^n terms, n <= 14.
template <class T>
T pfaffian_by_expansion(const Matrix<T>& a) {
  const std::size_t n = a.rows();
  std::vector<T> known(std::size_t{1} << n);
  std::vector<char> done(known.size(), 0);
  known[0] = T(1);
  done[0] = 1;
  const auto value = [&](const auto& self, std::uint32_t members) -> T {
    if (done[members] != 0) return known[members];
    std::size_t first = 0;
    while ((members >> first & 1U) == 0) ++first;
    T sum(0);
    bool positive = true;
    for (std::size_t j = first + 1; j < n; ++j) {
      if ((members >> j & 1U) == 0) continue;
      if (!structurally_zero(a(first, j))) {
        const T term = a(first, j) * self(self, members & ~(1U << first) & ~(1U << j));
        sum = positive ? sum + term : sum - term;
      }
      positive = !positive;
    }
    done[members] = 1;
    return known[members] = sum;
  };
  return n % 2 != 0 ? T(0) : value(value, static_cast<std::uint32_t>((std::size_t{1} << n) - 1));
}

/// Pf A by skew elimination with the largest partner as pivot; exact where the scalar is.
template <class T>
T pfaffian_by_elimination(Matrix<T> a) {
  const std::size_t n = a.rows();
  if (n % 2 != 0) return T(0);
  T product(1);
  for (std::size_t k = 0; k < n; k += 2) {
    std::size_t partner = k + 1;
    for (std::size_t j = k + 2; j < n; ++j)
      if (abs(value_of(a(k, j))) > abs(value_of(a(k, partner)))) partner = j;
    if (abs(value_of(a(k, partner))) == Value<T>(0)) return T(0);
    if (partner != k + 1) {
      for (std::size_t j = 0; j < n; ++j) std::swap(a(k + 1, j), a(partner, j));
      for (std::size_t i = 0; i < n; ++i) std::swap(a(i, k + 1), a(i, partner));
      product = -product;
    }
    const T pivot = a(k, k + 1);
    product = product * pivot;
    for (std::size_t i = k + 2; i < n; ++i)
      for (std::size_t j = k + 2; j < n; ++j)
        a(i, j) = a(i, j) - (a(i, k + 1) * a(k, j) - a(i, k) * a(k + 1, j)) / pivot;
  }
  return product;
}

/// The Pfaffian by whichever method the scalar allows.
template <class T>
T pfaffian(const Matrix<T>& a) {
  if constexpr (detail::has_numbers<T>) {
    return pfaffian_by_elimination(a);
  } else {
    return pfaffian_by_expansion(a);
  }
}

/// (3.6): every bracket.
struct BorderedDirac {
  static constexpr const char* name = "bordered-determinant";
  static constexpr bool wants_tensor = false;
  [[nodiscard]] bool applies(const DiracData<double>& /*data*/) const { return true; }

  template <class T>
  struct Work {
    Work(const BorderedDirac& /*solver*/, std::size_t /*dimension*/, std::size_t /*count*/) {}
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& /*work*/) const {
    const std::size_t count = data.count, n = data.dimension;
    const T denominator = determinant_of(Matrix<T>(count, data.gram));
    if (!detail::usable_pivot(denominator)) return Status::singular;
    Matrix<T> bordered(count + 1, count + 1);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) bordered(i, j) = data.gram[i * count + j];
      bordered(i, count) = data.brackets[i];
    }
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t j = 0; j < count; ++j) bordered(count, j) = data.sharps[j * n + a];
      bordered(count, count) = data.vector[a];
      result[a] = determinant_of(bordered) / denominator;
    }
    return Status::converged;
  }
};

/// The ratio of Pfaffians: skew brackets.
struct PfaffianDirac {
  static constexpr const char* name = "pfaffian";
  static constexpr bool wants_tensor = false;
  [[nodiscard]] bool applies(const DiracData<double>& data) const {
    return data.symmetry == Symmetry::skew && data.count % 2 == 0;
  }

  template <class T>
  struct Work {
    Work(const PfaffianDirac& /*solver*/, std::size_t /*dimension*/, std::size_t /*count*/) {}
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& /*work*/) const {
    const std::size_t count = data.count, n = data.dimension;
    const T denominator = pfaffian(Matrix<T>(count, data.gram));
    if (!detail::usable_pivot(denominator)) return Status::singular;
    Matrix<T> bordered(count + 2, count + 2);  // phi_1 .. phi_K, z_a, alpha
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) bordered(i, j) = data.gram[i * count + j];
      bordered(i, count + 1) = data.brackets[i];
      bordered(count + 1, i) = -data.brackets[i];
    }
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t j = 0; j < count; ++j) {
        bordered(count, j) = data.sharps[j * n + a];
        bordered(j, count) = -data.sharps[j * n + a];
      }
      bordered(count, count + 1) = data.vector[a];
      bordered(count + 1, count) = -data.vector[a];
      result[a] = pfaffian(bordered) / denominator;
    }
    return Status::converged;
  }
};

}  // namespace pfaff
