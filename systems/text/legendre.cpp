#include <pfaff/systems/text/legendre.hpp>

#include <algorithm>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::text {

namespace {
using Values = std::vector<Recorded>;

// (q, 0): the positions of a tape's arguments, with no velocity.
Values at_rest(In<Recorded> q) {
  Values point(q.begin(), q.end());
  point.resize(2 * q.size());
  return point;
}

bool reads_input_from(const Tape& tape, int first) {
  return std::any_of(tape.code.begin(), tape.code.end(),
                     [&](const Instruction& i) { return i.operation == Operation::input && i.a >= first; });
}

bool is_constant(const Tape& tape) {
  return std::all_of(tape.outputs.begin(), tape.outputs.end(),
                     [&](int slot) { return slot < tape.time_begin; });
}

// The rank of M by elimination with complete pivoting; pivots below round-off of the largest count as zero.
std::size_t rank_of(std::vector<Quad> m, std::size_t n) {
  constexpr double round_off = 1e-28;
  Quad largest(0);
  for (const Quad& x : m) largest = std::max(largest, abs(x));
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t row = k, column = k;
    for (std::size_t i = k; i < n; ++i)
      for (std::size_t j = k; j < n; ++j)
        if (abs(m[i * n + j]) > abs(m[row * n + column])) row = i, column = j;
    if (!(abs(m[row * n + column]) > Quad(round_off) * largest)) return k;
    for (std::size_t j = 0; j < n; ++j) std::swap(m[k * n + j], m[row * n + j]);
    for (std::size_t i = 0; i < n; ++i) std::swap(m[i * n + k], m[i * n + column]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Quad factor = m[i * n + k] / m[k * n + k];
      for (std::size_t j = k; j < n; ++j) m[i * n + j] = m[i * n + j] - factor * m[k * n + j];
    }
  }
  return n;
}

// M^-1 w for a matrix of constants, by its inverse, which is made exactly where the matrix is of fractions.
Values solved_exactly(const Values& matrix, const Values& w) {
  const std::size_t n = w.size();
  Values x(n, Recorded(0));
  for (std::size_t j = 0; j < n; ++j) {
    Values unit(n, Recorded(0));
    unit[j] = Recorded(1);
    const Values column = solve(matrix, unit);
    for (std::size_t i = 0; i < n; ++i) x[i] = x[i] + column[i] * w[j];
  }
  return x;
}
}  // namespace

LegendreTransform legendre_transform(const Tape& lagrangian, const std::vector<Real>& q) {
  const int both = lagrangian.inputs, degrees = both / 2;
  const auto m = static_cast<std::size_t>(degrees);
  const Values one{Recorded(1)};
  const Tape momentum = record(both, degrees, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
    const Values slope = gradient(lagrangian, t, x, one);
    std::copy(slope.begin() + degrees, slope.end(), out.begin());
  });
  const Tape mass =
      record(both, degrees * degrees, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
        const Values slope = jacobian(momentum, t, x);
        for (std::size_t i = 0; i < m; ++i)
          for (std::size_t j = 0; j < m; ++j) out[i * m + j] = slope[i * 2 * m + m + j];
      });

  LegendreTransform result;
  const auto ranked = [&] {
    std::vector<Quad> point(2 * m), matrix(m * m);
    for (std::size_t k = 0; k < m; ++k) point[k] = q[k].quad();
    Replay<Quad> replay(std::make_shared<const Tape>(mass));
    replay(Quad(0), point.data(), matrix.data());
    return rank_of(matrix, m);
  };
  const std::size_t rank = ranked();
  const std::string said = "its Hessian in the velocities, d2L/dv2, has rank " + std::to_string(rank) +
                           " of " + std::to_string(m) + " in the initial positions";
  if (rank < m) {
    result.refused = said + "; expected one from which the velocities can be solved for";
    return result;
  }
  if (reads_input_from(mass, degrees)) {
    result.refused = said + " and depends on the velocities; expected a lagrangian that is quadratic in them";
    return result;
  }

  // M and b at positions q, and p -> v.
  const auto velocity_of = [&](const Recorded& t, const Values& rest, In<Recorded> p) {
    const Values matrix = evaluate(mass, t, rest), offset = evaluate(momentum, t, rest);
    Values w(m);
    for (std::size_t k = 0; k < m; ++k) w[k] = p[k] - offset[k];
    const bool constant =
        std::all_of(matrix.begin(), matrix.end(), [](const Recorded& x) { return x.is_constant(); });
    return std::pair(constant ? solved_exactly(matrix, w) : solve(matrix, w), w);
  };
  const auto half_product = [&](const Values& a, const Values& b) {
    Recorded sum(0);
    for (std::size_t k = 0; k < m; ++k) sum = sum + a[k] * b[k];
    return sum / Recorded(2);
  };
  const auto potential = [&](const Recorded& t, const Values& rest) {
    return -evaluate(lagrangian, t, rest)[0];
  };
  const Tape drift = record(degrees, degrees, [&](const Recorded& t, In<Recorded> at, Out<Recorded> out) {
    const Values offset = evaluate(momentum, t, at_rest(at));
    std::copy(offset.begin(), offset.end(), out.begin());
  });
  const bool no_drift =
      is_constant(drift) && std::all_of(drift.outputs.begin(), drift.outputs.end(), [&](int slot) {
        return drift.constants[static_cast<std::size_t>(drift.code[static_cast<std::size_t>(slot)].a)].is(0);
      });
  if (no_drift && is_constant(mass)) {
    result.kinetic = std::make_shared<const Tape>(
        record(degrees, 1, [&](const Recorded& t, In<Recorded> p, Out<Recorded> out) {
          const auto solved = velocity_of(t, Values(2 * m), p);
          out[0] = half_product(solved.second, solved.first);
        }));
    result.potential = std::make_shared<const Tape>(record(
        degrees, 1,
        [&](const Recorded& t, In<Recorded> at, Out<Recorded> out) { out[0] = potential(t, at_rest(at)); }));
  } else {
    result.hamiltonian = std::make_shared<const Tape>(
        record(both, 1, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
          const Values rest = at_rest(x.first(m));
          const auto solved = velocity_of(t, rest, x.subspan(m));
          out[0] = half_product(solved.second, solved.first) + potential(t, rest);
        }));
  }
  return result;
}

std::vector<Real> momenta_of_lagrangian(const Tape& lagrangian, const std::vector<Real>& q,
                                        const std::vector<Real>& v) {
  Values point;
  for (const Real& x : q) point.emplace_back(x);
  for (const Real& x : v) point.emplace_back(x);
  const Values slope = gradient(lagrangian, Recorded(0), point, Values{Recorded(1)});
  std::vector<Real> p;
  for (std::size_t k = q.size(); k < slope.size(); ++k) p.push_back(slope[k].constant());
  return p;
}

}  // namespace pfaff::text
