#include "tests/core/signal/arbitrary_samples.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::signal {
namespace {

namespace gen = rc::gen;

constexpr std::int64_t kDay_us = 86'400'000'000;

rc::Gen<double> sixteenths() {
  return gen::map(gen::inRange(-16'000, 16'001),
                  [](int k) { return static_cast<double>(k) / 16.0; });
}

/// A value or, one time in five, a missing one.
rc::Gen<double> value_or_missing() {
  return gen::weightedOneOf<double>({{4, sixteenths()}, {1, gen::just(kMissing)}});
}

/// A stretch of values, or one of missing samples.
rc::Gen<Samples> stretch() {
  return gen::weightedOneOf<Samples>({{3, gen::container<Samples>(sixteenths())},
                                      {1, gen::container<Samples>(gen::just(kMissing))},
                                      {1, gen::container<Samples>(value_or_missing())}});
}

}  // namespace

rc::Gen<Samples> samples_with_gaps() {
  return gen::map(gen::container<std::vector<Samples>>(stretch()),
                  [](const std::vector<Samples>& parts) {
                    Samples samples;
                    for (const Samples& part : parts)
                      samples.insert(samples.end(), part.begin(), part.end());
                    return samples;
                  });
}

rc::Gen<RawSeries> arbitrary_rows() {
  // Whole seconds repeat now and then.
  const auto second =
      gen::map(gen::inRange<std::int64_t>(0, 200), [](std::int64_t s) { return s * 1'000'000; });
  const auto time = gen::oneOf(second, gen::inRange<std::int64_t>(0, kDay_us));
  const auto row = gen::pair(time, value_or_missing());
  return gen::map(gen::nonEmpty(gen::container<std::vector<std::pair<std::int64_t, double>>>(row)),
                  [](std::vector<std::pair<std::int64_t, double>> rows) {
                    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
                      return a.first < b.first;
                    });
                    RawSeries series;
                    for (const auto& [time_us, value] : rows) {
                      series.time_us.push_back(time_us);
                      series.value.push_back(value);
                    }
                    return series;
                  });
}

rc::Gen<Grid> arbitrary_grid() {
  return gen::map(gen::tuple(gen::inRange<std::int64_t>(0, kDay_us),
                             gen::oneOf(gen::inRange(1, 20), gen::inRange(1, 600'000)),
                             gen::inRange<std::size_t>(0, 200)),
                  [](const std::tuple<std::int64_t, int, std::size_t>& parts) {
                    const auto [start_us, interval_ms, size] = parts;
                    return Grid{start_us, static_cast<double>(interval_ms) / 1000.0, size};
                  });
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool same(const Samples& a, const Samples& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return same(x, y); });
}

}  // namespace loopscope::core::signal
