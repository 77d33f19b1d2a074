// What methods do on the systems that they fit: the orders they state and what they claim to keep there.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff::app {

/// A method, over the systems that fit.
struct MethodSurvey {
  std::set<int> orders;
  std::map<Claim, std::set<int>> kept;  // for each claim in its scope the orders with which it is made
  bool adaptive = false;
};

/// Every registered system with the parameters it has by itself, and its motion where it has constraints.
/// Systems of plug-ins that cannot be made are left out.
class SurveyedSystems {
 public:
  SurveyedSystems();
  /// The method over all of these systems, with each of the parameters given. A method that fails to answer
  /// has an empty survey.
  [[nodiscard]] MethodSurvey of(const MethodPlugin& method, const std::vector<Assignments>& parameters) const;

 private:
  struct Surveyed {
    std::shared_ptr<const Model> whole, motion;
  };
  std::vector<Surveyed> systems_;
};

/// Numbers as in "4", "2, 4, 6" or "1 to 12, 14".
std::string in_words(const std::set<int>& numbers);

/// The folder of a plug-in: the folder of its source in the room of its kind, such as "runge-kutta"; empty
/// for sources in the room itself, and "plug-ins" for those from elsewhere.
std::string folder_of(const Plugin& plugin, const std::string& room);

}  // namespace pfaff::app
