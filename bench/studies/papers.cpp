#include <pfaff/bench/studies/papers.hpp>

#include <array>
#include <utility>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
constexpr std::array named_papers{
    std::pair{Paper::su_qin, "su-qin"}, std::pair{Paper::nguyen_turski, "nguyen-turski"},
    std::pair{Paper::pitanga_rodrigues, "pitanga-rodrigues"}, std::pair{Paper::others, "others"}};
}  // namespace

std::vector<std::string> papers() {
  std::vector<std::string> names;
  for (const auto& [paper, name] : named_papers) names.emplace_back(name);
  return names;
}

Paper paper_named(const std::string& name) {
  for (const auto& [paper, known] : named_papers)
    if (name == known) return paper;
  throw InputError(unknown_name("paper", name, papers()));
}

}  // namespace pfaff
