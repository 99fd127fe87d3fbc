#include "core/model/whitening.hpp"

#include <algorithm>

namespace loopscope::core::model {

void Whitening::add(std::span<const double> signal, std::span<double> whitened) {
  from_.push_back(signal);
  to_.push_back(whitened);
}

void Whitening::run(const NoiseModel& noise) const {
  std::size_t at = 0;
  for (; at + 2 <= from_.size(); at += 2) {
    whiten(noise, {from_[at], from_[at + 1]}, {to_[at], to_[at + 1]});
  }
  if (at < from_.size()) whiten(noise, from_[at], to_[at]);
}

void put_later(std::span<const double> signal, std::span<double> later) {
  if (signal.empty()) return;
  later[0] = signal[0];
  std::copy(signal.begin(), signal.end() - 1, later.begin() + 1);
}

}  // namespace loopscope::core::model
