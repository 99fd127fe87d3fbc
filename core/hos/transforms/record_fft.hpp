#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

namespace loopscope::core::hos {

/// DFT of one real record, X(k) = sum x(n) exp(-2 pi i k n / length), k = 0 .. length / 2, and
/// back. Plans are kept per length and shared by all threads (plan_cache.hpp).
class RecordFft {
 public:
  /// The plan for `length` (even), made at its first use. Throws std::bad_alloc if FFTW makes none.
  [[nodiscard]] static const RecordFft& of_length(std::size_t length);

  explicit RecordFft(std::size_t length);
  RecordFft(const RecordFft&) = delete;
  RecordFft& operator=(const RecordFft&) = delete;
  ~RecordFft();

  /// `record` is padded with zeros, or cut, to the length; length / 2 + 1 values.
  [[nodiscard]] std::vector<std::complex<double>> transform(std::vector<double> record) const;
  /// The record of `length` samples with this transform (length / 2 + 1 values, which are used up).
  [[nodiscard]] std::vector<double> inverse(std::vector<std::complex<double>> spectrum) const;

 private:
  struct Plan;
  std::size_t length_;
  std::unique_ptr<Plan> plan_;
};

}  // namespace loopscope::core::hos
