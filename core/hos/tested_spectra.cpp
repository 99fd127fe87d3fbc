#include "core/hos/tested_spectra.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/hos/locked_line.hpp"
#include "core/hos/segments.hpp"

namespace loopscope::core::hos {
namespace {

/// Overlaps that move a line which keeps its phase at 0.5: hops of 28, 26 and 22 of 64 samples.
constexpr std::array kOtherOverlaps = {0.5625, 0.59375, 0.65625};

void take_differences(std::span<const double> signal, std::vector<double>& result) {
  result.resize(signal.size());
  for (std::size_t n = 1; n < signal.size(); ++n) result[n] = signal[n] - signal[n - 1];
  if (!result.empty()) result[0] = result.size() > 1 ? result[1] : 0.0;
}

/// Lag-one correlation of the differences, whose mean is close to zero; missing samples left out.
double smoothness(std::span<const double> signal, const Kernels& kernels) {
  const PairSums sums = kernels.sum_differences(signal);
  return sums.power > 0.0 ? 2.0 * sums.product / sums.power : 0.0;
}

/// Above this the differences themselves wander like a random walk, and the record like an
/// integrated one, whose trends within a segment no taper holds back.
constexpr double kSteep = 0.9;

}  // namespace

TestedSpectra::TestedSpectra(std::span<const double> signal, const Bicoherence& published,
                             std::span<const double> published_bic2, const Settings& settings)
    : signal_(signal),
      settings_(settings),
      kernels_(&published.spectra().kernels()),
      precautions_{smoothness(signal, *kernels_) > kSteep, settings.overlap},
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
                             const Settings& settings, const Kernels& kernels)
    : settings_(settings), kernels_(&kernels), precautions_(precautions) {
  look_at(signal);
}

void TestedSpectra::look_at(std::span<const double> signal) {
  signal_ = signal;
  estimate();
}

void TestedSpectra::estimate() {
  settings_.overlap = precautions_.overlap;
  if (!own_ || own_->spectra().settings().overlap != settings_.overlap) {
    own_.emplace(settings_, *kernels_);
  }
  if (precautions_.differenced) take_differences(signal(), differences_);
  bic2_ = own_->estimate(precautions_.differenced ? differences_ : signal());
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
