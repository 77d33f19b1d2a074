// The Sun and the five outer planets of hairer-lubich-wanner2006 I.2.4 as points that attract each other:
//
//   H = sum_i |p_i|^2/(2 m_i) - G sum_{j < i} m_i m_j/|q_i - q_j|
//
// Units: astronomical units, days, masses of the Sun. Frame: equatorial, with the Sun at rest in the origin
// at the start, 5 September 1994 at 0h; its mass holds those of the inner planets. The centre of mass moves.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/gravitation.hpp>

namespace {
using namespace pfaff;

struct OuterSolarSystem : Gravitation<OuterSolarSystem> {
  static constexpr int dimension = 36;
  Real gravitation = 2.95912208286e-4_r, sun = 1.00000597682_r, jupiter = 0.000954786104043_r,
       saturn = 0.000285583733151_r, uranus = 0.0000437273164546_r, neptune = 0.0000517759138449_r,
       pluto = Real::fraction(1, 130000000);
  static std::vector<Parameter> parameters() {
    using S = OuterSolarSystem;
    const auto mass = [](Real S::*member, const char* name, const std::string& of = "") {
      return parameter(member, name, "Msun", 1e-12, 10,
                       "mass" + of + "; what has none is a probe of restricted-n-body");
    };
    return {parameter(&S::gravitation, "gravitation", "au^3/(Msun d^2)", 0, 1, "constant of gravitation"),
            mass(&S::sun, "sun", ", with the inner planets"),
            mass(&S::jupiter, "jupiter"),
            mass(&S::saturn, "saturn"),
            mass(&S::uranus, "uranus"),
            mass(&S::neptune, "neptune"),
            mass(&S::pluto, "pluto")};
  }
  static int bodies() { return 6; }
  static int dimensions() { return 3; }
  static Real softening() { return {}; }
  [[nodiscard]] const Real& constant() const { return gravitation; }
  template <class T>
  T mass(std::size_t body) const {
    using S = OuterSolarSystem;
    constexpr std::array masses{&S::sun, &S::jupiter, &S::saturn, &S::uranus, &S::neptune, &S::pluto};
    return T(this->*masses[body]);
  }
  static std::vector<Coordinate> coordinates() {
    return named({"sun", "jupiter", "saturn", "uranus", "neptune", "pluto"}, 3, "au", "Msun au/d");
  }
  static std::vector<Invariant> invariant_list() {
    return kept(3, "Msun au^2/d^2", "Msun au/d", "Msun au^2/d");
  }
  template <class T>
  void initial(Out<T> z) const {
    const std::array<std::array<Real, 6>, 6> rows{{
        {0, -3.5023653_r, 9.0755314_r, 8.3101420_r, 11.4707666_r, -15.5387357_r},
        {0, -3.8169847_r, -3.0458353_r, -16.2901086_r, -25.7294829_r, -25.2225594_r},
        {0, -1.5507963_r, -1.6483708_r, -7.2521278_r, -10.8169456_r, -3.1902382_r},
        // Velocities.
        {0, 0.00565429_r, 0.00168318_r, 0.00354178_r, 0.00288930_r, 0.00276725_r},
        {0, -0.00412490_r, 0.00483525_r, 0.00137102_r, 0.00114527_r, -0.00170702_r},
        {0, -0.00190589_r, 0.00192462_r, 0.00055029_r, 0.00039677_r, -0.00136504_r},
    }};
    for (std::size_t row = 0; row < 6; ++row)
      for (std::size_t i = 0; i < 6; ++i)
        z[6 * row + i] = row < 3 ? T(rows[row][i]) : mass<T>(i) * T(rows[row][i]);
  }
};

const System<OuterSolarSystem> registered{
    {.name = "outer-solar-system",
     .title = "the Sun and the five outer planets, H = sum |p_i|^2/(2 m_i) - G sum m_i m_j/|q_i - q_j|",
     .reference = "hairer-lubich-wanner2006 I.2.4",
     .description = "Sun, Jupiter, Saturn, Uranus, Neptune and Pluto as point masses that attract each "
                    "other. Take it for long runs with steps of tens to hundreds of days: Jupiter goes "
                    "round in 4333 days, Pluto in 90000. Masses and states are those of a textbook and not "
                    "of an ephemeris.",
     .time_unit = "d"}};
}  // namespace
