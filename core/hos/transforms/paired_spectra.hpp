#pragma once

#include <vector>

#include "core/hos/kernels/segment_dft.hpp"
#include "core/hos/transforms/paired_fft.hpp"

namespace loopscope::core::hos {

/// Spectra of a batch of segments by FFTW: for the lengths that SegmentDft is not made for, and
/// what it is compared with. One object per thread.
class PairedSpectra {
 public:
  /// Both even, dft_length >= segment_length.
  PairedSpectra(std::size_t segment_length, std::size_t dft_length);

  /// As Kernels::transform; `batch.scratch` is not used.
  void transform(const SegmentBatch& batch);

 private:
  void load_segment(const SegmentBatch& batch, std::size_t sequence);
  void store_pair(const SegmentBatch& batch, std::size_t pair);

  const PairedFft* fft_;
  std::size_t frequencies_;
  std::vector<double> centred_;  // one segment
  AlignedVector input_;
  AlignedVector output_;
};

}  // namespace loopscope::core::hos
