#include "core/hos/spectra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/hos/magnitude.hpp"
#include "core/hos/paired_fft.hpp"
#include "core/hos/segments.hpp"
#include "core/hos/window.hpp"

namespace loopscope::core::hos {
namespace {

const Settings& validated(const Settings& settings) {
  validate(settings);
  return settings;
}

}  // namespace

Spectra::Spectra(const Settings& settings)
    : settings_(validated(settings)),
      window_(make_window(settings.window, settings.segment_length)),
      centred_(settings.segment_length),
      fft_(&PairedFft::of_length(settings.dft_length)),
      input_(fft_->buffer_size()),
      output_(fft_->buffer_size()),
      total_power_(frequencies()) {}

void Spectra::compute(std::span<const double> signal) {
  const std::vector<std::size_t> starts = segment_starts(signal, settings_);
  const double largest = largest_magnitude(signal);
  scale_ = power_of_two_below(largest);
  segments_ = starts.size();
  positions_.resize(segments_);
  std::transform(starts.begin(), starts.end(), positions_.begin(),
                 [hop = segment_hop(settings_)](std::size_t start) { return start / hop; });
  resize_rows((segments_ + kLanes - 1) / kLanes * kLanes);
  for (std::size_t first = 0; first < segments_; first += kLanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (first + i < segments_) {
        load_segment(signal.subspan(starts[first + i], window_.size()), i);
      } else {
        clear_segment(i);
      }
    }
    fft_->execute(input_, output_);
    store_batch(first);
  }
  sum_power(largest / scale_);
}

void Spectra::scale_segments(std::span<const double> factors) {
  for (std::size_t k = 0; k < frequencies(); ++k) {
    double* const re = rows_.data() + k * kRows * row_length_;
    double* const im = re + row_length_;
    double* const power = im + row_length_;
    for (std::size_t s = 0; s < segments_; ++s) {
      re[s] *= factors[s];
      im[s] *= factors[s];
      power[s] *= factors[s] * factors[s];
    }
    // A bin that was rounding noise stays empty.
    total_power_[k] =
        total_power_[k] > 0.0 ? std::accumulate(power, power + row_length_, 0.0) : 0.0;
  }
}

void Spectra::resize_rows(std::size_t row_length) {
  // Rows of the same length are overwritten whole, but for the zero frequencies that stay as they
  // are.
  if (row_length != row_length_) {
    row_length_ = row_length;
    rows_.assign((frequencies() + kZeroFrequencies) * kRows * row_length_, 0.0);
  }
}

void Spectra::load_segment(std::span<const double> segment, std::size_t sequence) {
  const double factor = 1.0 / scale_;
  // About the first sample, so that a constant leaves exact zeros whatever its length; two sums,
  // since one would make every addition wait for the one before it.
  const double first = segment[0] * factor;
  double even = 0.0;
  double odd = 0.0;
  for (std::size_t n = 0; n < segment.size(); n += 2) {
    centred_[n] = segment[n] * factor - first;
    centred_[n + 1] = segment[n + 1] * factor - first;
    even += centred_[n];
    odd += centred_[n + 1];
  }
  const double mean = (even + odd) / static_cast<double>(segment.size());
  double* const input = input_.data() + fft_->input_begin(sequence);
  for (std::size_t n = 0; n < segment.size(); ++n) {
    input[n * PairedFft::kStride] = (centred_[n] - mean) * window_[n];
  }
}

void Spectra::clear_segment(std::size_t sequence) {
  double* const input = input_.data() + fft_->input_begin(sequence);
  for (std::size_t n = 0; n < window_.size(); ++n) {
    input[n * PairedFft::kStride] = 0.0;
  }
}

void Spectra::store_batch(std::size_t first_segment) {
  static_assert(PairedFft::kBatch == kLanes, "a batch fills one cache line of every row");
  for (std::size_t k = 0; k < frequencies(); ++k) {
    double* const re = rows_.data() + k * kRows * row_length_ + first_segment;
    double* const im = re + row_length_;
    double* const power = im + row_length_;
    for (std::size_t i = 0; i < kLanes; i += 2) {
      const auto [first, second] = fft_->separate(output_, i / 2, k);
      re[i] = first.real();
      im[i] = first.imag();
      power[i] = re[i] * re[i] + im[i] * im[i];
      re[i + 1] = second.real();
      im[i + 1] = second.imag();
      power[i + 1] = re[i + 1] * re[i + 1] + im[i + 1] * im[i + 1];
    }
  }
}

void Spectra::sum_power(double largest) {
  const double weight = std::accumulate(window_.begin(), window_.end(), 0.0);
  const double noise = kRoundingUnits * std::numeric_limits<double>::epsilon() * largest * weight;
  const double floor = noise * noise * static_cast<double>(segments_);
  for (std::size_t k = 0; k < frequencies(); ++k) {
    const double* const values = power(k);
    const double sum = std::accumulate(values, values + row_length_, 0.0);
    total_power_[k] = sum > floor ? sum : 0.0;
  }
}

}  // namespace loopscope::core::hos
