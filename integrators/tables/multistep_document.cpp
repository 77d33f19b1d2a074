#include <pfaff/integrators/tables/multistep_document.hpp>

namespace pfaff {

MultistepPolynomials read_multistep_polynomials(TableDocument& document, TableHead& head,
                                                std::size_t fewest) {
  MultistepPolynomials method{document.numbers("rho"), document.numbers("sigma")};
  constexpr std::size_t most = 25;
  const std::size_t length = method.rho.size();
  if (length < fewest || length > most)
    document.refuse("rho", "expected " + std::to_string(fewest) + " to " + std::to_string(most) +
                               " numbers, got " + std::to_string(length));
  if (method.sigma.size() != length)
    document.refuse("sigma", "expected " + std::to_string(length) + " numbers, as many as rho has, got " +
                                 std::to_string(method.sigma.size()));
  if (method.rho.back() == Quad(0)) document.refuse("rho", "the last number is 0; expected another");
  head.descriptor.preserves = kept_claims(document, {}, [](Claim /*claim*/) {
    return "a multistep method is a map of several states, of which no claim speaks";
  });
  return method;
}

OrderTheory multistep_theory(const char* kind, const TableHead& head, const std::vector<Quad>& numbers,
                             std::size_t steps) {
  OrderTheory theory{kind, head.descriptor.order, numbers, {}, head.precision};
  for (std::size_t k = 0; k < numbers.size(); ++k) theory.sums.push_back(k < steps ? 0 : 1);
  return theory;
}

}  // namespace pfaff
