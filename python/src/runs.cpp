// Runs: `_pfaff.RunInProgress`, a run of the library's runner whose samples are arrays. What is used of the
// runner's record stands here alone.
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <pfaff/bench/experiment/experiment_directory.hpp>
#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/measure_tables.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/core/facets/tile_rows.hpp>
#include <pfaff/core/process/checksum.hpp>
#include <pfaff/python/src/arrays.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/json_value.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/python/src/words.hpp>
#include <pfaff/runs/measuring.hpp>
#include <pfaff/runs/support/constraints.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
// Takes samples as columns of doubles, in which NaN stands for what was not measured, and passes them on.
class Columns final : public SampleTaker {
 public:
  void begin(const MeasuredBeside& of) override {
    measured = of;
    if (also != nullptr) also->begin(of);
  }
  void take(const Sample<double>& sample) override {
    add(sample);
    if (also != nullptr) also->take(sample);
  }
  void take(const Sample<Quad>& sample) override {
    add(sample);
    if (also != nullptr) also->take(sample);
  }

  void take(const SampleRows<double>& samples) override {
    const ChosenRows& rows = samples.rows;
    copy_times(samples.block, rows, t.extend(rows.count));
    const auto put_rows = [&](const Tiles<double>& from, Numbers& to) {
      copy_rows(from, rows, to.extend(from.components() * rows.count));
    };
    put_rows(samples.block.states, y);
    if (samples.invariants != nullptr) put_rows(*samples.invariants, invariants);
    if (measured.structure)
      std::fill_n(structure.extend(rows.count), rows.count, std::numeric_limits<double>::quiet_NaN());
    if (also != nullptr) also->take(samples);
  }
  using SampleTaker::take;

  // Room for so many samples of a model.
  void reserve(std::size_t rows, const Model& model) {
    t.reserve(rows);
    y.reserve(rows * static_cast<std::size_t>(model.dimension()));
    invariants.reserve(rows * model.invariants().size());
  }

  SampleTaker* also = nullptr;
  MeasuredBeside measured;
  Numbers t, y, invariants, constraints, error, structure;

 private:
  static void put(Numbers& to, double value) { *to.extend(1) = value; }
  template <class T>
  static void put(Numbers& to, const std::vector<T>& values) {
    double* place = to.extend(values.size());
    for (const T& x : values) *place++ = static_cast<double>(x);
  }
  template <class T>
  static void put(Numbers& to, const std::optional<T>& value) {
    put(to, value ? static_cast<double>(*value) : std::numeric_limits<double>::quiet_NaN());
  }
  template <class T>
  void add(const Sample<T>& sample) {
    put(t, static_cast<double>(sample.t));
    put(y, sample.state);
    put(invariants, sample.invariants);
    put(constraints, sample.constraints);
    if (measured.error) put(error, sample.error);
    if (measured.structure) put(structure, sample.structure);
  }
};

// What the settings of a run that stands in a directory call its system and its method, both empty where one
// of them has no name; and the text of a system that is written in Python, which stands beside them.
struct WrittenAs {
  std::string system, integrator, system_text;
};

// A directory of the user's in which the files of a run are left.
class Files {
 public:
  Files(const ResolvedRun& run, const std::filesystem::path& directory, const WrittenAs& written, bool force)
      : experiment_(take_experiment_of(directory, "pfaff.run")),
        lock_(take_output_directory(directory, "pfaff.run", names())),
        files_(directory, run, beside(run, directory, written, force)) {}
  [[nodiscard]] SampleTaker& series() { return files_.series(); }
  void finish(const nlohmann::json& summary) { files_.finish(summary); }

 private:
  static constexpr const char *config_name = "config.toml", *system_name = "system.toml";
  static std::vector<std::string> names() {
    std::vector<std::string> names = run_file_names();
    names.emplace_back(system_name);
    return names;
  }
  // The files beside the series. InputError where the directory holds what they may not replace.
  static std::vector<FileOfRun> beside(const ResolvedRun& run, const std::filesystem::path& directory,
                                       const WrittenAs& written, bool force) {
    ResolvedRun named = run;
    named.settings.system = written.system, named.settings.integrator = written.integrator;
    if (!written.system_text.empty()) add_file(named.origins, written.system, sha1_of(written.system_text));
    if (!force) {
      refuse_to_replace(kept_run(directory, named), directory, "force=True");
      refuse_files_of_others(directory, named, names(), "a new directory or an empty one");
    }
    return {{config_name, written.system.empty() ? "" : config_text(named)},
            {system_name, written.system_text}};
  }

  std::unique_ptr<DirectoryLock> experiment_, lock_;
  RunFiles files_;
};

RunSettings settings_of(const PySystem& system, const PyMethod& method, const py::dict& asked) {
  const auto text = [&](const char* key) { return asked[key].cast<std::string>(); };
  const auto texts = [&](const char* key) { return asked[key].cast<std::vector<std::string>>(); };
  RunSettings settings;
  settings.model = system.model;
  settings.method = method.method;
  settings.formulation = text("formulation");
  settings.initial = texts("initial");
  settings.initial_velocities = texts("initial_velocities");
  settings.t0 = text("t0"), settings.step = text("step"), settings.tolerance = text("tolerance");
  settings.time = text("time");
  settings.absolute = texts("absolute");
  settings.every = asked["every"].cast<std::int64_t>();
  settings.precision = parse_precision(text("precision"));
  settings.project_initial = asked["project_initial"].cast<bool>();
  settings.allow_inconsistent = asked["allow_inconsistent"].cast<bool>();
  settings.structure_residuals = asked["structure"].cast<bool>();
  const AskedReference reference = parse_reference(text("reference"), "reference", references_of_runs);
  settings.reference = reference.against;
  settings.errors_at_every_row = reference.every_row;
  return settings;
}

// Work beside the steps of a run, of which it is said `during` what it was where Ctrl-C ends it.
template <class Work>
auto interruptible(const char* during, const Work& work) {
  try {
    return work();
  } catch (const BudgetSpent& spent) {
    if (!spent.stopped()) throw;
    throw RunError(std::string("it was interrupted while ") + during);
  }
}

class RunInProgress {
 public:
  RunInProgress(const PySystem& system, const PyMethod& method, const py::dict& asked)
      : run_(without_lock([settings = settings_of(system, method, asked)] { return resolve(settings); })),
        measures_(measures_asked_for(asked["measures"].cast<std::vector<std::string>>())),
        out_(asked["out"].cast<std::string>()),
        force_(asked["force"].cast<bool>()),
        written_{asked["system"].cast<std::string>(), asked["integrator"].cast<std::string>(),
                 asked["system_text"].cast<std::string>()} {
    for (const auto& measure : measures_)
      if (const std::string reason = refuses(*measure, run_); !reason.empty()) throw InputError(reason);
  }

  // Whatever is thrown, the samples up to there are kept.
  void execute() {
    const Interruption interruption;
    without_lock([&] {
      const auto reference = interruptible("its reference was computed, before the first step",
                                           [&] { return reference_asked_for(run_); });
      std::optional<Files> files;
      if (!run_.adaptive())
        columns_.reserve(static_cast<std::size_t>(std::min(run_.rows(), most_reserved) + 1), *run_.model);
      if (!out_.empty()) columns_.also = &files.emplace(run_, out_, written_, force_).series();
      record_ = pfaff::execute(run_, reference.get(), {}, &interruption.stop(), &columns_);
      if (files) files->finish(summary(run_, *record_));
      if (!record_->interrupted && !measures_.empty())
        tables_ = interruptible("measures looked at it, which its tables are without",
                                [&] { return measured_tables(); });
    });
    if (record_->interrupted && interruption.taken()) raise_interrupted(record_->message.c_str());
  }

  // What is said to be conserved and is not, one line; or empty.
  [[nodiscard]] const std::string& not_conserved() const { return run_.not_conserved; }

  // Drifts are classed when this is first asked for.
  [[nodiscard]] py::object summary_of_run() const {
    return record_ ? python_value(summary(run_, *record_)) : py::dict();
  }
  [[nodiscard]] py::dict samples() {
    const auto rows = static_cast<py::ssize_t>(columns_.t.size());
    const auto n = static_cast<py::ssize_t>(run_.model->dimension());
    py::dict result, invariants, constraints;
    const auto column_names = [](const auto& list) {
      std::vector<std::string> names;
      for (const auto& one : list) names.push_back(one.name);
      return names;
    };
    result["t"] = array_owning(std::move(columns_.t), {rows});
    result["y"] = array_owning(std::move(columns_.y), {rows, n});
    const auto names = column_names(run_.model->invariants());
    result["invariant_names"] = names;
    result["invariants"] =
        array_owning(std::move(columns_.invariants), {rows, static_cast<py::ssize_t>(names.size())});
    const auto levels = constraint_residual_names(*run_.model);
    result["constraint_names"] = levels;
    result["constraints"] =
        array_owning(std::move(columns_.constraints), {rows, static_cast<py::ssize_t>(levels.size())});
    const bool begun = rows > 0;
    result["error"] = begun && columns_.measured.error
                          ? py::object(array_owning(std::move(columns_.error), {rows}))
                          : py::none();
    result["structure"] = begun && columns_.measured.structure
                              ? py::object(array_owning(std::move(columns_.structure), {rows}))
                              : py::none();
    result["coordinates"] = column_names(run_.model->coordinates());
    result["units"] = units();
    result["steps"] = run_.steps;
    result["initial"] = texts_of(run_.initial);
    result["step"] = to_string(run_.step);
    result["t0"] = to_string(run_.t0);
    const bool ended = record_ && !record_->interrupted;
    result["status"] = ended ? to_string(record_->status) : "interrupted";
    result["message"] = record_ ? in_words_of_python(record_->message) : "";
    result["tables"] = tables_of_measures();
    return result;
  }

 private:
  [[nodiscard]] std::vector<MeasuredTable> measured_tables() const {
    std::vector<const MeasureInstance*> pointers;
    for (const auto& one : measures_) pointers.push_back(one.get());
    const auto solution = solution_of(run_);
    if (run_.settings.precision == Precision::quad)
      return measured(Integration<Quad>(start_of<Quad>(run_)), record_->completed, pointers, solution.get());
    return measured(Integration<double>(start_of<double>(run_)), record_->completed, pointers,
                    solution.get());
  }
  [[nodiscard]] py::dict tables_of_measures() const {
    py::dict result;
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      const MeasuredTable& table = tables_[k];
      py::dict columns, units;
      py::array_t<std::int64_t> steps(static_cast<py::ssize_t>(table.lines.size()));
      for (std::size_t row = 0; row < table.lines.size(); ++row)
        steps.mutable_data()[row] = table.lines[row].step;
      columns["step"] = std::move(steps);
      units["step"] = "";
      for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const Column& column = table.columns[i];
        const py::str name(column.name);
        const bool numbers = column.kind == Column::Kind::number;
        columns[name] = numbers ? numbers_of(table, i) : texts_of(table, i);
        if (numbers) units[name] = column.unit;
      }
      result[py::str(measures_[k]->descriptor().name)] =
          py::make_tuple(columns, units, in_words_of_python(table.ended));
    }
    return result;
  }
  // A list, with None where there is nothing to say, as of a quantity without a drift.
  static py::object texts_of(const MeasuredTable& table, std::size_t column) {
    py::list texts;
    for (const MeasuredTable::Line& line : table.lines) {
      const auto* text = std::get_if<std::string>(&line.cells[column]);
      texts.append(text != nullptr ? py::object(py::str(*text)) : py::none());
    }
    return texts;
  }
  static py::object numbers_of(const MeasuredTable& table, std::size_t column) {
    py::array_t<double> numbers(static_cast<py::ssize_t>(table.lines.size()));
    for (std::size_t row = 0; row < table.lines.size(); ++row) {
      const Cell& cell = table.lines[row].cells[column];
      const auto* quad = std::get_if<Quad>(&cell);
      numbers.mutable_data()[row] = quad != nullptr ? static_cast<double>(*quad) : std::get<double>(cell);
    }
    return numbers;
  }
  [[nodiscard]] std::map<std::string, std::string> units() const {
    std::map<std::string, std::string> result{{"t", run_.model->time_unit()}};
    for (const Coordinate& c : run_.model->coordinates()) result[c.name] = c.unit;
    for (const Invariant& i : run_.model->invariants()) result[i.name] = i.unit;
    return result;
  }
  static std::vector<std::string> texts_of(const std::vector<Real>& numbers) {
    std::vector<std::string> texts;
    for (const Real& x : numbers) texts.push_back(to_string(x));
    return texts;
  }

  static constexpr std::int64_t most_reserved = 1 << 20;  // a run may end early

  ResolvedRun run_;
  Measures measures_;
  std::string out_;    // the directory in which files are left; or empty
  bool force_;         // replaces what that holds of another run
  WrittenAs written_;  // what its config.toml calls system and method
  Columns columns_;
  std::optional<RunRecord> record_;
  std::vector<MeasuredTable> tables_;
};
}  // namespace

void bind_runs(py::module_& module) {
  py::class_<RunInProgress>(module, "RunInProgress", "A run, checked, with the samples that it has left.")
      .def(py::init<const PySystem&, const PyMethod&, const py::dict&>())
      .def_property_readonly("not_conserved", &RunInProgress::not_conserved)
      .def("execute", &RunInProgress::execute)
      .def("samples", &RunInProgress::samples)
      .def("summary", &RunInProgress::summary_of_run);
}

}  // namespace pfaff::python
