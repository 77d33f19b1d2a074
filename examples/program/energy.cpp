// Integrates the pendulum with a symplectic method and with one that is not, and prints what becomes of the
// energy.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

namespace {

// The largest energy error along `steps` steps of size h, looked at every hundred steps.
double energy_error(const pfaff::MethodInstance& method, const std::shared_ptr<const pfaff::Model>& model,
                    double h, std::int64_t steps) {
  std::vector<double> z;
  for (const pfaff::Real& x : model->initial()) z.push_back(x.value());
  const pfaff::Problem<double> problem(model);
  const auto energy = [&](double t) {
    std::vector<double> values(model->invariants().size());
    problem.invariants(t, z, values);
    return values[0];
  };
  const auto stepper = method.stepper(model, double());
  const double start = energy(0);
  double worst = 0;
  for (std::int64_t done = 0, completed = 0; done < steps; done += completed) {
    const auto count = std::min<std::int64_t>(100, steps - done);
    const pfaff::Status status = stepper->advance(0, done, h, count, z, completed);
    if (status != pfaff::Status::converged) throw pfaff::RunError(std::string(to_string(status)));
    worst = std::max(worst, std::abs(energy(h * static_cast<double>(done + completed)) - start));
  }
  return worst;
}

}  // namespace

int main() {
  try {
    const auto model = pfaff::systems().get("pendulum", "system").make({{"omega", "2"}});
    for (const char* name : {"verlet", "rk4"}) {
      const auto method = pfaff::integrators().get(name, "integrator").make({});
      if (const std::string reason = method->refuses(*model); !reason.empty())
        throw pfaff::InputError(reason);
      std::printf("%-8s %.1e\n", name, energy_error(*method, model, 0.1, 1'000'000));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "energy: %s\n", error.what());
    return 1;
  }
}
