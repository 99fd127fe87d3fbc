#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/model/controller/controller_law.hpp"
#include "core/model/controller/sampled_process.hpp"
#include "core/model/results/explanation.hpp"
#include "core/simulate/loop.hpp"

/// Simulated loops whose process and controller are known, one sample per second.
namespace loopscope::core::model::known {

using Series = std::vector<double>;

/// What a controller's records hold; owns them.
struct Records {
  Series error, sp, op, pv;
  [[nodiscard]] ControllerRecord view() const { return {error, sp, op, true}; }
  /// Again sp - pv, after a change of either.
  void renew_error();
};

struct KnownLoop {
  simulate::LoopSettings settings;
  ProcessFit process;  ///< as simulated; of a process with a zero (paper) the lag without it
  ControllerLaw law;   ///< as simulated
};

[[nodiscard]] KnownLoop scenario(std::string_view name);
/// First order or integrating, delay 1 to 10, SIMC law times 0.1 to 2, the load at either end, with
/// and without noise; stable with Ms < 8 and no set-point moves.
[[nodiscard]] KnownLoop random_loop(std::uint64_t seed);

[[nodiscard]] ControllerLaw law(double gain, double integral, std::size_t lag = 0);
[[nodiscard]] Records run(const simulate::LoopSettings& settings, std::uint64_t seed);
/// op rounded to `op_step` (0 = not), noise that the controller did not see on pv, in standard
/// deviations of the error.
void blur(Records& records, double op_step, double pv_noise, std::uint64_t seed);
[[nodiscard]] ControllerLaw find_law(const Records& records);

/// `fit` with gain and time constants off by up to a fifth.
[[nodiscard]] ProcessFit off_by_a_fifth(ProcessFit fit, std::uint64_t seed);

/// The process of equation 20, its zero included.
[[nodiscard]] SampledProcess paper_process();

/// The naive fit: pv on `order` past pv and op of the same sample and `order` before, least
/// squares.
[[nodiscard]] SampledProcess fit_without_delay(const Records& records, int order);

}  // namespace loopscope::core::model::known
