#include <pfaff/runs/measure.hpp>

#include <algorithm>
#include <cmath>
#include <new>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

template class Registry<MeasurePlugin>;

Registry<MeasurePlugin>& measures() {
  static Registry<MeasurePlugin> registry;
  return registry;
}

std::vector<std::int64_t> evenly(std::int64_t steps, int count) {
  std::vector<std::int64_t> numbers{0};
  for (int k = 1; k <= count; ++k)
    if (const std::int64_t step = steps * k / count; step > numbers.back()) numbers.push_back(step);
  return numbers;
}

std::vector<std::int64_t> evenly_in_logarithm(std::int64_t steps, int count) {
  std::vector<std::int64_t> numbers{1};
  for (int k = 1; k <= count; ++k) {
    const std::int64_t step =
        std::llround(std::pow(static_cast<double>(steps), static_cast<double>(k) / count));
    if (step > numbers.back()) numbers.push_back(step);
  }
  return numbers;
}

std::string MeasureInstance::called() const {
  return to_string(PluginValue{descriptor().name, parameters()});
}

namespace {
// What is wrong with the names of columns; or empty.
std::string wrong_names(const std::vector<Column>& columns) {
  for (auto column = columns.begin(); column != columns.end(); ++column) {
    const std::string& name = column->name;
    if (name.empty()) return "has a column without a name";
    if (std::find(columns_of_the_run.begin(), columns_of_the_run.end(), name) != columns_of_the_run.end())
      return "has a column '" + name + "', which every table of a measure has before its own";
    if (std::any_of(columns.begin(), column, [&](const Column& other) { return other.name == name; }))
      return "has two columns '" + name + "'";
  }
  return {};
}
}  // namespace

std::string MeasureInstance::refuses(const Model& model, const MethodInstance& method) const {
  std::string reason;
  try {
    reason = objection(model, method);
    if (reason.empty()) reason = wrong_names(columns(model));
  } catch (const BudgetSpent&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const InputError&) {  // of settings that name what the system has not
    throw;
  } catch (...) {
    reason = "fails: " + words_of_current_exception();
  }
  return reason.empty() ? reason : descriptor().name + " " + reason;
}

std::unique_ptr<MeasureInstance> measure_asked_for(const std::string& text) {
  const PluginValue value = parse_plugin_value(text, "measure");
  return measures().get(value.name, "measure").make(value.settings);
}

}  // namespace pfaff
