#include "core/loop/unit_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace loopscope::core::loop {
namespace {

/// One loop in a hundred has its units mixed up, one in ten an offset that lasts.
constexpr double kPriorOfUnits = 0.01;
constexpr double kPriorOfOffset = 0.1;

/// A controller with integral action keeps the mean error of a window below so much of pv's
/// standard deviation about it, ...
constexpr double kMeanError = 0.4;
/// ... and what was converted and rounded lies so far away, of its size.
constexpr double kRounding = 5e-4;
/// By how much a slope over a window with the delay of the loop may be off, of itself.
constexpr double kSlopeError = 0.07;
/// How well a slope is known that is taken for shown, standard error of the conversion's factor.
constexpr double kKnownSlope = 0.15;

constexpr std::size_t kBlocks = 32;
constexpr double kMostMemory = 0.9;
/// Below this share of its size the setpoint moves by rounding alone.
constexpr double kRest = 1e-6;

struct Line {
  std::size_t blocks = 0;
  double sp = 0.0, pv = 0.0;             ///< means
  double slope = 0.0;                    ///< of pv over sp
  std::optional<double> slope_variance;  ///< nullopt where sp rests
  double residual = 0.0;                 ///< standard deviation of the blocks about the line
  double spread = 0.0;                   ///< of the samples about it
};

struct Means {
  std::vector<double> sp, pv;
};

bool both(double sp, double pv) {
  return std::isfinite(sp) && std::isfinite(pv);
}

Means block_means(std::span<const double> sp, std::span<const double> pv) {
  Means means;
  const std::size_t length = pv.size() / kBlocks;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    double sp_sum = 0.0;
    double pv_sum = 0.0;
    std::size_t count = 0;
    for (std::size_t k = block * length; k < (block + 1) * length; ++k) {
      if (!both(sp[k], pv[k])) continue;
      sp_sum += sp[k];
      pv_sum += pv[k];
      ++count;
    }
    if (2 * count < length || count == 0) continue;
    means.sp.push_back(sp_sum / static_cast<double>(count));
    means.pv.push_back(pv_sum / static_cast<double>(count));
  }
  return means;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Sum of products of the distances from both means.
double product(const std::vector<double>& a, double a_mean, const std::vector<double>& b,
               double b_mean) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - a_mean) * (b[k] - b_mean);
  return sum;
}

/// Of the residuals of neighbouring blocks, 0 to kMostMemory.
double memory_of(const std::vector<double>& residuals) {
  double neighbours = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    squares += residuals[k] * residuals[k];
    if (k > 0) neighbours += residuals[k] * residuals[k - 1];
  }
  return squares > 0.0 ? std::clamp(neighbours / squares, 0.0, kMostMemory) : 0.0;
}

double spread_about(const Line& line, std::span<const double> sp, std::span<const double> pv) {
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (!both(sp[k], pv[k])) continue;
    const double distance = pv[k] - line.pv - line.slope * (sp[k] - line.sp);
    squares += distance * distance;
    ++count;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

/// nullopt where too few blocks hold both.
std::optional<Line> fit_line(std::span<const double> sp, std::span<const double> pv) {
  const Means means = block_means(sp, pv);
  if (2 * means.pv.size() < kBlocks) return std::nullopt;
  Line line;
  line.blocks = means.pv.size();
  line.sp = mean(means.sp);
  line.pv = mean(means.pv);
  const double squares = product(means.sp, line.sp, means.sp, line.sp);
  const auto blocks = static_cast<double>(line.blocks);
  const bool moves = squares > blocks * std::pow(kRest * std::abs(line.sp), 2);
  if (moves) line.slope = product(means.sp, line.sp, means.pv, line.pv) / squares;
  std::vector<double> residuals(line.blocks);
  for (std::size_t k = 0; k < line.blocks; ++k)
    residuals[k] = means.pv[k] - line.pv - line.slope * (means.sp[k] - line.sp);
  const double variance = product(residuals, 0.0, residuals, 0.0) / (blocks - 2.0);
  const double memory = memory_of(residuals);
  if (moves) line.slope_variance = variance / squares * (1.0 + memory) / (1.0 - memory);
  line.residual = std::sqrt(variance);
  line.spread = spread_about(line, sp, pv);
  return line;
}

double log_normal(double distance, double variance) {
  return -0.5 * (distance * distance / variance + std::log(2.0 * std::numbers::pi * variance));
}

/// Probability that a normal deviate lies below.
double normal_below(double deviate) {
  return 0.5 * std::erfc(-deviate / std::numbers::sqrt2);
}

/// How likely pv's mean is where the controller keeps it to the converted setpoint.
double log_level(const Line& line, double factor, double offset) {
  const double rounding = kRounding * std::max(std::abs(line.pv), std::abs(factor * line.sp));
  const double variance = std::pow(kMeanError * line.spread, 2) + rounding * rounding;
  return log_normal(offset + factor * line.sp - line.pv, std::max(variance, 1e-300));
}

double log_slope(const Line& line, double factor) {
  if (!line.slope_variance) return 0.0;
  return log_normal(line.slope - factor, *line.slope_variance + std::pow(kSlopeError * factor, 2));
}

/// The slope of a loop with an offset: none in manual and at a limit, one where something is added
/// to pv, between both without integral action, and by chance any.
double log_slope_of_offset(const Line& line) {
  if (!line.slope_variance) return 0.0;
  constexpr double kNarrow = 0.05 * 0.05;
  constexpr double kWide = 4.0;
  const double variance = *line.slope_variance;
  const double error = std::sqrt(std::max(variance, 1e-300));
  const double between =
      std::max(normal_below(line.slope / error) - normal_below((line.slope - 1.0) / error), 0.0);
  return std::log(0.4 * std::exp(log_normal(line.slope, variance + kNarrow)) +
                  0.25 * std::exp(log_normal(line.slope - 1.0, variance + kNarrow)) +
                  0.25 * between + 0.1 * std::exp(log_normal(line.slope, variance + kWide)));
}

/// pv anywhere within a span of its size, or the transmitter's.
double log_offset(const Line& line, const std::optional<signal::OpRange>& range) {
  const double span =
      range ? range->high - range->low : std::max(std::abs(line.sp), std::abs(line.pv));
  return -std::log(std::max(span, 1e-300)) + log_slope_of_offset(line);
}

UnitMatch match_with(const Line& line, std::vector<UnitConversion> conversions,
                     const std::optional<signal::OpRange>& range) {
  std::vector<double> logs;
  for (const UnitConversion& conversion : conversions) {
    logs.push_back(std::log(kPriorOfUnits * conversion.share) +
                   log_level(line, conversion.factor, conversion.offset) +
                   log_slope(line, conversion.factor));
  }
  const double kept =
      std::log(1.0 - kPriorOfOffset) + log_level(line, 1.0, 0.0) + log_slope(line, 1.0);
  const double offset = std::log(kPriorOfOffset) + log_offset(line, range);
  const auto likeliest = std::ranges::max_element(logs);
  const double most = std::max({*likeliest, kept, offset});
  double units = 0.0;
  for (const double value : logs) units += std::exp(value - most);
  UnitMatch match;
  match.probability = units / (units + std::exp(kept - most) + std::exp(offset - most));
  match.conversion = std::move(conversions[static_cast<std::size_t>(likeliest - logs.begin())]);
  match.sp_mean = line.sp;
  match.pv_mean = line.pv;
  match.slope = line.slope;
  match.offset = line.pv - line.slope * line.sp;
  match.residual = line.residual;
  match.follows = line.slope_variance &&
                  std::sqrt(*line.slope_variance) < kKnownSlope * std::abs(match.conversion.factor);
  return match;
}

}  // namespace

std::vector<UnitConversion> unit_conversions(const std::optional<signal::OpRange>& range) {
  constexpr double kDegrees = 1.8;
  constexpr double kFreezing_F = 32.0;
  constexpr double kFreezing_K = 273.15;
  constexpr double kPsiPerBar = 14.5038;
  constexpr double kKilopascalPerPsi = 6.89476;
  std::vector<UnitConversion> all{
      {"converted from degF to degC", 1.0 / kDegrees, -kFreezing_F / kDegrees, 0.2},
      {"converted from degC to degF", kDegrees, kFreezing_F, 0.2},
      {"converted from K to degC", 1.0, -kFreezing_K, 0.05},
      {"converted from degC to K", 1.0, kFreezing_K, 0.05},
      {"converted from bar to psi", kPsiPerBar, 0.0, 0.04},
      {"converted from psi to bar", 1.0 / kPsiPerBar, 0.0, 0.04},
      {"converted from psi to kPa", kKilopascalPerPsi, 0.0, 0.03},
      {"converted from kPa to psi", 1.0 / kKilopascalPerPsi, 0.0, 0.03},
      {"times 10", 10.0, 0.0, 0.04},
      {"divided by 10", 0.1, 0.0, 0.04},
      {"times 100", 100.0, 0.0, 0.05},
      {"divided by 100", 0.01, 0.0, 0.05},
      {"times 1000", 1000.0, 0.0, 0.04},
      {"divided by 1000", 0.001, 0.0, 0.04},
  };
  if (!range) return all;
  const double span = range->high - range->low;
  all.push_back({"taken as percent of pv's range", span / 100.0, range->low, 0.07});
  all.push_back({"in percent of pv's range", 100.0 / span, -100.0 * range->low / span, 0.03});
  return all;
}

std::optional<UnitMatch> match_units(std::span<const double> sp, std::span<const double> pv,
                                     const std::optional<signal::OpRange>& range) {
  if (sp.size() != pv.size() || pv.size() < kBlocks) return std::nullopt;
  const std::optional<Line> line = fit_line(sp, pv);
  if (!line) return std::nullopt;
  UnitMatch match = match_with(*line, unit_conversions(range), range);
  // Sizes whose squares overflow.
  return std::isfinite(match.probability) ? std::optional(std::move(match)) : std::nullopt;
}

}  // namespace loopscope::core::loop
