#include <pfaff/core/facets/taped_velocity_constraints.hpp>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

VelocityTapes record_velocity(const Model& model) {
  using Numbers = std::vector<Recorded>;
  const auto a = model.tape(Formula::velocity_constraints), b = model.tape(Formula::velocity_offsets),
             phi = model.given(Formula::holonomic) ? model.tape(Formula::holonomic) : nullptr;
  VelocityTapes tapes;
  tapes.gradient = slopes_of_motion(model);
  const std::size_t n = tapes.degrees = static_cast<std::size_t>(a->inputs),
                    holonomic = phi == nullptr ? 0 : phi->outputs.size();
  tapes.count = holonomic + b->outputs.size();
  const int inputs = static_cast<int>(2 * n);
  const auto positions = [&](const Numbers& z) { return std::span<const Recorded>(z).first(n); };

  const auto rows = [&](const Recorded& t, const Numbers& z) {
    Numbers all = phi == nullptr ? Numbers{} : jacobian(*phi, t, positions(z));
    append(all, evaluate(*a, t, positions(z)));
    return all;
  };
  tapes.values = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers slopes = evaluate(*tapes.gradient, t, z), offsets = evaluate(*b, t, positions(z)),
                  every = evaluate(*a, t, positions(z));
    const auto v = std::span<const Recorded>(slopes).subspan(n);
    if (phi != nullptr) append(out, directional_derivative(*phi, t, Recorded(1), positions(z), v));
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      Recorded sum = offsets[i];
      for (std::size_t k = 0; k < n; ++k) sum = sum + every[i * n + k] * v[k];
      out.push_back(sum);
    }
  });
  const Tape& psi = *tapes.values;

  const auto linear = [&](const Recorded& t, const Numbers& z, Numbers& out) {
    const Numbers every = rows(t, z), slopes = jacobian(psi, t, z);
    record_linear(RecordedMatrix{every, tapes.count, n, n, 0}.sparse(),
                  RecordedMatrix{slopes, tapes.count, n, 2 * n, n}.sparse(), tapes, out);
  };
  tapes.linear = record_list(inputs, linear);
  tapes.place = record_list(inputs, [&](const Recorded& t, const Numbers& z, Numbers& out) {
    linear(t, z, out);
    const Numbers flow = flow_of(*tapes.gradient, t, z);
    append(out, flow);
    append(out, evaluate(psi, t, z));
    append(out, directional_derivative(psi, t, Recorded(1), z, flow));
  });
  return tapes;
}

}  // namespace pfaff
