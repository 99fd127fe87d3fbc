#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace loopscope::core::hos {

/// DFTs of a batch of real sequences, two at a time as real and imaginary part of one complex
/// sequence z = a + i b:
///
///     A(k) = (Z(k) + Z*(M - k)) / 2,   B(k) = (Z(k) - Z*(M - k)) / (2 i),   k = 0..M/2
///
/// with Z(k) = sum z(n) exp(-2 pi i k n / M). That takes a third of the time of FFTW's own real
/// transforms at the lengths in use here. A batch fills one cache line of every frequency row.
///
/// execute() may run in many threads at once. Plans are kept per length and shared
/// (plan_cache.hpp); they are made with FFTW_ESTIMATE, so that two runs on one processor give the
/// same digits.
class PairedFft {
 public:
  static constexpr std::size_t kBatch = 8;  ///< sequences

  /// The plan for `length` (even), made at its first use. Throws std::bad_alloc if FFTW makes none.
  [[nodiscard]] static const PairedFft& of_length(std::size_t length);

  explicit PairedFft(std::size_t length);
  PairedFft(const PairedFft&) = delete;
  PairedFft& operator=(const PairedFft&) = delete;
  ~PairedFft();

  /// Doubles in the input, [pair][sample][sequence of the pair], and as many in the output,
  /// [pair][frequency of Z][real, imaginary].
  [[nodiscard]] std::size_t buffer_size() const { return kBatch * length_; }
  /// Place of the first sample of a sequence in the input; the next ones follow at kStride.
  [[nodiscard]] std::size_t input_begin(std::size_t sequence) const {
    return sequence / 2 * 2 * length_ + sequence % 2;
  }
  static constexpr std::size_t kStride = 2;

  /// Both buffers must be AlignedVectors of buffer_size().
  void execute(std::span<double> input, std::span<double> output) const;

  /// The spectra of sequences 2 pair and 2 pair + 1 at bin k, 0 to length / 2.
  struct PairOfBins {
    std::complex<double> first;
    std::complex<double> second;
  };
  [[nodiscard]] PairOfBins separate(std::span<const double> output, std::size_t pair,
                                    std::size_t k) const {
    const double* const bins = output.data() + 2 * pair * length_;
    const double* const z = bins + 2 * k;
    const double* const mirror = bins + 2 * (k == 0 ? 0 : length_ - k);
    return {{0.5 * (z[0] + mirror[0]), 0.5 * (z[1] - mirror[1])},
            {0.5 * (z[1] + mirror[1]), 0.5 * (mirror[0] - z[0])}};
  }

 private:
  struct Plan;
  std::size_t length_;
  std::unique_ptr<Plan> plan_;
};

}  // namespace loopscope::core::hos
