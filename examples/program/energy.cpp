// Integrates the pendulum with a symplectic method and with one that is not, and prints what becomes of the
// energy.
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/invariant_errors.hpp>

#include <cstdio>
#include <exception>

int main() {
  try {
    for (const char* method : {"verlet", "rk4"}) {
      auto run = pfaff::integrate("pendulum", {{"omega", "2"}}, method, {}, {.step = "0.1"});
      pfaff::InvariantErrors errors;
      run.watch(errors, 100);
      run.steps(1'000'000).expect_reached();
      std::printf("%-8s %.1e\n", method, errors.largest()[0]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "energy: %s\n", error.what());
    return 1;
  }
}
