#include "core/hos/transforms/window.hpp"

#include <cmath>
#include <numbers>

namespace loopscope::core::hos {
namespace {

/// `mean - swing cos(2 pi (n + shift) / period)` for n = 0..length-1.
std::vector<double> raised_cosine(std::size_t length, double mean, double swing, double shift,
                                  double period) {
  std::vector<double> weights(length);
  for (std::size_t n = 0; n < length; ++n) {
    const double turn = (static_cast<double>(n) + shift) / period;
    weights[n] = mean - swing * std::cos(2.0 * std::numbers::pi * turn);
  }
  return weights;
}

}  // namespace

std::vector<double> make_window(WindowShape shape, std::size_t length) {
  const auto samples = static_cast<double>(length);
  switch (shape) {
    case WindowShape::hann:
      return raised_cosine(length, 0.5, 0.5, 1.0, samples + 1.0);
    case WindowShape::hann_periodic:
      return raised_cosine(length, 0.5, 0.5, 0.0, samples);
    case WindowShape::hamming:
      return raised_cosine(length, 0.54, 0.46, 0.0, samples - 1.0);
    case WindowShape::rectangular:
      break;
  }
  return std::vector<double>(length, 1.0);
}

double main_lobe_half_width(WindowShape shape) {
  return shape == WindowShape::rectangular ? 1.0 : 2.0;
}

}  // namespace loopscope::core::hos
