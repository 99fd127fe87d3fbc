#pragma once

#include "core/model/fit/fit_variants.hpp"

namespace loopscope::core::model {

/// An outside wave and what it leaves: n ln(error) on the fit rows, the price of its columns beyond
/// those of a plain line included.
struct PricedWave {
  EffectPtr effect;
  double misfit = 0.0;
};

/// The misfit of a PricedWave, of a fit whose last effect is a wave.
[[nodiscard]] double misfit_of(const Fit& fit, const LoopData& data);

/// The line changing a few times over the record; null where the record is too short for that, or
/// Mechanism::wave_shape is left out.
[[nodiscard]] EffectPtr slowly_changing(const EffectPtr& line, const LoopData& data);

/// The wave that explains most for its price, of those that share a period with `start`, by turns
/// with other harmonics and with other knots; process and noise as the variants have them.
[[nodiscard]] PricedWave best_wave(const FitVariants& variants, const LoopData& data,
                                   const EffectPtr& start);

/// A first look at a line: as it is, or changing a few times over the record, whichever is better.
/// A phase that wanders leaves little of the line itself.
[[nodiscard]] PricedWave first_look_at_wave(const FitVariants& variants, const LoopData& data,
                                            const EffectPtr& line);

}  // namespace loopscope::core::model
