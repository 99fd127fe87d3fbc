#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "core/hos/analyse.hpp"
#include "core/model/traces.hpp"
#include "daemon/service/windows/loop_input.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// The squared bicoherence of a loop's error over the principal domain of a DFT of `dft_length`.
struct BicoherenceMap {
  std::vector<double> bic2;  ///< in the order of core::hos::PrincipalDomain
  std::size_t dft_length = 0;
  double interval_s = 1.0;             ///< between the samples that were transformed
  std::vector<core::hos::Peak> peaks;  ///< strongest first, cycles per sample of that interval
  bool slow = false;                   ///< of the second look, resampled to a slow oscillation
};

/// A loop's slot looked at again, with everything that the pictures are made of.
struct LoopEvidence {
  storage::CatalogueEntry loop;
  LoopWindowAtSlot at_slot;
  core::signal::PreparedLoop prepared;
  core::Diagnosis diagnosis;
  std::optional<core::model::ExplanationTraces> traces;  ///< nullopt = no model was fitted
  std::optional<BicoherenceMap> map;                     ///< nullopt = the data are not usable
};

/// Diagnoses a slot again, as core::diagnose() does, with the same seed as analyse_window(): the
/// same rows and settings give the same verdict. Throws as core::diagnose() does.
[[nodiscard]] LoopEvidence rediagnose(const storage::CatalogueEntry& loop, const LoopInput& input,
                                      const core::AnalysisSettings& settings);

}  // namespace loopscope::daemon
