// Whether a method chooses its steps in quad. Methods of other libraries often do so in double alone.
#pragma once

#include <memory>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// True where the method takes a tolerance in quad precision too, which it is asked by a run of no length on
/// the model. False for a method that takes fixed steps only.
bool adaptive_in_quad(const MethodInstance& method, const std::shared_ptr<const Model>& model);

}  // namespace pfaff
