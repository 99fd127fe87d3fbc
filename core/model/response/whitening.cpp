#include "core/model/response/whitening.hpp"

#include <algorithm>

#include "core/model/record/loop_data.hpp"

namespace loopscope::core::model {
namespace {

/// From a zero, on which the filters rest, to the last sample that is none.
Range heard(std::span<const double> signal) {
  // Filters take four samples at a time.
  constexpr std::size_t kTogether = 4;
  const auto sounds = [](double value) { return value != 0.0; };
  const auto first = std::ranges::find_if(signal, sounds);
  const auto last = std::find_if(signal.rbegin(), signal.rend(), sounds);
  const auto from = static_cast<std::size_t>(first - signal.begin());
  const auto end = static_cast<std::size_t>(signal.rend() - last);
  return {from == 0 ? 0 : (from - 1) / kTogether * kTogether, std::max(from, end)};
}

void silence(std::span<double> signal, const Range& but) {
  std::ranges::fill(signal.first(but.first), 0.0);
  std::ranges::fill(signal.subspan(but.end), 0.0);
}

}  // namespace

void Whitening::add(std::span<const double> signal, std::span<double> whitened) {
  from_.push_back(signal);
  to_.push_back(whitened);
}

void Whitening::run(const NoiseModel& noise) const {
  for (std::size_t at = 0; at < from_.size(); at += 2) {
    run(noise, at, std::min<std::size_t>(2, from_.size() - at));
  }
}

/// One or two signals.
void Whitening::run(const NoiseModel& noise, std::size_t first, std::size_t count) const {
  const std::size_t other = first + count - 1;
  const std::size_t samples = from_[first].size();
  const Range a = heard(from_[first]), b = heard(from_[other]);
  Range stretch{std::min(a.first, b.first), std::max(a.end, b.end)};
  if (stretch.end < samples)
    stretch.end += std::min(samples - stretch.end, whitening_memory(noise));
  const auto from = [&](std::size_t i) { return from_[i].subspan(stretch.first, stretch.size()); };
  const auto to = [&](std::size_t i) { return to_[i].subspan(stretch.first, stretch.size()); };
  if (count == 2) {
    whiten(noise, {from(first), from(other)}, {to(first), to(other)});
  } else {
    whiten(noise, from(first), to(first));
  }
  for (std::size_t i = first; i <= other; ++i) silence(to_[i], stretch);
}

void put_later(std::span<const double> signal, std::span<double> later) {
  if (signal.empty()) return;
  later[0] = signal[0];
  std::copy(signal.begin(), signal.end() - 1, later.begin() + 1);
}

}  // namespace loopscope::core::model
