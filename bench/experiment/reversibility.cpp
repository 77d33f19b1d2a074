#include <pfaff/bench/experiment/reversibility.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <pfaff/bench/experiment/carried_states.hpp>
#include <pfaff/bench/experiment/cells.hpp>
#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/runs/support/history.hpp>

namespace pfaff {

namespace {

constexpr std::int64_t most_steps = 1000, least_steps = 100;
constexpr std::int64_t most_numbers = 64 * most_steps;  // steps times coordinates
constexpr int intervals = 12;
constexpr double unit = 0x1p-53;
constexpr double change = 0x1p-26;  // at the turn: so small that it acts linearly, and far above round-off
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

using Coordinates = std::vector<double>;

double apart(const Coordinates& a, const Coordinates& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square);
}

// True where a stepper has to keep what it remembers when it turns round.
bool remembers(const ResolvedRun& run) {
  std::vector<Quad> z;
  for (const Real& x : run.initial) z.push_back(x.quad());
  return keeps_history(*run.method, run.model, run.t0.quad(), run.step.quad(), z);
}

bool claimed(const ResolvedRun& run, Claim claim) {
  const std::vector<Claim> claims = claims_in_scope(run.method->preserves(*run.model), *run.model);
  return std::find(claims.begin(), claims.end(), claim) != claims.end();
}

// Nullopt where nothing leads the method back.
std::optional<WayBack> way_back(const ResolvedRun& run, bool remembering) {
  const bool stated = run.model->given(Formula::reversal) && run.model->autonomous();
  if (!remembering) return stated ? WayBack::reversal : WayBack::negative_steps;
  if (stated && claimed(run, Claim::reversible)) return WayBack::reversal;
  if (claimed(run, Claim::symmetric)) return WayBack::negative_steps;
  return std::nullopt;
}

// There and back again on one run.
class RoundTrip {
 public:
  RoundTrip(const ResolvedRun& run, WayBack by, bool remembering)
      : t0_(run.t0.value()),
        h_(run.step.value()),
        by_(by),
        remembering_(remembering),
        stepper_(run.method->stepper(run.model, double())) {
    for (const Real& x : run.initial) start_.push_back(x.value());
    if (by == WayBack::reversal) reversal_ = make_evaluator<double>(run.model, Formula::reversal);
  }

  // The state after so many steps from the start; nullopt where one fails.
  [[nodiscard]] std::optional<Coordinates> forward(std::int64_t steps) {
    stepper_->forget();
    return taken(t0_, h_, steps, start_);
  }

  // The state at the end of the way back from there; nullopt where a step fails.
  [[nodiscard]] std::optional<Coordinates> back(std::int64_t steps, const Coordinates& turn) {
    const double t = t0_ + static_cast<double>(steps) * h_;
    if (!remembering_) stepper_->forget();
    if (by_ == WayBack::negative_steps) return taken(t, -h_, steps, turn);
    const auto end = taken(t, h_, steps, reversed(turn));
    return end ? std::optional(reversed(*end)) : std::nullopt;
  }

  [[nodiscard]] const Coordinates& start() const { return start_; }

 private:
  [[nodiscard]] Coordinates reversed(const Coordinates& z) const {
    Coordinates image(z.size());
    reversal_.call(reversal_.context, t0_, z.data(), image.data());
    return image;
  }
  [[nodiscard]] std::optional<Coordinates> taken(double t, double h, std::int64_t steps, Coordinates z) {
    std::int64_t completed = 0;
    if (stepper_->advance(t, 0, h, steps, z, completed) != Status::converged) return std::nullopt;
    return z;
  }

  double t0_, h_;
  WayBack by_;
  bool remembering_;
  StepperPointer<double> stepper_;
  Coordinates start_;
  Evaluator<double> reversal_;
};

// What a rounding of each coordinate may be: relative changes of either sign, without a pattern that
// symmetric states have.
Coordinates changed(Coordinates z) {
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] *= std::cos(1 + 2 * static_cast<double>(i)) > 0 ? 1 + change : 1 - change;
  return z;
}

// The numbers of steps after which a method turns round.
std::vector<std::int64_t> turns(const ResolvedRun& run) {
  const std::int64_t most =
      std::clamp<std::int64_t>(most_numbers / run.model->dimension(), least_steps, most_steps);
  const auto all = static_cast<double>(std::min(run.steps, most));
  std::vector<std::int64_t> found;
  for (int k = 0; k <= intervals; ++k) {
    const std::int64_t turn = std::llround(std::pow(all, static_cast<double>(k) / intervals));
    if (found.empty() || found.back() < turn) found.push_back(turn);
  }
  return found;
}

}  // namespace

Returns returns_to_start(const ResolvedRun& run) {
  Returns returns;
  const bool remembering = remembers(run);
  const auto by = way_back(run, remembering);
  if (!by) return returns;
  returns.by = *by;
  RoundTrip trip(run, *by, remembering);
  const double norm = apart(trip.start(), Coordinates(trip.start().size())), size = norm > 0 ? norm : 1;
  for (const std::int64_t steps : turns(run)) {
    const auto turn = trip.forward(steps);
    if (!turn) break;
    Return one{static_cast<double>(steps) * run.step.value(), not_known, not_known};
    if (const auto end = trip.back(steps, *turn)) {
      one.distance = apart(*end, trip.start()) / size;
      // What is remembered belongs to the state that was reached, and to no other.
      const auto other = remembering ? std::nullopt : trip.back(steps, changed(*turn));
      if (other) one.rounding = apart(*other, *end) / size * (unit / change);
    }
    returns.looks.push_back(one);
  }
  return returns;
}

std::string reversibility_csv(const std::vector<ExperimentRun>& runs,
                              const std::vector<nlohmann::json>& summaries) {
  const auto largest =
      runs_at_largest_steps(runs, summaries, [](const ResolvedRun& run) { return !run.adaptive(); });
  std::vector<std::string> rows(largest.size());
  in_parallel(largest.size(), [&](std::size_t m) {
    const ExperimentRun& run = *largest[m];
    const auto cell = [](double x) { return std::isfinite(x) ? formatted("%.9g", x) : std::string(); };
    const Returns returns = returns_to_start(run.resolved);
    for (const Return& one : returns.looks)
      rows[m] += csv_quoted(run.which->name) + "," + csv_quoted(run.method->label) + "," +
                 csv_quoted(run.step) + "," + formatted("%.12g", one.t) + "," + cell(one.distance) + "," +
                 cell(one.rounding) + "," +
                 (returns.by == WayBack::reversal ? "reversal" : "negative steps") + "\n";
  });
  std::string text;
  for (const std::string& row : rows) text += row;
  return text.empty() ? "" : "case,method,step,t,distance,rounding,by\n" + text;
}

}  // namespace pfaff
