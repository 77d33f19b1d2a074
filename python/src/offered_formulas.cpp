#include <pfaff/python/src/offered_formulas.hpp>

#include <stdexcept>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff::python {

FacetSet facets_of(const FormulaRow& row) { return {row.traits.offered_by.bits | row.traits.part_of.bits}; }

const FormulaRow& offered_formula(const Model& model, const std::string& name) {
  for (const FormulaRow& row : formula_table) {
    if (row.name != name || !model.facets().meets(facets_of(row))) continue;
    // Parts may be left out, as an entropy, and not all follow from others.
    try {
      (void)model.tape(row.formula);
    } catch (const std::logic_error&) {
      break;
    }
    return row;
  }
  throw InputError("system " + model.name() + " has no " + name);
}

}  // namespace pfaff::python
