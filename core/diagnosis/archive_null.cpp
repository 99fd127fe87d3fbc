#include "core/diagnosis/archive_null.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/hos/linear/draw_missing.hpp"
#include "core/hos/linear/innovations.hpp"
#include "core/hos/numeric/distributions.hpp"
#include "core/hos/surrogates/surrogates.hpp"
#include "core/signal/archive.hpp"
#include "core/signal/holes.hpp"
#include "core/signal/swinging_door.hpp"

namespace loopscope::core {
namespace {

/// p-values above this decide nothing, whatever the door does.
constexpr double kUnclear = 0.05;
/// Records sent through the door: the mean of an exponential variable is known to a fifth, and a
/// linear loop that needs it has one of 2 to 4.
constexpr int kRecords = 24;

using Tests = std::array<std::optional<double> hos::Result::*, 4>;
constexpr Tests kTests = {&hos::Result::ngi_p, &hos::Result::nli_p, &hos::Result::cubic_p,
                          &hos::Result::nonlinear_p};

double evidence_of(double p) {
  return -std::log(hos::above_zero(p));
}

/// What is seen of a record behind a door of this half width.
std::optional<hos::Result> behind_door(const signal::Samples& record, double band,
                                       const hos::Settings& settings, std::uint64_t seed) {
  const signal::Reconstruction whole = signal::reconstruct(
      {signal::swinging_door(record, band), signal::Archive::swinging_door, band});
  return hos::analyse(hos::draw_missing(whole.value, {whole.low, whole.high}, seed), settings,
                      seed);
}

/// Sums of -ln p of each test over the records, and of how many.
struct DoorEvidence {
  std::array<double, kTests.size()> sum{};
  std::array<double, kTests.size()> count{};

  void add(const hos::Result& result) {
    for (std::size_t i = 0; i < kTests.size(); ++i) {
      const std::optional<double>& p = result.*kTests[i];
      if (!p) continue;
      sum[i] += evidence_of(*p);
      count[i] += 1.0;
    }
  }
  /// At least 1.
  [[nodiscard]] double mean(std::size_t test) const {
    if (count[test] < 2.0) return 1.0;
    const double mean = sum[test] / count[test];
    return mean > 1.0 + 1.0 / std::sqrt(count[test]) ? mean : 1.0;
  }
};

}  // namespace

void allow_for_door(const signal::Samples& error, double band, const hos::Settings& settings,
                    std::uint64_t seed, hos::Result& result) {
  const bool clear = std::ranges::all_of(
      kTests, [&](auto test) { return (result.*test).value_or(1.0) > kUnclear; });
  if (clear || !(band > 0.0)) return;
  const std::optional<hos::Innovations> innovations = hos::Innovations::of(error);
  if (!innovations) return;
  hos::Surrogates surrogates(error, *innovations, hos::Null::permuted, seed);
  signal::Samples record;
  DoorEvidence evidence;
  for (int i = 0; i < kRecords; ++i) {
    surrogates.draw(record);
    const auto seen = behind_door(record, band, settings, seed + static_cast<std::uint64_t>(i));
    if (seen) evidence.add(*seen);
  }
  for (std::size_t i = 0; i < kTests.size(); ++i) {
    std::optional<double>& p = result.*kTests[i];
    if (p) p = std::pow(*p, 1.0 / evidence.mean(i));
  }
  if (result.nonlinear_p.value_or(1.0) > settings.alpha) {
    result.coupling = hos::Coupling::none_found;
  }
}

}  // namespace loopscope::core
