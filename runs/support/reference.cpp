#include <pfaff/runs/support/reference.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/tape/taylor_steps.hpp>

namespace pfaff {

namespace {
// Of order p and with steps of e^{-81/p} of the radius of convergence, which leave terms of degree p at e^-81
// = 7e-36 of the first. The work for a unit of time, p^2 e^{81/p}, is least at p = 40, and 6 % more at 32.
constexpr int order_of_solution = 32, order_of_check = 40;
constexpr double logarithm_of_last_term = -81;
// What a step may leave out, of each coordinate: far more than the last term, and less than rounding makes in
// some tens of steps.
const Quad left_out_of_a_step(1e-32);
constexpr std::int64_t most_reference_steps = 1000000;
// A motion that blows up may turn ever faster on its way, so that its steps get short long before it ends. It
// is given up where the pace of this many steps would take ten times the most of them; a passage near a
// singularity, to a part of 1e-8 of its distance, takes some 400.
constexpr std::int64_t steps_of_pace = 1000, most_at_pace = 10 * most_reference_steps;
constexpr std::size_t most_stored_numbers = std::size_t{1} << 26;
// Digits of a solution: those that are claimed, and those without which it is none, with which an error in
// double is known to four digits at round-off.
constexpr int digits_claimed = 30;
const Quad least_agreement(1e-20);

const char* const out_of_the_domain = "the state or its derivatives are no numbers from there on";
const char* const no_step_leads_on = "no step leads on from there, as where a motion blows up";

// A solution that goes on step by step, each a series of one order.
class SeriesOfSolution {
 public:
  SeriesOfSolution(const Model& model, int order, Quad t, std::vector<Quad> z)
      : steps_(model.tape(Formula::field), order, std::exp(logarithm_of_last_term / order)),
        t_(t),
        paced_(t),
        z_(std::move(z)),
        least_(z_.size()) {}

  /// Expands the solution where it is and chooses a step in the direction of `goal` and not beyond. Empty, or
  /// why there is none. BudgetSpent where the budget of the thread has run out.
  [[nodiscard]] std::string expand(Quad goal) {
    spend(1, 1);
    if (++taken_ > most_reference_steps)
      return std::to_string(most_reference_steps) + " steps have been taken";
    if (taken_ % steps_of_pace == 0) {
      if (abs(goal - t_) > abs(t_ - paced_) * Quad(static_cast<double>(most_at_pace)) /
                               Quad(static_cast<double>(steps_of_pace)))
        return "at the pace of its last " + std::to_string(steps_of_pace) + " steps the end is more than " +
               std::to_string(most_at_pace) + " steps away";
      paced_ = t_;
    }
    if (!steps_.expand(t_, z_.data())) return out_of_the_domain;
    const Quad step = steps_.step(goal - t_, left_out_of_a_step, least_);
    if (step == Quad(0)) return no_step_leads_on;
    // What a coordinate that begins with a high power of the time was measured against is kept until it is
    // larger, for its first digits are below the others' last ones.
    for (std::size_t k = 0; k < z_.size(); ++k) least_[k] = std::max(least_[k], steps_.unsized()[k]);
    after_ = abs(goal - t_) <= abs(step) ? goal : t_ + step;
    if (steps_.ends_at_kink()) ++kinks_;
    return {};
  }
  /// The time and the state at the point of expansion, and the time at the end of the step.
  [[nodiscard]] Quad time() const { return t_; }
  [[nodiscard]] const std::vector<Quad>& state() const { return z_; }
  [[nodiscard]] Quad after() const { return after_; }
  [[nodiscard]] const TaylorExpansion<Quad>& expansion() const { return steps_.expansion(); }
  /// How many kinks of the field the steps have led to.
  [[nodiscard]] std::int64_t kinks() const { return kinks_; }
  /// The state at a time of the step.
  void evaluate(Quad t, std::vector<Quad>& z) const {
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z_[k] + expansion().increment(t - t_, k);
  }
  /// Goes to the end of the step.
  void advance() {
    evaluate(after_, z_);  // each coordinate is read once, before it is written
    t_ = after_;
  }
  /// How far another state at the end of the step is from this one, relative to the sizes of coordinates.
  [[nodiscard]] Quad distance(const std::vector<Quad>& here, const std::vector<Quad>& other) {
    std::vector<Quad> sizes = steps_.sizes();
    for (std::size_t k = 0; k < sizes.size(); ++k) sizes[k] = std::max(sizes[k], least_[k]);
    const Quad worst = largest(here, other, sizes);
    if (worst <= claimed()) return worst;
    // A coordinate that is but a rest of its terms agrees in fewer digits than these.
    steps_.add_terms_of_rates(after_ - t_, sizes);
    return largest(here, other, sizes);
  }
  static Quad claimed() { return exp(Quad(-digits_claimed) * log(Quad(10))); }

 private:
  static Quad largest(const std::vector<Quad>& here, const std::vector<Quad>& other,
                      const std::vector<Quad>& sizes) {
    Quad worst(0);
    for (std::size_t k = 0; k < here.size(); ++k)
      if (const Quad off = abs(here[k] - other[k]); off != Quad(0)) {
        const Quad relative = off / std::max(sizes[k], abs(here[k]));
        if (!(relative <= worst)) worst = relative;
      }
    return worst;
  }

  TaylorSteps<Quad> steps_;
  Quad t_, paced_, after_;
  std::vector<Quad> z_, least_;  // the least sizes of coordinates
  std::int64_t taken_ = 0, kinks_ = 0;
};

std::string solution_found_up_to(Quad t, const std::string& reason) {
  return "the solution was found up to t = " + to_string(t, 10) + ": " + reason;
}
}  // namespace

ReferenceExpansion::ReferenceExpansion(const Model& model)
    : TaylorExpansion(model.tape(Formula::field), 28) {}

void ReferenceExpansion::evaluate(Quad s, Quad* z) const {
  for (std::size_t k = 0; k < size(); ++k) z[k] = coefficients()[k] + increment(s, k);
}

SolutionEnds::SolutionEnds(Quad t, const std::string& reason) : RunError(solution_found_up_to(t, reason)) {}

std::int64_t taylor_flow(const Model& model, Quad t, Quad elapsed, std::vector<Quad>& z) {
  SeriesOfSolution solution(model, order_of_solution, t, z);
  const Quad goal = t + elapsed;
  while (solution.time() != goal) {
    if (const std::string reason = solution.expand(goal); !reason.empty())
      throw SolutionEnds(solution.time(), reason);
    solution.advance();
  }
  z = solution.state();
  return solution.kinks();
}

namespace {
// The closed form of a model from one state on.
struct ExactSolution {
  const std::shared_ptr<const Model>& model;
  Quad t0;
  const std::vector<Quad>& initial;

  // After so long.
  [[nodiscard]] std::vector<Quad> after(Quad elapsed) const {
    // A problem evaluates in buffers of its own; each call makes one, so that threads can call at once.
    const Problem<Quad> problem(model);
    std::vector<Quad> arguments = initial, z(initial.size());
    arguments.push_back(t0);
    problem.exact_solution(elapsed, arguments, z);
    return z;
  }

  // Errors against a solution of other equations, or from another state, would be numbers without a meaning.
  // Whether a closed form is right to its last digit is a question for verification; here it is refused
  // (InputError) where it is another one beyond doubt, near the start. What is not finite there is no
  // solution, which is said elsewhere.
  // What a number is off by is relative to its size, or to as small a part of the largest one: a momentum of
  // zero is what rounding leaves of it.
  static constexpr double beyond_doubt = 1e-6;

  void check_start() const {
    const std::vector<Quad> start = after(Quad(0));
    const Quad rounded = Quad(beyond_doubt) * largest(initial);
    for (std::size_t k = 0; k < start.size(); ++k)
      if (abs(start[k] - initial[k]) >
          Quad(beyond_doubt) * std::max({abs(start[k]), abs(initial[k]), rounded}))
        refuse("does not begin at the state that it is asked for: " + name(k) + " is " +
               to_string(start[k], 6) + " instead of " + to_string(initial[k], 6));
  }
  // By differences over a short time, extrapolated where they are straight in it, which shows that it is
  // short enough and long enough for what is rounded.
  void check_rate(Quad duration) const {
    std::vector<Quad> field(initial.size());
    Problem<Quad>(model).field(t0, initial, field);
    const std::vector<Quad> start = after(Quad(0));
    const Quad rounded = Quad(beyond_doubt) * std::max(largest(field), abs(largest(initial) / duration));
    for (const int exponent : {-40, -55, -70}) {
      const Quad s = duration * Quad(std::ldexp(1.0, exponent));
      if (s == Quad(0)) return;
      const std::vector<Quad> quarter = after(s / Quad(4)), half = after(s / Quad(2)), whole = after(s);
      bool straight = true;
      std::string wrong;
      for (std::size_t k = 0; k < start.size(); ++k) {
        const auto rate_over = [&](const std::vector<Quad>& end, int parts) {
          return Quad(parts) * (end[k] - start[k]) / s;
        };
        const Quad near = rate_over(quarter, 4), far = rate_over(half, 2), farther = rate_over(whole, 1);
        const Quad rate = Quad(2) * near - far, bend = abs(far - near);
        const Quad size = std::max({abs(field[k]), abs(initial[k] / duration), rounded});
        const bool bends_evenly = abs(farther - far - Quad(2) * (far - near)) <= bend / Quad(10);
        straight = straight && (bends_evenly || bend <= Quad(beyond_doubt) * size / Quad(1000));
        if (wrong.empty() && abs(rate - field[k]) > Quad(beyond_doubt) * size + bend)
          wrong = "does not follow its equations: at the start " + name(k) + " changes by " +
                  to_string(rate, 6) + " a unit of time instead of " + to_string(field[k], 6);
      }
      if (!straight) continue;
      if (!wrong.empty()) refuse(wrong);
      return;
    }
  }

 private:
  static Quad largest(const std::vector<Quad>& numbers) {
    Quad most(0);
    for (const Quad& x : numbers) most = std::max(most, abs(x));
    return most;
  }
  [[nodiscard]] std::string name(std::size_t k) const { return model->coordinates()[k].name; }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError("the exact solution of " + model->name() + " " + what +
                     "; expected a right one, or --reference none");
  }
};
}  // namespace

ReferenceSolution::ReferenceSolution(std::shared_ptr<const Model> model, Quad t0, std::vector<Quad> initial,
                                     Quad duration, Certainty certainty)
    : model_(std::move(model)),
      t0_(t0),
      initial_(std::move(initial)),
      backwards_(duration < Quad(0)),
      end_(t0) {
  if (model_->facets().has(Facet::exact_solution)) {
    // A closed form may be for some starts only, as that of Kepler's ellipses, or end before the duration.
    const std::vector<Quad> end = ExactSolution{model_, t0_, initial_}.after(duration);
    exact_ = std::all_of(end.begin(), end.end(), [](const Quad& x) { return isfinite(x); });
    if (exact_) return;
  }
  solve(duration, certainty);
}

void ReferenceSolution::solve(Quad duration, Certainty certainty) {
  // A little further than asked for, since the times of a run in double are rounded.
  const Quad goal = t0_ + duration + duration / Quad(1000000);
  SeriesOfSolution solution(*model_, order_of_solution, t0_, initial_),
      check(*model_, order_of_check, t0_, initial_);
  std::vector<Quad> here(initial_.size()), other(initial_.size());
  std::string reason;
  try {
    if (certainty == Certainty::by_two_series) reason = check.expand(goal);
    while (reason.empty() && end_ != goal) {
      if (reason = solution.expand(goal); !reason.empty()) break;
      while (certainty == Certainty::by_two_series && reason.empty() &&
             precedes(check.after(), solution.after())) {
        check.advance();
        reason = check.expand(goal);
      }
      if (!reason.empty()) break;
      Quad off(1);
      if (certainty == Certainty::by_two_series) {
        solution.evaluate(solution.after(), here);
        check.evaluate(solution.after(), other);
        off = solution.distance(here, other);
        if (!(off <= least_agreement)) {
          reason = "series of two orders agree in less than 20 digits from there on";
          break;
        }
      }
      if ((pieces_.size() + 1) * solution.expansion().coefficients().size() > most_stored_numbers) {
        reason = "its series fill a gigabyte";
        break;
      }
      disagreement_ = std::max(disagreement_, off);
      pieces_.push_back({solution.time(), solution.expansion().coefficients()});
      solution.advance();
      end_ = solution.time();
    }
  } catch (const BudgetSpent& spent) {
    if (spent.stopped()) throw;
    reason = spent.what();
  }
  if (precedes(end_, t0_ + duration)) ended_ = solution_found_up_to(end_, reason);
}

void ReferenceSolution::check_closed_form(Quad duration) const {
  if (!exact_) return;
  const ExactSolution solution{model_, t0_, initial_};
  solution.check_start();
  if (model_->facets().has(Facet::vector_field)) solution.check_rate(duration);
}

std::string ReferenceSolution::kind() const {
  if (exact_) return "exact";
  const double digits = disagreement_ > SeriesOfSolution::claimed()
                            ? std::floor(-static_cast<double>(log(disagreement_)) / std::log(10.0))
                            : digits_claimed;
  return std::to_string(static_cast<int>(digits)) + "-digit";
}

bool ReferenceSolution::covers(Quad t) const { return exact_ || (!pieces_.empty() && !precedes(end_, t)); }

std::vector<Quad> ReferenceSolution::at(Quad t) const {
  if (t == t0_) return initial_;
  const std::size_t n = initial_.size();
  std::vector<Quad> z(n);
  if (exact_) return ExactSolution{model_, t0_, initial_}.after(t - t0_);
  if (!covers(t)) throw SolutionEnds(end_, "the state at t = " + to_string(t, 10) + " was asked for");
  const auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), t,
                       [this](Quad time, const Piece& piece) { return precedes(time, piece.begin); });
  const Piece& piece = after == pieces_.begin() ? pieces_.front() : *std::prev(after);
  const Quad s = t - piece.begin;
  const std::size_t degrees = piece.coefficients.size() / n;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = degrees; l-- > 0;) z[k] = z[k] * s + piece.coefficients[l * n + k];
  return z;
}

}  // namespace pfaff
