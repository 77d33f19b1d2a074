// Published numbers of other works than the three papers, by section: "solutions" at printed times, "methods"
// with printed errors, "books" with figures and statements.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/papers/rows.hpp>

namespace pfaff::others {

void solution_rows(Rows& rows);
void method_rows(Rows& rows);
void book_rows(Rows& rows);

/// The path of a model or table that ships as an example: "models/pleiades.toml".
std::string example(const std::string& name);

/// A run of a registered method, or of a table of the examples, on a system.
struct Asked {
  std::string system, integrator;
  Assignments set;  // system.KEY and integrator.KEY
  std::string step, time;
  std::vector<std::string> initial = {};  // empty: the system's own
};
ResolvedRun resolved(const Asked& asked);

/// The state at the end by the system's exact solution or by Taylor series in quad.
Numbers solution_at_end(const ResolvedRun& run);

/// The state at the end, in double, by a method that chooses its steps. RunError where it fails.
Numbers state_at_end(const std::string& system, const std::string& integrator, const std::string& tolerance,
                     const std::string& time);

/// Calls each(z) with the state before the first step and after every step, in the scalar T. RunError where a
/// step fails.
template <class T>
void follow(const ResolvedRun& run, const std::function<void(const std::vector<T>&)>& each);

/// The energy (the system's first invariant) less that at the start: at the end, and the largest in size.
struct EnergyError {
  Quad last = Quad(0);
  double largest = 0;
};
template <class T>
EnergyError energy_error(const ResolvedRun& run);

}  // namespace pfaff::others
