#pragma once

#include <cstdint>
#include <vector>

#include "core/model/fit/fit.hpp"
#include "core/model/record/model_input.hpp"
#include "core/model/residual_tests/test_residual.hpp"

namespace loopscope::core::model {

/// The model run on op alone, pv units.
[[nodiscard]] std::vector<double> response_of(const LoopData& data, const Fit& fit);

/// What the one-step errors of a fit still hold, by the residual tests. `data` and `fit` are of the
/// record in `input`.
[[nodiscard]] std::vector<TestOutcome> run_residual_tests(const ModelInput& input,
                                                          const LoopData& data, const Fit& fit);
/// The same by the tests of core/hos, which cost more than the others together: nonlinear, ngi.
/// `seed` drives the simulations behind their p-values.
[[nodiscard]] std::vector<TestOutcome> run_coupling_tests(const LoopData& data, const Fit& fit,
                                                          std::uint64_t seed);

}  // namespace loopscope::core::model
