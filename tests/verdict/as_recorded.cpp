#include "tests/verdict/as_recorded.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/effects/random.hpp"
#include "tests/generators/values.hpp"
#include "tests/verdict/known_generators.hpp"
#include "tests/verdict/mixed_loop.hpp"
#include "tests/verdict/site_loop.hpp"

namespace loopscope::tests::verdict {
namespace {

using Code = core::diagnosis::VerdictCode;
using core::signal::Samples;
using effects::Random;
using generators::standard_deviation;

constexpr std::size_t kLeast = 512, kMost = 4096;

std::vector<double> thinned(const std::vector<double>& values, std::size_t every) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < values.size(); k += every) kept.push_back(values[k]);
  return kept;
}

std::vector<double> last(std::vector<double> values, std::size_t count) {
  if (values.size() > count)
    values.erase(values.begin(), values.end() - static_cast<std::ptrdiff_t>(count));
  return values;
}

Samples part_of(const Samples& values, std::size_t from, std::size_t length) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(from);
  return {first, first + static_cast<std::ptrdiff_t>(length)};
}

void each_series(SimulatedLoop& loop, auto change) {
  for (std::vector<double>* series : {&loop.sp, &loop.pv, &loop.op, &loop.mv})
    if (!series->empty()) *series = change(*series);
}

/// Every so manieth sample, and a stretch of these.
void cut(SimulatedLoop& loop, Random& random) {
  const auto every = static_cast<std::size_t>(random.chance(0.15) ? random.whole(2, 4) : 1);
  if (every > 1 && loop.pv.size() / every >= kLeast)
    each_series(loop, [&](const std::vector<double>& v) { return thinned(v, every); });
  std::size_t length = kMost;
  if (random.chance(0.45))
    length = static_cast<std::size_t>(random.log_uniform(kLeast, static_cast<double>(kMost)));
  each_series(loop, [&](const std::vector<double>& v) { return last(v, length); });
}

void round_to(std::vector<double>& values, double grid) {
  for (double& value : values) value = generators::to_grid(value, grid);
}

/// An archive that keeps a value once it is farther than `band` from the last one kept.
void compress(std::vector<double>& values, double band, bool lines) {
  std::size_t kept = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (std::abs(values[k] - values[kept]) <= band && k + 1 != values.size()) continue;
    for (std::size_t i = kept + 1; i < k; ++i) {
      const double share = static_cast<double>(i - kept) / static_cast<double>(k - kept);
      values[i] = lines ? values[kept] + share * (values[k] - values[kept]) : values[kept];
    }
    kept = k;
  }
}

void store(SimulatedLoop& loop, Random& random) {
  const double pv = standard_deviation(loop.pv), op = standard_deviation(loop.op);
  if (random.chance(0.15))
    compress(loop.pv, pv * random.log_uniform(0.03, 0.4), random.chance(0.5));
  if (random.chance(0.1)) compress(loop.op, op * random.log_uniform(0.03, 0.3), random.chance(0.5));
  if (random.chance(0.5)) round_to(loop.pv, pv * random.log_uniform(1e-3, 0.3));
  // Many controllers tell op in whole percent, some of them of a loop that needs no more than one.
  if (random.chance(0.4)) round_to(loop.op, op * random.log_uniform(1e-3, 1.5));
}

void lose(Samples& values, Random& random) {
  const auto size = static_cast<int>(values.size());
  for (int gaps = random.whole(1, 6); gaps > 0; --gaps) {
    const int first = random.whole(0, size - 1);
    const int length = random.whole(1, 1 + size / 80);
    for (int k = first; k < std::min(size, first + length); ++k)
      values[static_cast<std::size_t>(k)] = core::signal::kMissing;
  }
}

void centre(Samples& values, double mean) {
  for (double& value : values) value -= mean;
}

double mean_of(const Samples& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

core::signal::LoopWindow window_of(const SimulatedLoop& loop) {
  core::signal::LoopWindow window;
  window.sample_interval_s = loop.interval_s;
  window.sp = loop.sp;
  window.pv = loop.pv;
  window.op = loop.op;
  return window;
}

/// A transmitter, or its tag, that stands still for a while or for good.
void freeze(LabelledRecord& record, Random& random) {
  constexpr int kShortest = 320;
  Samples& pv = record.window.pv;
  const auto size = static_cast<int>(pv.size());
  if (size < 2 * kShortest) return;
  const int length = random.whole(kShortest, size / 2);
  const int first = random.whole(0, size - length);
  std::fill_n(pv.begin() + first, length, pv[static_cast<std::size_t>(first)]);
  record.truth.causes.insert(Code::sensor_fault);
}

/// What the catalogue says and what the plant records.
void describe(const SimulatedLoop& loop, LabelledRecord& record, Random& random) {
  core::signal::LoopWindow& window = record.window;
  if (random.chance(0.6)) {
    // A controller's limits are those of its range as often as they lie within it.
    window.op_range = random.chance(0.5) ? loop.limits : core::signal::OpRange{};
  } else if (random.chance(0.5)) {
    centre(window.op, mean_of(window.op));
  }
  if (random.chance(0.12)) window.mv = loop.mv;
  if (random.chance(0.03)) window.op.clear();
  if (random.chance(0.02)) window.sp.clear();
  if (random.chance(0.3) && !window.sp.empty()) {
    const double level = mean_of(window.pv);
    centre(window.pv, level);
    centre(window.sp, level);
  }
  if (window.op_range && !window.op.empty()) record.facts.pv_span = loop.pv_span;
}

}  // namespace

LabelledRecord as_recorded(const SimulatedLoop& simulated, std::uint64_t seed) {
  Random random(effects::seed_for("as recorded", seed));
  SimulatedLoop loop = simulated;
  cut(loop, random);
  store(loop, random);
  loop.interval_s = random.log_uniform(0.1, 60.0);
  LabelledRecord record{window_of(loop), {}, loop.truth};
  record.facts.integrating = loop.integrating;
  record.facts.seed = seed;
  describe(loop, record, random);
  // Without both ranges nobody can tell.
  if (!record.facts.pv_span && record.truth.causes.erase(Code::valve_oversized) > 0)
    record.truth.doubtful.insert(Code::valve_oversized);
  if (random.chance(0.05)) lose(record.window.pv, random);
  if (random.chance(0.02)) freeze(record, random);
  for (const Code cause : record.truth.causes) record.truth.doubtful.erase(cause);
  return record;
}

LabelledRecord draw_record(std::uint64_t seed) {
  Random random(effects::seed_for("generator", seed));
  const double which = random.uniform(0.0, 1.0);
  const SimulatedLoop loop = which < 0.34   ? effects_loop(seed)
                             : which < 0.50 ? family_loop(random.next() % 4'000'000)
                             : which < 0.80 ? mixed_loop(random.next())
                                            : site_loop(random.next());
  return as_recorded(loop, seed);
}

std::vector<SuccessiveWindow> draw_windows(std::uint64_t seed, std::size_t count) {
  const LabelledRecord whole = draw_record(seed);
  const std::size_t samples = whole.window.pv.size();
  if (count < 2 || samples < 2 * kLeast) return {};
  Random random(effects::seed_for("windows", seed));
  const auto length = static_cast<std::size_t>(
      random.log_uniform(static_cast<double>(kLeast), 0.5 * static_cast<double>(samples)));
  const std::size_t step = (samples - length) / (count - 1);
  if (step == 0) return {};
  std::vector<SuccessiveWindow> windows;
  for (std::size_t w = 0; w < count; ++w) {
    const std::size_t from = samples - length - (count - 1 - w) * step;
    LabelledRecord record = whole;
    for (Samples* series :
         {&record.window.sp, &record.window.pv, &record.window.op, &record.window.mv})
      if (!series->empty()) *series = part_of(*series, from, length);
    const double share = static_cast<double>(step) / static_cast<double>(length);
    windows.push_back({std::move(record), w == 0 ? 1.0 : std::min(1.0, share)});
  }
  return windows;
}

}  // namespace loopscope::tests::verdict
