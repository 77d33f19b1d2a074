// The formulas that a step in Python may call: those that the facets of a model offer, and the parts that the
// facets are made of, as `pfaff list facets` has them.
#pragma once

#include <string>

#include <pfaff/core/facets/model.hpp>

namespace pfaff::python {

/// The facets that a formula belongs to.
FacetSet facets_of(const FormulaRow& row);

/// The row of a formula of this name that the model has. InputError where it has none.
const FormulaRow& offered_formula(const Model& model, const std::string& name);

}  // namespace pfaff::python
