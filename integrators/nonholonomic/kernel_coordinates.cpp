#include <pfaff/integrators/nonholonomic/kernel_coordinates.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>

namespace pfaff {

namespace {

using Numbers = std::vector<Recorded>;
using Places = std::vector<std::size_t>;  // coordinates

// Determinants are expanded by rows, which grows as the factorial of their size.
constexpr std::size_t most_constraints = 3, most_degrees = 16;
// Of the determinant that is divided by, in units of the largest one at the initial state.
constexpr double smallest_determinant = 0.125;

Recorded minor_determinant(const Numbers& a, std::size_t n, const Places& columns, std::size_t row = 0) {
  if (columns.empty()) return Recorded(1);
  Recorded sum(0);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Places others = columns;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const Recorded term = a[row * n + columns[k]] * minor_determinant(a, n, others, row + 1);
    sum = k % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

// Every choice of `size` among `places`, in lexicographic order.
void choose(const Places& places, std::size_t size, std::size_t from, Places& chosen,
            std::vector<Places>& all) {
  if (chosen.size() == size) {
    all.push_back(chosen);
    return;
  }
  for (std::size_t k = from; k < places.size(); ++k) {
    chosen.push_back(places[k]);
    choose(places, size, k + 1, chosen, all);
    chosen.pop_back();
  }
}

std::vector<double> initial_positions(const Model& model) {
  std::vector<double> q(static_cast<std::size_t>(model.dimension()) / 2);
  for (std::size_t k = 0; k < q.size() && k < model.initial().size(); ++k) q[k] = model.initial()[k].value();
  return q;
}

// Records the coordinates of one model.
class Recording {
 public:
  explicit Recording(const Model& model)
      : rows_(model.tape(Formula::velocity_constraints)),
        energy_(model.tape(Formula::hamiltonian)),
        slopes_(model.tape(Formula::hamiltonian_gradient)),
        n_(static_cast<std::size_t>(model.dimension()) / 2),
        count_(rows_->outputs.size() / n_) {
    for (std::size_t k = 0; k < n_; ++k) (zero_column(k) ? free_ : coupled_).push_back(k);
  }

  [[nodiscard]] std::size_t degrees() const { return n_; }
  [[nodiscard]] std::size_t rank() const { return n_ - count_; }
  [[nodiscard]] const Places& coupled() const { return coupled_; }
  // D, where one serves everywhere.
  [[nodiscard]] std::optional<Places> dependent(const Model& model) const {
    std::vector<Places> all;
    Places chosen;
    choose(coupled_, count_, 0, chosen, all);
    if (coupled_.size() == count_ + 1) return all.front();
    const Tape tape = record(static_cast<int>(n_), static_cast<int>(all.size()),
                             [&](const Recorded& t, In<Recorded> q, Out<Recorded> out) {
                               const Numbers a = evaluate(*rows_, t, q);
                               for (std::size_t k = 0; k < all.size(); ++k)
                                 out[k] = minor_determinant(a, n_, all[k]);
                             });
    std::vector<double> values(all.size());
    Replay<double>(std::make_shared<const Tape>(tape))(0.0, initial_positions(model).data(), values.data());
    double largest = 0, best = 0;
    std::optional<Places> found;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double size = std::abs(values[k]);
      largest = std::max(largest, size);
      const bool constant =
          tape.code[static_cast<std::size_t>(tape.outputs[k])].operation == Operation::constant;
      if (!constant || size <= best) continue;
      best = size;
      found = all[k];
    }
    return best >= smallest_determinant * largest ? found : std::nullopt;
  }

  [[nodiscard]] KernelCoordinates coordinates(const Places& dependent) const {
    const auto shared = [](Tape tape) { return std::make_shared<const Tape>(std::move(tape)); };
    const int n = static_cast<int>(n_), r = static_cast<int>(rank());
    KernelCoordinates made;
    made.degrees = n_;
    made.rank = rank();
    const Tape basis = record(n, n * r, [&](const Recorded& t, In<Recorded> q, Out<Recorded> out) {
      const Numbers x = basis_at(t, q, dependent);
      std::copy(x.begin(), x.end(), out.begin());
    });
    made.momentum = shared(record(n + r, n, [&](const Recorded& t, In<Recorded> in, Out<Recorded> out) {
      const Numbers p = momentum_at(t, in.first(n_), in.subspan(n_), basis, dependent);
      std::copy(p.begin(), p.end(), out.begin());
    }));
    made.energy = shared(record(n + r, 1, [&](const Recorded& t, In<Recorded> in, Out<Recorded> out) {
      Numbers z(in.begin(), in.begin() + n);
      const Numbers p = evaluate(*made.momentum, t, in);
      z.insert(z.end(), p.begin(), p.end());
      out[0] = evaluate(*energy_, t, z).front();
    }));
    made.reduced = shared(record(2 * n, r, [&](const Recorded& t, In<Recorded> in, Out<Recorded> out) {
      const Numbers x = evaluate(basis, t, in.first(n_));
      for (std::size_t a = 0; a < rank(); ++a)
        for (std::size_t k = 0; k < n_; ++k) out[a] = out[a] + x[k * rank() + a] * in[n_ + k];
    }));
    made.middle = shared(
        record(n + r, n + r + n * r + r * r, [&](const Recorded& t, In<Recorded> in, Out<Recorded> out) {
          const Numbers gradient_of_energy = gradient(*made.energy, t, in, Numbers{Recorded(1)}),
                        x = evaluate(basis, t, in.first(n_)), p = evaluate(*made.momentum, t, in),
                        gamma = brackets(t, in.first(n_), x, p, basis);
          auto next = std::copy(gradient_of_energy.begin(), gradient_of_energy.end(), out.begin());
          next = std::copy(x.begin(), x.end(), next);
          std::copy(gamma.begin(), gamma.end(), next);
        }));
    return made;
  }

 private:
  [[nodiscard]] bool zero_column(std::size_t k) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const Instruction& code = rows_->code[static_cast<std::size_t>(rows_->outputs[i * n_ + k])];
      if (code.operation != Operation::constant || !rows_->constants[static_cast<std::size_t>(code.a)].is(0))
        return false;
    }
    return true;
  }

  // X, row-major: vectors of C first.
  [[nodiscard]] Numbers basis_at(const Recorded& t, In<Recorded> q, const Places& dependent) const {
    const Numbers a = evaluate(*rows_, t, q);
    Numbers x(n_ * rank());
    std::size_t column = 0;
    for (const std::size_t place : coupled_) {
      if (std::find(dependent.begin(), dependent.end(), place) != dependent.end()) continue;
      x[place * rank() + column] = minor_determinant(a, n_, dependent);
      for (std::size_t j = 0; j < dependent.size(); ++j) {
        Places replaced = dependent;
        replaced[j] = place;
        x[dependent[j] * rank() + column] = -minor_determinant(a, n_, replaced);
      }
      ++column;
    }
    for (const std::size_t place : free_) x[place * rank() + column++] = Recorded(1);
    return x;
  }

  // p = p^ - A^T S^-1 psi, where X^T p^ = pi and psi = A H_p at p^.
  [[nodiscard]] Numbers momentum_at(const Recorded& t, In<Recorded> q, In<Recorded> pi, const Tape& basis,
                                    const Places& dependent) const {
    const Numbers a = evaluate(*rows_, t, q), x = evaluate(basis, t, q);
    Numbers z(q.begin(), q.end());
    for (const Recorded& component : lifted(x, pi, dependent)) z.push_back(component);
    const Numbers slopes = evaluate(*slopes_, t, z);
    Numbers psi(count_), s(count_ * count_);
    for (std::size_t j = 0; j < count_; ++j) {
      Numbers along(2 * n_);
      for (std::size_t k = 0; k < n_; ++k) {
        psi[j] = psi[j] + a[j * n_ + k] * slopes[n_ + k];
        along[n_ + k] = a[j * n_ + k];
      }
      const Numbers moved = directional_derivative(*slopes_, t, Recorded(0), z, along);
      for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t k = 0; k < n_; ++k)
          s[i * count_ + j] = s[i * count_ + j] + a[i * n_ + k] * moved[n_ + k];
    }
    const Numbers multipliers = solve(s, psi);
    Numbers p(z.begin() + static_cast<std::ptrdiff_t>(n_), z.end());
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t j = 0; j < count_; ++j) p[k] = p[k] - a[j * n_ + k] * multipliers[j];
    return p;
  }

  // Some p^ with X^T p^ = pi. Where there is one vector of C, it is that along the vector; otherwise it is
  // zero at D, and divided by the determinant, which is a constant then.
  [[nodiscard]] Numbers lifted(const Numbers& x, In<Recorded> pi, const Places& dependent) const {
    const std::size_t r = rank(), of_coupled = coupled_.size() - count_;
    Numbers p(n_);
    for (std::size_t k = 0; k < free_.size(); ++k) p[free_[k]] = pi[of_coupled + k];
    if (of_coupled == 1) {
      Recorded square(0);
      for (const std::size_t place : coupled_) square = square + x[place * r] * x[place * r];
      for (const std::size_t place : coupled_) p[place] = x[place * r] * pi[0] / square;
      return p;
    }
    std::size_t column = 0;
    for (const std::size_t place : coupled_) {
      if (std::find(dependent.begin(), dependent.end(), place) != dependent.end()) continue;
      p[place] = pi[column] / x[place * r + column];
      ++column;
    }
    return p;
  }

  // Gam, row-major.
  [[nodiscard]] Numbers brackets(const Recorded& t, In<Recorded> q, const Numbers& x, const Numbers& p,
                                 const Tape& basis) const {
    const std::size_t r = rank();
    Numbers turned(r * r), gamma(r * r);  // turned[a r + b] = p.DX_b X_a
    for (std::size_t a = 0; a < r; ++a) {
      Numbers along(n_);
      for (std::size_t k = 0; k < n_; ++k) along[k] = x[k * r + a];
      const Numbers moved = directional_derivative(basis, t, Recorded(0), q, along);
      for (std::size_t b = 0; b < r; ++b)
        for (std::size_t k = 0; k < n_; ++k) turned[a * r + b] = turned[a * r + b] + p[k] * moved[k * r + b];
    }
    for (std::size_t a = 0; a < r; ++a)
      for (std::size_t b = 0; b < r; ++b) gamma[a * r + b] = turned[b * r + a] - turned[a * r + b];
    return gamma;
  }

  std::shared_ptr<const Tape> rows_, energy_, slopes_;
  std::size_t n_, count_;
  Places coupled_, free_;  // C and the others
};

}  // namespace

std::string no_kernel_coordinates(const Model& model) {
  if (model.given(Formula::velocity_offsets))
    return "needs constraints A v = 0; those of " + model.name() + " have b(q, t)";
  if (model.given(Formula::holonomic))
    return "needs constraints of velocities alone; " + model.name() + " has holonomic ones beside them";
  const Recording recording(model);
  const std::size_t count = recording.degrees() - recording.rank();
  if (count > most_constraints || recording.degrees() > most_degrees || recording.coupled().size() < count)
    return "needs a basis of ker A made of minors, which is for few constraints; " + model.name() +
           " has too many";
  if (!recording.dependent(model))
    return "needs one basis of ker A that serves everywhere; the minors of " + model.name() + " make none";
  if (!velocity_is_linear<double>(*model.velocity_constraints<double>(), generic_time<double>(),
                                  initial_positions(model)))
    return "needs an energy that is quadratic in p; that of " + model.name() + " is not";
  return {};
}

std::shared_ptr<const KernelCoordinates> kernel_coordinates(const Model& model) {
  const Recording recording(model);
  return std::make_shared<const KernelCoordinates>(recording.coordinates(recording.dependent(model).value()));
}

}  // namespace pfaff
