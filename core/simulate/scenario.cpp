#include "core/simulate/scenario.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>

#include "core/simulate/paper_loops.hpp"
#include "core/simulate/paper_signals.hpp"
#include "core/simulate/plant_loops.hpp"

namespace loopscope::core::simulate {

namespace {

using SignalMaker = std::vector<double> (*)(std::size_t samples, std::uint64_t seed);
using PaperLoopMaker = LoopSettings (*)();
using PlantLoopMaker = LoopSettings (*)(const Recording&);

/// A scenario and what makes it: exactly one of the three.
struct Entry {
  Scenario scenario;
  SignalMaker signal = nullptr;
  PaperLoopMaker paper = nullptr;
  PlantLoopMaker plant = nullptr;
  double sample_interval_s = 1.0;
};

Entry signal(std::string_view name, std::string_view description, SignalMaker maker) {
  return {.scenario = {name, description, false},
          .signal = maker,
          .paper = nullptr,
          .plant = nullptr,
          .sample_interval_s = 1.0};
}

Entry paper(std::string_view name, std::string_view description, PaperLoopMaker maker) {
  return {.scenario = {name, description, true},
          .signal = nullptr,
          .paper = maker,
          .plant = nullptr,
          .sample_interval_s = 1.0};
}

Entry plant(std::string_view name, std::string_view description, PlantLoopMaker maker,
            double sample_interval_s = 1.0) {
  return {.scenario = {name, description, true},
          .signal = nullptr,
          .paper = nullptr,
          .plant = maker,
          .sample_interval_s = sample_interval_s};
}

constexpr double kTemperatureInterval_s = 10.0;
constexpr double kLevelInterval_s = 5.0;

LoopSettings sticking_printed() {
  return sticking_loop(StictionLaw::choudhury);
}
LoopSettings sticking_kano() {
  return sticking_loop(StictionLaw::kano);
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list = {
      signal("paper_4_1_linear", "narrow-band noise, linear (eq. 15)", narrow_band_linear),
      signal("paper_4_1_nonlinear", "the same with 10 % of its square (eq. 16)",
             narrow_band_squared),
      signal("paper_4_2_linear", "two sinusoids in white noise (eq. 17)", two_sinusoids_linear),
      signal("paper_4_2_nonlinear", "the same with 5 % of their square (eq. 18)",
             two_sinusoids_squared),
      paper("paper_5_1", "well tuned loop", well_tuned_loop),
      paper("paper_5_2_printed", "integral action as printed, 0.15 / 2.5", printed_integral_loop),
      paper("paper_5_2_excessive", "integral action as meant, 0.15 * 2.5", excessive_integral_loop),
      paper("paper_5_3", "outside sinusoid of period 100 and amplitude 2", outside_sinusoid_loop),
      paper("paper_5_4", "stiction S = 3, J = 1, the paper's valve law", sticking_printed),
      paper("paper_5_4_kano", "stiction S = 3, J = 1, Kano's valve law", sticking_kano),
      plant("healthy_flow", "flow loop with nothing wrong", healthy_flow),
      plant("tight_tuning", "flow loop tuned to the edge of stability", tight_tuning),
      plant("sluggish_tuning", "flow loop that answers to nothing in time", sluggish_tuning),
      plant("sticking_valve", "flow loop with a valve that sticks, S = 5, J = 2", sticking_valve),
      plant("square_limit_cycle", "flow loop whose valve only jumps, S = J = 4: a square wave",
            square_limit_cycle),
      plant("deadband", "temperature loop hunting in 4 % of play", deadband,
            kTemperatureInterval_s),
      plant("oversized_valve", "flow loop with a valve twelve times too large", oversized_valve),
      plant("saturated_valve", "flow loop whose valve opens to 53 % only", saturated_valve),
      plant("worn_valve", "flow loop with a curved valve and setpoint moves", worn_valve),
      plant("nonlinear_process", "flow loop with a curved process and setpoint moves",
            nonlinear_process),
      plant("process_gain_change", "flow loop whose process gain rises to 2.5 times halfway",
            process_gain_change),
      plant("outside_oscillation", "flow loop shaken from outside, period 60 samples",
            outside_oscillation),
      plant("load_upsets", "flow loop with three steps of the load", load_upsets),
      plant("quantised_sensor", "flow loop with a transmitter that rounds to 1", quantised_sensor),
      plant("holding_sensor", "flow loop whose pv is renewed every 12 samples only",
            holding_sensor),
      plant("level_loop", "level loop (integrating) with nothing wrong", level_loop,
            kLevelInterval_s),
      plant("sticking_level", "level loop with a valve that sticks, S = 4, J = 2", sticking_level,
            kLevelInterval_s),
  };
  return list;
}

const Entry& find(std::string_view name) {
  const auto entry =
      std::ranges::find(entries(), name, [](const Entry& e) { return e.scenario.name; });
  if (entry == entries().end()) {
    throw std::invalid_argument("no scenario is called " + std::string(name));
  }
  return *entry;
}

/// Times of a paper loop's effects are given at 1 s: scaled along with the interval.
void rescale_times(LoopSettings& loop, double factor) {
  for (Effect& effect : loop.effects) {
    if (auto* oscillation = std::get_if<ExternalOscillation>(&effect)) {
      oscillation->period_s *= factor;
    }
  }
}

LoopSettings paper_loop(const Entry& entry, std::size_t samples, double interval_s) {
  LoopSettings loop = entry.paper();
  rescale_times(loop, interval_s / loop.sample_interval_s);
  loop.sample_interval_s = interval_s;
  loop.recorded_samples = samples;
  return loop;
}

LoopRecord signal_record(const Entry& entry, const ScenarioOptions& options, std::uint64_t seed) {
  if (!options.added_effects.empty()) {
    throw std::invalid_argument(std::string(entry.scenario.name) + " is not a loop: no effects");
  }
  LoopRecord record;
  record.sample_interval_s = options.sample_interval_s.value_or(entry.sample_interval_s);
  record.sp.assign(options.samples, 0.0);
  record.pv = entry.signal(options.samples, seed);
  std::ranges::transform(record.pv, record.pv.begin(), std::negate<>());
  return record;
}

}  // namespace

const std::vector<Scenario>& all_scenarios() {
  static const std::vector<Scenario> scenarios = [] {
    std::vector<Scenario> list;
    for (const Entry& entry : entries()) {
      list.push_back(entry.scenario);
    }
    return list;
  }();
  return scenarios;
}

LoopSettings scenario_loop(std::string_view name, const ScenarioOptions& options) {
  const Entry& entry = find(name);
  if (!entry.scenario.is_loop) {
    throw std::invalid_argument(std::string(name) + " is not a loop");
  }
  const double interval_s = options.sample_interval_s.value_or(entry.sample_interval_s);
  LoopSettings loop = entry.paper != nullptr ? paper_loop(entry, options.samples, interval_s)
                                             : entry.plant({options.samples, interval_s});
  loop.effects.insert(loop.effects.end(), options.added_effects.begin(),
                      options.added_effects.end());
  return loop;
}

LoopRecord simulate_scenario(std::string_view name, const ScenarioOptions& options,
                             std::uint64_t seed) {
  const Entry& entry = find(name);
  return entry.scenario.is_loop ? simulate_loop(scenario_loop(name, options), seed)
                                : signal_record(entry, options, seed);
}

}  // namespace loopscope::core::simulate
