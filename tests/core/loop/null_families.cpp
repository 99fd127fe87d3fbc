#include "tests/core/loop/null_families.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/simulate/scenario.hpp"

namespace loopscope::core::loop::signals {
namespace {

/// Blocks of 10 to 60 samples go missing until 40 % of the record has.
Series with_blocks_missing(Random& random, Series series) {
  std::size_t missing = 0;
  while (10 * missing < 4 * series.size()) {
    const std::size_t length = 10 + random() % 51;
    const std::size_t first = random() % (series.size() - length);
    for (std::size_t k = first; k < first + length; ++k) {
      if (std::isfinite(series[k])) ++missing;
      series[k] = std::nan("");
    }
  }
  return series;
}

Family noise(std::string_view name, double phi) {
  return {name, [phi](std::size_t samples, std::uint64_t seed) {
            Random random(seed);
            return ar1(random, samples, phi);
          }};
}

Family scattered(std::string_view name, double phi) {
  return {name, [phi](std::size_t samples, std::uint64_t seed) {
            Random random(seed);
            return with_missing(random, ar1(random, samples, phi), 0.3);
          }};
}

Family blocked(std::string_view name, double phi) {
  return {name, [phi](std::size_t samples, std::uint64_t seed) {
            Random random(seed);
            return with_blocks_missing(random, ar1(random, samples, phi));
          }};
}

Family scenario(std::string_view name) {
  return {name, [name](std::size_t samples, std::uint64_t seed) {
            return scenario_error(name, samples, seed);
          }};
}

Family damped(std::string_view name, double damping) {
  return {name, [damping](std::size_t samples, std::uint64_t seed) {
            Random random(seed);
            return resonance(random, samples, 20.0, damping);
          }};
}

Family sinusoid(std::string_view name, double period) {
  return {name, [period](std::size_t samples, std::uint64_t seed) {
            Random random(seed);
            const Series clean = wave(random, samples, Wave::sine, period);
            return at_snr(clean, white(random, samples), 0.0);
          }};
}

}  // namespace

Series scenario_error(std::string_view scenario, std::size_t samples, std::uint64_t seed) {
  simulate::ScenarioOptions options;
  options.samples = samples;
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, options, seed);
  Series error(record.pv.size());
  std::transform(record.sp.begin(), record.sp.end(), record.pv.begin(), error.begin(),
                 std::minus<>());
  return error;
}

std::span<const Family> quiet_families() {
  static const std::array families{noise("white noise", 0.0),
                                   noise("AR(1) 0.9", 0.9),
                                   noise("AR(1) 0.99", 0.99),
                                   noise("random walk", 1.0),
                                   scenario("healthy_flow"),
                                   scenario("paper_5_1"),
                                   scenario("paper_5_2_printed"),
                                   scenario("level_loop"),
                                   scattered("random walk, 30 % missing", 1.0),
                                   blocked("AR(1) 0.9, 40 % missing in blocks", 0.9)};
  return families;
}

std::span<const Family> oscillating_families() {
  static const std::array families{sinusoid("sinusoid, period 20, 0 dB", 20.0),
                                   sinusoid("sinusoid, period 100, 0 dB", 100.0),
                                   sinusoid("sinusoid, period 300, 0 dB", 300.0),
                                   scenario("square_limit_cycle"),
                                   scenario("tight_tuning"),
                                   scenario("paper_5_2_excessive"),
                                   scenario("outside_oscillation"),
                                   scenario("paper_5_3"),
                                   scenario("sticking_valve")};
  return families;
}

std::span<const Family> damped_families() {
  static const std::array families{damped("poles 0.8, 1 % left after a period", 0.8),
                                   damped("poles 0.9, 12 % left", 0.9),
                                   damped("poles 0.97, 54 % left", 0.97)};
  return families;
}

}  // namespace loopscope::core::loop::signals
