#include <pfaff/verify/falsification/judgement.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/runs/history.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/falsification/many_steps.hpp>

namespace pfaff {

namespace {

// Residuals are measured with the step halved up to so many times.
constexpr int halvings = 8;
// Above this residual double sees more than its own rounding, and has to agree with quad.
constexpr double seen_in_double = 1e-12;

const ClaimCheck& check_of(Claim claim) {
  const auto rows = claim_checks();
  return *std::find_if(rows.begin(), rows.end(), [&](const ClaimCheck& row) { return row.claim == claim; });
}

// What comes before the steps that are judged, and what goes with them.
struct Past {
  int warm_up = 0;       // steps
  bool carried = false;  // claims about two steps take the second with what the method remembers of the first
};

// The residual of at.count steps of the length h in a row, after as many steps as the warm-up has. This is
// the only place where a claim is measured.
template <class T>
double residual_of(const MethodInstance& method, Claim claim, const JudgedStep& at, const Past& past,
                   const Real& h) {
  const ManySteps many(method, at.count);
  const MethodInstance& stepped = at.count == 1 ? method : many;
  MeasuredStep<T> step(stepped, at.model, at.state, at.time, Real(at.count) * h, past.warm_up, past.carried);
  return pfaff::residual_of(check_of(claim), step);
}

bool one_sided(Claim claim) { return claim == Claim::entropy; }

// True where the residual is the same number in both precisions, which that of rounding is not.
bool same_in_both(double a, double b) { return std::abs(a - b) <= 0.01 * std::max(std::abs(a), std::abs(b)); }

// Measures while the step is halved, until the last so many exponents, each log2 of the ratio of successive
// residuals, agree with their neighbours, or until round-off is near. True where they agree on a residual
// that falls.
template <class Measure>
bool power_of_step(Judgement& judgement, const Measure& measure, Real h, double round_off, int agreeing,
                   double tolerance) {
  int alike = 0;
  for (int k = 0; k < halvings; ++k) {
    h = h / Real(2);
    const double residual = measure(h), last = judgement.exponent;
    if (!(residual > round_off)) break;
    judgement.exponent = std::log2(judgement.residuals.back() / residual);
    judgement.residuals.push_back(residual);
    alike = k > 0 && std::abs(judgement.exponent - last) < tolerance ? alike + 1 : 1;
    if (alike == agreeing) return judgement.exponent > 0.5;
  }
  return false;
}

bool remembers(const MethodInstance& method, const JudgedStep& at) {
  std::vector<Quad> z;
  for (const Real& x : at.state) z.push_back(x.quad());
  return keeps_history(method, at.model, at.time.quad(), at.step.quad(), z);
}

}  // namespace

bool judged_by_long_runs(Claim claim) { return check_of(claim).of_rounding; }

double falsifying_residual(const MethodInstance& method, Claim claim) {
  if (judged_by_long_runs(claim)) return largest_allowed<double>(check_of(claim));
  return method.descriptor().double_coefficients ? 1e-8 : 1e-20;
}

namespace {
// A claim about rounding is judged in double alone, by steps that the measure chooses; it has repeated what
// fails with other starts.
Judgement judged_by_rounding(const MethodInstance& method, Claim claim, const JudgedStep& at) {
  Judgement judgement;
  JudgedStep single = at;
  single.count = 1;
  judgement.in_double = residual_of<double>(method, claim, single, {}, at.step);
  judgement.residuals = {judgement.in_double};
  judgement.falsified = judgement.in_double > falsifying_residual(method, claim);
  if (std::isnan(judgement.in_double)) {
    judgement.reason = "a step did not converge, or truncation hides what rounding does";
  } else if (!judgement.falsified) {
    judgement.reason = "the rounding is a random walk";
  }
  return judgement;
}

Judgement judged(const MethodInstance& method, Claim claim, const JudgedStep& at, const Past& past) {
  const bool doubles = method.descriptor().double_coefficients;
  const auto measure = [&](const Real& h) {
    return doubles ? residual_of<double>(method, claim, at, past, h)
                   : residual_of<Quad>(method, claim, at, past, h);
  };
  Judgement judgement;
  judgement.residuals = {measure(at.step)};
  const double residual = judgement.residuals.front();
  if (std::isnan(residual)) {
    judgement.reason = "the step did not converge, or not to finite numbers";
    return judgement;
  }
  judgement.in_double = doubles ? residual : residual_of<double>(method, claim, at, past, at.step);
  if (!(residual > falsifying_residual(method, claim))) {
    judgement.reason = "the residual is that of rounding";
    return judgement;
  }
  const double in_other = doubles ? residual_of<Quad>(method, claim, at, past, at.step) : judgement.in_double;
  const bool same = same_in_both(in_other, residual);
  if (one_sided(claim) || residual > seen_in_double) {
    if (!same) {
      judgement.reason = "the residual differs between double and quad";
      return judgement;
    }
  }
  // What only quad can see has to be a power through more halvings, since rounding may look like one by
  // chance.
  judgement.falsified =
      one_sided(claim) ||
      (residual > seen_in_double ? power_of_step(judgement, measure, at.step, doubles ? 1e-13 : 1e-30, 2, 0.5)
                                 : power_of_step(judgement, measure, at.step, 1e-30, 4, 0.25));
  if (!judgement.falsified) judgement.reason = "the residual is no power of the step size";
  return judgement;
}
}  // namespace

// A claim is about a method's own step. That of a method which remembers its past comes after steps that
// forget how it was started; as verification does, a single step is therefore judged there too. Over many
// steps the start counts, but what the method carries from step to step goes back with the state.
Judgement judge(const MethodInstance& method, Claim claim, const JudgedStep& at) {
  if (judged_by_long_runs(claim)) return judged_by_rounding(method, claim, at);
  Judgement cold = judged(method, claim, at, {});
  if (!cold.falsified || !remembers(method, at)) return cold;
  return judged(method, claim, at, {.warm_up = at.count > 1 ? 0 : steps_of_warm_up, .carried = true});
}

}  // namespace pfaff
