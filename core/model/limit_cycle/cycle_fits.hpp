#pragma once

#include <span>
#include <vector>

#include "core/model/limit_cycle/cycle_band.hpp"
#include "core/model/limit_cycle/cycle_evidence.hpp"
#include "core/model/limit_cycle/simulation_fit.hpp"
#include "core/model/valve_law/op_turns.hpp"

namespace loopscope::core::model {

/// Share of op's travel that it has to go back for a turn.
inline constexpr double kTurnProminence = 0.3;

/// A stretch in the band of its cycle, in kept samples.
struct BandedCycle {
  std::vector<double> pv, op;
  std::vector<double> weights;  ///< 1, or 0 where pv or op is missing
  std::vector<double> op_kept;  ///< not yet in the band
  double travel = 0.0;          ///< peak-to-peak travel of op were it a triangle, op units
  double sign = 0.0;            ///< of the controller, +1 or -1; 0 = not known
};
[[nodiscard]] BandedCycle to_band(const CycleRecord& record, const CycleBand& band);

/// The travel alone, op units, of op in the band (not empty).
[[nodiscard]] double travel_of(std::span<const double> op);

/// The three models that the judge of limit cycles compares, each at its best.
struct CycleFits {
  std::vector<OpTurn> turns;  ///< of op as recorded
  SimulationFit linear;
  SimulationFit law;      ///< behind a valve of He's law that starts at the first turn
  SimulationFit turning;  ///< behind a valve known to have moved at every turn
};
/// The fits view `banded` and `band`.
[[nodiscard]] CycleFits fit_cycle(const CycleRecord& record, const CycleBand& band,
                                  const BandedCycle& banded);

/// pv in the band as the best of each gives it, kept samples.
[[nodiscard]] std::vector<double> linear_output(const CycleFits& fits, const BandedCycle& banded);
[[nodiscard]] std::vector<double> law_output(const CycleFits& fits, const CycleRecord& record,
                                             const CycleBand& band);
[[nodiscard]] std::vector<double> turning_output(const CycleFits& fits, const CycleRecord& record,
                                                 const CycleBand& band);

}  // namespace loopscope::core::model
