#include "core/hos/tested_spectra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/hos/locked_line.hpp"
#include "core/hos/segments.hpp"

namespace loopscope::core::hos {
namespace {

/// Overlaps that move a line which keeps its phase at 0.5: hops of 28, 26 and 22 of 64 samples.
constexpr std::array kOtherOverlaps = {0.5625, 0.59375, 0.65625};

std::vector<double> differences(std::span<const double> signal) {
  std::vector<double> result(signal.size());
  for (std::size_t n = 1; n < signal.size(); ++n) result[n] = signal[n] - signal[n - 1];
  if (result.size() > 1) result[0] = result[1];
  return result;
}

/// Lag-one correlation of the differences, whose mean is close to zero; missing samples left out.
double smoothness(std::span<const double> signal) {
  double product = 0.0;
  double power = 0.0;
  for (std::size_t n = 2; n < signal.size(); ++n) {
    const double now = signal[n] - signal[n - 1];
    const double before = signal[n - 1] - signal[n - 2];
    if (!std::isfinite(now + before)) continue;
    product += now * before;
    power += 0.5 * (now * now + before * before);
  }
  return power > 0.0 ? product / power : 0.0;
}

/// Above this the differences themselves wander like a random walk, and the record like an
/// integrated one, whose trends within a segment no taper holds back.
constexpr double kSteep = 0.9;

}  // namespace

TestedSpectra::TestedSpectra(std::span<const double> signal, const Bicoherence& published,
                             std::span<const double> published_bic2, const Settings& settings)
    : signal_(signal),
      settings_(settings),
      precautions_{smoothness(signal) > kSteep, settings.overlap},
      published_(&published),
      bic2_(published_bic2) {
  if (precautions_.differenced) estimate();
  if (!bic2_.empty() && has_locked_line(bicoherence().spectra())) unlock();
  if (bic2_.empty()) return;
  SegmentLevels levels(bicoherence().spectra());
  if (!levels.upsets().empty()) {
    leave_out(levels.upsets());
    if (bic2_.empty()) return;
    levels = SegmentLevels(bicoherence().spectra());
  }
  if (!levels.vary()) return;
  if (!own_) estimate();
  bic2_ = own_->scale_segments(levels.factors());
  levels_ = std::move(levels);
}

TestedSpectra::TestedSpectra(std::span<const double> signal, const Precautions& precautions,
                             const Settings& settings)
    : signal_(signal), settings_(settings), precautions_(precautions) {
  estimate();
}

void TestedSpectra::estimate() {
  settings_.overlap = precautions_.overlap;
  own_.emplace(settings_);
  bic2_ =
      precautions_.differenced ? own_->estimate(differences(signal())) : own_->estimate(signal());
}

/// Takes the first overlap at which no line keeps its phase, the last one if none does.
void TestedSpectra::unlock() {
  for (const double overlap : kOtherOverlaps) {
    precautions_.overlap = overlap;
    estimate();
    if (bic2_.empty() || !has_locked_line(own_->spectra())) return;
  }
}

/// The middle half of every upset segment is marked: neighbours that see the same upset in their
/// own middle are upset themselves.
void TestedSpectra::leave_out(const std::vector<std::size_t>& upsets) {
  steady_.assign(signal_.begin(), signal_.end());
  const std::size_t length = settings_.segment_length;
  for (const std::size_t s : upsets) {
    const std::size_t start = bicoherence().spectra().positions()[s] * segment_hop(settings_);
    const auto first = steady_.begin() + static_cast<std::ptrdiff_t>(start + length / 4);
    std::fill_n(first, length / 2, std::numeric_limits<double>::quiet_NaN());
  }
  estimate();
}

}  // namespace loopscope::core::hos
