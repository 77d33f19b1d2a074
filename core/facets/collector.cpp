#include <pfaff/core/facets/collector.hpp>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/tape/counted_outputs.hpp>

namespace pfaff::detail {

namespace {
// Throws InputError where a formula, called as `written` says, wrote past the results expected or left one
// out.
void require_written(const ModelSource& source, std::string_view written, const CountedOutputs& results,
                     int expected, bool all, bool listed) {
  const auto count = static_cast<std::size_t>(expected);
  std::string wrong;
  if (results.written() > count) {
    wrong = "writes " + std::to_string(results.written()) + " results";
  } else if (const std::size_t k = results.first_unwritten(); all && k < count) {
    wrong = "does not write result " + std::to_string(k + 1);
  } else {
    return;
  }
  throw InputError("system " + source.name + ": " + std::string(written) + " " + wrong + "; expected " +
                   std::to_string(expected) + (listed ? ", as many as the descriptor lists" : ""));
}
}  // namespace

void record_into(ModelSource& source, Formula formula, FormulaSize size, const RecordedFormula& written) {
  const FormulaRow& row = row_of(formula);
  source.given[index(formula)] = std::make_shared<const Tape>(
      record(size.inputs, size.outputs, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
        CountedOutputs results(size.outputs);
        on_behalf_of("system " + source.name + ": " + std::string(row.written),
                     [&] { written.call(written.system, t, x, results.span()); });
        require_written(source, row.written, results, size.outputs, !row.traits.may_skip_zeros,
                        row.traits.listed);
        std::copy(results.span().begin(), results.span().end(), out.begin());
      }));
}

void record_initial(ModelSource& source, void (*start)(const void* system, Out<Recorded> z),
                    const void* system) {
  CountedOutputs z(source.dimension);
  on_behalf_of("system " + source.name + ": initial(z)", [&] { start(system, z.span()); });
  require_written(source, "initial(z)", z, source.dimension, false, false);  // zeros need not be written
  source.initial.clear();
  for (const Recorded& x : z.span()) source.initial.push_back(x.constant());
}

void require_no_list(const ModelSource& source, Formula formula) {
  if (!source.invariants.empty())
    throw InputError("system " + source.name + ": the descriptor lists the invariant " +
                     source.invariants.front().name + "; expected " + std::string(row_of(formula).written));
}

}  // namespace pfaff::detail
