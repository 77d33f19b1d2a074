// Nothing that is asked of rods while a run goes on allocates. The global operator new of this program counts
// while it is told to.
#include <atomic>
#include <cstdlib>
#include <new>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>

#include "bead_rod_files.hpp"

namespace {
std::atomic<bool> counting = false;
std::atomic<long> allocations = 0;

void* allocate(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory = alignment <= alignof(std::max_align_t) ? std::malloc(size == 0 ? 1 : size)
                                                        : std::aligned_alloc(alignment, whole);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/,
                                       std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}

namespace {
using namespace pfaff;

template <class Work>
long allocations_of(Work&& work) {
  allocations = 0;
  counting = true;
  work();
  counting = false;
  return allocations;
}

template <class T>
void expect_none(const std::string& system, const Assignments& parameters) {
  const auto model = systems().get(system, "system").make(parameters);
  std::vector<T> z, rate(static_cast<std::size_t>(model->dimension()));
  for (const Real& x : model->initial()) z.push_back(T(x));
  const std::size_t n = z.size() / 2;
  const In<T> q(z.data(), n), p(z.data() + n, n);
  for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"}) {
    const auto field =
        make_evaluator<T>(formulations().get(formulation, "formulation").apply(model, {}), Formula::field);
    EXPECT_EQ(allocations_of([&] { field.call(field.context, T(0), z.data(), rate.data()); }), 0)
        << system << ' ' << formulation;
  }
  const auto constraints = model->holonomic_constraints<T>();
  std::vector<T> phi(constraints->count()), along(n);
  EXPECT_EQ(allocations_of([&] {
              constraints->values(T(0), q, phi);
              constraints->hidden_values(T(0), q, p, phi);
              constraints->velocity(T(0), q, p, along);
              constraints->force(T(0), q, p, along);
              constraints->linearise(T(0), q, p);
              constraints->apply(q, phi);
              constraints->solve(phi, phi);
              constraints->apply_transpose(phi, along);
              constraints->place(T(0), q, p);
              constraints->factor_friction();
              constraints->solve_friction(phi, phi);
            }),
            0)
      << system;
}

TEST(BeadRodAllocation, NoneInAnEvaluation) {
  // The counter counts: a vector is an allocation.
  EXPECT_EQ(allocations_of([] { const std::vector<double> v(100); }), 1);
  const Assignments cells{{"beads", "40"}, {"cutoff", "2.5"}, {"friction", "0.2"}};
  expect_none<double>("chain-molecule", cells);
  expect_none<Quad>("chain-molecule", cells);
  expect_none<double>("n-pendulum", {{"bobs", "33"}});
  expect_none<double>("ring", {{"beads", "12"}, {"friction", "0.1"}});
  expect_none<double>("humanoid", {});
  expect_none<Quad>("humanoid", {});
  expect_none<double>("four-bar", {});
}

}  // namespace
