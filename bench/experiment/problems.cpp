#include <pfaff/bench/experiment/problems.hpp>

#include <map>

#include <pfaff/runs/motion.hpp>

namespace pfaff {

namespace {
// The form of the friction of a motion on constraints; empty where there is none.
std::string form_of_friction(const std::shared_ptr<const Model>& model) {
  if (model->frictionless()) return {};
  for (const auto& [key, value] : motion_of(model)->source().formulation_parameters)
    if (key == "friction-form") return value;
  return {};
}

// A line for each problem of which something is said, by one of its runs.
template <class Said>
std::string line_of_each_problem(const std::vector<ExperimentRun>& runs, const Said& said) {
  std::map<ProblemKey, std::string> lines;
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (const std::string text = said(k); !text.empty()) lines[problem_of(runs[k])] = text + "\n";
  std::string text;
  for (const auto& [problem, line] : lines) text += line;
  return text;
}

// Of each reference solution that ends before its runs.
std::string ended_references(const std::vector<ExperimentRun>& runs,
                             const std::vector<nlohmann::json>& summaries) {
  return line_of_each_problem(runs, [&](std::size_t k) -> std::string {
    if (!summaries[k].contains("reference_ended")) return {};
    return "reference of " + runs[k].which->name + ": " + summaries[k]["reference_ended"].get<std::string>() +
           "; errors are measured up to there";
  });
}

// Of what is said to be conserved and is not.
std::string false_invariants(const std::vector<ExperimentRun>& runs) {
  return line_of_each_problem(runs, [&](std::size_t k) -> std::string {
    const std::string& said = runs[k].resolved.not_conserved;
    return said.empty() ? said : runs[k].which->name + ": " + said;
  });
}

// Where the methods of a case have friction of different forms, which are motions of their own.
std::string forms_of_friction(const std::vector<ExperimentRun>& runs) {
  std::map<const ExperimentCase*, std::map<std::string, std::vector<std::string>>> methods;
  for (const ExperimentRun& run : runs) {
    if (makes_another_motion(*run.resolved.model)) continue;
    std::vector<std::string>& labels = methods[run.which][std::get<2>(problem_of(run))];
    if (labels.empty() || labels.back() != run.method->label) labels.push_back(run.method->label);
  }
  std::string text;
  for (const auto& [one, forms] : methods) {
    if (forms.size() < 2) continue;
    text += one->name + ": friction makes " + std::to_string(forms.size()) +
            " motions, and errors are those against the motion of the method's own form:";
    for (const auto& [form, labels] : forms) {
      text += (form == forms.begin()->first ? " " : "; ") + (form.empty() ? std::string("none") : form) +
              " with ";
      for (std::size_t k = 0; k < labels.size(); ++k) text += (k == 0 ? "" : ", ") + labels[k];
    }
    text += "\n";
  }
  return text;
}
}  // namespace

bool makes_another_motion(const Model& model) {
  return !model.restricted() && !model.source().formulation.empty();
}

ProblemKey problem_of(const ExperimentRun& run) {
  const std::shared_ptr<const Model>& model = run.resolved.model;
  return {run.which, run.seed,
          makes_another_motion(*model) ? model->source().formulation : form_of_friction(model)};
}

std::string said_of_problems(const std::vector<ExperimentRun>& runs,
                             const std::vector<nlohmann::json>& summaries) {
  return ended_references(runs, summaries) + false_invariants(runs) + forms_of_friction(runs);
}

}  // namespace pfaff
