#include "tests/core/loop/unit_loops.hpp"

#include <cmath>
#include <optional>
#include <span>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop::signals {
namespace {

constexpr std::size_t kWindow = 4096;

struct Range {
  double low = 0.0, high = 0.0;
  [[nodiscard]] double span() const { return high - low; }
};

constexpr std::array kRanges{Range{0, 100},  Range{20, 400}, Range{0, 500},
                             Range{0, 10},   Range{0.5, 50}, Range{-30, 60},
                             Range{0, 5000}, Range{0, 1},    Range{200, 700}};
constexpr std::array kTemperatures{Range{20, 400}, Range{0, 100}, Range{-30, 60}, Range{40, 90}};

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<>(low, high)(random);
}

double normal(Random& random) {
  return std::normal_distribution<>()(random);
}

/// 10 to a power between both.
double spread_over(Random& random, double low, double high) {
  return std::pow(10.0, uniform(random, low, high));
}

std::size_t below(Random& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

Range range_of(Random& random, std::span<const Range> ranges) {
  return ranges[below(random, ranges.size())];
}

double rounded(double value, double digits) {
  const double ten = std::pow(10.0, digits);
  return std::round(value * ten) / ten;
}

/// Standard deviation `std`.
Series wander(Random& random, double phi, double std) {
  Series series = ar1(random, kWindow, phi);
  for (double& value : series) value *= std * std::sqrt(1.0 - phi * phi);
  return series;
}

void step_up(Random& random, const Range& range, Series& sp) {
  const double base = sp.front();
  for (std::size_t left = 1 + below(random, 7); left > 0; --left) {
    const std::size_t at = below(random, kWindow);
    const double value = base + normal(random) * 0.05 * range.span();
    for (std::size_t k = at; k < kWindow; ++k) sp[k] = value;
  }
}

Series setpoint(Random& random, Setpoint kind, const Range& range) {
  const double margin = 0.1 * range.span();
  Series sp(kWindow, uniform(random, range.low + margin, range.high - margin));
  if (kind == Setpoint::steps) step_up(random, range, sp);
  if (kind == Setpoint::cascade)
    sp = sum(std::move(sp), wander(random, 0.995, 0.03 * range.span()), 1.0);
  const double digits = static_cast<double>(below(random, 3)) + (range.span() > 20.0 ? 0.0 : 1.0) +
                        (range.span() > 1.0 ? 0.0 : 1.0);
  for (double& value : sp) value = rounded(value, digits);
  return sp;
}

/// pv of a loop that takes `sp` as its setpoint: integral action takes the slow part of the load.
Series follow(Random& random, const Series& sp, double span) {
  const double lag = std::exp(-1.0 / uniform(random, 3.0, 60.0));
  const Series load = wander(random, std::exp(-1.0 / uniform(random, 2.0, 100.0)),
                             span * spread_over(random, -3.3, -1.7));
  const double noise = span * spread_over(random, -4.0, -2.3);
  constexpr double kSlow = 0.995;
  Series pv(sp.size());
  double level = sp.front();
  double taken = 0.0;
  for (std::size_t k = 0; k < sp.size(); ++k) {
    level = lag * level + (1.0 - lag) * sp[k];
    taken = kSlow * taken + (1.0 - kSlow) * load[k];
    pv[k] = level + load[k] - taken + noise * normal(random);
  }
  return pv;
}

Series towards(Series sp, double share, double base) {
  for (double& value : sp) value = share * value + (1.0 - share) * base;
  return sp;
}

template <typename Draw, typename Right>
UnitShares shares(std::size_t records, std::uint64_t seed, const Draw& draw, const Right& right) {
  UnitShares shares;
  const double part = 1.0 / static_cast<double>(records);
  for (std::size_t k = 0; k < records; ++k) {
    Random random(seed + k);
    const UnitLoop loop = draw(random);
    const auto match = match_units(loop.sp, loop.pv, std::nullopt).value();
    const bool far = is_far(loop), likely = match.probability > 0.5;
    shares.far += far ? part : 0.0;
    shares.doubted += far && likely && right(match) ? part : 0.0;
    shares.shown += match.follows && match.probability >= 0.99 && right(match) ? part : 0.0;
    shares.wrong += likely && !right(match) ? part : 0.0;
  }
  return shares;
}

}  // namespace

std::string_view name(Setpoint kind) {
  if (kind == Setpoint::rests) return "rests";
  return kind == Setpoint::steps ? "steps" : "cascade";
}

std::string_view name(Elsewhere why) {
  switch (why) {
    case Elsewhere::proportional:
      return "no integral action";
    case Elsewhere::held:
      return "held at a limit";
    case Elsewhere::manual:
      return "in manual";
    case Elsewhere::bias:
      return "biased";
    default:
      return "sound";
  }
}

UnitLoop loop_elsewhere(Random& random, Setpoint kind, Elsewhere why) {
  const Range range = range_of(random, kRanges);
  UnitLoop loop{setpoint(random, kind, range), {}};
  const double base = uniform(random, range.low, range.high);
  const bool follows = why == Elsewhere::nothing || why == Elsewhere::bias;
  const double share = why == Elsewhere::proportional ? uniform(random, 0.3, 0.95) : 0.0;
  loop.pv = follow(random, follows ? loop.sp : towards(loop.sp, share, base), range.span());
  if (why == Elsewhere::manual)
    loop.pv = sum(std::move(loop.pv), wander(random, 0.999, range.span()),
                  spread_over(random, -3.0, -1.5));
  if (why == Elsewhere::bias) {
    const double sign = below(random, 2) == 0 ? -1.0 : 1.0;
    const Series bias(kWindow, sign * range.span() * spread_over(random, -1.7, -0.3));
    loop.pv = sum(std::move(loop.pv), bias, 1.0);
  }
  return loop;
}

UnitLoop loop_in_units(Random& random, Setpoint kind, const UnitConversion& conversion) {
  const bool degrees = conversion.offset != 0.0;
  const Range range = degrees ? range_of(random, kTemperatures) : range_of(random, kRanges);
  UnitLoop loop{setpoint(random, kind, range), {}};
  loop.pv = follow(random, loop.sp, range.span());
  for (double& value : loop.sp)
    value = rounded((value - conversion.offset) / conversion.factor, 4.0);
  return loop;
}

bool is_far(const UnitLoop& loop) {
  constexpr double kFar = 5.0;
  Series error(loop.sp.size());
  for (std::size_t k = 0; k < error.size(); ++k) error[k] = loop.sp[k] - loop.pv[k];
  const auto spread = signal::measure_spread(error).value();
  return std::abs(spread.mean) > kFar * spread.std;
}

UnitShares shares_elsewhere(Setpoint kind, Elsewhere why, std::size_t records, std::uint64_t seed) {
  return shares(
      records, seed, [&](Random& random) { return loop_elsewhere(random, kind, why); },
      [](const UnitMatch&) { return true; });
}

UnitShares shares_in_units(Setpoint kind, const UnitConversion& conversion, std::size_t records,
                           std::uint64_t seed) {
  return shares(
      records, seed, [&](Random& random) { return loop_in_units(random, kind, conversion); },
      [&](const UnitMatch& match) { return match.conversion.words == conversion.words; });
}

}  // namespace loopscope::core::loop::signals
