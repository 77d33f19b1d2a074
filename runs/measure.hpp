// What the author of a measure includes. A measure says of a run what its steps do: it looks at states that
// go by, or carries states of its own along, and leaves a table.
//
// M is a struct in an anonymous namespace that holds settings, and has
//   std::vector<Column> columns(const Model& model) const;
//                                the columns of its table (a name, a unit, digits), behind the elapsed time
//   template <class T> struct Work { Work(const M&, const Measured<T>& run); ... };
//                                what it keeps meanwhile
// It looks at a run in one or several of three ways, each a template of the scalar T, double and Quad. Steps
// count from 0, which is the start.
//   std::vector<std::int64_t> looks(const Measured<T>& run) const;
//                                the numbers of steps at which it looks, in increasing order (evenly())
//   bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const;
//                                called at each of them. It fills a row, a number or a text for each column,
//                                or clears it to leave none; false ends the table before it
//   void block(const Measured<T>& run, const Block<T>& block, Work<T>& work) const;
//                                called with every state, many at a time: block.states.get(row, z) is that
//                                after block.step(row) steps
//   std::vector<Row> end(const Measured<T>& run, Work<T>& work) const;
//                                the rows that stand below: called behind the last look, or where there is
//                                block() or no look() once all steps are taken
//
// What a system knows of itself is evaluated by a Problem<T>(run.start.model()), made in Work, as
// problem.invariants(t, z, values) in the order of model->invariants(), which have names; `field`,
// `hamiltonian` and others likewise (core/facets/problem.hpp). BlockValues evaluates a formula at all states
// of a block. Constraints are those of model->holonomic_constraints<T>(). Another run, from a state beside
// the start or backwards, is run.start.beside(state) or run.start.reversed(), which carry_to() follows.
// What the motion itself does, to 30 digits, is run.solution.to(duration)->at(t).
//
// Optional members of M. One of the names with another signature is refused by the compiler, which says what
// was expected.
//   static parameters()          the settings of the measure
//   refuses(model, method)       why it says nothing of a run, as a predicate ("needs a system with ..."), or
//                                empty
//   static controls()            what it has to give on systems of which the answer is known, and faults that
//                                it has to see (MeasureControl): `pfaff verify` runs them, and a measure that
//                                states none fails
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/claims.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/measure_statement.hpp>
#include <pfaff/runs/shared_solution.hpp>

namespace pfaff {

/// A run as a measure sees it.
template <class T>
struct Measured {
  const Integration<T>& start;  // at the start, to take others from with beside() and reversed()
  std::int64_t steps;           // that the run has
  const SharedSolution& solution;
  const Integration<T>& now;  // as it goes: what its steps have cost so far

  /// The time that so many steps take, and the time behind them, as the solution counts it.
  [[nodiscard]] Quad duration(double count) const { return Quad(count) * Quad(start.step()); }
  [[nodiscard]] Quad time_after(double count) const { return Quad(start.time()) + duration(count); }
};

/// A state of the run, after `step` steps.
template <class T>
struct RunState {
  std::int64_t step;
  T t;
  std::span<const T> z;
};

/// 0 and about `count` other numbers of steps, evenly spaced up to `steps`.
std::vector<std::int64_t> evenly(std::int64_t steps, int count);

/// 1 and about `count` other numbers of steps, evenly spaced in their logarithm up to `steps`.
std::vector<std::int64_t> evenly_in_logarithm(std::int64_t steps, int count);

/// Takes the steps that lead a run beside the measured one to `step`. RunError where one fails, which ends
/// the table of the measure and says why.
template <class T>
void carry_to(std::int64_t step, Integration<T>& run) {
  const Outcome outcome = run.steps(step - run.steps_taken());
  if (!outcome.reached()) throw RunError("beside the run " + outcome.message());
}

/// A measure at work on one run. What its author's code throws passes.
template <class T>
class Measuring {
 public:
  virtual ~Measuring() = default;
  [[nodiscard]] virtual const std::vector<std::int64_t>& looks() const = 0;
  virtual bool look(const RunState<T>& at, Row& row) = 0;
  [[nodiscard]] virtual bool sees_blocks() const = 0;
  virtual void block(const Block<T>& block) = 0;
  [[nodiscard]] virtual bool has_end() const = 0;
  virtual std::vector<Row> end() = 0;
};

/// A measure with its settings fixed.
class MeasureInstance {
 public:
  virtual ~MeasureInstance() = default;
  [[nodiscard]] virtual const MeasureDescriptor& descriptor() const = 0;
  [[nodiscard]] virtual Assignments parameters() const = 0;
  /// NAME, or NAME(key=value, …) with all of its settings.
  [[nodiscard]] std::string called() const;
  [[nodiscard]] virtual std::vector<Column> columns(const Model& model) const = 0;
  /// Why it says nothing of runs of this method on this model, naming itself; empty where it does. What its
  /// author's code throws is such a reason, and so are names of columns that cannot stand in a table.
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& method) const;
  /// Sets to work on a run, whose `start` must outlive what is returned.
  [[nodiscard]] virtual std::unique_ptr<Measuring<double>> on(const Measured<double>& run) const = 0;
  [[nodiscard]] virtual std::unique_ptr<Measuring<Quad>> on(const Measured<Quad>& run) const = 0;

 protected:
  [[nodiscard]] virtual std::string objection(const Model& model, const MethodInstance& method) const = 0;
};

/// A registered measure.
class MeasurePlugin : public Plugin {
 public:
  MeasurePlugin(MeasureDescriptor descriptor, std::vector<Parameter> parameters, const std::type_info& type,
                const std::source_location& where)
      : Plugin(descriptor.name, std::move(parameters), type, where), descriptor_(std::move(descriptor)) {}
  [[nodiscard]] const MeasureDescriptor& descriptor() const { return descriptor_; }
  /// InputError for settings that are none.
  [[nodiscard]] virtual std::unique_ptr<MeasureInstance> make(const Assignments& set) const = 0;
  [[nodiscard]] virtual std::vector<MeasureControl> controls() const = 0;

 private:
  MeasureDescriptor descriptor_;
};

/// All measures.
Registry<MeasurePlugin>& measures();
extern template class Registry<MeasurePlugin>;

/// The measure that a text names, NAME or NAME(key=value, …). InputError with the nearest name where there is
/// none.
std::unique_ptr<MeasureInstance> measure_asked_for(const std::string& text);

namespace detail {

// Kinds share some names: each kind looks its own up in a namespace of its own.
namespace measure {
PFAFF_MEMBER_NAME(looks)
PFAFF_MEMBER_NAME(look)
PFAFF_MEMBER_NAME(block)
PFAFF_MEMBER_NAME(end)
PFAFF_MEMBER_NAME(refuses)
PFAFF_MEMBER_NAME(controls)
}  // namespace measure

template <class M>
concept WritesColumns = requires(const M& m, const Model& model) {
  { m.columns(model) } -> std::same_as<std::vector<Column>>;
};
// What the struct has in the scalar T.
template <class M, class T>
using WorkOfMeasure = typename M::template Work<T>;
template <class M, class T>
concept WritesMeasureWork = requires {
  typename WorkOfMeasure<M, T>;
  requires std::constructible_from < WorkOfMeasure<M, T>,
  const M&, const Measured<T>& > ;
};
template <class M, class T>
concept WritesLooks = requires(const M& m, const Measured<T>& run) {
  { m.looks(run) } -> std::same_as<std::vector<std::int64_t>>;
};
template <class M, class T>
concept WritesLook = requires(const M& m, const Measured<T>& run, const RunState<T>& at,
                              WorkOfMeasure<M, T>& work, Row& row) {
  { m.look(run, at, work, row) } -> std::same_as<bool>;
};
template <class M, class T>
concept WritesBlock = requires(const M& m, const Measured<T>& run, const Block<T>& block,
                               WorkOfMeasure<M, T>& work) {
  { m.block(run, block, work) } -> std::same_as<void>;
};
template <class M, class T>
concept WritesEnd = requires(const M& m, const Measured<T>& run, WorkOfMeasure<M, T>& work) {
  { m.end(run, work) } -> std::same_as<std::vector<Row>>;
};
template <class M>
concept WritesObjection = requires(const M& m, const Model& model, const MethodInstance& method) {
  { m.refuses(model, method) } -> std::same_as<std::string>;
};
template <class M>
concept WritesControls = requires {
  { M::controls() } -> std::same_as<std::vector<MeasureControl>>;
};

/// Refuses, while M is compiled, a struct that measures nothing, and members that bear the name of one that
/// is known and cannot be used as one.
template <class M>
constexpr void check_measure_members() {
  static_assert(WritesColumns<M>, "columns: expected std::vector<Column> columns(const Model& model) const");
  static_assert(WritesMeasureWork<M, double> && WritesMeasureWork<M, Quad>,
                "Work: expected template <class T> struct Work with a constructor Work(const M&, const "
                "Measured<T>& run)");
  static_assert((WritesLook<M, double> && WritesLook<M, Quad>) || !measure::has_look<M>,
                "look: expected template <class T> bool look(const Measured<T>& run, const RunState<T>& at, "
                "Work<T>& work, Row& row) const");
  static_assert((WritesLooks<M, double> && WritesLooks<M, Quad>) || !measure::has_looks<M>,
                "looks: expected template <class T> std::vector<std::int64_t> looks(const Measured<T>& run) "
                "const");
  static_assert(measure::has_look<M> == measure::has_looks<M>,
                "look and looks belong together: expected both of them or neither");
  static_assert((WritesBlock<M, double> && WritesBlock<M, Quad>) || !measure::has_block<M>,
                "block: expected template <class T> void block(const Measured<T>& run, const Block<T>& "
                "block, Work<T>& work) const");
  static_assert((WritesEnd<M, double> && WritesEnd<M, Quad>) || !measure::has_end<M>,
                "end: expected template <class T> std::vector<Row> end(const Measured<T>& run, Work<T>& "
                "work) const");
  static_assert(measure::has_look<M> || measure::has_end<M>,
                "a measure without rows: expected look and looks, or end");
  static_assert(WritesObjection<M> || !measure::has_refuses<M>,
                "refuses: expected std::string refuses(const Model& model, const MethodInstance& method) "
                "const");
  static_assert(WritesControls<M> || !measure::has_controls<M>,
                "controls: expected static std::vector<MeasureControl> controls()");
}

template <class M, class T>
class MeasuringWith final : public Measuring<T> {
 public:
  MeasuringWith(const M& measure, const Measured<T>& run)
      : measure_(measure), run_(run), work_(measure_, run_) {
    if constexpr (WritesLooks<M, T>) looks_ = measure_.looks(run_);
  }
  [[nodiscard]] const std::vector<std::int64_t>& looks() const override { return looks_; }
  bool look([[maybe_unused]] const RunState<T>& at, [[maybe_unused]] Row& row) override {
    if constexpr (WritesLook<M, T>) return measure_.look(run_, at, work_, row);
    return false;
  }
  [[nodiscard]] bool sees_blocks() const override { return WritesBlock<M, T>; }
  void block([[maybe_unused]] const Block<T>& block) override {
    if constexpr (WritesBlock<M, T>) measure_.block(run_, block, work_);
  }
  [[nodiscard]] bool has_end() const override { return WritesEnd<M, T>; }
  std::vector<Row> end() override {
    if constexpr (WritesEnd<M, T>) return measure_.end(run_, work_);
    return {};
  }

 private:
  M measure_;
  Measured<T> run_;
  typename M::template Work<T> work_;
  std::vector<std::int64_t> looks_;
};

template <class M>
class MeasureWith final : public MeasureInstance {
 public:
  MeasureWith(const MeasurePlugin& plugin, M measure) : plugin_(plugin), measure_(std::move(measure)) {}
  [[nodiscard]] const MeasureDescriptor& descriptor() const override { return plugin_.descriptor(); }
  [[nodiscard]] Assignments parameters() const override { return resolved(plugin_.parameters(), &measure_); }
  [[nodiscard]] std::vector<Column> columns(const Model& model) const override {
    return measure_.columns(model);
  }
  [[nodiscard]] std::unique_ptr<Measuring<double>> on(const Measured<double>& run) const override {
    return std::make_unique<MeasuringWith<M, double>>(measure_, run);
  }
  [[nodiscard]] std::unique_ptr<Measuring<Quad>> on(const Measured<Quad>& run) const override {
    return std::make_unique<MeasuringWith<M, Quad>>(measure_, run);
  }

 protected:
  [[nodiscard]] std::string objection([[maybe_unused]] const Model& model,
                                      [[maybe_unused]] const MethodInstance& method) const override {
    if constexpr (WritesObjection<M>) return measure_.refuses(model, method);
    return {};
  }

 private:
  const MeasurePlugin& plugin_;
  M measure_;
};

}  // namespace detail

/// Registers M when the library that holds it is loaded.
template <class M>
class Measure final : public MeasurePlugin {
 public:
  explicit Measure(MeasureDescriptor descriptor,
                   const std::source_location& where = std::source_location::current())
      : MeasurePlugin(std::move(descriptor), parameters_of<M>(), typeid(M), where) {
    detail::check_measure_members<M>();
    measures().add(this);
  }
  [[nodiscard]] std::unique_ptr<MeasureInstance> make(const Assignments& set) const override {
    M object;
    assign_all(parameters(), &object, set, "measure " + name());
    return std::make_unique<detail::MeasureWith<M>>(*this, std::move(object));
  }
  [[nodiscard]] std::vector<MeasureControl> controls() const override {
    if constexpr (detail::WritesControls<M>) return M::controls();
    return {};
  }
};

}  // namespace pfaff
