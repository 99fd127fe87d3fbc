#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/model/explain.hpp"
#include "core/model/fit/fit.hpp"
#include "core/model/valve_law/valve_law.hpp"
#include "core/model/valve_search/hysteresis_grid_search.hpp"
#include "core/simulate/loop.hpp"

/// Records whose model is known, one sample per second unless said otherwise.
namespace loopscope::core::model::tests {

using Series = std::vector<double>;

/// A disturbance that wanders about its mean for tens of samples.
inline constexpr NoiseModel kNoise{1, {0.95, 0.0, 0.0}, {-0.4, 0.0, 0.0}};
inline constexpr double kInterval = 5.0;  ///< seconds between samples that are not one apart
/// Turns of op after which its direction is believed.
inline constexpr std::size_t kManyTurns = 100;

/// op that steps by up to `size` % about 50 % and rests 5 to 45 samples between: no feedback.
[[nodiscard]] Series stepping_op(std::size_t samples, std::uint64_t seed, double size = 10.0);

[[nodiscard]] Series white_noise(std::size_t samples, std::uint64_t seed, double deviation = 1.0);

/// Amplitude 1, in noise of that deviation.
[[nodiscard]] Series sine(std::size_t samples, double period, double noise = 0.0);
/// 0 up to `half` and back within twice as many samples.
[[nodiscard]] Series triangle(std::size_t samples, std::size_t half);

/// The noise model's v from w = white_noise(samples, seed, deviation), at rest before.
[[nodiscard]] Series coloured_noise(const NoiseModel& noise, std::size_t samples,
                                    std::uint64_t seed, double deviation);

[[nodiscard]] Series sum(const Series& left, const Series& right);
[[nodiscard]] Series scaled(Series series, double factor);
[[nodiscard]] double mean(const Series& series);

/// pv = 50 + gain answer(shape, op - 50) + noise.
[[nodiscard]] Series process_record(const ProcessShape& shape, double gain, const Series& op,
                                    const Series& noise);

/// What a sensor records of it that is renewed every so many samples, from `first` on.
[[nodiscard]] Series held(Series series, std::size_t samples, std::size_t first = 0);

/// One lag after some samples of delay, two lags, an integrator.
[[nodiscard]] ProcessShape one_lag(double pole, std::size_t delay_samples);
[[nodiscard]] ProcessShape two_lags(double pole, double second_pole, std::size_t delay_samples);
[[nodiscard]] ProcessShape integrator(std::size_t delay_samples);

/// That structure without noise dynamics, second lag and second tap as the shape has them.
[[nodiscard]] Structure structure_of(const ProcessShape& shape,
                                     std::vector<EffectPtr> effects = {});

/// The flow loop of the scenarios with that effect and nothing else: neither noise nor load; the
/// setpoint moves up and down by `move` every 100 samples or so.
[[nodiscard]] simulate::LoopRecord noiseless_loop(const simulate::Effect& effect, double move);
/// Its process: gain 1.2, pole 0.6, delay 2.
[[nodiscard]] ProcessShape noiseless_process();
inline constexpr double kNoiselessGain = 1.2;

/// That process with this effect, fitted to such a loop.
[[nodiscard]] Fit fit_noiseless(const LoopData& data, EffectPtr effect);

/// The coefficients of the last effect's columns.
[[nodiscard]] Series last_coefficients(const Fit& fit);
/// The last effect in the results' words.
[[nodiscard]] std::vector<Parameter> last_parameters(const LoopData& data, const Fit& fit);
/// The parameter of that name; NaN when there is none.
[[nodiscard]] double value_of(const std::vector<Parameter>& parameters, std::string_view name);

/// The valve that a search has put last.
[[nodiscard]] const Valve& valve_of(const GridResult& find);

/// A scenario's loop, with the settings of the scenario.
[[nodiscard]] simulate::LoopRecord scenario_record(std::string_view name, std::uint64_t seed = 1);

/// explain() of what the historian would hold of a simulated loop.
[[nodiscard]] std::optional<Explanation> explain_record(const simulate::LoopRecord& record,
                                                        std::uint64_t seed = 1);
[[nodiscard]] std::optional<Explanation> explain_scenario(std::string_view name,
                                                          std::uint64_t seed);

/// Whether valve, process or sensor are said to be wrong.
[[nodiscard]] bool claims_hardware(const Explanation& explanation);

}  // namespace loopscope::core::model::tests
