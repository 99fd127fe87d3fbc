#include "core/simulate/band_pass.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace loopscope::core::simulate {

using Complex = std::complex<double>;

BandPass::BandPass(double low, double high) {
  if (!(low > 0.0 && low < high && high < 0.5)) {
    throw std::invalid_argument("band edges outside 0 < low < high < 0.5 cycles per sample");
  }
  const double warped_low = std::tan(std::numbers::pi * low);
  const double warped_high = std::tan(std::numbers::pi * high);
  const double width = warped_high - warped_low;
  const double centre_squared = warped_low * warped_high;

  // The prototype's pole in the upper half plane; s -> (s^2 + w0^2) / (width s) makes two of it,
  // each of which with its conjugate is one section.
  const Complex prototype = std::polar(1.0, 0.75 * std::numbers::pi);
  const Complex half = 0.5 * width * prototype;
  const Complex root = std::sqrt(half * half - centre_squared);
  const std::array<Complex, 2> analog_poles = {half + root, half - root};
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const Complex pole = (1.0 + analog_poles[i]) / (1.0 - analog_poles[i]);
    sections_[i].a1 = -2.0 * pole.real();
    sections_[i].a2 = std::norm(pole);
  }
  const double centre = std::atan(std::sqrt(centre_squared)) / std::numbers::pi;
  sections_[0].gain = 1.0 / magnitude(centre);
}

double BandPass::magnitude(double frequency) const {
  const Complex delay = std::polar(1.0, -2.0 * std::numbers::pi * frequency);
  double product = 1.0;
  for (const Section& section : sections_) {
    const Complex numerator = section.gain * (1.0 - delay * delay);
    product *= std::abs(numerator / (1.0 + delay * (section.a1 + delay * section.a2)));
  }
  return product;
}

std::vector<double> BandPass::filter(std::span<const double> input) const {
  std::vector<double> signal(input.begin(), input.end());
  for (const Section& section : sections_) {
    double input_1 = 0.0;
    double input_2 = 0.0;
    double output_1 = 0.0;
    double output_2 = 0.0;
    for (double& sample : signal) {
      const double output =
          section.gain * (sample - input_2) - section.a1 * output_1 - section.a2 * output_2;
      input_2 = input_1;
      input_1 = sample;
      output_2 = output_1;
      output_1 = output;
      sample = output;
    }
  }
  return signal;
}

}  // namespace loopscope::core::simulate
