#include "core/hos/transforms/settings.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

namespace loopscope::core::hos {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("higher-order statistics: " + what);
}

std::string text(double number) {
  std::ostringstream out;
  out << number;
  return out.str();
}

void require_within(const Bounds& bounds, double value, const std::string& setting) {
  require(bounds.hold(value),
          setting + " must lie within " + text(bounds.least) + " to " + text(bounds.largest));
}

void require_even(std::size_t value, const std::string& setting) {
  require(value % 2 == 0, setting + " must be even");
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
  require_within(bounds::kSegmentLength, static_cast<double>(settings.segment_length),
                 "segment_length (samples)");
  require_even(settings.segment_length, "segment_length");
  require_within(bounds::kOverlap, settings.overlap, "overlap");
  require_within(bounds::kDftLength, static_cast<double>(settings.dft_length),
                 "dft_length (samples)");
  require_even(settings.dft_length, "dft_length");
  require(settings.dft_length >= settings.segment_length,
          "dft_length must not be less than segment_length");
  require_within(bounds::kAlpha, settings.alpha, "alpha");
  require_within(bounds::kThreshold, settings.ngi_threshold, "ngi_threshold");
  require_within(bounds::kThreshold, settings.nli_threshold, "nli_threshold");
  require_within(bounds::kMaxPeaks, static_cast<double>(settings.max_peaks), "max_peaks");
}

}  // namespace loopscope::core::hos
