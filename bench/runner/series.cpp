#include <pfaff/bench/runner/series.hpp>

#include <algorithm>
#include <utility>

#include <pfaff/runs/support/constraints.hpp>

namespace pfaff {

namespace {
constexpr int digits_of_errors = 6;
std::string header(const std::string& name, const std::string& unit) {
  return name + " [" + (unit.empty() ? "1" : unit) + "]";
}
}  // namespace

SeriesWriter::SeriesWriter(const ResolvedRun& run, RowWriter::Destination destination)
    : model_(*run.model), rows_(std::move(destination)) {}

void SeriesWriter::begin(const MeasuredBeside& measured) {
  measured_ = measured;
  rows_.text(header("t", model_.time_unit()));
  for (const Coordinate& c : model_.coordinates()) rows_.text(header(c.name, c.unit));
  for (const Invariant& i : model_.invariants()) rows_.text(header(i.name, i.unit));
  for (const std::string& name : constraint_residual_names(model_)) rows_.text(header(name, "1"));
  if (measured.error) rows_.text("error [1]");
  // What is conserved has its drift for an error; of what changes the error is written.
  for (const Invariant& i : model_.invariants())
    if (measured.invariant_errors && i.behaviour != Behaviour::conserved) {
      ++changing_;
      rows_.text(header(i.name + ":error", i.unit));
    }
  if (measured.structure) rows_.text("structure_residual [1]");
  rows_.end_row();
}

template <class T>
void SeriesWriter::row(const Sample<T>& sample) {
  rows_.number(sample.t);
  for (const T& x : sample.state) rows_.number(x);
  for (const T& x : sample.invariants) rows_.number(x);
  for (const T& x : sample.constraints) rows_.text(to_string(Quad(x), digits_of_errors));
  if (measured_.error) rows_.text(sample.error ? to_string(*sample.error, digits_of_errors) : "");
  for (std::size_t i = 0; i < changing_; ++i)  // none where nothing is compared
    rows_.text(sample.invariant_errors.empty() ? ""
                                               : to_string(sample.invariant_errors[i], digits_of_errors));
  if (measured_.structure)
    rows_.text(sample.structure ? to_string(Quad(*sample.structure), digits_of_errors) : "");
  rows_.end_row();
}

}  // namespace pfaff
