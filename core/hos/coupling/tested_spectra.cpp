#include "core/hos/coupling/tested_spectra.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/hos/coupling/locked_line.hpp"
#include "core/hos/transforms/segments.hpp"

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
    : recorded_(signal),
      settings_(settings),
      kernels_(&published.spectra().kernels()),
      precautions_{smoothness(signal, *kernels_) > kSteep, settings.overlap},
      published_(&published) {
  if (precautions_.differenced) transform();
  take_precautions();
  bic2_ = own_ ? own_->average() : published_bic2;
}

TestedSpectra::TestedSpectra(std::span<const double> signal, Bicoherence& workspace,
                             const Settings& settings)
    : recorded_(signal),
      settings_(settings),
      kernels_(&workspace.spectra().kernels()),
      precautions_{smoothness(signal, *kernels_) > kSteep, settings.overlap},
      workspace_(&workspace) {
  transform();
  take_precautions();
  bic2_ = own_->average();
}

void TestedSpectra::take_precautions() {
  if (has_segments() && has_locked_line(bicoherence().spectra())) unlock();
  if (!has_segments()) return;
  SegmentLevels levels(bicoherence().spectra());
  if (!levels.upsets().empty()) {
    leave_out(levels.upsets());
    if (!has_segments()) return;
    levels = SegmentLevels(bicoherence().spectra());
  }
  if (!levels.vary()) return;
  if (!own_) transform();
  own_->scale_segments(levels.factors());
  levels_ = std::move(levels);
}

void TestedSpectra::transform() {
  settings_.overlap = precautions_.overlap;
  const auto fits = [&](const Bicoherence& bicoherence) {
    return bicoherence.spectra().settings().overlap == settings_.overlap;
  };
  if (workspace_ && fits(*workspace_)) {
    own_ = workspace_;
  } else {
    if (!made_ || !fits(*made_)) made_.emplace(settings_, *kernels_);
    own_ = &*made_;
  }
  if (precautions_.differenced) take_differences(signal(), differences_);
  own_->transform(precautions_.differenced ? differences_ : signal());
}

/// Takes the first overlap at which no line keeps its phase, the last one if none does.
void TestedSpectra::unlock() {
  for (const double overlap : kOtherOverlaps) {
    precautions_.overlap = overlap;
    transform();
    if (!has_segments() || !has_locked_line(own_->spectra())) return;
  }
}

/// The middle half of every upset segment is marked: neighbours that see the same upset in their
/// own middle are upset themselves.
void TestedSpectra::leave_out(const std::vector<std::size_t>& upsets) {
  steady_.assign(recorded_.begin(), recorded_.end());
  const std::size_t length = settings_.segment_length;
  for (const std::size_t s : upsets) {
    const std::size_t start = bicoherence().spectra().positions()[s] * segment_hop(settings_);
    const auto first = steady_.begin() + static_cast<std::ptrdiff_t>(start + length / 4);
    std::fill_n(first, length / 2, std::numeric_limits<double>::quiet_NaN());
  }
  transform();
}

}  // namespace loopscope::core::hos
