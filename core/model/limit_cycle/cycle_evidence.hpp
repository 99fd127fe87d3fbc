#pragma once

#include <span>
#include <vector>

#include "core/model/limit_cycle/cycle_band.hpp"
#include "core/model/limit_cycle/limit_cycle_cause.hpp"

namespace loopscope::core::model {

/// One stretch of a recording without holes, equally long: bridged where samples are missing.
struct CycleRecord {
  std::span<const double> pv;        ///< pv units
  std::span<const double> op;        ///< %, or op units without a range
  std::span<const double> error;     ///< sp - pv, pv units
  std::span<const double> recorded;  ///< 1, or 0 where pv or op is missing
};

/// CycleEvidence::op_coherence alone, which costs a hundredth of the rest; 0 without half cycles.
[[nodiscard]] double op_coherence(const CycleRecord& record, const CycleBand& band);

/// All of CycleEvidence but `cycles`, `period_samples` and `pace`. op and pv move.
[[nodiscard]] CycleEvidence gather_cycle_evidence(const CycleRecord& record, const CycleBand& band);

}  // namespace loopscope::core::model
