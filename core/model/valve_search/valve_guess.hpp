#pragma once

#include <array>
#include <cstddef>

#include "core/model/effects/valve.hpp"
#include "core/model/response/process_shape.hpp"

namespace loopscope::core::model {

/// What a guess of a valve between the samples, and of the process behind it, is made of: as long
/// as the valve is wrong the process is too, so that neither can be sought by itself.
enum class Gene : std::size_t {
  log_band,           ///< of S, % of op
  jump_share,         ///< J by S, 0 to 1
  behind_op,          ///< of the first op, in breakaways (S + J) / 2; -1 to 1
  log_actuator_lag,   ///< samples
  log_slowness,       ///< of the times that the first lag of the process is as long as it was
  log_lateness,       ///< the same of dead time and second lag together
  second_share,       ///< of the second lag by the two, up to 1; none where below 0
  log_stem_lag,       ///< samples; of law `kano`, as is the next
  log_resting_speed,  ///< bands a sample; one below kSlowestRest is none
};
inline constexpr std::size_t kGenes = 9;

/// Such a guess, in coordinates along which a step means about as much everywhere.
struct ValveGuess {
  std::array<double, kGenes> at{};
  double fit_error = 0.0;

  [[nodiscard]] double operator[](Gene gene) const { return at[static_cast<std::size_t>(gene)]; }
};

/// Guess `number` of those that fill the room evenly, about a valve of that band (% of op, > 0).
[[nodiscard]] ValveGuess drawn_genes(double band, std::size_t number);

/// How two guesses differ, of which a child goes a `share` of the way.
struct Way {
  const ValveGuess& from;
  const ValveGuess& to;
  double share = 0.0;
};

/// Child `number` of a guess: moved along that way, and by itself in all directions; `scale` 1 =
/// about as far as guesses lie apart.
[[nodiscard]] ValveGuess varied(const ValveGuess& parent, const Way& way, double scale,
                                std::size_t number);

/// `first_op` in % from the mean of op.
[[nodiscard]] ValveEffect valve_of(const ValveGuess& genes, ValveLaw law, double first_op);
[[nodiscard]] ProcessShape process_of(const ValveGuess& genes, ProcessShape start);

}  // namespace loopscope::core::model
