// A tuned splitting as a table of coefficients.
#include <pfaff/derive/tuning/tuned_splitting.hpp>

namespace pfaff {

namespace {

// The lists of the lengths of flows that begin with a drift, a number on each line.
std::string lists(const std::vector<PartialFlow>& flows) {
  std::string drift, kick;
  for (const PartialFlow& flow : flows)
    (flow.part == 0 ? drift : kick) += "  \"" + to_string(flow.length) + "\",\n";
  return "first = \"drift\"\ndrift = [\n" + drift + "]\nkick = [\n" + kick + "]\n";
}

}  // namespace

std::string splitting_table(const TunedSplitting& tuned, const std::string& name, int order,
                            const std::string& system) {
  const bool processed = !tuned.pre.empty();
  const std::string kind = processed                                 ? "processed"
                           : tuned.parts == Parts::quadratic_kinetic ? "rkn-splitting"
                                                                     : "splitting";
  const std::string head =
      "name = \"" + name + "\"\nkind = \"" + kind + "\"\norder = " + std::to_string(order) + "\ntitle = \"" +
      (processed ? "processed splitting" : "splitting") + " of order " + std::to_string(order) +
      " tuned to " + system + "\"\nreference = \"" +
      (processed ? "blanes-casas-ros1999" : "blanes-casas2016") + "\"\ndescription = \"\"\"\n";
  const std::string where =
      "are small on the system " + system + ". On other systems \\\nnothing is known of them.\"\"\"\n";
  if (!processed) return head + "A palindrome whose leading shadow terms " + where + lists(tuned.flows);
  return head +
         "A palindrome with a processor that gives it its order. The leading shadow terms of both \\\n" +
         where + "\n[kernel]\n" + lists(tuned.flows) + "\n[pre]\n" + lists(tuned.pre);
}

}  // namespace pfaff
