#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace loopscope::core::plant {

/// A peak in the spectrum of one loop that is narrower than a well damped loop makes it.
struct SpectralLine {
  double frequency_hz = 0.0;
  /// Probability that a record whose spectrum nowhere stands higher than kResonance above its
  /// surroundings shows such a peak anywhere; not below 1e-300.
  double p = 1.0;
  double height = 0.0;  ///< power in the peak by what its surroundings foresee there
  double share = 0.0;   ///< of the signal's variance, what lies above the surroundings; 0 to 1
};

/// By how much the resonance of a sound loop may stand above its surroundings. A controller's peak
/// sensitivity Ms multiplies the power of whatever disturbs the loop by Ms^2; robust designs keep
/// Ms at 1.4 to 1.6 (Astrom and Hagglund 2006, 4.6).
inline constexpr double kResonance = 2.5;

/// Widths of lines that are looked for, by surroundings that fit them.
inline constexpr std::size_t kLineShapes = 7;

/// Lines in the spectrum of one record: power in a band of the Hann-windowed periodogram against a
/// power law through the bands below and above it, an F statistic. Bands of +-0 to 10 % and
/// surroundings from 12 or 20 % on, so that both a steady line and the wandering one of a limit
/// cycle are seen. `error` may hold NaN: gaps are bridged.
class LineSpectrum {
 public:
  /// Without a line.
  LineSpectrum() = default;
  /// `sample_interval_s` > 0. Fewer than 256 samples, or constant ones, have no line.
  LineSpectrum(std::span<const double> error, double sample_interval_s);

  /// Most significant first, four at most, none within a quarter of another's frequency.
  /// `largest_p` is that of a line at a given place: bands() times as much is its p anywhere.
  /// Periods from kShortestPeriod samples to 1 / kFewestPeriods of the record (envelope.hpp).
  [[nodiscard]] std::vector<SpectralLine> lines(double largest_p) const;
  /// -ln p of a line of each width at this frequency, the number of bands left out; 0 where the
  /// record cannot show it.
  [[nodiscard]] std::array<double, kLineShapes> evidence(double frequency_hz) const;
  /// Share of the record's variance in the most significant line about this frequency; 0 = none
  /// that is significant at 0.01.
  [[nodiscard]] double share(double frequency_hz) const;
  /// SpectralLine::height of that line; 1 = none.
  [[nodiscard]] double height(double frequency_hz) const;
  /// Share of the record's variance within half of this frequency to either side, where an envelope
  /// (envelope.hpp) takes its power from.
  [[nodiscard]] double share_about(double frequency_hz) const;
  /// Share of the record's variance about its trend at this frequency and below.
  [[nodiscard]] double share_below(double frequency_hz) const;
  /// How many lines could be told apart in the record; 0 = too short or constant.
  [[nodiscard]] double bands() const { return bands_; }

 private:
  struct Power {
    double mean = 0.0;
    double freedom = 0.0;  // degrees, of a chi-square variable
    double place = 0.0;    // middle, cycles per record
    double share = 0.0;    // of the record's power
  };
  struct Peak {
    double place = 0.0;
    double p = 1.0;
    double height = 0.0;
    double share = 0.0;
    double half = 0.0;  ///< half width, cycles per record
  };
  /// Of the periodogram by its largest.
  [[nodiscard]] double bin(std::size_t number) const;
  /// Of the bins before each of them, and of all: what many places are measured by.
  using Sums = std::vector<double>;
  [[nodiscard]] Sums all_sums() const;
  /// Of the bins before this one; without `sums` from the nearest block's.
  [[nodiscard]] double sum_before(std::size_t number, const Sums& sums) const;
  [[nodiscard]] Power power(double low, double high, const Sums& sums = {}) const;
  /// p = 1 where it is larger than `largest_p`.
  [[nodiscard]] Peak measure(double place, std::size_t shape_number, const Sums& sums = {},
                             double largest_p = 1.0) const;
  [[nodiscard]] Peak best_at(double place, double largest_p, const Sums& sums = {}) const;
  /// The most significant line about a frequency; p = 1 where there is none that is clear.
  [[nodiscard]] Peak clear_line(double frequency_hz) const;
  /// Centre of the power within a peak.
  [[nodiscard]] double centre(const Peak& peak) const;

  double samples_ = 0.0;
  double duration_s_ = 0.0;
  double stretch_ = 1.0;  // length of the transform by that of the record
  double bands_ = 0.0;
  double total_ = 0.0;                 // power of all bins
  std::vector<std::uint16_t> powers_;  // the periodogram by its largest, as shortened()
  std::vector<double> sums_;           // of the bins before each block of them
};

}  // namespace loopscope::core::plant
