// The bracket of friction as a plug-in: <p_i, p_j> = delta_ij lambda_i on (q, p).
#include <pfaff/brackets/symmetric.hpp>
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct Semimetric {
  std::vector<Real> coefficients{1, 2};
  static std::vector<Parameter> parameters() {
    return {parameter(&Semimetric::coefficients, "coefficients", "kg/s", 0, 1e9,
                      "lambda_i >= 0, one for each degree of freedom")};
  }
  [[nodiscard]] int dimension() const { return 2 * static_cast<int>(coefficients.size()); }
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    friction_bracket([this](const auto&, auto, auto lambda) {
      for (std::size_t k = 0; k < lambda.size(); ++k)
        lambda[k] = std::decay_t<decltype(lambda[k])>(coefficients[k]);
    }).sharp(t, z, covector, vector);
  }
};

const Bracket<Semimetric> registered{
    {.name = "semimetric",
     .title = "friction, <p_i, p_j> = delta_ij lambda_i",
     .reference = "nguyen-turski section 4",
     .description =
         "The symmetric bracket of linear friction, which acts on momenta alone. Take it beside a Poisson "
         "bracket to make a damped system: energy falls at the rate <H, H>. It is degenerate, as positions "
         "are Casimirs of it, and obeys no Jacobi identity; its coefficients are not negative.",
     .symmetry = Symmetry::symmetric,
     .jacobi = false,
     .semimetric = true}};
}  // namespace
