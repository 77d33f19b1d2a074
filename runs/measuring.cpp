#include <pfaff/runs/measuring.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff {

namespace {
// A measure at work, and its table.
template <class T>
struct AtWork {
  std::unique_ptr<Measuring<T>> measuring;  // null once its table has ended
  MeasuredTable* table;
  std::size_t next = 0;  // of its looks

  // What the measure throws ends its table.
  void guarded(const std::function<void()>& work) try { work(); } catch (const BudgetSpent&) {
    throw;
  } catch (...) {
    end(words_of_current_exception());
  }
  void end(const std::string& why) {
    measuring.reset();
    table->ended = why;
  }
  [[nodiscard]] std::int64_t next_look() const {
    return measuring == nullptr || next == measuring->looks().size()
               ? std::numeric_limits<std::int64_t>::max()
               : measuring->looks()[next];
  }
  void look(const RunState<T>& at) {
    if (next_look() != at.step) return;
    ++next;
    guarded([&] {
      Row row(table->columns.size());
      if (!measuring->look(at, row))
        return end("the measure has no row from t = " + to_string(Quad(at.t), 10) + " on");
      if (!row.empty()) add(at.step, std::move(row));
    });
  }
  void look_at_the_end(std::int64_t step) {
    if (measuring == nullptr || !measuring->has_end()) return;
    // Of a measure that looks at some states alone the rows say what was up to the last of them.
    if (!measuring->sees_blocks() && !measuring->looks().empty()) step = measuring->looks().back();
    guarded([&] {
      for (Row& row : measuring->end()) add(step, std::move(row));
    });
  }
  // A measure that looks at some states alone is done with the last of them.
  [[nodiscard]] bool sees_all() const {
    return measuring != nullptr &&
           (measuring->sees_blocks() || (measuring->has_end() && measuring->looks().empty()));
  }

 private:
  void add(std::int64_t step, Row row) {
    if (row.size() != table->columns.size())
      throw InputError("expected a row of " + std::to_string(table->columns.size()) + " cells, got " +
                       std::to_string(row.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
      if (table->columns[i].kind == Column::Kind::number && std::holds_alternative<std::string>(row[i]))
        throw InputError("column " + table->columns[i].name + ": expected a number, got '" +
                         std::get<std::string>(row[i]) + "'");
    table->lines.push_back({step, std::move(row)});
  }
};

template <class T>
SharedSolution solution_from(const Integration<T>& start) {
  const std::span<const T> z = start.state();
  return {start.model(), Quad(start.time()), {z.begin(), z.end()}};
}

template <class T>
class SeesBlocks final : public Watcher<T> {
 public:
  explicit SeesBlocks(std::vector<AtWork<T>>& all) : all_(all) {}
  void start(const Integration<T>& run) override {
    Block<T> first(run.state().size(), 1);
    first.t0 = run.time_of(0), first.h = run.step();
    first.rows = 1;
    first.states.put(0, run.state().data());
    first.states.fill_behind(1);
    look(run, first);
  }
  void look(const Integration<T>& /*run*/, const Block<T>& block) override {
    for (AtWork<T>& one : all_)
      if (one.measuring != nullptr && one.measuring->sees_blocks())
        one.guarded([&] { one.measuring->block(block); });
  }

 private:
  std::vector<AtWork<T>>& all_;
};
}  // namespace

template <class T>
std::vector<MeasuredTable> measured(const Integration<T>& start, std::int64_t steps,
                                    const std::vector<const MeasureInstance*>& measures,
                                    const SharedSolution* solution) {
  const SharedSolution of_start = solution_from(start);
  std::vector<MeasuredTable> tables(measures.size());
  std::vector<AtWork<T>> all(measures.size());
  Integration<T> run = start.beside({start.state().begin(), start.state().end()});
  const Measured<T> of{start, steps, solution == nullptr ? of_start : *solution, run};
  for (std::size_t m = 0; m < measures.size(); ++m) {
    all[m].table = &tables[m];
    all[m].guarded([&] {
      tables[m].columns = measures[m]->columns(*start.model());
      all[m].measuring = measures[m]->on(of);
      const std::vector<std::int64_t>& looks = all[m].measuring->looks();
      if (!std::is_sorted(looks.begin(), looks.end(), std::less_equal<>()) ||
          (!looks.empty() && (looks.front() < 0 || looks.back() > steps)))
        throw InputError("looks: expected numbers of steps from 0 to the " + std::to_string(steps) +
                         " of the run, in increasing order");
    });
  }
  SeesBlocks<T> blocks(all);
  const auto any = [&](const auto& holds) { return std::any_of(all.begin(), all.end(), holds); };
  if (any([](const AtWork<T>& one) { return one.measuring != nullptr && one.measuring->sees_blocks(); }))
    run.watch(blocks);
  while (true) {
    std::int64_t until = std::numeric_limits<std::int64_t>::max();
    for (const AtWork<T>& one : all) until = std::min(until, one.next_look());
    const bool to_the_end = until > steps;
    if (to_the_end && !any([](const AtWork<T>& one) { return one.sees_all(); })) {
      for (AtWork<T>& one : all) one.look_at_the_end(run.steps_taken());
      break;
    }
    const Outcome outcome = run.steps(std::min(until, steps) - run.steps_taken());
    if (!outcome.reached()) {
      for (AtWork<T>& one : all)
        if (one.measuring != nullptr) one.end(outcome.message());
      break;
    }
    if (to_the_end) {
      for (AtWork<T>& one : all) one.look_at_the_end(steps);
      break;
    }
    for (AtWork<T>& one : all) one.look({until, run.time(), run.state()});
  }
  return tables;
}

template std::vector<MeasuredTable> measured(const Integration<double>&, std::int64_t,
                                             const std::vector<const MeasureInstance*>&,
                                             const SharedSolution*);
template std::vector<MeasuredTable> measured(const Integration<Quad>&, std::int64_t,
                                             const std::vector<const MeasureInstance*>&,
                                             const SharedSolution*);

std::string text_of(const Cell& cell, const Column& column) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* x = std::get_if<Quad>(&cell))
    return isfinite(*x) ? to_string(*x, column.digits > 0 ? column.digits : 36) : std::string();
  const double x = std::get<double>(cell);
  if (!std::isfinite(x)) return {};
  return formatted("%.*g", column.digits > 0 ? column.digits : 17, x);
}

}  // namespace pfaff
