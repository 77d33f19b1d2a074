#include <pfaff/runs/support/watched_quantity.hpp>

namespace pfaff {

namespace {
using OfField = QuantityField::Value;
using Watched = WatchedQuantity;

OfField known(const std::optional<double>& x) { return x ? OfField(*x) : OfField(); }
OfField middle_of(const std::optional<windows::Estimate>& x) { return x ? OfField(x->value) : OfField(); }
OfField low_of(const std::optional<windows::Estimate>& x) { return x ? OfField(x->low) : OfField(); }
OfField high_of(const std::optional<windows::Estimate>& x) { return x ? OfField(x->high) : OfField(); }
}  // namespace

const std::vector<QuantityField>& quantity_fields() {
  using Of = QuantityField::Of;
  static const std::vector<QuantityField> fields{
      {"max", "[e]", "the largest size of I(t) - I(0), or of the residual", true, true, Of::both,
       [](const Watched& q) { return OfField(q.drift.maximum); }},
      {"rms", "[e]", "the root of its mean square", true, true, Of::both,
       [](const Watched& q) { return OfField(q.drift.rms); }},
      {"final", "[e]", "the last value", true, true, Of::both,
       [](const Watched& q) { return OfField(q.drift.final_value); }},
      {"slope", "[e]/[t]", "the linear trend", true, false, Of::both,
       [](const Watched& q) { return OfField(q.drift.slope); }},
      {"slope_low", "[e]/[t]", "the lower end of its 95 % interval", true, false, Of::both,
       [](const Watched& q) { return OfField(q.drift.slope_low); }},
      {"slope_high", "[e]/[t]", "the upper end", true, false, Of::both,
       [](const Watched& q) { return OfField(q.drift.slope_high); }},
      {"oscillation", "[e]", "half of the range about the trend", true, false, Of::both,
       [](const Watched& q) { return OfField(q.drift.oscillation_amplitude); }},
      {"exponent", "", "the power of time with which it grows", true, false, Of::both,
       [](const Watched& q) { return middle_of(q.drift.exponent); }},
      {"exponent_low", "", "the lower end of its interval", false, false, Of::both,
       [](const Watched& q) { return low_of(q.drift.exponent); }},
      {"exponent_high", "", "the upper end", false, false, Of::both,
       [](const Watched& q) { return high_of(q.drift.exponent); }},
      {"rate", "1/[t]", "the rate of exponential growth", false, false, Of::both,
       [](const Watched& q) { return middle_of(q.drift.rate); }},
      {"rate_low", "1/[t]", "the lower end of its interval", false, false, Of::both,
       [](const Watched& q) { return low_of(q.drift.rate); }},
      {"rate_high", "1/[t]", "the upper end", false, false, Of::both,
       [](const Watched& q) { return high_of(q.drift.rate); }},
      {"class", "", "the class of its drift", true, false, Of::both,
       [](const Watched& q) { return OfField(std::string(to_string(q.drift.drift_class))); }},
      {"evidence", "", "why it is of that class", false, false, Of::both,
       [](const Watched& q) { return OfField(q.drift.evidence); }},
      {"samples", "", "how many values that is found from", false, false, Of::both,
       [](const Watched& q) { return OfField(static_cast<std::int64_t>(q.drift.samples)); }},
      {"scale", "[e]", "the largest sum of the sizes of its terms", false, false, Of::conserved,
       [](const Watched& q) { return OfField(q.round_off.scale); }},
      {"propagated", "[e]", "what the roundings of a state change, over the unit of round-off", false, false,
       Of::conserved, [](const Watched& q) { return known(q.round_off.propagated); }},
      {"range", "[e]", "how much of it there is to lose", false, false, Of::conserved,
       [](const Watched& q) { return known(q.round_off.range); }},
      {"growth", "", "the power of time with which the largest value so far grows", true, true, Of::residuals,
       [](const Watched& q) { return q.growth ? OfField(q.growth->exponent) : OfField(); }},
      {"growth_rate", "1/[t]", "the rate with which it grows", true, true, Of::residuals,
       [](const Watched& q) { return q.growth ? OfField(q.growth->rate) : OfField(); }}};
  return fields;
}

std::string unit_of(const QuantityField& field, const std::string& quantity, const std::string& time) {
  std::string text = field.unit;
  const auto put = [&](const std::string& place, const std::string& unit) {
    if (const std::size_t at = text.find(place); at != std::string::npos)
      text.replace(at, place.size(), unit.empty() ? "1" : unit);
  };
  put("[e]", quantity);
  put("[t]", time);
  return text == "1" || text == "1/1" ? "" : text;
}

}  // namespace pfaff
