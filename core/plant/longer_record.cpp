#include "core/plant/longer_record.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/grid.hpp"
#include "core/signal/microseconds.hpp"

namespace loopscope::core::plant {

signal::Samples means_of(std::span<const double> samples, std::size_t of) {
  signal::Samples means;
  means.reserve(samples.size() / of);
  for (std::size_t k = samples.size() % of; k < samples.size(); k += of) {
    double sum = 0.0, count = 0.0;
    for (const double value : samples.subspan(k, of))
      if (std::isfinite(value)) sum += value, count += 1.0;
    means.push_back(count > 0.0 ? sum / count : signal::kMissing);
  }
  return means;
}

std::int64_t start_of_means(std::int64_t start_us, std::size_t samples, std::size_t of,
                            double sample_interval_s) {
  const double middle = 0.5 * (static_cast<double>(of) - 1.0);
  return start_us +
         signal::microseconds((static_cast<double>(samples % of) + middle) * sample_interval_s);
}

std::int64_t end_of_earlier(const PackedError& record, std::size_t of) {
  // Rows of archives that compress lie tens to a few hundred samples apart.
  constexpr std::size_t kShared = 256;
  const std::size_t means = std::min(kShared, record.size()) / of;
  const std::size_t samples = record.size() % of + means * of;
  return record.start_us() +
         signal::microseconds((static_cast<double>(samples) - 1.0) * record.sample_interval_s());
}

PackedError longer_record(const EarlierMeans& earlier, const PackedError& record, std::size_t of) {
  const double interval_s = record.sample_interval_s() * static_cast<double>(of);
  const signal::Samples own = means_of(record.unpacked(), of);
  const std::int64_t own_start_us =
      start_of_means(record.start_us(), record.size(), of, record.sample_interval_s());
  const double steps =
      std::round(signal::elapsed_us(earlier.start_us, own_start_us) * 1e-6 / interval_s);
  const auto before = static_cast<std::size_t>(std::max(0.0, steps));
  signal::Samples all(before, signal::kMissing);
  std::ranges::copy(earlier.values.first(std::min(before, earlier.values.size())), all.begin());
  all.insert(all.end(), own.begin(), own.end());
  return {all, interval_s,
          own_start_us - signal::microseconds(interval_s * static_cast<double>(before))};
}

}  // namespace loopscope::core::plant
