// Random formulas that can be written with any scalar: the same seed gives the same formula.
#pragma once

#include <random>
#include <span>
#include <vector>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff::testing {

/// A x = b by elimination without pivots, for diagonally dominant A; recorded as one solve.
template <class T>
std::vector<T> solved(std::vector<T> a, std::vector<T> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) {
      const T factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
      b[i] = b[i] - factor * b[k];
    }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) b[i] = b[i] - a[i * n + j] * b[j];
    b[i] = b[i] / a[i * n + i];
  }
  return b;
}
inline std::vector<Recorded> solved(const std::vector<Recorded>& a, const std::vector<Recorded>& b) {
  return solve(a, b);
}

/// A formula of every operation a tape has, finite and smooth everywhere but on the switching surfaces of its
/// selects. Its intermediate values stay of order one.
struct RandomFormula {
  unsigned seed;
  int inputs, outputs, operations;
  bool special = false;  // with special functions among the operations

  template <class T>
  void operator()(const T& t, In<T> z, Out<T> out) const {
    std::mt19937 random(seed);
    std::vector<T> x(z.begin(), z.end());
    x.push_back(t);
    x.push_back(T(Real::fraction(3, 7)));
    // Operands are drawn one statement at a time: calls within one expression have no order.
    const auto any = [&] { return x[random() % x.size()]; };
    for (int k = 0; k < operations; ++k) {
      const auto operation = random() % (special ? 16 : 14);
      const T a = any(), b = any(), c = any(), d = any(), one(1);
      switch (operation) {
        case 0:
          x.push_back(sin(a + b));
          break;
        case 1:
          x.push_back(cos(a) - b / 2);
          break;
        case 2:
          x.push_back(sin(a) * sin(b));
          break;
        case 3:
          x.push_back(sin(a) / (2 + cos(b)));
          break;
        case 4:
          x.push_back(sqrt(1 + a * a) - 1);
          break;
        case 5:
          x.push_back(exp(sin(a) - one));
          break;
        case 6:
          x.push_back(log(1 + a * a));
          break;
        case 7:
          x.push_back(pow(1 + sin(a) * sin(a), -1.7_r));
          break;
        case 8:
          x.push_back(pow(cos(a), Real(3)));
          break;
        case 9:
          x.push_back(pow(1 + cos(a) * cos(a), Real::fraction(-3, 2)));
          break;
        case 14:
          x.push_back(atan(2 * a - b));
          break;
        case 15:
          x.push_back(erf(a) * tanh(b));
          break;
        case 10:
          x.push_back(select(sin(3 * a), sin(b), -cos(c)));
          break;
        case 11:
          x.push_back(-a / 3 + 0.25_r * sin(b));
          break;
        case 12: {
          const auto s = solved(std::vector<T>{3 + sin(a), cos(c), cos(b), 3 - sin(b)}, {sin(d), cos(a)});
          x.push_back(s[0]);
          x.push_back(s[1]);
          break;
        }
        default: {
          const std::vector<T> matrix{5 + sin(a), sin(c), T(1), sin(d), T(4), T(0), cos(a), cos(b), T(3)};
          const auto s = solved(matrix, std::vector<T>{T(0), a, b});
          x.push_back(sin(s[0] + s[1]) - s[2] / 3);
          break;
        }
      }
    }
    for (std::size_t k = 0; k < out.size(); ++k) {
      const T a = any(), b = any();
      out[k] = x[x.size() - 1 - k] * sin(a) + cos(b);
    }
  }

  [[nodiscard]] Tape tape() const { return record(inputs, outputs, *this); }
};

}  // namespace pfaff::testing
