// Compositions with a processor: tables of the kind "composition" with a list `pre`.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <pfaff/integrators/order_conditions/word_conditions.hpp>
#include <pfaff/integrators/tables/table_document.hpp>

#include "../eigen/decompositions.hpp"
#include "method_files.hpp"
#include "processed_samples.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::distance;
using pfaff::testing::ended;
using pfaff::testing::expect_one_map;
using pfaff::testing::expect_table_refused;
using pfaff::testing::pushed_pendulum;
using pfaff::testing::shipped_tables;

struct Lists {
  std::vector<Quad> kernel, pre;
  [[nodiscard]] std::vector<Quad> weights() const { return processed_weights(pre, kernel); }
};
Lists shipped(const std::string& name) {
  TableDocument document(shipped_tables + name + ".toml");
  return {document.numbers("weights"), document.numbers("pre")};
}

// Bases of each kind: explicit and on a system that depends on time; with predictions from past steps, which
// the sub-steps of a processor cannot make; and with constraints.
TEST(ProcessedComposition, StepsInARowEndWhereSingleStepsDo) {
  const Lists lists = shipped("blanes-casas-murua-processed-6");
  const auto composed = [&](const char* base) {
    return integrators().get(base, "integrator").make({})->composed(lists.weights(), lists.pre.size());
  };
  const auto system = [](const char* name) { return systems().get(name, "system").make({}); };
  // Some hundreds of sub-steps, each of which rounds by some units of 1e-34.
  expect_one_map(*composed("verlet"), pushed_pendulum(), 1e-31);
  expect_one_map(*composed("verlet"), system("henon-heiles"), 1e-31);
  expect_one_map(*composed("midpoint-darboux"), system("damped-pendulum"), 1e-30);
  expect_one_map(*composed("conformal-splitting"), system("damped-pendulum"), 1e-30);
  expect_one_map(*composed("rattle"), system("spherical-pendulum"), 1e-30);
}

// The control: a processor whose last weight does not take back the first.
TEST(ProcessedComposition, AProcessorThatIsNotTakenBackShows) {
  Lists lists = shipped("blanes-casas-murua-processed-6");
  std::vector<Quad> weights = lists.weights();
  weights.back() += Quad(1e-9);
  const auto changed =
      integrators().get("verlet", "integrator").make({})->composed(weights, lists.pre.size());
  const auto model = pushed_pendulum();
  const Quad h(0.1);
  EXPECT_GT(distance(ended(*changed, model, 1, 30, h).z, ended(*changed, model, 30, 1, h).z), 1e-10);
}

TEST(ProcessedComposition, StepsInARowCostWhatTheirKernelDoes) {
  const auto table = read_method_table(shipped_tables + "blanes-casas-murua-processed-8.toml");
  const auto method = table->make({});
  const auto model = systems().get("henon-heiles", "system").make({});
  EXPECT_TRUE(method->processed());
  EXPECT_EQ(ended(*method, model, 1, 50, 0.1).forces, 50 * 13 + 2 * 20);
  EXPECT_EQ(ended(*method, model, 10, 5, 0.1).forces, 50 * 13 + 10 * 2 * 20);
}

// In the chart too: single steps evaluate the processor and its inverse, together 24 sub-steps, beside
// eleven.
TEST(ProcessedComposition, StepsInARowCostLessInDarbouxCoordinates) {
  const Lists lists = shipped("blanes-casas-murua-processed-6");
  const auto method = integrators()
                          .get("midpoint-darboux", "integrator")
                          .make({})
                          ->composed(lists.weights(), lists.pre.size());
  const auto model = systems().get("damped-pendulum", "system").make({});
  EXPECT_GT(ended(*method, model, 50, 1, 0.1).forces, 2 * ended(*method, model, 1, 50, 0.1).forces);
}

TEST(ProcessedComposition, WrongNumbersAreToldApart) {
  const std::string head = "name = \"table\"\nkind = \"composition\"\nbase = \"verlet\"\norder = 4\n";
  const std::string jump = "let.g = \"1/(2 - 2^(1/3))\"\nweights = [\"g\", \"1 - 2*g\", \"g\"]\n";
  // The triple jump needs no processor, and any that commutes with it to this order does no harm.
  EXPECT_EQ(pfaff::testing::table_refusal(head + jump + "pre = [0.1, -0.1]\n"), "accepted: table");
  expect_table_refused(head + jump + "pre = [0.1, 0.2, -0.3]\n",
                       {"key 'order': 4, but the Lie word Y1 Y3 = 0, a condition of order 4, is off by"});
  expect_table_refused(
      head + "weights = [0.4, 0.2, 0.4]\npre = [0.1, -0.1]\n",
      {"key 'weights': is not of effective order 4: whatever the processor, the Lie word Y3 = 0"});
}

// What no processor removes of compositions: one condition of degree 1, 3 and 5 each where the kernel is a
// palindrome, and of degree 7 two.
TEST(ProcessedComposition, PalindromesHaveFewConditions) {
  const std::vector<Quad> kernel{Quad(0.2), Quad(0.3), Quad(0), Quad(0.3), Quad(0.2)};
  std::array<int, 9> violated{};
  for (const OrderCondition& c : effective_composition_conditions(kernel, 8))
    violated.at(static_cast<std::size_t>(c.order)) += abs(c.residual) > Quad(1e-25);
  EXPECT_EQ(violated, (std::array<int, 9>{0, 0, 0, 1, 0, 1, 0, 2, 0}));
}

// A published method: the numbers that its kernel and its processor depend on, by their published digits.
struct Published {
  const char* name;
  int order;
  std::vector<const char*> kernel, pre;
  std::size_t equal;               // how many weights at the ends of the kernel are the first number
  std::vector<std::size_t> exact;  // numbers that are as they stand
  double printed;                  // what the published digits leave open
};

// A palindrome with the sum 1.
std::vector<Quad> kernel_of(const Published& method, const std::vector<Quad>& numbers) {
  std::vector<Quad> half(method.equal, numbers.front());
  half.insert(half.end(), numbers.begin() + 1,
              numbers.begin() + static_cast<std::ptrdiff_t>(method.kernel.size()));
  Quad middle(1);
  for (const Quad& x : half) middle -= Quad(2) * x;
  std::vector<Quad> kernel = half;
  kernel.push_back(middle);
  kernel.insert(kernel.end(), half.rbegin(), half.rend());
  return kernel;
}
// Two lists one after the other, the second with the opposite signs; the sum of each is zero.
std::vector<Quad> pre_of(const Published& method, const std::vector<Quad>& numbers) {
  std::vector<Quad> list(1);
  for (std::size_t k = method.kernel.size(); k < numbers.size(); ++k) {
    list.front() -= numbers[k];
    list.push_back(numbers[k]);
  }
  const std::size_t half = list.size();
  for (std::size_t k = 0; k < half; ++k) list.push_back(-list[k]);
  return list;
}

// The published digits, moved by the smallest correction to where all conditions hold.
std::vector<Quad> solved_again(const Published& method) {
  std::vector<Quad> numbers;
  for (const auto* list : {&method.kernel, &method.pre})
    for (const char* text : *list) EXPECT_TRUE(parse(text, numbers.emplace_back()));
  const auto residuals = [&](const std::vector<Quad>& x) {
    std::vector<Quad> list;
    for (const OrderCondition& c :
         composition_conditions(processed_weights(pre_of(method, x), kernel_of(method, x)), method.order))
      list.push_back(c.residual);
    return list;
  };
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (std::find(method.exact.begin(), method.exact.end(), k) == method.exact.end()) free.push_back(k);
  std::vector<Quad> defect = residuals(numbers);
  Eigen::MatrixXd slopes(defect.size(), free.size());
  const Quad shift(0x1p-40);
  for (std::size_t j = 0; j < free.size(); ++j) {
    std::vector<Quad> above = numbers, below = numbers;
    above[free[j]] += shift;
    below[free[j]] -= shift;
    const std::vector<Quad> up = residuals(above), down = residuals(below);
    for (std::size_t c = 0; c < defect.size(); ++c)
      slopes(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(j)) =
          static_cast<double>((up[c] - down[c]) / (Quad(2) * shift));
  }
  for (int iteration = 0; iteration < 6; ++iteration) {  // each leaves 1e-7 of the defect at most
    Quad scale(0);
    for (const Quad& x : defect) scale = std::max(scale, abs(x));
    Eigen::VectorXd right(defect.size());
    for (std::size_t c = 0; c < defect.size(); ++c)
      right(static_cast<Eigen::Index>(c)) = static_cast<double>(defect[c] / scale);
    // The smallest slope that is not round-off is 2e-8 of the largest.
    const Eigen::VectorXd correction = pfaff::testing::shortest_solution(slopes, right, 1e-9);
    for (std::size_t j = 0; j < free.size(); ++j)
      numbers[free[j]] -= Quad(correction(static_cast<Eigen::Index>(j))) * scale;
    defect = residuals(numbers);
  }
  return numbers;
}

// Sources: blanes2001, blanes-casas-murua2006, as collected with blanes-casas-murua2024 (table 8.1).
TEST(ProcessedComposition, NumbersAreWhatTheirConditionsGive) {
  const std::vector<Published> list{
      {"blanes-processed-6",
       6,
       {"0.513910778424374", "0.364193022833858", "-0.867423280969274"},
       {"-0.461165940466494", "-0.074332422810238", "0.384998538774070", "0.375012038697862"},
       1,
       {},
       1e-15},
      {"blanes-casas-murua-processed-6",
       6,
       {"0.1705768865009222157", "-0.423366140892658048"},
       {"-0.20621953139126", "0.23651387483203", "0.09086982276241", "0.24687306977659", "-0.1"},
       4,
       {6},
       1e-14},
      {"blanes-casas-murua-processed-8",
       8,
       {"0.168", "0.585550530805562", "-0.460090457516872", "0.172863148729731", "0.179664539695039"},
       {"-0.008488123494574411", "-0.337188967354338", "0.333987768164597", "0.588351189003849",
        "0.162324207599241", "-0.511744926116413", "0.236885952363384", "0.598212975943381",
        "-0.543415765371656"},
       2,
       {0},
       1e-14},
      // Its conditions hardly tell some combinations of numbers apart: residuals of 2e-11 move them by 2e-9.
      {"blanes-casas-murua-processed-10",
       10,
       {"0.121657748919383", "-0.511318780154828", "-0.172858614884985", "0.123016258833066",
        "0.441503951671565", "-0.327071324165477", "0.070952700957766"},
       {"0.4727142080578221", "0.01344750613191108", "-0.4637104712987078", "-0.3045590922565247",
        "-0.5382945821834320", "-0.1899795533199732", "0.1548256472553489", "-0.3594148033156072",
        "0.3430345669677392", "0.5334030283695922", "0.009116042043427756"},
       5,
       {},
       1e-8}};
  for (const Published& method : list) {
    const std::vector<Quad> numbers = solved_again(method);
    const Lists held = shipped(method.name);
    const std::vector<Quad> weights = processed_weights(pre_of(method, numbers), kernel_of(method, numbers)),
                            table = held.weights();
    ASSERT_EQ(weights.size(), table.size()) << method.name;
    // What residuals of 1e-33 leave open, divided by the smallest slopes: 0.04, 7e-4 and 2e-7.
    const Quad open = method.order == 6 ? Quad(1e-31) : method.order == 8 ? Quad(5e-30) : Quad(1e-26);
    for (std::size_t k = 0; k < weights.size(); ++k)
      EXPECT_LT(abs(weights[k] - table[k]), open) << method.name << ' ' << k;
    std::vector<Quad> printed;
    for (const auto* digits : {&method.kernel, &method.pre})
      for (const char* text : *digits) EXPECT_TRUE(parse(text, printed.emplace_back()));
    for (std::size_t k = 0; k < printed.size(); ++k)
      EXPECT_LT(abs(numbers[k] - printed[k]), Quad(method.printed)) << method.name << ' ' << k;
  }
}

}  // namespace
