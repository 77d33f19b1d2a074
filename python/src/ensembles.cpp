// Ensembles: one method from many initial states, over threads.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <pfaff/core/facets/tile_rows.hpp>
#include <pfaff/python/src/arrays.hpp>
#include <pfaff/python/src/asked_stepping.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/runs/integrate.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
using States = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Writes the states that go by into the rows of one trajectory, and how many rows there are.
template <class T>
class RowWriterOf final : public Watcher<T> {
 public:
  void start(const Integration<T>& /*run*/) override {}
  void look(const Integration<T>& /*run*/, const Block<T>& block) override {
    copy_rows(block.states, {.count = block.rows}, to);
    to += block.rows * block.states.components();
    *rows += static_cast<std::int64_t>(block.rows);
  }
  double* to = nullptr;
  std::int64_t* rows = nullptr;
};

// In quad a double stands for the decimal that it is printed as, as it does where Python gives it to an
// integration.
template <class T>
T number_as_printed(double x) {
  if constexpr (std::is_same_v<T, double>) {
    return x;
  } else {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.begin(), text.end(), x).ptr;
    return T(number_of(std::string(text.begin(), end), "states"));
  }
}

struct Asked {
  AskedStepping start;  // without a state
  std::int64_t steps, every;
  std::size_t states, dimension, rows;
  const double* from;
  double* times;
  double* to;             // of shape (states, rows, dimension)
  std::int64_t* reached;  // by each trajectory: how many of its rows
  bool* done;             // whether it has come to its end or its failure
  SharedObject callback;  // called when a trajectory has ended, with its index
  // As many as were begun, and others between them.
  [[nodiscard]] std::size_t begun() const {
    std::size_t count = states;
    while (count > 0 && reached[count - 1] == 0) --count;
    return count;
  }
};

void check_finite(const Asked& asked) {
  for (std::size_t k = 0; k < asked.states * asked.dimension; ++k)
    if (!std::isfinite(asked.from[k]))
      throw InputError("states: expected finite numbers; state " + std::to_string(k / asked.dimension) +
                       " has others");
}

// The trajectories of an ensemble, which threads take one after another.
template <class T>
class Work {
 public:
  Work(const Asked& asked, const std::atomic<bool>& stop)
      : asked_(asked), start_(start_in<T>(asked.start)), stop_(stop) {}

  // The first state is checked as that of any integration is.
  [[nodiscard]] Integration<T> first() const { return begun(start_at(0)); }
  [[nodiscard]] double time_of_row(std::size_t row) const {
    return static_cast<double>(start_.t0 +
                               T(static_cast<double>(asked_.every) * static_cast<double>(row)) * start_.h);
  }
  // Takes trajectories until there are none left, or somebody has failed or asked for the end, with an
  // integration that is there already or one of its own.
  void take_all(SavedError& saved, std::optional<Integration<T>> run = {}) {
    try {
      const SavedError::Scope scope(saved);
      const Budget budget({}, &stop_);
      RowWriterOf<T> writer;
      if (run) run->watch(writer, asked_.every);
      for (std::size_t k = next_++; k < asked_.states && !ends_; k = next_++) one(k, run, writer);
    } catch (...) {
      ends_ = true;
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
    }
  }
  // What was begun and not ended is NaN from there on. Memory that no trajectory has come to stays untouched,
  // since to fill it may take longer than anybody waits who has pressed Ctrl-C.
  void fill_begun() {
    for (std::size_t k = 0; k < asked_.begun(); ++k) fill_behind(k);
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }
  std::map<std::size_t, std::string> failures;  // why some of them ended early

 private:
  [[nodiscard]] Start<T> start_at(std::size_t k) const {
    Start<T> start = start_;
    const double* const from = asked_.from + k * asked_.dimension;
    for (std::size_t i = 0; i < asked_.dimension; ++i) start.state.push_back(number_as_printed<T>(from[i]));
    return start;
  }
  [[nodiscard]] double* row_of(std::size_t k, std::size_t row) const {
    return asked_.to + (k * asked_.rows + row) * asked_.dimension;
  }
  void fill_behind(std::size_t k) const {
    std::fill(row_of(k, static_cast<std::size_t>(asked_.reached[k])), row_of(k + 1, 0),
              std::numeric_limits<double>::quiet_NaN());
  }

  void one(std::size_t k, std::optional<Integration<T>>& run, RowWriterOf<T>& writer) {
    Start<T> start = start_at(k);
    std::transform(start.state.begin(), start.state.end(), row_of(k, 0),
                   [](const T& x) { return static_cast<double>(x); });
    writer.to = row_of(k, 1);
    writer.rows = &(asked_.reached[k] = 1);
    if (run && !run->adaptive()) {
      run->go_on_from(std::move(start.state), start.t0, start.h);
      run->forget();
    } else {  // what a step control has learnt stays with it, and the steps that it counts
      run.emplace(std::move(start));
      run->watch(writer, asked_.every);
    }
    if (const Outcome outcome = run->steps(asked_.steps); !outcome.reached()) {
      const std::lock_guard lock(mutex_);
      failures[k] = outcome.message();
    }
    asked_.done[k] = true;
    if (asked_.reached[k] < static_cast<std::int64_t>(asked_.rows)) fill_behind(k);
    if (asked_.callback) with_lock([&] { asked_.callback.get()(k); });
  }

  const Asked& asked_;
  const Start<T> start_;  // without a state
  const std::atomic<bool>& stop_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> ends_{false};
  std::mutex mutex_;
  std::exception_ptr thrown_;
};

// Fills what is asked for, and says of the trajectories that ended early why.
template <class T>
void take(const Asked& asked, std::size_t threads, const std::atomic<bool>& stop, py::dict& failures) {
  Work<T> work(asked, stop);
  for (std::size_t row = 0; row < asked.rows; ++row) asked.times[row] = work.time_of_row(row);
  const auto note_failures = [&] {
    for (const auto& [k, message] : work.failures) failures[py::int_(k)] = message;
  };
  const auto all = [&] {
    check_finite(asked);
    if (asked.states == 0) return;
    std::optional<Integration<T>> first(work.first());
    SavedError saved;  // of all threads
    std::vector<std::thread> others;
    for (std::size_t k = 1; k < std::min(threads, asked.states); ++k)
      others.emplace_back([&] { work.take_all(saved); });
    work.take_all(saved, std::move(first));
    for (std::thread& thread : others) thread.join();
    work.fill_begun();
    if (saved.holds()) {
      const py::gil_scoped_acquire lock;
      raise_saved(saved);
    }
    work.rethrow();
  };
  try {
    without_lock(all);
  } catch (...) {
    note_failures();
    throw;
  }
  note_failures();
}

// Puts "t", "y", "failures" and "done" of a pfaff.Ensemble into a dictionary, also where something is raised.
void ensemble(const PySystem& system, const PyMethod& method, const py::dict& asked_for, const States& states,
              std::int64_t steps, std::int64_t every, std::size_t threads, const py::object& callback,
              py::dict& into) {
  const py::ssize_t count = states.shape(0), rows = 1 + steps / every;
  py::array_t<double> t(rows), y({count, rows, states.shape(1)});
  py::array_t<bool> done(count);
  std::vector<std::int64_t> reached(static_cast<std::size_t>(count));
  std::fill_n(t.mutable_data(), rows, std::numeric_limits<double>::quiet_NaN());
  std::fill_n(done.mutable_data(), count, false);
  py::dict failures;
  Asked asked{{},
              steps,
              every,
              reached.size(),
              static_cast<std::size_t>(states.shape(1)),
              static_cast<std::size_t>(rows),
              states.data(),
              t.mutable_data(),
              y.mutable_data(),
              reached.data(),
              done.mutable_data(),
              callback.is_none() ? SharedObject() : SharedObject(callback)};
  const auto give = [&] {
    const auto begun = static_cast<py::ssize_t>(asked.begun());
    const auto of_begun = [&](const py::array& all) {
      return begun == count ? py::object(all) : py::object(all[py::slice(0, begun, 1)]);
    };
    into["t"] = t, into["y"] = of_begun(y), into["done"] = of_begun(done), into["failures"] = failures;
  };
  try {
    const Interruption interruption;
    asked.start = asked_stepping(system, method, asked_for);
    (asked.start.quad ? &take<Quad> : &take<double>)(asked, threads, interruption.stop(), failures);
  } catch (...) {
    give();
    throw;
  }
  give();
}
}  // namespace

void bind_ensembles(py::module_& module) { module.def("ensemble", &ensemble); }

}  // namespace pfaff::python
