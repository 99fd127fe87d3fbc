#include "core/hos/transforms/spectra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/hos/numeric/magnitude.hpp"
#include "core/hos/transforms/segments.hpp"
#include "core/hos/transforms/window.hpp"

namespace loopscope::core::hos {
namespace {

const Settings& validated(const Settings& settings) {
  validate(settings);
  return settings;
}

const SegmentDft* segment_dft(const Settings& settings) {
  const bool made = SegmentDft::made_for(settings.segment_length, settings.dft_length);
  return made ? &SegmentDft::of_length(settings.dft_length) : nullptr;
}

}  // namespace

Spectra::Spectra(const Settings& settings, const Kernels& kernels)
    : settings_(validated(settings)),
      kernels_(&kernels),
      window_(make_window(settings.window, settings.segment_length)),
      window_sum_(std::accumulate(window_.begin(), window_.end(), 0.0)),
      dft_(segment_dft(settings)),
      silence_(settings.segment_length, 0.0),
      scratch_(dft_ != nullptr ? dft_->scratch_size() : 0),
      total_power_(frequencies()) {
  if (dft_ == nullptr) paired_.emplace(settings.segment_length, settings.dft_length);
}

void Spectra::compute(std::span<const double> signal) {
  const MagnitudeScan scan = kernels_->scan(signal);
  scale_ = power_of_two_below(scan.largest);
  find_segments(signal, scan.complete, settings_, positions_);
  segments_ = positions_.size();
  resize_rows((segments_ + kLanes - 1) / kLanes * kLanes);
  for (std::size_t first = 0; first < segments_; first += kLanes) transform_batch(signal, first);
  sum_power();
  const double floor = power_floor(scan.largest / scale_);
  for (double& power : total_power_) power = power > floor ? power : 0.0;
}

void Spectra::scale_segments(std::span<const double> factors) {
  for (std::size_t k = 0; k < frequencies(); ++k) {
    double* const re = rows_.data() + k * kRows * pitch_;
    double* const im = re + pitch_;
    double* const power = im + pitch_;
    for (std::size_t s = 0; s < segments_; ++s) {
      re[s] *= factors[s];
      im[s] *= factors[s];
      power[s] *= factors[s] * factors[s];
    }
  }
  const std::vector<double> before = total_power_;
  sum_power();
  // A bin that was rounding noise stays empty.
  for (std::size_t k = 0; k < frequencies(); ++k) {
    if (!(before[k] > 0.0)) total_power_[k] = 0.0;
  }
}

void Spectra::resize_rows(std::size_t row_length) {
  // The batches overwrite all rows but those of the zero frequencies.
  if (row_length != row_length_) {
    row_length_ = row_length;
    // An odd number of cache lines: a batch that writes one line of every row would else find room
    // in a few sets of the first cache only.
    pitch_ = row_length + (row_length / kLanes % 2 == 0 ? kLanes : 0);
    rows_.resize((frequencies() + kZeroFrequencies) * kRows * pitch_);
    std::fill(rows_.begin() + static_cast<std::ptrdiff_t>(frequencies() * kRows * pitch_),
              rows_.end(), 0.0);
  }
}

void Spectra::transform_batch(std::span<const double> signal, std::size_t first) {
  SegmentBatch batch{{},    1.0 / scale_, window_.data(), scratch_.data(), rows_.data() + first,
                     pitch_};
  const std::size_t hop = segment_hop(settings_);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const bool present = first + i < segments_;
    batch.segments[i] = present ? signal.data() + positions_[first + i] * hop : silence_.data();
  }
  if (dft_ != nullptr) {
    kernels_->transform(*dft_, batch);
  } else {
    paired_->transform(batch);
  }
}

std::vector<double> Spectra::sums(std::size_t which) const {
  std::vector<double> result(frequencies());
  sum_rows(which, result.data());
  return result;
}

void Spectra::sum_rows(std::size_t which, double* sums) const {
  kernels_->sum_rows({row(0, which), kRows * pitch_, row_length_, frequencies()}, sums);
}

double Spectra::power_floor(double largest) const {
  const double epsilon = std::numeric_limits<double>::epsilon();
  const double noise = kRoundingUnits * epsilon * largest * window_sum_;
  return noise * noise * static_cast<double>(segments_);
}

}  // namespace loopscope::core::hos
