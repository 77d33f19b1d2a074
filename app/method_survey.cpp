#include <pfaff/app/method_survey.hpp>

#include <algorithm>
#include <exception>

#include <pfaff/runs/motion.hpp>

namespace pfaff::app {

SurveyedSystems::SurveyedSystems() {
  for (const SystemPlugin* system : systems().all()) try {
      const std::shared_ptr<const Model> whole = system->make({});
      systems_.push_back({whole, motion_of(whole)});
    } catch (const std::exception&) {
      // A plug-in's fault, which `describe` and `run` report.
    }
}

MethodSurvey SurveyedSystems::of(const MethodPlugin& method,
                                 const std::vector<Assignments>& parameters) const {
  MethodSurvey survey;
  try {
    for (const Assignments& assignments : parameters) {
      const auto instance = method.make(assignments);
      survey.adaptive = survey.adaptive || instance->adaptive();
      for (const Surveyed& system : systems_) {
        const bool itself = instance->refuses(*system.whole).empty();
        const Model& model = itself ? *system.whole : *system.motion;
        if (!itself && !instance->refuses(model).empty()) continue;
        const int order = instance->order(model);
        survey.orders.insert(order);
        for (const Claim claim : claims_in_scope(instance->preserves(model), model))
          if (claim != Claim::none) survey.kept[claim].insert(order);
      }
    }
  } catch (const std::exception&) {
    return {};  // as above
  }
  return survey;
}

std::string in_words(const std::set<int>& numbers) {
  std::string text;
  for (auto at = numbers.begin(); at != numbers.end();) {
    const int first = *at;
    int last = first;
    while (++at != numbers.end() && *at == last + 1) last = *at;
    text += (text.empty() ? "" : ", ") + std::to_string(first);
    if (last > first) text += (last == first + 1 ? ", " : " to ") + std::to_string(last);
  }
  return text;
}

std::string folder_of(const Plugin& plugin, const std::string& room) {
  const std::size_t at = plugin.file().rfind("/" + room + "/");
  if (at == std::string::npos) return "plug-ins";
  const std::string inside = plugin.file().substr(at + room.size() + 2);
  std::string folder = inside.substr(0, inside.find('/') == std::string::npos ? 0 : inside.find('/'));
  std::replace(folder.begin(), folder.end(), '_', '-');
  return folder;
}

}  // namespace pfaff::app
