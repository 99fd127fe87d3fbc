#pragma once

#include <cstddef>

#include "core/model/effects/valve.hpp"
#include "core/model/process_shape.hpp"

namespace loopscope::core::model {

/// One guess of a valve that is looked at between the samples, and of the process behind it: as
/// long as the valve is wrong the process is too, so that neither can be sought by itself.
struct StemGenes {
  double band = 0.0;         ///< S, % of op, > 0
  double jump_share = 0.0;   ///< J by S, 0 to 1
  double behind_op = 0.0;    ///< of the first op, in breakaways (S + J) / 2; -1 to 1
  BetweenSamples between{};  ///< actuator_lag_samples > 0
  double slowness = 1.0;     ///< times the first lag of the process that the search began with
  double second_slowness = 1.0;
  int later_samples = 0;  ///< than its dead time
  double fit_error = 0.0;
};

/// Guess `number` of those that fill the room evenly, about a valve of that band.
[[nodiscard]] StemGenes drawn_genes(ValveLaw law, double band, std::size_t number);

/// Child `number` of a guess; `scale` 1 = about as far as guesses lie apart.
[[nodiscard]] StemGenes varied(const StemGenes& parent, double scale, std::size_t number);

/// `first_op` in % from the mean of op.
[[nodiscard]] ValveEffect valve_of(const StemGenes& genes, ValveLaw law, double first_op);
[[nodiscard]] ProcessShape process_of(const StemGenes& genes, ProcessShape start);

}  // namespace loopscope::core::model
