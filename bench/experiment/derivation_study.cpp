#include <pfaff/bench/experiment/derivation_study.hpp>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>
#include <sstream>

#include <pfaff/bench/derivation/derivation.hpp>
#include <pfaff/bench/experiment/cells.hpp>
#include <pfaff/bench/experiment/citations.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/directory_lock.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {

constexpr const char* experiment_file = "experiment.json";

/// A derivation that was made.
struct Derived {
  std::string method, size;
  std::size_t rods = 0, equations = 0, operations = 0, nodes = 0;
  double tree = 0;  // infinite beyond the range of doubles
  double seconds = 0;
};

nlohmann::json to_json(const Derived& d) {
  nlohmann::json j{{"schema", 1},
                   {"method", d.method},
                   {"size", d.size},
                   {"constraints", d.rods},
                   {"equations", d.equations},
                   {"operations", d.operations},
                   {"nodes", d.nodes},
                   {"tree_operations", nullptr},
                   {"seconds", d.seconds}};
  if (std::isfinite(d.tree)) j["tree_operations"] = d.tree;
  return j;
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Derived derived(const DerivationStudy& study, const std::string& method, const std::string& size) {
  Assignments settings = study.set;
  settings.emplace_back(study.parameter, size);
  const std::shared_ptr<const Model> model = system_named(study.system).make(settings);
  Derived result{.method = method, .size = size};
  result.seconds = HUGE_VAL;
  double all = 0;
  // Quick derivations are repeated, because the first one also warms the processor's memory.
  constexpr double enough = 0.03;
  constexpr int most = 10;
  for (int k = 0; k < most && all < enough; ++k) {
    const double begin = processor_seconds();
    const Equations equations = derive(*model, method, FrictionForm::none);
    const double taken = processor_seconds() - begin;
    all += taken;
    result.seconds = std::min(result.seconds, taken);
    result.equations = equations.coordinates.size();
    result.operations = operations(equations.tape);
    result.nodes = equations.tape.code.size();
    result.tree = tree_operations(equations.tape);
  }
  result.rods = model->source().constraint_names.size();
  return result;
}

// A derivation that the directory holds, whole.
std::optional<Derived> kept(const fs::path& file, const std::string& method, const std::string& size) {
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  const nlohmann::json j = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!j.is_object() || j.value("method", "") != method || j.value("size", "") != size) return std::nullopt;
  for (const char* key : {"constraints", "equations", "operations", "nodes", "seconds"})
    if (!j.contains(key) || !j[key].is_number()) return std::nullopt;
  Derived d{.method = method, .size = size};
  d.rods = j["constraints"];
  d.equations = j["equations"];
  d.operations = j["operations"];
  d.nodes = j["nodes"];
  d.seconds = j["seconds"];
  d.tree = j.contains("tree_operations") && j["tree_operations"].is_number()
               ? j["tree_operations"].get<double>()
               : HUGE_VAL;
  return d;
}

nlohmann::json description(const Experiment& experiment) {
  const DerivationStudy& study = *experiment.derivation;
  nlohmann::json j{{"schema", 1},
                   {"kind", "derivation"},
                   {"name", experiment.name},
                   {"title", experiment.title},
                   {"description", experiment.description},
                   {"reference", experiment.reference},
                   {"citation", nlohmann::json::array()},
                   {"notes", experiment.notes},
                   {"quick", experiment.quick},
                   {"versions", versions()},
                   {"system", study.system},
                   {"parameter", study.parameter},
                   {"parameters", nlohmann::json::object()},
                   {"seconds", study.seconds},
                   {"fit_from", study.fit_from},
                   {"methods", nlohmann::json::array()},
                   {"published", nlohmann::json::array()}};
  for (const std::string& key : experiment.reference) j["citation"].push_back(citation(key));
  for (const auto& [key, value] : study.set) j["parameters"][key] = value;
  for (const DerivationSweep& sweep : study.sweeps)
    for (const DerivationMethod& method : derivation_methods())
      if (method.name == sweep.method)
        j["methods"].push_back({{"name", sweep.method}, {"title", method.title}, {"sizes", sweep.sizes}});
  for (const PublishedTime& p : study.published)
    j["published"].push_back({{"label", p.label}, {"factor", p.factor}, {"rate", p.rate}});
  return j;
}

struct Fit {
  std::string method, quantity, law;
  double from = 0, to = 0;
  FittedSlope slope;
};

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

std::vector<Fit> fits_of(const DerivationStudy& study, const std::vector<Derived>& all) {
  std::vector<Fit> fits;
  for (const DerivationSweep& sweep : study.sweeps) {
    const auto add = [&](const std::string& quantity, auto&& value, bool also_exponential) {
      const Fit power = fit_of(study, all, sweep.method, quantity, true, value);
      const Fit exponential = fit_of(study, all, sweep.method, quantity, false, value);
      const bool better = also_exponential && exponential.slope.residual < power.slope.residual;
      if (power.slope.points > 0) fits.push_back(better ? exponential : power);
    };
    add("operations", [](const Derived& d) { return static_cast<double>(d.operations); }, false);
    add("seconds", [](const Derived& d) { return d.seconds; }, false);
    add("tree", [](const Derived& d) { return d.tree; }, true);
  }
  return fits;
}

const Fit* found_fit(const std::vector<Fit>& fits, const std::string& method, const std::string& quantity) {
  const auto found = std::find_if(fits.begin(), fits.end(), [&](const Fit& fit) {
    return fit.method == method && fit.quantity == quantity;
  });
  return found == fits.end() ? nullptr : &*found;
}

void write_tables(const fs::path& directory, const std::vector<Derived>& all, const std::vector<Fit>& fits) {
  std::string results = "method,size,constraints,equations,operations,nodes,tree_operations\n";
  std::string costs = "method,size,constraints,seconds\n";
  for (const Derived& d : all) {
    const std::string begin = d.method + "," + csv_quoted(d.size) + "," + std::to_string(d.rods) + ",";
    results += begin + std::to_string(d.equations) + "," + std::to_string(d.operations) + "," +
               std::to_string(d.nodes) + "," + (std::isfinite(d.tree) ? as_text(d.tree, "%.17g") : "") + "\n";
    costs += begin + as_text(d.seconds, "%.9g") + "\n";
  }
  std::string slopes = "method,quantity,law,points,from,to,exponent,low,high\n";
  for (const Fit& fit : fits) {
    slopes += fit.method + "," + fit.quantity + "," + fit.law + "," + std::to_string(fit.slope.points);
    for (const double x : {fit.from, fit.to, fit.slope.slope, fit.slope.low, fit.slope.high})
      slopes += "," + as_text(x, "%.9g");
    slopes += "\n";
  }
  write_file(directory / "results.csv", results);
  write_file(directory / "cost.csv", costs);
  write_file(directory / "fits.csv", slopes);
}

// For the terminal, of each method its largest derivation and its growth.
std::string table_of(const DerivationStudy& study, const std::vector<Derived>& all,
                     const std::vector<Fit>& fits) {
  std::ostringstream text;
  std::array<char, 160> line{};
  const auto put = [&](const char* method, const char* rods, const char* operations, const char* seconds,
                       const char* a, const char* b, const char* c) {
    (void)std::snprintf(line.data(), line.size(), "%-18s %5s %11s %9s  %-17s %-17s %s\n", method, rods,
                        operations, seconds, a, b, c);
    text << line.data();
  };
  text << "\nall equations of " << study.system << " with K constraints, and how they grow with K\n";
  put("method", "K", "operations", "seconds", "operations", "seconds", "without sharing");
  for (const DerivationSweep& sweep : study.sweeps) {
    const Derived* last = nullptr;
    for (const Derived& d : all)
      if (d.method == sweep.method) last = &d;
    if (last == nullptr) continue;
    const auto growth = [&](const char* quantity) -> std::string {
      const Fit* fit = found_fit(fits, sweep.method, quantity);
      if (fit == nullptr) return "-";
      std::array<char, 60> cell{};
      (void)std::snprintf(cell.data(), cell.size(),
                          fit->law == "power" ? "K^(%.2f+-%.2f)" : "e^(%.3f+-%.3f K)", fit->slope.slope,
                          (fit->slope.high - fit->slope.low) / 2);
      return cell.data();
    };
    put(sweep.method.c_str(), std::to_string(last->rods).c_str(), std::to_string(last->operations).c_str(),
        as_text(last->seconds, "%.2g").c_str(), growth("operations").c_str(), growth("seconds").c_str(),
        growth("tree").c_str());
  }
  return text.str();
}

void judge(const DerivationStudy& study, const std::vector<Fit>& fits, ExperimentOutcome& outcome) {
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
      outcome.failed_claims += (outcome.failed_claims.empty() ? "" : "; ") +
                               ("operations of " + sweep.method + " grow like K^" +
                                as_text(fit->slope.slope, "%.2f") + ", expected below K^" +
                                as_text(sweep.exponent_below, "%.2f"));
  }
}

// Refuses a directory with another experiment, or with one that another build made.
void check_identity(const fs::path& directory, const nlohmann::json& mine, bool force) {
  const fs::path identity = directory / experiment_file;
  std::error_code error;
  if (!fs::exists(identity, error)) return;
  nlohmann::json theirs = nlohmann::json::parse(read_file(identity), nullptr, false);
  if (!theirs.is_object() || !theirs.contains("schema")) return;
  const bool same_build = theirs["versions"] == mine["versions"];
  theirs["versions"] = mine["versions"];
  const std::string where = "output directory '" + directory.string() + "' holds ";
  if (theirs != mine)
    throw InputError(where + "another experiment; expected a new directory or the same experiment to resume");
  if (!same_build && !force)
    throw InputError(where + "derivations by another build of Pfaff; expected a new directory, or --force " +
                     "to make them anew");
  if (same_build && !force) return;
  fs::remove_all(directory / "runs", error);
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
  const double reach = boost::math::quantile(distribution, 0.975) * std::sqrt(fit.residual / (count - 2) / xx);
  fit.low = fit.slope - reach;
  fit.high = fit.slope + reach;
  return fit;
}

ExperimentOutcome run_derivation_study(
    const Experiment& experiment, const fs::path& directory,
    const std::function<void(const std::string& what, std::size_t done, std::size_t all)>& progress,
    bool force) {
  const DerivationStudy& study = *experiment.derivation;
  // Every size is made once before anything is derived, so that mistakes are found first.
  for (const DerivationSweep& sweep : study.sweeps)
    for (const std::string& size : sweep.sizes) {
      Assignments settings = study.set;
      settings.emplace_back(study.parameter, size);
      const auto model = system_named(study.system).make(settings);
      if (const std::string reason = derivation_misfit(*model, sweep.method); !reason.empty())
        throw InputError(experiment.name + ": " + reason);
    }
  const nlohmann::json described = description(experiment);
  std::error_code error;
  if (!fs::exists(directory / experiment_file, error)) make_output_directory(directory, {experiment_file});
  const DirectoryLock held(directory, "pfaff compare");
  check_identity(directory, described, force);
  write_file(directory / experiment_file, described.dump(1) + "\n");
  ExperimentOutcome outcome;
  std::vector<Derived> all;
  std::size_t done = 0;
  for (const DerivationSweep& sweep : study.sweeps)
    for (const std::string& size : sweep.sizes) {
      const fs::path run = directory / "runs" / (sweep.method + "-" + size);
      const fs::path file = run / "summary.json";
      if (progress) progress("method " + sweep.method + ", " + study.parameter + " " + size, done, study.size());
      ++done;
      const std::optional<Derived> before = kept(file, sweep.method, size);
      outcome.resumed += before.has_value() ? 1 : 0;
      all.push_back(before ? *before : derived(study, sweep.method, size));
      if (!before) {
        fs::create_directories(run, error);
        write_file(file, to_json(all.back()).dump(1) + "\n");
      }
      if (all.back().seconds > study.seconds) {
        done += static_cast<std::size_t>(&sweep.sizes.back() - &size);
        break;
      }
    }
  outcome.runs = all.size();
  const std::vector<Fit> fits = fits_of(study, all);
  write_tables(directory, all, fits);
  judge(study, fits, outcome);
  outcome.table = table_of(study, all, fits);
  if (progress) progress("figures and report", study.size(), study.size());
  outcome.report = make_report(directory);
  return outcome;
}

}  // namespace pfaff
