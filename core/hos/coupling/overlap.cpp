#include "core/hos/coupling/overlap.hpp"

#include <cmath>
#include <compare>
#include <numbers>

#include "core/hos/kernels/plan_cache.hpp"
#include "core/hos/transforms/segments.hpp"
#include "core/hos/transforms/window.hpp"

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

/// exp(-2 pi i j / M), j = 0 .. M - 1.
std::vector<Complex> unit_circle(std::size_t dft_length) {
  std::vector<Complex> turns(dft_length);
  const double step = -2.0 * std::numbers::pi / static_cast<double>(dft_length);
  for (std::size_t j = 0; j < dft_length; ++j) {
    turns[j] = std::polar(1.0, step * static_cast<double>(j));
  }
  return turns;
}

/// g_d(D) for one d and D = 0 .. reach.
std::vector<Complex> lag_products(const std::vector<double>& window, std::size_t shift,
                                  const std::vector<Complex>& turns, std::size_t reach) {
  std::vector<Complex> result(reach + 1);
  for (std::size_t difference = 0; difference <= reach; ++difference) {
    for (std::size_t t = shift; t < window.size(); ++t) {
      result[difference] += window[t] * window[t - shift] * turns[difference * t % turns.size()];
    }
  }
  return result;
}

/// Value at a difference of either sign.
Complex at(const std::vector<Complex>& g, std::ptrdiff_t difference) {
  const auto magnitude = static_cast<std::size_t>(std::abs(difference));
  return difference < 0 ? std::conj(g[magnitude]) : g[magnitude];
}

/// G(D1, D2). A lag of -d has the products of d in reversed time, so that the two add up to twice
/// the real part.
double triple_correlation(const std::vector<std::vector<Complex>>& lags, std::ptrdiff_t first,
                          std::ptrdiff_t second) {
  Complex sum;
  for (std::size_t d = 0; d < lags.size(); ++d) {
    const Complex product =
        at(lags[d], first) * at(lags[d], second) * std::conj(at(lags[d], first + second));
    sum += d == 0 ? product : Complex(2.0 * product.real());
  }
  return std::abs(sum);
}

/// The settings that an Overlap depends on.
struct Key {
  std::size_t segment_length, hop, dft_length;
  WindowShape window;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang 14 sees a 0 in what the compiler makes of it.
  friend auto operator<=>(const Key&, const Key&) = default;
};

struct Kept {
  explicit Kept(const Key& key)
      : overlap({.segment_length = key.segment_length,
                 .overlap =
                     1.0 - static_cast<double>(key.hop) / static_cast<double>(key.segment_length),
                 .window = key.window,
                 .dft_length = key.dft_length}) {}
  Overlap overlap;
};

}  // namespace

const Overlap& Overlap::of(const Settings& settings) {
  validate(settings);
  return cached_plan<Kept>(Key{settings.segment_length, segment_hop(settings), settings.dft_length,
                               settings.window})
      .overlap;
}

std::vector<double> segment_correlation(const std::vector<double>& window, std::size_t hop) {
  std::vector<double> result;
  for (std::size_t shift = 0; shift < window.size(); shift += hop) {
    double sum = 0.0;
    for (std::size_t t = shift; t < window.size(); ++t) sum += window[t] * window[t - shift];
    result.push_back(shift == 0 ? sum : sum / result.front());
  }
  result.front() = 1.0;
  return result;
}

Overlap::Overlap(const Settings& settings) {
  validate(settings);
  const std::vector<double> window = make_window(settings.window, settings.segment_length);
  const std::size_t hop = segment_hop(settings);
  // Two main lobes apart nothing is left of the correlation.
  const double lobe = main_lobe_half_width(settings.window) *
                      static_cast<double>(settings.dft_length) /
                      static_cast<double>(settings.segment_length);
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(2.0 * lobe));
  const std::vector<Complex> turns = unit_circle(settings.dft_length);
  std::vector<std::vector<Complex>> lags;
  for (std::size_t shift = 0; shift < window.size(); shift += hop) {
    lags.push_back(lag_products(window, shift, turns, 2 * static_cast<std::size_t>(reach)));
    for (Complex& value : lags.back()) value /= shift == 0 ? 1.0 : lags.front()[0].real();
  }
  const double power = lags.front()[0].real();
  for (Complex& value : lags.front()) value /= power;
  correlation_ = segment_correlation(window, hop);
  mean_ = triple_correlation(lags, 0, 0);
  correlated_cells_ = 0.0;
  for (std::ptrdiff_t first = -reach; first <= reach; ++first) {
    for (std::ptrdiff_t second = -reach; second <= reach; ++second) {
      const double correlation = triple_correlation(lags, first, second);
      correlated_cells_ += correlation * correlation;
    }
  }
}

}  // namespace loopscope::core::hos
