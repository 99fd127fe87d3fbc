#include "core/plant/spectral_line.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/hos/numeric/distributions.hpp"
#include "core/plant/envelope.hpp"
#include "core/plant/periodogram.hpp"

namespace loopscope::core::plant {
namespace {

constexpr std::size_t kShortestRecord = 256;
constexpr double kGridStep = 0.01;
/// Bins that a Hann window makes one of: independent values are so many times fewer.
constexpr double kHannBins = 1.6;
constexpr double kMainLobe = 3.0;  // bins from a line's middle beyond which it has no power
constexpr double kSeparate = 0.25;
constexpr std::size_t kMostLines = 4;
constexpr double kClearLine = 0.01;
/// By kResonance; the most bands that ever make up a peak are not significant below.
constexpr double kLeastHeight = 1.1;

/// Half width of the peak's band and where its surroundings begin and end, as shares of its
/// frequency. Narrow and wide lines need different surroundings.
struct Shape {
  double half_width = 0.0;
  double near = 0.0;
  double far = 0.0;
};
constexpr std::array<Shape, kLineShapes> kShapes = {{{0.0, 0.12, 0.40},
                                                     {0.02, 0.12, 0.40},
                                                     {0.04, 0.12, 0.40},
                                                     {0.06, 0.12, 0.40},
                                                     {0.04, 0.20, 0.50},
                                                     {0.07, 0.20, 0.50},
                                                     {0.10, 0.20, 0.50}}};
/// Bands that can be told apart: relative frequencies about a mean band apart, for half of the
/// shapes (the others are their neighbours').
constexpr double kBandsPerShape = 0.5;
constexpr double kApart = 0.04;

/// Of a number of at least 0; std::round is a call on the plainest x86-64.
double nearest(double number) {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): numbers of bins, with a half only by chance.
  return static_cast<double>(static_cast<std::int64_t>(number + 0.5));
}

/// Bins from one sum to the next: so many sums in double precision take an eighth of the bins'
/// memory.
constexpr std::size_t kBlock = 32;

// A power from 2^-64 to 1 in 16 bits: the lowest six of a float's exponent and the highest ten of
// its fraction, good to a 2000th, where the power in a band is known to some percent at best.
constexpr unsigned kFractionBits = 13;  // that are left out
constexpr std::uint32_t kOne = std::bit_cast<std::uint32_t>(1.0F) >> kFractionBits;
constexpr std::uint32_t kLowest = kOne - std::numeric_limits<std::uint16_t>::max();

std::uint16_t shortened(double power) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(power));
  const std::uint32_t rounded = (bits + (1U << (kFractionBits - 1))) >> kFractionBits;
  return static_cast<std::uint16_t>(std::max(rounded, kLowest) - kLowest);
}

double lengthened(std::uint16_t power) {
  return static_cast<double>(std::bit_cast<float>((power + kLowest) << kFractionBits));
}

/// Whether the p of an F statistic is larger than this for sure, told without its law. With a =
/// freedom / 2 >= 1, x = a ratio and t = x^a exp(-x) / gamma(a) (Stirling: at most a tenth larger
/// than here) the p of a chi-square variable lies between t / x and t / (x - a + 1). Divided by
/// another variable, whose mean is 1, it has no smaller one: p is convex about x, and as long as
/// p + t <= 1 its tangent there stays below it down to 0.
bool surely_above(double p, double ratio, double freedom) {
  const double a = 0.5 * freedom, x = a * ratio;
  const double t = std::sqrt(a / (2.0 * std::numbers::pi)) *
                   std::exp(a * (std::log(ratio) - ratio + 1.0) - 1.0 / (12.0 * a));
  return x > a && t > p * x && 1.1 * t * (1.0 + 1.0 / (x - a + 1.0)) <= 1.0;
}

}  // namespace

LineSpectrum::LineSpectrum(std::span<const double> error, double sample_interval_s) {
  const Periodogram found = hann_periodogram(error, kShortestRecord);
  if (found.power.empty()) return;
  samples_ = found.samples;
  duration_s_ = samples_ * sample_interval_s;
  stretch_ = found.stretch;
  // Of the largest: single precision would not hold the power of every unit.
  const double largest = std::ranges::max(found.power);
  if (!(largest > 0.0 && std::isfinite(largest))) return;
  powers_.reserve(found.power.size());
  for (const double power : found.power) powers_.push_back(shortened(power / largest));
  sums_.reserve(powers_.size() / kBlock + 2);
  double sum = 0.0;
  for (std::size_t k = 0; k < powers_.size(); ++k) {
    if (k % kBlock == 0) sums_.push_back(sum);
    sum += bin(k);
  }
  sums_.push_back(sum);
  total_ = sum;
  bands_ = std::log(samples_ / kShortestPeriod / kFewestPeriods) / kApart * kBandsPerShape *
           static_cast<double>(kShapes.size());
}

double LineSpectrum::bin(std::size_t number) const {
  return lengthened(powers_[number]);
}

LineSpectrum::Sums LineSpectrum::all_sums() const {
  Sums sums;
  sums.reserve(powers_.size() + 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < powers_.size(); ++k) {
    sums.push_back(sum);
    sum += bin(k);
  }
  sums.push_back(sum);
  return sums;
}

double LineSpectrum::sum_before(std::size_t number, const Sums& sums) const {
  if (!sums.empty()) return sums[number];
  // From the nearer end of the block.
  const std::size_t block = (number + kBlock / 2) / kBlock;
  const std::size_t known = std::min(block * kBlock, powers_.size());
  double sum = sums_[block];
  for (std::size_t k = known; k < number; ++k) sum += bin(k);
  for (std::size_t k = number; k < known; ++k) sum -= bin(k);
  return sum;
}

LineSpectrum::Power LineSpectrum::power(double low, double high, const Sums& sums) const {
  const double last = static_cast<double>(powers_.size()) - 1.0;
  const double first = std::clamp(nearest(low * stretch_), 1.0, last);
  const double end = std::clamp(nearest(high * stretch_), first, last);
  const double bins = end - first + 1.0;
  // What is lost by rounding behind a tall line must not make a band of nothing.
  const double sum =
      std::max(bins * lengthened(0), sum_before(static_cast<std::size_t>(end) + 1, sums) -
                                         sum_before(static_cast<std::size_t>(first), sums));
  return {sum / bins, 2.0 * std::max(1.0, bins / stretch_ / kHannBins),
          0.5 * (first + end) / stretch_, sum / total_};
}

LineSpectrum::Peak LineSpectrum::measure(double place, std::size_t shape_number, const Sums& sums,
                                         double largest_p) const {
  const Shape& shape = kShapes.at(shape_number);
  const double half = std::max(1.0, shape.half_width * place);
  const double near = std::max(shape.near * place, half + kMainLobe);
  const double far = shape.far * place;
  if (far < near + 2.0) return {place};
  const Power inside = power(place - half, place + half, sums);
  const Power below = power(place - far, place - near, sums);
  const Power above = power(place + near, place + far, sums);
  constexpr double kLeastRatio = kLeastHeight * kResonance;
  // Between both sides lies their power law: most places are told without it.
  if (!(inside.mean > kLeastRatio * std::min(below.mean, above.mean))) return {place};
  const double from = std::log(below.place / place), to = std::log(above.place / place);
  const double weight = to / (to - from), rest = 1.0 - weight;
  const double around = std::exp(weight * std::log(below.mean) + rest * std::log(above.mean));
  Peak peak{place, 1.0, inside.mean / around, 0.0, half};
  if (!(peak.height > kLeastRatio) ||
      surely_above(largest_p, peak.height / kResonance, inside.freedom))
    return peak;
  const double freedom = 1.0 / (weight * weight / below.freedom + rest * rest / above.freedom);
  peak.p = hos::f_upper(peak.height / kResonance, inside.freedom, freedom);
  peak.share = inside.share * (1.0 - 1.0 / peak.height);
  return peak;
}

LineSpectrum::Peak LineSpectrum::best_at(double place, double largest_p, const Sums& sums) const {
  Peak best{place};
  for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
    const Peak peak = measure(place, shape, sums, std::min(largest_p, best.p));
    if (peak.p < best.p) best = peak;
  }
  return best;
}

double LineSpectrum::centre(const Peak& peak) const {
  // Squares: the slope of what lies below the line would draw the mean to one side.
  const auto first = static_cast<std::size_t>(std::round((peak.place - peak.half) * stretch_));
  const auto last = static_cast<std::size_t>(std::round((peak.place + peak.half) * stretch_));
  double moment = 0.0, power = 0.0;
  for (std::size_t k = first; k <= last && k < powers_.size(); ++k) {
    const double here = bin(k);
    power += here * here;
    moment += here * here * static_cast<double>(k);
  }
  return power > 0.0 ? moment / power / stretch_ : peak.place;
}

std::vector<SpectralLine> LineSpectrum::lines(double largest_p) const {
  if (!(bands_ > 0.0)) return {};
  const Sums sums = all_sums();
  std::vector<Peak> peaks;
  const double last = samples_ / kShortestPeriod;
  for (double place = kFewestPeriods; place <= last; place += std::max(0.5, kGridStep * place)) {
    const Peak best = best_at(place, largest_p, sums);
    if (best.p <= largest_p) peaks.push_back(best);
  }
  std::ranges::stable_sort(peaks, {}, &Peak::p);
  std::vector<Peak> kept;
  std::vector<SpectralLine> lines;
  for (const Peak& peak : peaks) {
    const bool beside = std::ranges::any_of(kept, [&](const Peak& other) {
      return std::abs(std::log(peak.place / other.place)) < kSeparate;
    });
    if (beside) continue;
    kept.push_back(peak);
    lines.push_back({centre(peak) / duration_s_, std::clamp(bands_ * peak.p, 1e-300, 1.0),
                     peak.height, std::min(1.0, peak.share)});
    if (lines.size() == kMostLines) break;
  }
  return lines;
}

LineSpectrum::Peak LineSpectrum::clear_line(double frequency_hz) const {
  const double place = frequency_hz * duration_s_;
  Peak none{place, 1.0, 1.0};
  if (!(bands_ > 0.0) || place < kFewestPeriods || place * kShortestPeriod > samples_) return none;
  const Peak best = best_at(place, kClearLine);
  return best.p <= kClearLine ? best : none;
}

double LineSpectrum::share(double frequency_hz) const {
  return std::min(1.0, clear_line(frequency_hz).share);
}

double LineSpectrum::share_about(double frequency_hz) const {
  const double place = frequency_hz * duration_s_;
  return bands_ > 0.0 ? power(0.5 * place, 1.5 * place).share : 0.0;
}

double LineSpectrum::share_below(double frequency_hz) const {
  return bands_ > 0.0 ? power(0.0, frequency_hz * duration_s_).share : 0.0;
}

double LineSpectrum::height(double frequency_hz) const {
  return clear_line(frequency_hz).height;
}

std::array<double, kLineShapes> LineSpectrum::evidence(double frequency_hz) const {
  std::array<double, kLineShapes> found{};
  const double place = frequency_hz * duration_s_;
  if (!(bands_ > 0.0) || place < kFewestPeriods || place * kShortestPeriod > samples_) return found;
  for (std::size_t shape = 0; shape < kShapes.size(); ++shape)
    found[shape] = -std::log(std::max(1e-300, measure(place, shape).p));
  return found;
}

}  // namespace loopscope::core::plant
