// Code that two compilations of a source leave each other (core/facets/scalar_units.hpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/runs/motion.hpp>

namespace pfaff {
namespace {

template <class... T, class Use>
void for_each_scalar(Scalars<T...> /*list*/, const Use& use) {
  (use(T()), ...);
}

// A plug-in whose source is compiled once, by mistake, could step in double and in nothing else.
TEST(ScalarUnits, EveryMethodIsMadeInEveryScalar) {
  for (const MethodPlugin* plugin : integrators().all()) {
    const auto method = plugin->make({});
    for (const SystemPlugin* system : systems().all()) {
      const auto model = motion_for(*method, system->make({}));
      if (!method->refuses(*model).empty()) continue;
      for_each_scalar(StepScalars(), [&](auto scalar) {
        EXPECT_NE(method->stepper(model, scalar), nullptr) << plugin->name() << " on " << system->name();
      });
      break;
    }
  }
}

TEST(ScalarUnits, EveryFormulaOfEverySystemIsMadeInEveryScalarAndRecorded) {
  for (const SystemPlugin* system : systems().all()) {
    const auto model = system->make({});
    for (std::size_t k = 0; k < formula_count; ++k) {
      const FormulaProgram* program = model->program(static_cast<Formula>(k));
      if (program == nullptr) continue;
      for_each_scalar(StepScalars(),
                      [&](auto scalar) { EXPECT_NE(program->evaluator(scalar).call, nullptr); });
      EXPECT_FALSE(program->record().code.empty()) << system->name();
    }
    if (model->facets().has(Facet::holonomic))
      for_each_scalar(StepScalars(), [&](auto scalar) {
        EXPECT_NE(model->holonomic_constraints<decltype(scalar)>(), nullptr) << system->name();
      });
  }
}

TEST(ScalarUnits, EveryFormulationMakesItsFieldInEveryScalar) {
  for (const FormulationPlugin* formulation : formulations().all())
    for (const SystemPlugin* system : systems().all()) {
      const auto model = system->make({});
      if (!formulation->refuses(*model).empty()) continue;
      const auto motion = formulation->apply(model, {});
      const FormulaProgram* field = motion->program(Formula::field);
      if (field == nullptr) continue;  // on tapes
      for_each_scalar(StepScalars(), [&](auto scalar) {
        EXPECT_NE(field->evaluator(scalar).call, nullptr) << formulation->name() << " of " << system->name();
      });
      EXPECT_FALSE(field->record().code.empty()) << formulation->name();
      break;
    }
}

struct Left {};

TEST(ScalarUnits, CodeThatNobodyLeftIsAnErrorThatNamesTheType) {
  EXPECT_THAT([] { static_cast<void>(detail::code_left(typeid(Left), typeid(Quad))); },
              ::testing::ThrowsMessage<std::logic_error>(::testing::HasSubstr("Left")));
}

TEST(ScalarUnits, TwoTypesOfOneNameAreAnError) {
  const auto code = [] {};
  detail::leave_code(typeid(Left), typeid(double), +code);
  EXPECT_EQ(detail::code_left(typeid(Left), typeid(double)), +code);
  EXPECT_THROW(detail::leave_code(typeid(Left), typeid(double), +code), std::logic_error);
}

}  // namespace
}  // namespace pfaff
