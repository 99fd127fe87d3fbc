#include "core/hos/transforms/settings.hpp"

#include <stdexcept>
#include <string>

namespace loopscope::core::hos {
namespace {

void require(bool in_range, const char* what) {
  if (!in_range) {
    throw std::invalid_argument(std::string("higher-order statistics: ") + what);
  }
}

// Written so that NaN is out of every range.
bool within(double value, double low, double high) {
  return value >= low && value <= high;
}

}  // namespace

std::string_view name(WindowShape shape) {
  switch (shape) {
    case WindowShape::hann:
      return "hann";
    case WindowShape::hann_periodic:
      return "hann_periodic";
    case WindowShape::hamming:
      return "hamming";
    case WindowShape::rectangular:
      return "rectangular";
  }
  throw std::invalid_argument("higher-order statistics: unknown window shape");
}

void validate(const Settings& settings) {
  const std::size_t segment = settings.segment_length;
  const std::size_t dft = settings.dft_length;
  require(segment >= 16 && segment <= 4096 && segment % 2 == 0,
          "segment_length must be even and lie within 16 to 4096 samples");
  require(within(settings.overlap, 0.0, 0.9), "overlap must lie within 0 to 0.9");
  require(dft >= segment && dft <= 8192 && dft % 2 == 0,
          "dft_length must be even and lie within segment_length to 8192");
  require(within(settings.alpha, 0.0001, 0.5), "alpha must lie within 0.0001 to 0.5");
  require(within(settings.ngi_threshold, 0.0, 1.0), "ngi_threshold must lie within 0 to 1");
  require(within(settings.nli_threshold, 0.0, 1.0), "nli_threshold must lie within 0 to 1");
  require(settings.max_peaks <= 50, "max_peaks must lie within 0 to 50");
}

}  // namespace loopscope::core::hos
