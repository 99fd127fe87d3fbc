#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "core/model/results/mechanism.hpp"
#include "tests/plants/plant.hpp"

namespace loopscope::tests::plants {

/// What the flags of a plant need to know of one loop's diagnosis.
struct DiagnosedLoop {
  std::string verdict;
  double confidence = 0.0;
  std::optional<double> p;  ///< of what the verdict rests on
  std::size_t tests = 0;    ///< that the loop brings into the family
  std::vector<std::string> steps;
  /// 1 less the probability of healthy; nullopt = nothing was weighed.
  std::optional<double> fault_probability = std::nullopt;
  double windows = 0.0;  ///< that share no sample and are behind it; 0 = of one window alone
};

[[nodiscard]] DiagnosedLoop diagnosed(const core::Diagnosis& diagnosis);

[[nodiscard]] DiagnosedLoop diagnose_loop(const PlantLoop& loop,
                                          const core::model::Without& without = {});

/// Every loop, in order; the same for any number of threads. Throws what a loop throws.
[[nodiscard]] std::vector<DiagnosedLoop> diagnose_plant(const std::vector<PlantLoop>& plant,
                                                        unsigned threads,
                                                        const core::model::Without& without = {});

}  // namespace loopscope::tests::plants
