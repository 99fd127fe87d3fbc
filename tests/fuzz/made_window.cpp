#include "tests/fuzz/made_window.hpp"

#include <array>
#include <limits>
#include <map>
#include <tuple>

#include "core/simulate/scenario.hpp"
#include "tests/fuzz/damage.hpp"

namespace loopscope::tests::fuzz {
namespace {

using core::signal::ControlMode;
using core::signal::LoopWindow;
using core::signal::Samples;
using core::simulate::LoopRecord;

/// Around what decides: nothing, one segment, the fewest that are judged, the usual window.
constexpr std::array<std::size_t, 24> kLengths = {0,   1,   2,    16,   31,   64,   100,  511,
                                                  512, 512, 513,  600,  600,  640,  700,  768,
                                                  900, 999, 1024, 1024, 1500, 2048, 3000, 4096};
constexpr std::array kIntervals_s = {1.0, 1.0, 1.0, 10.0, 60.0, 0.1, 1e-3, 86'400.0, 1e-9, 1e9};
constexpr std::array kNoIntervals_s = {0.0, -1.0, std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::quiet_NaN()};
constexpr std::size_t kMostDamages = 24;

/// Simulations are the same for the same few bytes: made once.
const LoopRecord& simulated(std::size_t scenario, std::size_t length, std::uint64_t seed) {
  static std::map<std::tuple<std::size_t, std::size_t, std::uint64_t>, LoopRecord> made;
  const auto [entry, is_new] = made.try_emplace({scenario, length, seed});
  if (is_new) {
    core::simulate::ScenarioOptions options;
    options.samples = length;
    entry->second = core::simulate::simulate_scenario(
        core::simulate::all_scenarios()[scenario].name, options, seed);
  }
  return entry->second;
}

void fill(LoopWindow& window, ByteSource& source) {
  const std::size_t length = kLengths[source.byte() % kLengths.size()];
  const std::size_t scenario = source.byte() % core::simulate::all_scenarios().size();
  const std::uint64_t seed = source.byte() % 4;
  if (length == 0) return;
  const LoopRecord& record = simulated(scenario, length, seed);
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  window.mv = record.mv;
}

/// Which series were recorded, and what is known beside them.
void choose_series(LoopWindow& window, ByteSource& source) {
  const std::uint8_t bits = source.byte();
  if ((bits & 1U) != 0) window.sp.clear();
  if ((bits & 6U) == 6U) window.op.clear();
  if ((bits & 8U) == 0) window.mv.clear();
  if ((bits & 16U) != 0) window.pv_rows = window.pv;
  if ((bits & 32U) != 0) window.mode.assign(window.size(), ControlMode::automatic);
  if ((bits & 64U) == 0) window.op_range = core::signal::OpRange{0.0, 100.0};
  if ((bits & 128U) != 0) window.repeated_times = 3;
}

void choose_settings(MadeWindow& made, ByteSource& source) {
  const std::uint8_t bits = source.byte();
  // A model takes many times what the rest takes.
  made.settings.fit_model = (bits & 3U) == 0;
  made.integrating = (bits & 4U) != 0;
  if ((bits & 24U) == 24U) made.settings.hos.segment_length = 32;
  if ((bits & 96U) == 96U) made.settings.prepare.max_missing_fraction = 1.0;
  if ((bits & 160U) == 160U) made.settings.prepare.min_usable_samples = 64;
  if ((bits & 144U) == 144U) made.settings.hos.window = core::hos::WindowShape::rectangular;
}

void choose_interval(MadeWindow& made, ByteSource& source) {
  const std::uint8_t choice = source.byte();
  made.window.sample_interval_s = kIntervals_s[choice % kIntervals_s.size()];
  if (choice != 255) return;
  made.window.sample_interval_s = kNoIntervals_s[source.byte() % kNoIntervals_s.size()];
  made.fits = false;
}

void cut_a_series(MadeWindow& made, ByteSource& source) {
  if (source.byte() != 255) return;
  LoopWindow& window = made.window;
  for (Samples* samples : {&window.pv_rows, &window.sp, &window.op, &window.mv}) {
    if (samples->empty() || samples->size() < 2) continue;
    samples->pop_back();
    made.fits = false;
    return;
  }
}

}  // namespace

MadeWindow make_window(ByteSource& source) {
  MadeWindow made;
  fill(made.window, source);
  choose_series(made.window, source);
  choose_settings(made, source);
  choose_interval(made, source);
  cut_a_series(made, source);
  for (std::size_t k = 0; k < kMostDamages && !source.empty(); ++k) damage(made.window, source);
  return made;
}

}  // namespace loopscope::tests::fuzz
