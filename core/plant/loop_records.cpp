#include "core/plant/loop_records.hpp"

#include <cmath>
#include <span>

namespace loopscope::core::plant {
namespace {

double variance_of(std::span<const double> series) {
  double count = 0.0, mean = 0.0, squares = 0.0;
  for (const double value : series) {
    if (!std::isfinite(value)) continue;
    count += 1.0;
    const double off = value - mean;
    mean += off / count;
    squares += off * (value - mean);
  }
  return count > 0.0 ? squares / count : 0.0;
}

double slowest_of(const PackedError& error) {
  if (error.empty()) return 0.0;
  return kFewestPeriods / (static_cast<double>(error.size()) * error.sample_interval_s());
}

}  // namespace

LoopRecords::Record::Record(PackedError packed) : error(std::move(packed)) {
  const signal::Samples samples = error.unpacked();
  spectrum = LineSpectrum(samples, error.sample_interval_s());
  variance = variance_of(samples);
}

LoopRecords::LoopRecords(PackedError error)
    : record_(std::move(error)), slowest_hz_(slowest_of(record_.error)) {}

LoopRecords::LoopRecords(const MemberLoop& loop)
    : LoopRecords(PackedError(loop.error, loop.sample_interval_s, loop.start_us)) {
  const LongerRecord& longer = loop.longer;
  if (!longer.error.empty())
    add_longer(PackedError(longer.error, longer.sample_interval_s, longer.start_us));
}

double LoopRecords::slower_share() const {
  return record_.spectrum.share_below(slowest_hz_);
}

const LoopRecords::Record& LoopRecords::at(double frequency_hz) const {
  return longer_ && frequency_hz < slowest_hz_ ? *longer_ : record_;
}

std::vector<SpectralLine> LoopRecords::lines(double largest_p) const {
  std::vector<SpectralLine> lines = record_.spectrum.lines(largest_p);
  if (!longer_) return lines;
  for (const SpectralLine& line : longer_->spectrum.lines(largest_p))
    if (line.frequency_hz < slowest_hz_) lines.push_back(line);
  return lines;
}

Envelope LoopRecords::envelope(double frequency_hz) const {
  return at(frequency_hz).error.envelope(frequency_hz);
}

std::array<double, kLineShapes> LoopRecords::evidence(double frequency_hz) const {
  return at(frequency_hz).spectrum.evidence(frequency_hz);
}

double LoopRecords::share(double frequency_hz) const {
  return at(frequency_hz).spectrum.share(frequency_hz);
}

double LoopRecords::share_about(double frequency_hz) const {
  return at(frequency_hz).spectrum.share_about(frequency_hz);
}

double LoopRecords::bands(double frequency_hz) const {
  return at(frequency_hz).spectrum.bands();
}

double LoopRecords::variance(double frequency_hz) const {
  return at(frequency_hz).variance;
}

}  // namespace loopscope::core::plant
