// Vectors and covectors mixed up, which the compiler must refuse. Each comment `refused:` is the beginning of
// a message it must give.
#include <pfaff/brackets/almost_product/almost_product.hpp>

namespace {
using namespace pfaff;

const AlmostProduct<double> structure =
    oblique(std::vector<Covector<double>>{Covector<double>(std::vector<double>{-1, 1})});
const Metric<double> metric(Matrix<double>::identity(2));
const TangentVector<double> velocity(2);
const Covector<double> momentum(2);

// A momentum is projected by P^T.
// refused: a map of vectors takes no covector, and a map of covectors no vector
const auto projected_momentum = structure.admissible() * momentum;
const auto projected_velocity = structure.admissible().transposed() * velocity;
// The inverse metric is split by P on one side and P^T on the other, Pibar has P above and -P^T below.
// refused: the map on the left does not take what the one on the right gives
const auto half = metric.sharp() * structure.admissible();
// refused: maps between different spaces have no sum
const auto blocks = structure.admissible() + structure.admissible().transposed();
// refused: a vector and a covector have no sum
const auto sum = velocity + momentum;
// refused: a vector and a covector have no difference
const auto difference = momentum - velocity;
// refused: a pairing takes a covector and then a vector
const auto square = pairing(velocity, velocity);
}  // namespace
