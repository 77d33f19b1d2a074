// A tuned splitting as a table of coefficients.
#include <pfaff/bench/tuning/tuned_splitting.hpp>

namespace pfaff {

std::string splitting_table(const TunedSplitting& tuned, const std::string& name, int order,
                            const std::string& system) {
  std::string drift, kick;
  for (const PartialFlow& flow : tuned.flows)
    (flow.part == 0 ? drift : kick) += "  \"" + to_string(flow.length) + "\",\n";
  return "name = \"" + name + "\"\nkind = \"splitting\"\norder = " + std::to_string(order) + "\ntitle = \"" +
         "splitting of order " + std::to_string(order) + " tuned to " + system +
         "\"\nreference = \"blanes-casas2016\"\ndescription = \"\"\"\nA palindrome whose leading shadow "
         "terms "
         "are small on the system " +
         system + ". On other systems \\\nnothing is known of them.\"\"\"\nfirst = \"drift\"\ndrift = [\n" +
         drift + "]\nkick = [\n" + kick + "]\n";
}

}  // namespace pfaff
