#include <pfaff/runs/measure.hpp>

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

std::string MeasureInstance::called() const {
  return to_string(PluginValue{descriptor().name, parameters()});
}

std::string MeasureInstance::refuses(const Model& model, const MethodInstance& method) const {
  const std::string reason = objection(model, method);
  return reason.empty() ? reason : descriptor().name + " " + reason;
}

std::unique_ptr<MeasureInstance> measure_asked_for(const std::string& text) {
  const PluginValue value = parse_plugin_value(text, "measure");
  return measures().get(value.name, "measure").make(value.settings);
}

}  // namespace pfaff
