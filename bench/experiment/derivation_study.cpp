#include <pfaff/bench/experiment/derivation_study.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/bench/runner/toml_keys.hpp>
#include <pfaff/bench/studies/derivation_methods.hpp>

namespace pfaff {

namespace {

double positive(Keys& keys, const std::string& key, const std::string& fallback) {
  return keys.read(key, fallback, [](const std::string& text) {
    const auto number = Real::parse(text);
    if (!number || !(number->value() > 0) || !std::isfinite(number->value()))
      throw InputError("expected a number > 0, got '" + text + "'");
    return number->value();
  });
}

DerivationSweep read_sweep(const toml::table& table, const std::string& where, bool quick) {
  Keys keys(table, where + " [[derive]]");
  DerivationSweep sweep;
  sweep.method = keys.required("method");
  std::vector<std::string> names;
  for (const DerivationMethod& method : derivation_methods()) names.push_back(method.name);
  if (std::find(names.begin(), names.end(), sweep.method) == names.end())
    throw InputError(where + " [[derive]]: " + unknown_name("method", sweep.method, names));
  sweep.sizes = keys.list_of_some("sizes");
  if (!keys.text("exponent_below", "").empty()) sweep.exponent_below = positive(keys, "exponent_below", "");
  if (const toml::table* less = keys.table("quick")) {
    Keys fewer(*less, where + " [derive.quick]");
    const std::vector<std::string> sizes = fewer.list_of_some("sizes");
    fewer.finish();
    if (quick) sweep.sizes = sizes;
  }
  keys.finish();
  if (sweep.sizes.empty()) throw InputError(where + " [[derive]]: key 'sizes' is missing");
  return sweep;
}

}  // namespace

std::size_t DerivationStudy::size() const {
  std::size_t count = 0;
  for (const DerivationSweep& sweep : sweeps) count += sweep.sizes.size();
  return count;
}

DerivationStudy read_derivation_study(Keys& keys, const std::string& where, bool quick) {
  DerivationStudy study;
  study.system = keys.required("system");
  study.parameter = keys.required("parameter");
  study.set = keys.assignments("set");
  study.seconds = positive(keys, "seconds", "60");
  study.fit_from = positive(keys, "fit_from", "8");
  for (const toml::table* table : keys.tables("derive"))
    study.sweeps.push_back(read_sweep(*table, where, quick));
  for (const toml::table* table : keys.tables("published", false)) {
    Keys published(*table, where + " [[published]]");
    study.published.push_back({published.required("label"), 0, 0});
    (void)published.required("factor");
    (void)published.required("rate");
    study.published.back().factor = positive(published, "factor", "");
    study.published.back().rate = positive(published, "rate", "");
    published.finish();
  }
  return study;
}

}  // namespace pfaff
