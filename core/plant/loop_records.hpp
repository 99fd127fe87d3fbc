#pragma once

#include <array>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

#include "core/plant/envelope.hpp"
#include "core/plant/member_loop.hpp"
#include "core/plant/packed_error.hpp"
#include "core/plant/spectral_line.hpp"

namespace loopscope::core::plant {

/// What the search asks of one loop at a frequency, of the record where that holds kFewestPeriods
/// of it and else of the longer one: a flow that is sampled every second follows a level that
/// swings once in twenty minutes. 14 kB of a window of 4096 samples: so much a loop the comparison
/// of all loops takes.
class LoopRecords {
 public:
  explicit LoopRecords(PackedError error);
  explicit LoopRecords(const MemberLoop& loop);

  /// A longer span that ends with the record, at coarser steps (means).
  void add_longer(PackedError error) { longer_.emplace(std::move(error)); }
  [[nodiscard]] bool has_longer() const { return longer_.has_value(); }
  [[nodiscard]] const PackedError& error() const { return record_.error; }
  /// The slowest frequency of which the record holds kFewestPeriods; 0 = it is empty.
  [[nodiscard]] double slowest_hz() const { return slowest_hz_; }
  /// Share of the error's variance about its trend in swings that are slower than that, 0 to 1: how
  /// much a longer record would tell.
  [[nodiscard]] double slower_share() const;

  /// LineSpectrum::lines of the record, and of the longer one those that are slower than it shows.
  [[nodiscard]] std::vector<SpectralLine> lines(double largest_p) const;
  /// make_envelope().
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
    explicit Record(PackedError packed);
    PackedError error;
    LineSpectrum spectrum;
    double variance = 0.0;
  };
  [[nodiscard]] const Record& at(double frequency_hz) const;

  Record record_;
  std::optional<Record> longer_;
  double slowest_hz_;  // of record_
};

}  // namespace loopscope::core::plant
