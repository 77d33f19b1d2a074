#include <pfaff/derive/derivation_growth/derived_sizes.hpp>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff {

namespace {

// The growth of value(derivation) with K by a power law or by an exponential; without points where there are
// too few.
template <class Value>
Fit fit_of(const DerivationStudy& study, const std::vector<Derived>& all, const std::string& method,
           const std::string& quantity, bool power, Value&& value) {
  Fit fit{method, quantity, power ? "power" : "exponential", HUGE_VAL, 0, {}};
  std::vector<double> x, y;
  for (const Derived& d : all) {
    const auto rods = static_cast<double>(d.rods);
    if (d.method != method || rods < study.fit_from || !std::isfinite(value(d))) continue;
    fit.from = std::min(fit.from, rods);
    fit.to = std::max(fit.to, rods);
    x.push_back(power ? std::log(rods) : rods);
    y.push_back(std::log(value(d)));
  }
  fit.slope = fitted_slope(x, y);
  return fit;
}

const Fit* found_fit(const std::vector<Fit>& fits, const std::string& method, const std::string& quantity) {
  const auto found = std::find_if(fits.begin(), fits.end(), [&](const Fit& fit) {
    return fit.method == method && fit.quantity == quantity;
  });
  return found == fits.end() ? nullptr : &*found;
}

}  // namespace

FittedSlope fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
  FittedSlope fit;
  const std::size_t n = x.size();
  if (n < 3) return fit;
  const auto count = static_cast<double>(n);
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < n; ++k) {
    mean_x += x[k] / count;
    mean_y += y[k] / count;
  }
  for (std::size_t k = 0; k < n; ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  if (!(xx > 0)) return fit;
  fit.points = n;
  fit.slope = xy / xx;
  for (std::size_t k = 0; k < n; ++k) {
    const double left = y[k] - mean_y - fit.slope * (x[k] - mean_x);
    fit.residual += left * left;
  }
  const boost::math::students_t distribution(count - 2);
  const double reach =
      boost::math::quantile(distribution, 0.975) * std::sqrt(fit.residual / (count - 2) / xx);
  fit.low = fit.slope - reach;
  fit.high = fit.slope + reach;
  return fit;
}

std::vector<Fit> fits_of(const DerivationStudy& study, const std::vector<Derived>& all) {
  std::vector<Fit> fits;
  for (const DerivationSweep& sweep : study.sweeps) {
    const auto add = [&](const std::string& quantity, auto&& value, bool also_exponential) {
      const Fit power = fit_of(study, all, sweep.method, quantity, true, value);
      const Fit exponential = fit_of(study, all, sweep.method, quantity, false, value);
      const bool better = also_exponential && exponential.slope.residual < power.slope.residual;
      if (power.slope.points > 0) fits.push_back(better ? exponential : power);
    };
    add(
        "operations", [](const Derived& d) { return static_cast<double>(d.operations); }, false);
    add(
        "seconds", [](const Derived& d) { return d.seconds; }, false);
    add(
        "tree", [](const Derived& d) { return d.tree; }, true);
  }
  return fits;
}

void write_derivation_tables(const std::filesystem::path& directory, const std::vector<Derived>& all,
                             const std::vector<Fit>& fits) {
  std::string results = "method,size,constraints,equations,operations,nodes,tree_operations\n";
  std::string costs = "method,size,constraints,seconds\n";
  for (const Derived& d : all) {
    const std::string begin = d.method + "," + csv_quoted(d.size) + "," + std::to_string(d.rods) + ",";
    results += begin + std::to_string(d.equations) + "," + std::to_string(d.operations) + "," +
               std::to_string(d.nodes) + "," + (std::isfinite(d.tree) ? formatted("%.17g", d.tree) : "") +
               "\n";
    costs += begin + formatted("%.9g", d.seconds) + "\n";
  }
  std::string slopes = "method,quantity,law,points,from,to,exponent,low,high\n";
  for (const Fit& fit : fits) {
    slopes += fit.method + "," + fit.quantity + "," + fit.law + "," + std::to_string(fit.slope.points);
    for (const double x : {fit.from, fit.to, fit.slope.slope, fit.slope.low, fit.slope.high})
      slopes += "," + formatted("%.9g", x);
    slopes += "\n";
  }
  write_file(directory / "results.csv", results);
  write_file(directory / "cost.csv", costs);
  write_file(directory / "fits.csv", slopes);
}

std::string derivation_table(const DerivationStudy& study, const std::vector<Derived>& all,
                             const std::vector<Fit>& fits) {
  TextStream text;
  const auto put = [&](const char* method, const char* rods, const char* operations, const char* seconds,
                       const char* a, const char* b, const char* c) {
    text << formatted("%-18s %5s %11s %9s  %-17s %-17s %s\n", method, rods, operations, seconds, a, b, c);
  };
  text << "\nall equations of " << study.system << " with K constraints, and how they grow with K\n";
  put("method", "K", "operations", "seconds", "operations grow", "seconds grow", "without sharing");
  for (const DerivationSweep& sweep : study.sweeps) {
    const Derived* last = nullptr;
    for (const Derived& d : all)
      if (d.method == sweep.method) last = &d;
    if (last == nullptr) continue;
    const auto growth = [&](const char* quantity) -> std::string {
      const Fit* fit = found_fit(fits, sweep.method, quantity);
      if (fit == nullptr) return "-";
      const double spread = (fit->slope.high - fit->slope.low) / 2;
      return fit->law == "power" ? formatted("K^(%.2f+-%.2f)", fit->slope.slope, spread)
                                 : formatted("e^(%.3f+-%.3f K)", fit->slope.slope, spread);
    };
    put(sweep.method.c_str(), std::to_string(last->rods).c_str(), std::to_string(last->operations).c_str(),
        formatted("%.2g", last->seconds).c_str(), growth("operations").c_str(), growth("seconds").c_str(),
        growth("tree").c_str());
  }
  return text.str();
}

void judge_derivations(const DerivationStudy& study, const std::vector<Fit>& fits,
                       ExperimentOutcome& outcome) {
  for (const DerivationSweep& sweep : study.sweeps) {
    const Fit* fit = found_fit(fits, sweep.method, "operations");
    if (sweep.exponent_below == 0 || fit == nullptr) continue;
    const bool holds = fit->slope.slope < sweep.exponent_below;
    outcome.findings.push_back({{"method", sweep.method},
                                {"measure", "exponent of operations"},
                                {"relation", "stays-below"},
                                {"bound", sweep.exponent_below},
                                {"measured", fit->slope.slope},
                                {"holds", holds}});
    if (!holds)
      outcome.failed_claims +=
          (outcome.failed_claims.empty() ? "" : "; ") +
          ("operations of " + sweep.method + " grow like K^" + formatted("%.2f", fit->slope.slope) +
           ", expected below K^" + formatted("%.2f", sweep.exponent_below));
  }
}

}  // namespace pfaff
