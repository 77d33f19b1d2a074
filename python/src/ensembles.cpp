// Ensembles: one method from many initial states, over threads.
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include <pfaff/core/facets/tile_rows.hpp>
#include <pfaff/python/src/arrays.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/python/src/stepping.hpp>
#include <pfaff/runs/integrate.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
using States = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Writes the states that go by into the rows of one trajectory, the start in the first.
class RowWriterOf final : public Watcher<double> {
 public:
  void start(const Integration<double>& /*run*/) override {}
  void look(const Integration<double>& /*run*/, const Block<double>& block) override {
    copy_rows(block.states, {.count = block.rows}, to);
    to += block.rows * block.states.components();
  }
  double* to = nullptr;
};

struct Asked {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MethodInstance> method;
  double h, t0;
  std::int64_t steps, every;
  std::size_t states, dimension, rows;
  const double* from;
  double* to;
  SharedObject callback;  // called when a trajectory has ended, with its index
};

// The trajectories of an ensemble, which threads take one after another.
class Work {
 public:
  Work(const Asked& asked, const std::atomic<bool>& stop)
      : asked_(asked), stop_(stop), failures(asked.states), done(asked.states, 0) {}

  // Takes trajectories until there are none left, or somebody has failed or asked for the end.
  void take_all(SavedError& saved) {
    try {
      const SavedError::Scope scope(saved);
      const Budget budget({}, &stop_);
      RowWriterOf writer;
      std::optional<Integration<double>> run;
      for (std::size_t k = next_++; k < asked_.states && !ends_; k = next_++) one(k, run, writer);
    } catch (...) {
      ends_ = true;
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void one(std::size_t k, std::optional<Integration<double>>& run, RowWriterOf& writer) {
    const std::size_t n = asked_.dimension;
    const double* const from = asked_.from + k * n;
    double* const to = asked_.to + k * asked_.rows * n;
    std::copy_n(from, n, to);
    writer.to = to + n;
    std::vector<double> state(from, from + n);
    if (run) {
      run->go_on_from(std::move(state), asked_.t0, asked_.h);
      run->forget();
    } else {
      run.emplace(start_with(*asked_.method, asked_.model, std::move(state), asked_.h, asked_.t0));
      run->watch(writer, asked_.every);
    }
    const Outcome outcome = run->steps(asked_.steps);
    if (!outcome.reached()) failures[k] = outcome.message();
    done[k] = 1;
    if (asked_.callback) with_lock([&] { asked_.callback.get()(k); });
  }

  const Asked& asked_;
  const std::atomic<bool>& stop_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> ends_{false};
  std::mutex mutex_;
  std::exception_ptr thrown_;

 public:
  std::vector<std::string> failures;  // why each of them ended early; or empty
  std::vector<int> done;
};

// Fills `to`, of shape (states, rows, dimension). Gives the message of each trajectory that failed, empty
// ones for others, by `report`, also where something is raised.
void ensemble(const PySystem& system, const PyMethod& method, const States& states, py::array_t<double>& to,
              double h, double t0, std::int64_t steps, std::int64_t every, std::size_t threads,
              const py::object& callback, const py::object& report) {
  Asked asked{without_lock([&] { return model_for(*method.method, system.model, ""); }),
              method.method,
              h,
              t0,
              steps,
              every,
              static_cast<std::size_t>(states.shape(0)),
              static_cast<std::size_t>(states.shape(1)),
              static_cast<std::size_t>(to.shape(1)),
              states.data(),
              to.mutable_data(),
              callback.is_none() ? SharedObject() : SharedObject(callback)};
  std::fill_n(asked.to, to.size(), std::numeric_limits<double>::quiet_NaN());
  if (asked.states == 0) return;
  const Interruption interruption;
  Work work(asked, interruption.stop());
  const auto all = [&] {
    without_lock([&] {
      // The first state is checked as that of any integration is, before work starts.
      (void)begun(start_with(*asked.method, asked.model,
                             std::vector<double>(asked.from, asked.from + asked.dimension), h, t0));
      SavedError saved;  // of all threads; raised below
      std::vector<std::thread> others;
      for (std::size_t k = 1; k < std::min(threads, asked.states); ++k)
        others.emplace_back([&] { work.take_all(saved); });
      work.take_all(saved);
      for (std::thread& thread : others) thread.join();
      if (saved.holds()) {
        const py::gil_scoped_acquire lock;
        raise_saved(saved);
      }
      work.rethrow();
    });
  };
  try {
    all();
  } catch (...) {
    report(work.failures, work.done);
    throw;
  }
  report(work.failures, work.done);
}
}  // namespace

void bind_ensembles(py::module_& module) { module.def("ensemble", &ensemble); }

}  // namespace pfaff::python
