#include "core/plant/loop_records.hpp"

#include <cmath>

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

MemberLoop with_longer_record(const MemberLoop& loop) {
  MemberLoop longer;
  longer.sample_interval_s = loop.longer.sample_interval_s;
  longer.start_us = loop.longer.start_us;
  longer.error = loop.longer.error;
  return longer;
}

}  // namespace

LoopRecords::Record::Record(const MemberLoop& loop)
    : demodulator(loop),
      spectrum(loop.error, loop.sample_interval_s),
      variance(variance_of(loop.error)) {}

LoopRecords::LoopRecords(const MemberLoop& loop) : record_(loop), slowest_hz_(slowest_hz(loop)) {
  if (!loop.longer.error.empty()) longer_.emplace(with_longer_record(loop));
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
  return at(frequency_hz).demodulator.envelope(frequency_hz);
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

double slowest_hz(const MemberLoop& loop) {
  if (loop.error.empty()) return 0.0;
  return kFewestPeriods / (static_cast<double>(loop.error.size()) * loop.sample_interval_s);
}

double slower_share(const MemberLoop& loop) {
  return LineSpectrum(loop.error, loop.sample_interval_s).share_below(slowest_hz(loop));
}

}  // namespace loopscope::core::plant
