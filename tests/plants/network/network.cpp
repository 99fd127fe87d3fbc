#include "tests/plants/network/network.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "tests/effects/random.hpp"

namespace loopscope::tests::network {
namespace {

using Series = std::vector<double>;

Series error_of(const LoopRecord& record) {
  Series error(record.pv.size());
  std::transform(record.sp.begin(), record.sp.end(), record.pv.begin(), error.begin(),
                 std::minus<>());
  const double mean =
      std::accumulate(error.begin(), error.end(), 0.0) / static_cast<double>(error.size());
  for (double& value : error) value -= mean;
  return error;
}

double variance(const Series& series) {
  return std::inner_product(series.begin(), series.end(), series.begin(), 0.0) /
         static_cast<double>(series.size());
}

/// Share of the series' mean square in one line of its Fourier transform (both signs).
double line_power(const Series& series, long bin) {
  const double turn =
      2.0 * std::numbers::pi * static_cast<double>(bin) / static_cast<double>(series.size());
  const std::complex<double> rotor = std::polar(1.0, turn);
  std::complex<double> phase = 1.0;
  std::complex<double> sum = 0.0;
  for (const double value : series) sum += value * (phase *= rotor);
  const double count = static_cast<double>(series.size());
  return 2.0 * std::norm(sum) / (count * count);
}

/// Power within 15 % of a frequency in cycles per sample.
double power_about(const Series& series, double frequency) {
  const double count = static_cast<double>(series.size());
  const auto low = std::max(1L, std::lround(0.87 * frequency * count));
  const auto high = std::min(std::lround(1.15 * frequency * count), std::lround(count / 2.0));
  double sum = 0.0;
  for (long bin = low; bin <= high; ++bin) sum += line_power(series, bin);
  return sum;
}

/// Where a sixth of an octave holds most power, in cycles per sample.
double strongest_frequency(const Series& series) {
  double best = 0.0;
  double most = -1.0;
  for (double f = 8.0 / static_cast<double>(series.size()); f < 0.125; f *= 1.06) {
    const double power = power_about(series, f);
    if (power > most) most = power, best = f;
  }
  return best;
}

Series difference(const Series& with, const Series& without) {
  Series rise(with.size());
  std::transform(with.begin(), with.end(), without.begin(), rise.begin(), std::minus<>());
  return rise;
}

bool can_show(double interval_s, double period_s) {
  return period_s >= 8.0 * interval_s &&
         period_s <= static_cast<double>(kSamples) / 8.0 * interval_s;
}

/// The controllers of a plant hold their variables; loops meant to reach a stop may.
bool runs_well(const std::vector<LoopRecord>& records) {
  if (records.empty()) return false;
  std::size_t at_limit = 0;
  for (const LoopRecord& record : records) {
    const auto stopped =
        std::ranges::count_if(record.op, [](double op) { return op <= 0.0 || op >= 100.0; });
    if (stopped > static_cast<long>(records[0].pv.size() / 3)) return false;
    if (stopped > static_cast<long>(records[0].pv.size() / 100)) ++at_limit;
  }
  return at_limit <= 3;
}

class Measurement {
 public:
  Measurement(const Draft& draft, std::size_t samples)
      : draft_(draft), samples_(samples), with_(simulate(draft.with, samples)) {}

  /// nullopt = a plant that nobody would call shaken.
  std::optional<NetworkPlant> take() {
    if (!runs_well(with_) || !source_cycles()) return std::nullopt;
    without_ = simulate(draft_.without, samples_);
    if (without_.empty()) return std::nullopt;
    NetworkPlant plant;
    plant.source = draft_.source;
    plant.period_s = period_s();
    if (!(plant.period_s > 0.0)) return std::nullopt;
    for (std::size_t i = 0; i < with_.size(); ++i) plant.loops.push_back(truth(i, plant.period_s));
    if (!shaken(plant)) return std::nullopt;
    for (std::size_t i = 0; i < with_.size(); ++i)
      if (draft_.with.loops[i].master) plant.cascades.emplace_back(*draft_.with.loops[i].master, i);
    plant.records = std::move(with_);
    return plant;
  }

 private:
  /// Spares the second run for valves that stick without making a cycle.
  [[nodiscard]] bool source_cycles() const {
    if (!draft_.source) return true;
    const Series error = error_of(with_[*draft_.source]);
    return power_about(error, strongest_frequency(error)) >= kCarries * variance(error);
  }

  [[nodiscard]] double period_s() const {
    if (!draft_.source) return draft_.with.outside.period_s;
    const LoopRecord& record = with_[*draft_.source];
    const Series rise = difference(error_of(record), error_of(without_[*draft_.source]));
    return record.interval_s / strongest_frequency(rise);
  }

  [[nodiscard]] TrueLoop truth(std::size_t i, double period_s) const {
    TrueLoop loop;
    loop.name = draft_.with.loops[i].name;
    loop.kind = draft_.with.loops[i].kind;
    loop.unrelated = std::ranges::count(draft_.unrelated, i) > 0;
    loop.sticks = loop.unrelated && draft_.without.loops[i].valve;
    const Series with = error_of(with_[i]);
    const double frequency = with_[i].interval_s / period_s;
    if (frequency > 0.25 || frequency * static_cast<double>(kSamples) < 2.0) return loop;
    const double brought =
        power_about(with, frequency) - power_about(error_of(without_[i]), frequency);
    loop.share = std::max(0.0, brought / variance(with));
    loop.carries = loop.share >= kCarries && can_show(with_[i].interval_s, period_s);
    return loop;
  }

  [[nodiscard]] static bool shaken(const NetworkPlant& plant) {
    if (plant.source && !plant.loops[*plant.source].carries) return false;
    return std::ranges::count_if(plant.loops, &TrueLoop::carries) >= 4;
  }

  const Draft& draft_;
  std::size_t samples_;
  std::vector<LoopRecord> with_;
  std::vector<LoopRecord> without_;
};

/// Of the source, by the plant's number, so that slow ones are not crowded out by fast ones that
/// shake a plant more often.
LoopKind kind_of_source(std::uint64_t seed) {
  switch (effects::Random(effects::seed_for("kind", seed)).whole(0, 6)) {
    case 0:
      return LoopKind::level;
    case 1:
      return LoopKind::temperature;
    case 2:
    case 3:
      return LoopKind::pressure;
    default:
      return LoopKind::flow;
  }
}

std::optional<NetworkPlant> try_kind(std::uint64_t seed, Origin origin) {
  constexpr std::uint64_t kAttempts = 400;
  const LoopKind kind = kind_of_source(seed);
  for (std::uint64_t attempt = 1; attempt <= kAttempts; ++attempt) {
    const Draft draft =
        draw_plan(effects::seed_for("attempt", seed * kAttempts + attempt), origin, kind);
    if (!draft.source && origin != Origin::outside) continue;
    // A short run first: most drafts fail.
    if (!Measurement(draft, kSamples / 8).take()) continue;
    std::optional<NetworkPlant> plant = Measurement(draft, kSamples).take();
    if (!plant) continue;
    return plant;
  }
  return std::nullopt;
}

}  // namespace

NetworkPlant draw_network(std::uint64_t seed, Origin origin) {
  // Of a kind that shakes no plant (a level in front of small streams) one gives up in the end.
  constexpr std::uint64_t kKinds = 10;
  for (std::uint64_t round = 0; round < kKinds; ++round) {
    const std::uint64_t of_round = round == 0 ? seed : effects::seed_for("round", seed + round);
    if (std::optional<NetworkPlant> plant = try_kind(of_round, origin)) return std::move(*plant);
  }
  throw std::runtime_error("no plant is shaken by its cause, seed " + std::to_string(seed));
}

}  // namespace loopscope::tests::network
