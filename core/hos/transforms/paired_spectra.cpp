#include "core/hos/transforms/paired_spectra.hpp"

#include "core/hos/kernels/triple_tile.hpp"

namespace loopscope::core::hos {

PairedSpectra::PairedSpectra(std::size_t segment_length, std::size_t dft_length)
    : fft_(&PairedFft::of_length(dft_length)),
      frequencies_(dft_length / 2 + 1),
      centred_(segment_length),
      input_(fft_->buffer_size(), 0.0),
      output_(fft_->buffer_size(), 0.0) {}

void PairedSpectra::transform(const SegmentBatch& batch) {
  static_assert(PairedFft::kBatch == kLanes, "a batch fills one cache line of every row");
  for (std::size_t i = 0; i < kLanes; ++i) load_segment(batch, i);
  fft_->execute(input_, output_);
  for (std::size_t pair = 0; pair < kLanes / 2; ++pair) store_pair(batch, pair);
}

void PairedSpectra::load_segment(const SegmentBatch& batch, std::size_t sequence) {
  const double* const segment = batch.segments[sequence];
  // About the first sample, so that a constant leaves exact zeros whatever its length; two sums,
  // since one would make every addition wait for the one before it.
  const double first = segment[0] * batch.factor;
  double even = 0.0;
  double odd = 0.0;
  for (std::size_t n = 0; n < centred_.size(); n += 2) {
    centred_[n] = segment[n] * batch.factor - first;
    centred_[n + 1] = segment[n + 1] * batch.factor - first;
    even += centred_[n];
    odd += centred_[n + 1];
  }
  const double mean = (even + odd) / static_cast<double>(centred_.size());
  double* const input = input_.data() + fft_->input_begin(sequence);
  for (std::size_t n = 0; n < centred_.size(); ++n) {
    input[n * PairedFft::kStride] = (centred_[n] - mean) * batch.window[n];
  }
}

void PairedSpectra::store_pair(const SegmentBatch& batch, std::size_t pair) {
  for (std::size_t k = 0; k < frequencies_; ++k) {
    const auto [first, second] = fft_->separate(output_, pair, k);
    double* row = batch.rows + k * SpectrumRows::kRows * batch.pitch + 2 * pair;
    row[0] = first.real();
    row[1] = second.real();
    row += batch.pitch;
    row[0] = first.imag();
    row[1] = second.imag();
    row += batch.pitch;
    row[0] = first.real() * first.real() + first.imag() * first.imag();
    row[1] = second.real() * second.real() + second.imag() * second.imag();
  }
}

}  // namespace loopscope::core::hos
