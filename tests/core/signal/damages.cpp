#include "tests/core/signal/damages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "core/signal/base_interval.hpp"
#include "core/signal/order/spread.hpp"
#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/signal/archives.hpp"

namespace loopscope::core::signal {
namespace {

using Keep = Kept (*)(const Samples&, double);
using Change = LoopRecording (*)(LoopRecording, std::mt19937_64&);

double uniform(std::mt19937_64& random) {
  return std::uniform_real_distribution<double>()(random);
}

LoopRecording rows(const LoopRecording& whole, const Kept& kept) {
  LoopRecording result;
  for (const std::size_t k : kept) {
    result.time_s.push_back(whole.time_s[k]);
    result.sp.push_back(whole.sp[k]);
    result.pv.push_back(whole.pv[k]);
    if (!whole.op.empty()) result.op.push_back(whole.op[k]);
  }
  return result;
}

Kept all_but(std::size_t size, const std::vector<bool>& gone) {
  Kept kept;
  for (std::size_t k = 0; k < size; ++k) {
    if (!gone[k]) kept.push_back(k);
  }
  return kept;
}

enum class Form { rows, steps, lines };

LoopRecording in_form(LoopRecording whole, const Kept& kept, Form form) {
  if (form == Form::rows) return rows(whole, kept);
  whole.pv = form == Form::steps ? held_between(whole.pv, kept) : lines_between(whole.pv, kept);
  return whole;
}

Damage compressed(std::string name, Keep keep, double factor, Form form) {
  return {std::move(name), [=](LoopRecording whole, std::uint64_t) {
            return in_form(whole, keep_one_in(factor, whole.pv, keep), form);
          }};
}

Damage missing_at_random(std::string name, double share, Form form) {
  return {std::move(name), [=](LoopRecording whole, std::uint64_t seed) {
            std::mt19937_64 random(seed);
            std::vector<bool> gone(whole.pv.size(), false);
            for (std::size_t k = 1; k + 1 < gone.size(); ++k) gone[k] = uniform(random) < share;
            return in_form(whole, all_but(gone.size(), gone), form);
          }};
}

Damage gaps(std::string name, double share, std::size_t count) {
  return {std::move(name), [=](LoopRecording whole, std::uint64_t seed) {
            std::mt19937_64 random(seed);
            const std::size_t size = whole.pv.size();
            const auto length = static_cast<std::size_t>(share * double(size) / double(count));
            std::vector<bool> gone(size, false);
            for (std::size_t i = 0; i < count; ++i) {
              const double room = double(size) / double(count) - double(length);
              const double start = double(i * size) / double(count) + uniform(random) * room;
              std::fill_n(gone.begin() + std::lround(std::max(1.0, start)), length - 1, true);
            }
            return rows(whole, all_but(size, gone));
          }};
}

Damage changed(std::string name, Change change) {
  return {std::move(name), [=](LoopRecording whole, std::uint64_t seed) {
            std::mt19937_64 random(seed);
            return change(std::move(whole), random);
          }};
}

double std_of(const Samples& samples) {
  return measure_spread(samples)->std;
}

template <int Percent>
LoopRecording rounded(LoopRecording whole, std::mt19937_64&) {
  const double step = 0.01 * Percent * std_of(whole.pv);
  for (double& value : whole.pv) value = step * std::round(value / step);
  return whole;
}

template <int Count, int Size, int Length>
LoopRecording with_spikes(LoopRecording whole, std::mt19937_64& random) {
  const double size = Size * std_of(whole.pv);
  for (int i = 0; i < Count; ++i) {
    const double room = double(whole.pv.size() - Length + 1);
    const auto at = static_cast<std::size_t>(uniform(random) * room);
    const double spike = uniform(random) < 0.5 ? -size : size;
    for (std::size_t k = at; k < at + Length; ++k) whole.pv[k] += spike;
  }
  return whole;
}

LoopRecording jittering(LoopRecording whole, std::mt19937_64& random) {
  for (double& time_s : whole.time_s) time_s += 0.6 * uniform(random) - 0.3;
  return whole;
}

LoopRecording repeated(LoopRecording whole, std::mt19937_64& random) {
  Kept kept;
  for (std::size_t k = 0; k < whole.pv.size(); ++k) {
    kept.insert(kept.end(), uniform(random) < 0.05 ? 2 : 1, k);
  }
  return rows(whole, kept);
}

LoopRecording louder(LoopRecording whole, std::mt19937_64&) {
  const double mean = measure_spread(whole.pv)->mean;
  for (std::size_t k = whole.pv.size() / 2; k < whole.pv.size(); ++k) {
    whole.pv[k] = mean + 3.0 * (whole.pv[k] - mean);
  }
  return whole;
}

LoopRecording shifted(LoopRecording whole, std::mt19937_64&) {
  const double size = 2.0 * std_of(whole.pv);
  for (std::size_t k = whole.pv.size() / 2; k < whole.pv.size(); ++k) whole.pv[k] += size;
  return whole;
}

/// The loop becomes another one, of the same spread and faster, from `Percent` of the record on.
template <int Percent>
LoopRecording another(LoopRecording whole, std::mt19937_64& random) {
  const auto from = whole.pv.size() * Percent / 100;
  const Spread spread = *measure_spread(whole.pv);
  const Samples noise = simulate::coloured_noise(
      simulate::real_pole(0.5), simulate::Innovation::gaussian, whole.pv.size(), random());
  const double scale = spread.std / std_of(noise);
  for (std::size_t k = from; k < whole.pv.size(); ++k) whole.pv[k] = spread.mean + scale * noise[k];
  return whole;
}

LoopRecording staircase(LoopRecording whole, std::mt19937_64&) {
  constexpr std::array kPattern = {1.0, 1.0, -1.0, -1.0, 1.0, -1.0};
  const double size = 3.0 * std_of(whole.pv);
  double sp = 0.0;
  double followed = 0.0;
  for (std::size_t k = 0; k < whole.pv.size(); ++k) {
    if (k > 0 && k % 500 == 0) sp += size * kPattern[(k / 500 - 1) % kPattern.size()];
    followed += 0.25 * (sp - followed);
    whole.sp[k] += sp;
    whole.pv[k] += followed;
  }
  return whole;
}

LoopRecording frozen(LoopRecording whole, std::mt19937_64& random) {
  const std::size_t length = whole.pv.size() / 20;
  const auto start = static_cast<std::size_t>(uniform(random) * double(whole.pv.size() - length));
  std::fill_n(whole.pv.begin() + static_cast<std::ptrdiff_t>(start), length, whole.pv[start]);
  return whole;
}

std::vector<Damage> make_damages() {
  std::vector<Damage> list = {
      changed("none", [](LoopRecording whole, std::mt19937_64&) { return whole; })};
  const std::pair<const char*, Form> forms[] = {
      {"rows", Form::rows}, {"as lines", Form::lines}, {"as steps", Form::steps}};
  for (const char* const factor : {"1.25", "1.75", "2.5"}) {
    const double cf = std::stod(factor);
    for (const auto& [form_name, form] : forms) {
      const std::string end = std::string(" ") + factor + ", " + form_name;
      list.push_back(compressed("swinging door" + end, keep_swinging_door, cf, form));
      list.push_back(compressed("dead band" + end, keep_dead_band, cf, form));
    }
  }
  list.push_back(compressed("opening doors 2.5, rows", keep_opening_doors, 2.5, Form::rows));
  list.push_back(missing_at_random("20 % missing at random, rows", 0.2, Form::rows));
  list.push_back(missing_at_random("40 % missing at random, rows", 0.4, Form::rows));
  list.push_back(missing_at_random("40 % missing at random, as lines", 0.4, Form::lines));
  list.push_back(missing_at_random("40 % missing at random, as steps", 0.4, Form::steps));
  list.push_back(gaps("one gap of 40 %", 0.4, 1));
  list.push_back(gaps("five gaps, 40 % together", 0.4, 5));
  list.push_back(gaps("twenty gaps, 20 % together", 0.2, 20));
  list.push_back(changed("one spike of 8 standard deviations", with_spikes<1, 8, 1>));
  list.push_back(changed("5 spikes of 8 standard deviations", with_spikes<5, 8, 1>));
  list.push_back(changed("20 spikes of 4 standard deviations", with_spikes<20, 4, 1>));
  list.push_back(changed("20 spikes of 6 standard deviations", with_spikes<20, 6, 1>));
  list.push_back(changed("20 spikes of 8 standard deviations", with_spikes<20, 8, 1>));
  list.push_back(changed("20 spikes of 15 standard deviations", with_spikes<20, 15, 1>));
  list.push_back(changed("40 spikes of 8 standard deviations", with_spikes<40, 8, 1>));
  list.push_back(changed("20 pairs of spikes of 8 standard deviations", with_spikes<20, 8, 2>));
  list.push_back(changed("rounded to 0.25 standard deviations", rounded<25>));
  list.push_back(changed("rounded to 0.5 standard deviations", rounded<50>));
  list.push_back(changed("rounded to 1 standard deviation", rounded<100>));
  list.push_back(changed("stamps jitter by up to 0.3 intervals", jittering));
  list.push_back(changed("5 % of the rows twice", repeated));
  list.push_back(changed("second half three times as loud", louder));
  list.push_back(changed("mean 2 standard deviations up halfway", shifted));
  list.push_back(changed("another spectrum from 70 % on", another<70>));
  // Of two stretches of the same length the later one is judged
  // (core/hos/linear/stationary_stretch.hpp).
  list.push_back(changed("another spectrum from halfway on", another<50>));
  list.back().leaves_linear = true;
  list.push_back(changed("another spectrum from 30 % on", another<30>));
  list.back().leaves_linear = true;
  list.push_back(changed("setpoint staircase of 3 standard deviations", staircase));
  list.push_back(changed("5 % frozen", frozen));
  return list;
}

struct Coloured {
  const char* name;
  simulate::AllPole filter;
  double noise;  ///< of its standard deviation
};

const Coloured kColoured[] = {{"broad", simulate::resonance(40.0, 0.9), 0.0},
                              {"osc", simulate::resonance(20.0, 0.98), 0.0},
                              {"noisy_osc", simulate::resonance(20.0, 0.98), 0.2},
                              {"white", simulate::real_pole(0.0), 0.0}};

Samples coloured(const Coloured& law, std::uint64_t seed) {
  constexpr std::size_t kSize = 4096;
  constexpr auto kGaussian = simulate::Innovation::gaussian;
  Samples samples = simulate::coloured_noise(law.filter, kGaussian, kSize, 2 * seed);
  const Samples white =
      simulate::coloured_noise(simulate::real_pole(0.0), kGaussian, kSize, 2 * seed + 1);
  const double size = law.noise * std_of(samples);
  for (std::size_t k = 0; k < kSize; ++k) samples[k] += 50.0 + size * white[k];
  return samples;
}

RawSeries series(const std::vector<double>& time_s, const Samples& values) {
  RawSeries rows;
  for (std::size_t k = 0; k < values.size(); ++k) {
    rows.time_us.push_back(std::llround(time_s[k] * 1e6));
    rows.value.push_back(values[k]);
  }
  return rows;
}

}  // namespace

LoopRecording recording_of(const std::string& loop, std::uint64_t seed) {
  LoopRecording result;
  const auto* const law = std::ranges::find_if(
      kColoured, [&](const Coloured& candidate) { return loop == candidate.name; });
  if (law != std::end(kColoured)) {
    result.pv = coloured(*law, seed);
    result.sp.assign(result.pv.size(), 50.0);
  } else {
    const auto record = simulate::simulate_scenario(loop, {}, seed);
    result = {{}, record.sp, record.pv, record.op};
  }
  result.time_s.resize(result.pv.size());
  std::iota(result.time_s.begin(), result.time_s.end(), 0.0);
  return result;
}

std::span<const Damage> all_damages() {
  static const std::vector<Damage> list = make_damages();
  return list;
}

bool is_quick(const Damage& damage) {
  static const std::array kQuick = {"none", "swinging door 1.75, as steps", "dead band 2.5, rows",
                                    "40 % missing at random, rows", "five gaps, 40 % together"};
  return std::ranges::find(kQuick, damage.name) != kQuick.end();
}

LoopWindow window_of(const LoopRecording& recording) {
  LoopRows rows;
  rows.pv = series(recording.time_s, recording.pv);
  rows.sp = series(recording.time_s, recording.sp);
  rows.op = series(recording.time_s, recording.op);
  const double interval_s = base_interval_s(rows.pv);
  return assemble(rows, window_grid(rows.pv, interval_s, rows.pv.time_us.back(), 4096), {});
}

}  // namespace loopscope::core::signal
