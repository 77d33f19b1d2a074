#include <pfaff/python/src/stepping.hpp>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include <pfaff/core/facets/tile_rows.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/scalars.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/motion.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
// Whether it is True, NumPy's own among them, which comparisons of its numbers give.
bool is_true(const py::object& answer) {
  if (answer.is(py::bool_(true))) return true;
  static const py::handle kind = py::object(py::module_::import("numpy").attr("bool_")).release();
  return py::isinstance(answer, kind) && answer.cast<bool>();
}

// Keeps the states that go by, while it lives; none where `every` is 0.
template <class T>
class Keeper final : public Watcher<T> {
 public:
  Keeper(Integration<T>& run, std::int64_t every) : run_(run) {
    if (every > 0) run_.watch(*this, every);
  }
  ~Keeper() override { run_.unwatch(*this); }
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;
  void start(const Integration<T>& /*run*/) override {}
  void look(const Integration<T>& /*run*/, const Block<T>& block) override {
    const std::size_t n = block.states.components();
    copy_times(block, {.count = block.rows}, t.extend(block.rows));
    copy_rows(block.states, {.count = block.rows}, y.extend(n * block.rows));
  }
  Numbers t, y;

 private:
  Integration<T>& run_;
};

// Calls functions of Python: all of them at a state before any at the next one, so that none sees a state
// behind the end of the integration.
template <class T>
class Callers final : public Watcher<T> {
 public:
  void add(std::int64_t number, SharedObject callback, std::int64_t every) {
    callers_.push_back(std::make_unique<Caller>(number, std::move(callback), every));
  }
  // It is not called from now on, whoever takes steps meanwhile.
  void remove(std::int64_t number) {
    for (auto& one : callers_)
      if (one->number == number) one->removed = true;
  }
  // Only while nobody takes steps.
  void drop_removed() {
    std::erase_if(callers_, [](const auto& one) { return one->removed.load(); });
  }
  // Of the numbers of steps at which somebody is called; 0 where nobody is.
  [[nodiscard]] std::int64_t every() const {
    std::int64_t common = 0;
    for (const auto& one : callers_) common = std::gcd(common, one->every);
    return common;
  }

  void start(const Integration<T>& /*run*/) override {}
  // They are asked here, before others look, so that an integration ends at the state at which one gives True
  // or raises something.
  std::size_t end(const Integration<T>& /*run*/, const Block<T>& block) override {
    std::size_t row = 0;
    try {
      with_lock([&] {
        std::vector<T> z(block.states.components());
        std::vector<double> in_double(z.size());
        for (; row < block.rows; ++row) {
          block.states.get(row, z);
          std::transform(z.begin(), z.end(), in_double.begin(),
                         [](const T& x) { return static_cast<double>(x); });
          if (call(block.step(row), static_cast<double>(block.time(row)), in_double)) return;
        }
      });
    } catch (const PythonError&) {
      // Whoever asked for the steps raises it.
    }
    return row;
  }
  void look(const Integration<T>& /*run*/, const Block<T>& /*block*/) override {}

 private:
  struct Caller {
    Caller(std::int64_t n, SharedObject called, std::int64_t steps)
        : number(n), callback(std::move(called)), every(steps) {}
    std::int64_t number;
    SharedObject callback;
    std::int64_t every;
    std::atomic<bool> removed{false};
  };
  // True where the integration is to end at this state, which all of them see.
  bool call(std::int64_t step, double t, const std::vector<double>& z) {
    bool ends = false;
    for (const auto& one : callers_)
      if (!one->removed && step % one->every == 0)
        ends = is_true(one->callback.get()(t, array_of(std::span<const double>(z)))) || ends;
    return ends;
  }
  std::vector<std::unique_ptr<Caller>> callers_;
};

template <class T>
std::vector<T> scalars_of(const std::vector<Real>& numbers) {
  std::vector<T> result;
  for (const Real& x : numbers) result.push_back(T(x));
  return result;
}

template <class T>
class SteppingIn final : public Stepping {
 public:
  explicit SteppingIn(Integration<T> run) : run_(std::move(run)) {}

  void steps(std::int64_t count, std::int64_t every) override {
    take(every, [&] { return run_.steps(count); });
  }
  void to(const Real& t, std::int64_t every) override {
    take(every, [&] { return run_.to(T(t)); });
  }
  void allow(std::int64_t steps) override {
    const Using use(*this);
    allowed_ = steps;
  }
  std::int64_t allowed() const override { return allowed_; }
  StepsTaken taken() override { return std::move(last_); }

  double time() const override { return static_cast<double>(run_.time()); }
  std::vector<double> state() const override {
    std::vector<double> z;
    for (const T& x : run_.state()) z.push_back(static_cast<double>(x));
    return z;
  }
  std::vector<std::string> state_as_texts() const override {
    std::vector<std::string> texts;
    for (const T& x : run_.state()) texts.push_back(to_string(Quad(x), std::is_same_v<T, Quad> ? 36 : 17));
    return texts;
  }
  double step() const override { return static_cast<double>(run_.step()); }
  std::int64_t steps_taken() const override {
    return run_.adaptive() ? run_.counters().steps : run_.steps_taken();
  }
  Counters counters() const override { return run_.counters(); }
  std::shared_ptr<const Model> model() const override { return run_.model(); }
  std::unique_ptr<Stepping> beside(const std::vector<Real>& state) const override {
    return std::make_unique<SteppingIn>(run_.beside(scalars_of<T>(state)));
  }
  std::unique_ptr<Stepping> reversed() const override {
    return std::make_unique<SteppingIn>(run_.reversed());
  }
  void turn() override {
    const Using use(*this);
    run_.turn();
  }
  void forget() override {
    const Using use(*this);
    run_.forget();
  }
  void go_on_from(const std::vector<Real>& state, const std::optional<Real>& t0,
                  const std::optional<Real>& h) override {
    const Using use(*this);
    run_.go_on_from(scalars_of<T>(state), t0 ? T(*t0) : run_.time(), h ? T(*h) : run_.step());
  }
  std::int64_t watch(SharedObject callback, std::int64_t every) override {
    const Using use(*this);
    callers_.add(++watched_, std::move(callback), every);
    watch_again();
    return watched_;
  }
  void unwatch(std::int64_t number) override {
    callers_.remove(number);
    if (!in_use_) drop_removed();
  }

  std::pair<std::vector<double>, std::vector<double>> jacobian(std::int64_t count) const override {
    const std::size_t n = run_.state().size();
    std::vector<double> end(n), rows(n * n);
    without_lock([&] {
      for (std::size_t first = 0; first < n; first += step_directions) {
        Integration<StepDual<T>> run = run_.differentiated(first);
        run.steps(count).expect_reached();
        for (std::size_t i = 0; i < n; ++i) {
          end[i] = static_cast<double>(value_of(run.state()[i]));
          for (std::size_t k = 0; k < step_directions && first + k < n; ++k)
            rows[i * n + first + k] = static_cast<double>(run.state()[i].derivative[k]);
        }
      }
    });
    return {std::move(end), std::move(rows)};
  }

 private:
  // An integration is used by one call at a time: not by a callback of its own, and not by two threads.
  class Using {
   public:
    explicit Using(SteppingIn& of) : of_(of) {
      if (std::exchange(of_.in_use_, true))
        throw InputError(
            "this integration is taking steps in another call; expected one at a time, and none from its own "
            "callbacks");
    }
    ~Using() {
      of_.in_use_ = false;
      of_.drop_removed();
    }
    Using(const Using&) = delete;
    Using& operator=(const Using&) = delete;

   private:
    SteppingIn& of_;
  };

  // The budget of a call: what it takes is gone, however it ends.
  class Allowance {
   public:
    explicit Allowance(std::int64_t& left) : left_(left), budget_({.steps = left}) {}
    ~Allowance() { left_ -= budget_.steps(); }
    Allowance(const Allowance&) = delete;
    Allowance& operator=(const Allowance&) = delete;

   private:
    std::int64_t& left_;
    Budget budget_;
  };

  void drop_removed() {
    callers_.drop_removed();
    if (callers_.every() != watched_every_) watch_again();
  }
  void watch_again() {
    run_.unwatch(callers_);
    watched_every_ = callers_.every();
    if (watched_every_ > 0) run_.watch(callers_, watched_every_);
  }

  template <class Take>
  void take(std::int64_t every, const Take& steps) {
    const Using use(*this);
    last_ = {};
    Keeper<T> keeper(run_, every);
    const std::int64_t begin = steps_taken();
    // However the call ends: what was kept, and how far it came.
    const auto note = [&] {
      last_.steps = steps_taken() - begin;
      last_.t = std::move(keeper.t), last_.y = std::move(keeper.y);
    };
    try {
      without_lock([&] {
        Allowance allowance(allowed_);
        const Outcome outcome = steps();
        last_.reached = outcome.reached();
        last_.status = to_string(outcome.status());
        last_.message = outcome.message();
      });
    } catch (const std::exception& error) {
      note();
      const std::string words = error.what();
      last_.message = words.substr(0, words.find('\n'));
      throw;
    }
    note();
  }

  Integration<T> run_;
  Callers<T> callers_;
  std::int64_t watched_ = 0;        // the last of their numbers
  std::int64_t watched_every_ = 0;  // so many steps they are asked; 0 where there are none
  StepsTaken last_;
  std::int64_t allowed_ = BudgetLimits::unlimited;
  bool in_use_ = false;  // under Python's lock
};

template <class T>
std::unique_ptr<Stepping> made(const AskedStepping& asked) {
  return std::make_unique<SteppingIn<T>>(begun(start_in<T>(asked)));
}
}  // namespace

std::unique_ptr<Stepping> make_stepping(const AskedStepping& asked) {
  return without_lock([&] { return asked.quad ? made<Quad>(asked) : made<double>(asked); });
}

std::shared_ptr<const Model> model_for(const MethodInstance& method,
                                       const std::shared_ptr<const Model>& model,
                                       const std::string& formulation) {
  if (formulation.empty()) return motion_for(method, model);
  const AskedFormulation asked = formulation_asked_for(*model, formulation);
  if (method.refuses(*model).empty())
    throw InputError(method.called() + " steps on the constraints of " + model->name() +
                     " themselves; expected no formulation");
  return asked.plugin->apply(model, asked.parameters);
}

}  // namespace pfaff::python
