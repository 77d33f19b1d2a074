// The coefficients of the splittings in examples/tables/ that are known as decimals: solved for again.
//
// The published digits, about sixteen of them, are the start of Newton's method for the order conditions.
// Where there are more coefficients than conditions, each correction is the smallest one that fulfils the
// linearised conditions, so that the solution is the point of the family nearest to the published one. The
// files hold that point to 36 digits.
#include <gtest/gtest.h>

#include <array>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/integrators/composition/composition_weights.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>
#include <pfaff/integrators/splitting/near_integrable_schemes.hpp>
#include <pfaff/integrators/tables/table_document.hpp>

namespace {
using namespace pfaff;

constexpr std::size_t drift = 0, kick = 1;

// A splitting by its published digits: of palindromes the first half, with the one in the middle.
struct PublishedTable {
  const char* name;
  int order;
  Parts parts;
  std::size_t first;
  bool palindrome;
  std::size_t flows;                 // of a whole step
  std::vector<const char*> numbers;  // in the order of the flows
  std::vector<int> orders{};         // the generalised order, of splittings with a small part
};

// Sources: mclachlan-atela1992, omelyan-mryglod-folk2002, blanes-moan2002 (tables 2 and 3). What the papers
// give as one less a sum is written out here by its first digits.
const std::vector<PublishedTable>& published() {
  static const std::vector<PublishedTable> list{
      {"mclachlan-atela-4",
       4,
       Parts::quadratic_kinetic,
       kick,
       false,
       8,
       {"0.1344961992774310892", "0.5153528374311229364", "-0.2248198030794208058", "-0.085782019412973646",
        "0.7563200005156682911", "0.4415830236164665242", "0.3340036032863214255", "0.1288461583653841854"}},
      {"pefrl",
       4,
       Parts::general,
       drift,
       true,
       9,
       {"0.1786178958448091", "0.7123418310626054", "-0.06626458266981849", "-0.2123418310626054",
        "0.77529337365001878"}},
      {"blanes-moan-s6",
       4,
       Parts::general,
       drift,
       true,
       13,
       {"0.0792036964311957", "0.209515106613362", "0.353172906049774", "-0.143851773179818",
        "-0.0420650803577195", "0.434336666566456", "0.2193769557534996"}},
      {"blanes-moan-s10",
       6,
       Parts::general,
       drift,
       true,
       21,
       {"0.0502627644003922", "0.148816447901042", "0.413514300428344", "-0.132385865767784",
        "0.0450798897943977", "0.067307604692185", "-0.188054853819569", "0.432666402578175",
        "0.541960678450780", "-0.016404589403618", "-0.7255255585086898"}},
      {"blanes-moan-srkn6",
       4,
       Parts::quadratic_kinetic,
       kick,
       true,
       13,
       {"0.0829844064174052", "0.245298957184271", "0.396309801498368", "0.604872665711080",
        "-0.0390563049223486", "-0.350171622895351", "0.1195241940131508"}},
      {"blanes-moan-srkn11",
       6,
       Parts::quadratic_kinetic,
       kick,
       true,
       23,
       {"0.0414649985182624", "0.123229775946271", "0.198128671918067", "0.290553797799558",
        "-0.0400061921041533", "-0.127049212625417", "0.0752539843015807", "-0.246331761062075",
        "-0.0115113874206879", "0.357208872795928", "0.2366699247869311", "0.20477705429147"}}};
  return list;
}

std::vector<PartialFlow> flows_of(const PublishedTable& method, const std::vector<Quad>& numbers) {
  std::vector<PartialFlow> flows;
  for (std::size_t k = 0; k < method.flows; ++k)
    flows.push_back(
        {(method.first + k) % 2, numbers[std::min(k, method.palindrome ? method.flows - 1 - k : k)]});
  return flows;
}

// The residuals that have to vanish: of palindromes those of odd degree, as the others do so by themselves.
std::vector<Quad> residuals(const PublishedTable& method, const std::vector<Quad>& numbers) {
  std::vector<Quad> list;
  const std::vector<PartialFlow> flows = flows_of(method, numbers);
  for (const OrderCondition& c : method.orders.empty()
                                     ? splitting_conditions(flows, method.order, method.parts)
                                     : near_integrable_conditions(flows, method.orders))
    if (!method.palindrome || c.order % 2 == 1) list.push_back(c.residual);
  return list;
}

std::vector<Quad> solved(const PublishedTable& method) {
  std::vector<Quad> numbers;
  for (const char* text : method.numbers) EXPECT_TRUE(parse(text, numbers.emplace_back()));
  const std::size_t n = numbers.size();
  for (int iteration = 0; iteration < 4; ++iteration) {  // the last one or two correct round-off only
    const std::vector<Quad> defect = residuals(method, numbers);
    const std::size_t m = defect.size();
    std::vector<Quad> slopes(m * n), multiplier(m);
    const Quad shift(0x1p-40);  // central differences are as exact as 2^-80, which is enough for Newton
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<Quad> above = numbers, below = numbers;
      above[k] += shift;
      below[k] -= shift;
      const std::vector<Quad> up = residuals(method, above), down = residuals(method, below);
      for (std::size_t c = 0; c < m; ++c) slopes[c * n + k] = (up[c] - down[c]) / (Quad(2) * shift);
    }
    LU<Quad> normal(m);
    for (std::size_t a = 0; a < m; ++a)
      for (std::size_t b = 0; b < m; ++b) {
        normal(a, b) = Quad(0);
        for (std::size_t k = 0; k < n; ++k) normal(a, b) += slopes[a * n + k] * slopes[b * n + k];
      }
    EXPECT_TRUE(normal.factor()) << method.name;
    normal.solve(defect.data(), multiplier.data());
    for (std::size_t c = 0; c < m; ++c)
      for (std::size_t k = 0; k < n; ++k) numbers[k] -= slopes[c * n + k] * multiplier[c];
  }
  return numbers;
}

// Sofroniou and Spaletta's composition of order 10: the published digits, and the table's weights, which must
// fulfil the sixteen conditions of symmetric compositions and stay within what was rounded off in print.
TEST(SolvedTables, CompositionOfOrderTen) {
  constexpr std::array printed{
      "0.07879572252168641926390768",  "0.31309610341510852776481247",  "0.02791838323507806610952027",
      "-0.22959284159390709415121340", "0.13096206107716486317465686",  "-0.26973340565451071434460973",
      "0.07497334315589143566613711",  "0.11199342399981020488957508",  "0.36613344954622675119314812",
      "-0.39910563013603589787862981", "0.10308739852747107731580277",  "0.41143087395589023782070412",
      "-0.00486636058313526176219566", "-0.39203335370863990644808194", "0.05194250296244964703718290",
      "0.05066509075992449633587434",  "0.04967437063972987905456880",  "0.04931773575959453791768001"};
  TableDocument document(std::string(PFAFF_GOLDEN) + "/../../examples/tables/sofroniou-spaletta-10.toml");
  std::vector<Quad> weights = document.numbers("weights");
  ASSERT_EQ(weights.size(), 35U);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    Quad digits;
    ASSERT_TRUE(parse(printed[std::min(k, 34 - k)], digits));
    EXPECT_LT(abs(weights[k] - digits), Quad(1e-26)) << k;
  }
  const auto worst = [&] {
    Quad largest(0);
    for (const Word& word : order_condition_words(10))
      largest = std::max(
          largest, abs(word_coefficient(weights, word) - Quad(word.size() == 1 && word[0] == 1 ? 1 : 0)));
    return largest;
  };
  EXPECT_EQ(order_condition_words(10).size(), 16U);
  EXPECT_LT(worst(), Quad(1e-32));  // sums of 35 numbers of at most 0.4
  weights[3] += Quad(1e-28);
  EXPECT_GT(worst(), Quad(1e-29));
}

// Splittings with a small part: mclachlan1995small gives twenty digits, and
// blanes-casas-farres-laskar-makazaga-murua2013 as many as stand here. The conditions leave a direction in
// which numbers move by 1e9 of what a residual moves, so that residuals of quad, 1e-33, tell them to 1e-23.
TEST(SolvedTables, SchemesOfASmallPartAreWhatTheirConditionsGive) {
  const std::vector<PublishedTable> list{
      {"aba-8-4",
       8,
       Parts::general,
       drift,
       true,
       11,
       {"0.07534696026989288842", "0.19022593937367661925", "0.51791685468825678230",
        "0.84652407044352625706", "-0.09326381495814967072", "-1.07350001963440575260"},
       {8, 4}},
      {"aba-10-4",
       10,
       Parts::general,
       drift,
       true,
       15,
       {"0.04706710064597250612947887637243678556564", "0.1188819173681970199453503950853885936957",
        "0.1847569354170881069247376193702560968574", "0.2410504605515015657441667865901651105675",
        "0.2827060056798362053243616565541452479160", "-0.2732866667053238060543113981664559460630",
        "-0.01453004174289681837857815229683813033908", "0.8267085775712504407295884329818044835997"},
       {10, 4}},
      {"aba-8-6-4",
       8,
       Parts::general,
       drift,
       true,
       15,
       {"0.0711334264982231177779387300061549964174", "0.183083687472197221961703757166430291072",
        "0.241153427956640098736487795326289649618", "0.310782859898574869507522291054262796375",
        "0.521411761772814789212136078067994229991", "-0.0265646185119588006972121379164987592663",
        "-0.333698616227678005726562603400438876027", "0.065396142282373418455972179391"},
       {8, 6, 4}},
      {"aba-10-6-4",
       10,
       Parts::general,
       drift,
       true,
       17,
       {"0.03809449742241219545697532230863756534060", "0.09585888083707521061077150377145884776921",
        "0.1452987161169137492940200726606637497442", "0.2044461531429987806805077839164344779763",
        "0.2076276957255412507162056113249882065158", "0.2170703479789911017143385924306336714532",
        "0.4359097036515261592231548624010651844006", "-0.01737538195906509300561788011852699719871",
        "-0.6538612258327867093807117373907094120024"},
       {10, 6, 4}}};
  for (const PublishedTable& method : list) {
    const std::vector<Quad> numbers = solved(method);
    for (const Quad& residual : residuals(method, numbers))
      EXPECT_LT(abs(residual), Quad(1e-32)) << method.name;
    const std::vector<PartialFlow> flows = flows_of(method, numbers),
                                   ours = near_integrable_scheme(method.name).flows;
    ASSERT_EQ(flows.size(), ours.size()) << method.name;
    for (std::size_t k = 0; k < flows.size(); ++k) {
      EXPECT_EQ(flows[k].part, ours[k].part);
      EXPECT_LT(abs(flows[k].length - ours[k].length), Quad(1e-20)) << method.name << " " << k;
    }
  }
}

TEST(SolvedTables, HoldWhatTheOrderConditionsGive) {
  for (const PublishedTable& method : published()) {
    const std::vector<Quad> numbers = solved(method);
    // Nothing has moved by more than the digits that were published.
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      Quad start;
      parse(method.numbers[k], start);
      EXPECT_LT(abs(numbers[k] - start), Quad(1e-13)) << method.name << " " << k;
    }
    for (const Quad& residual : residuals(method, numbers))
      EXPECT_LT(abs(residual), Quad(1e-32)) << method.name;
    TableDocument document(std::string(PFAFF_GOLDEN) + "/../../examples/tables/" + method.name + ".toml");
    std::array<std::vector<Quad>, 2> lists;
    for (const PartialFlow& flow : flows_of(method, numbers)) lists[flow.part].push_back(flow.length);
    for (const auto& [key, part] : {std::pair("drift", drift), std::pair("kick", kick)}) {
      const std::vector<Quad> in_file = document.numbers(key);
      ASSERT_EQ(in_file.size(), lists[part].size()) << method.name;
      for (std::size_t k = 0; k < in_file.size(); ++k)
        EXPECT_LT(abs(in_file[k] - lists[part][k]), Quad(1e-32))
            << method.name << " " << key << " " << k << ": " << to_string(lists[part][k]);
    }
  }
}

}  // namespace
