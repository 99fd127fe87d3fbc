#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "core/plant/envelope.hpp"
#include "core/plant/member_loop.hpp"
#include "core/plant/spectral_line.hpp"

namespace loopscope::core::plant {

/// What the search asks of one loop at a frequency, of the record where that holds kFewestPeriods
/// of it and else of the longer one: a flow that is sampled every second follows a level that
/// swings once in twenty minutes. Both have to outlive it.
class LoopRecords {
 public:
  explicit LoopRecords(const MemberLoop& loop);

  /// LineSpectrum::lines of the record, and of the longer one those that are slower than it shows.
  [[nodiscard]] std::vector<SpectralLine> lines(double largest_p) const;
  /// Demodulator::envelope.
  [[nodiscard]] Envelope envelope(double frequency_hz) const;
  /// LineSpectrum::evidence, share, share_about and bands.
  [[nodiscard]] std::array<double, kLineShapes> evidence(double frequency_hz) const;
  [[nodiscard]] double share(double frequency_hz) const;
  [[nodiscard]] double share_about(double frequency_hz) const;
  [[nodiscard]] double bands(double frequency_hz) const;
  /// Of the error, signal units squared.
  [[nodiscard]] double variance(double frequency_hz) const;

 private:
  struct Record {
    explicit Record(const MemberLoop& loop);
    Demodulator demodulator;
    LineSpectrum spectrum;
    double variance;
  };
  [[nodiscard]] const Record& at(double frequency_hz) const;

  Record record_;
  std::optional<Record> longer_;
  double slowest_hz_;  // of record_
};

/// The slowest frequency of which the record holds kFewestPeriods; 0 = it is empty.
[[nodiscard]] double slowest_hz(const MemberLoop& loop);
/// Share of the error's variance about its trend in swings that are slower than that, 0 to 1: how
/// much a longer record would tell.
[[nodiscard]] double slower_share(const MemberLoop& loop);

}  // namespace loopscope::core::plant
