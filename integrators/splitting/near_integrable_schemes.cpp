#include <pfaff/integrators/splitting/near_integrable_schemes.hpp>

#include <algorithm>
#include <stdexcept>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/gauss_legendre.hpp>

namespace pfaff {

namespace {

constexpr std::size_t dominant = 0, perturbation = 1;

std::vector<Quad> numbers(const std::vector<const char*>& texts) {
  std::vector<Quad> list;
  for (const char* text : texts) list.push_back(Real::parse(text).value().quad());
  return list;
}

// Adds a flow after the others; two flows of one part are one.
void append(std::vector<PartialFlow>& flows, const PartialFlow& flow) {
  if (!flows.empty() && flows.back().part == flow.part) {
    flows.back().length += flow.length;
  } else {
    flows.push_back(flow);
  }
}

// The palindrome that begins with A: halves of the lengths, of A and of B, whose middle stands once where
// there are an odd number of them.
std::vector<PartialFlow> palindromic_flows(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  std::vector<PartialFlow> half;
  for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k) {
    if (k < a.size()) half.push_back({dominant, a[k]});
    if (k < b.size()) half.push_back({perturbation, b[k]});
  }
  std::vector<PartialFlow> flows = half;
  for (std::size_t k = half.size() - 1; k-- > 0;) flows.push_back(half[k]);
  return flows;
}

// Gauss's formula with n nodes as lengths of B and its gaps as lengths of A.
std::vector<PartialFlow> gauss_flows(int n) {
  std::vector<QuadratureNode> nodes = gauss_legendre(n);
  std::reverse(nodes.begin(), nodes.end());
  std::vector<PartialFlow> flows;
  Quad at(0);
  for (const QuadratureNode& node : nodes) {
    flows.push_back({dominant, node.place.quad() - at});
    flows.push_back({perturbation, node.weight.quad()});
    at = node.place.quad();
  }
  flows.push_back({dominant, Quad(1) - at});
  return flows;
}

// The processor of order n = 2 k + 1: for j = 1, ..., k the pairs X(j a, b_j) X(-j a, -b_j) with X(a, b) =
// flow of A for -a, of B for b and of A for a, where a = sqrt(7/40) (wisdom-holman-touma1996). With one B,
// and B moved along A for the time s written e^(s x), the kernel is e^(x/2) and the flow of H is (e^x - 1)/x.
// That the corrected kernel is this flow up to x^n says, with c(x) = 2 sum_j b_j sinh(j a x),
//
//   2 sinh(x/2) c(x) = sinh(x/2)/(x/2) - 1 + O(x^(n + 1)),
//
// k linear equations for the odd coefficients of c.
std::vector<PartialFlow> processor(int order) {
  const auto count = static_cast<std::size_t>((order - 1) / 2);
  // The coefficients of x^(2 i + 1) in (sinh(x/2)/(x/2) - 1)/(2 sinh(x/2)), by division of series.
  std::vector<Quad> wanted(count), divisor(count);
  Quad factorial(1), power(1);  // (2 i + 1)! and 4^i
  for (std::size_t i = 0; i < count; ++i) {
    divisor[i] = Quad(1) / (factorial * power);  // of x^(2 i + 1) in 2 sinh(x/2)
    factorial *= Quad(static_cast<int>((2 * i + 2) * (2 * i + 3)));
    power *= Quad(4);
    wanted[i] = Quad(1) / (factorial * power);  // of x^(2 i + 2) in sinh(x/2)/(x/2) - 1
    for (std::size_t j = 0; j < i; ++j) wanted[i] -= divisor[i - j] * wanted[j];
  }
  // 2 sum_j b_j (j a)^(2 i + 1)/(2 i + 1)! = wanted_i: a system of Vandermonde's kind.
  const Quad a = sqrt(Quad(7) / Quad(40));
  LU<Quad> equations(count);
  for (std::size_t j = 0; j < count; ++j) {
    const Quad place = a * Quad(static_cast<int>(j + 1));
    Quad term = Quad(2) * place;
    for (std::size_t i = 0; i < count; ++i) {
      equations(i, j) = term;
      term *= place * place / Quad(static_cast<int>((2 * i + 2) * (2 * i + 3)));
    }
  }
  if (!equations.factor()) throw std::logic_error("the equations of a processor are singular");
  std::vector<Quad> weights(count);
  equations.solve(wanted.data(), weights.data());
  std::vector<PartialFlow> flows;
  for (std::size_t j = 0; j < count; ++j) {
    const Quad place = a * Quad(static_cast<int>(j + 1));
    for (const Quad& side : {Quad(1), Quad(-1)}) {
      append(flows, {dominant, -(side * place)});
      append(flows, {perturbation, side * weights[j]});
      append(flows, {dominant, side * place});
    }
  }
  return flows;
}

NearIntegrableScheme corrected(int order) {
  const std::vector<PartialFlow> before = processor(order);
  return {"corrected-" + std::to_string(order),
          {order + 1, 2},
          processed_step(before, palindromic_flows({Quad(1) / Quad(2)}, {Quad(1)})),
          false,
          before.size()};
}

// The published digits of the schemes of order (8, 4) of mclachlan1995small and (10, 4), (8, 6, 4) and (10,
// 6, 4) of blanes-casas-farres-laskar-makazaga-murua2013, continued to 36 by solving the generalised
// conditions again.
std::vector<NearIntegrableScheme> make_schemes() {
  std::vector<NearIntegrableScheme> list;
  list.push_back({"strang", {2}, palindromic_flows({Quad(1) / Quad(2)}, {Quad(1)})});
  for (const int n : {2, 3, 4, 5})
    list.push_back({"aba-" + std::to_string(2 * n) + "-2", {2 * n, 2}, gauss_flows(n)});
  list.push_back(
      {"aba-8-4",
       {8, 4},
       palindromic_flows(
           numbers({"0.0753469602698928884165278036834744644", "0.517916854688256782300773978496315644",
                    "-0.0932638149581496707173017821797901087"}),
           numbers({"0.190225939373676619245230762738453897", "0.846524070443526257055080544646775834",
                    "-1.07350001963440575260062261477045946"}))});
  list.push_back(
      {"aba-10-4",
       {10, 4},
       palindromic_flows(
           numbers({"0.0470671006459725061294788763724367856", "0.184756935417088106924737619370256097",
                    "0.282706005679836205324361656554145248", "-0.0145300417428968183785781522968381303"}),
           numbers({"0.118881917368197019945350395085388594", "0.241050460551501565744166786590165111",
                    "-0.273286666705323806054311398166455946", "0.826708577571250440729588432981804484"}))});
  list.push_back(
      {"aba-8-6-4",
       {8, 6, 4},
       palindromic_flows(
           numbers({"0.0711334264982231177779387300061549964", "0.24115342795664009873648779532628965",
                    "0.52141176177281478921213607806799423", "-0.333698616227678005726562603400438876"}),
           numbers({"0.183083687472197221961703757166430291", "0.310782859898574869507522291054262796",
                    "-0.0265646185119588006972121379164987593",
                    "0.0653961422823734184559721793916113436"}))});
  list.push_back(
      {"aba-10-6-4",
       {10, 6, 4},
       palindromic_flows(
           numbers({"0.0380944974224121954569753223086375653", "0.14529871611691374929402007266066375",
                    "0.207627695725541250716205611324988207", "0.435909703651526159223154862401065184",
                    "-0.653861225832786709380711737390709412"}),
           numbers({"0.0958588808370752106107715037714588478", "0.204446153142998780680507783916434478",
                    "0.217070347978991101714338592430633671", "-0.0173753819590650930056178801185269972"}))});
  for (const int order : {3, 5, 7, 11}) list.push_back(corrected(order));
  return list;
}

const std::vector<NearIntegrableScheme>& schemes() {
  static const std::vector<NearIntegrableScheme> list = make_schemes();
  return list;
}

}  // namespace

std::vector<std::string> near_integrable_names() {
  std::vector<std::string> names;
  for (const NearIntegrableScheme& scheme : schemes()) names.push_back(scheme.name);
  return names;
}

const NearIntegrableScheme& near_integrable_scheme(const std::string& name) {
  for (const NearIntegrableScheme& scheme : schemes())
    if (scheme.name == name) return scheme;
  throw std::logic_error("there is no near-integrable scheme " + name);
}

}  // namespace pfaff
