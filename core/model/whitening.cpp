#include "core/model/whitening.hpp"

#include <algorithm>

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
  std::vector<Range> heard_in;
  for (const auto& signal : from_) heard_in.push_back(heard(signal));
  const auto same = [&](std::size_t a, std::size_t b) {
    return heard_in[a].first == heard_in[b].first && heard_in[a].end == heard_in[b].end;
  };
  for (std::size_t at = 0; at < from_.size();) {
    const std::size_t left = from_.size() - at;
    const bool four = left >= 4 && same(at, at + 1) && same(at, at + 2) && same(at, at + 3);
    const std::size_t count = four ? 4 : std::min<std::size_t>(2, left);
    const Range& a = heard_in[at];
    const Range& b = heard_in[at + count - 1];
    run(noise, at, count, {std::min(a.first, b.first), std::max(a.end, b.end)});
    at += count;
  }
}

/// One, two or four signals, heard in that stretch.
void Whitening::run(const NoiseModel& noise, std::size_t first, std::size_t count,
                    Range stretch) const {
  const std::size_t samples = from_[first].size();
  if (stretch.end < samples)
    stretch.end += std::min(samples - stretch.end, whitening_memory(noise));
  const auto from = [&](std::size_t i) {
    return from_[first + i].subspan(stretch.first, stretch.size());
  };
  const auto to = [&](std::size_t i) {
    return to_[first + i].subspan(stretch.first, stretch.size());
  };
  if (count == 4) {
    whiten_four(noise, {from(0), from(1), from(2), from(3)}, {to(0), to(1), to(2), to(3)});
  } else if (count == 2) {
    whiten(noise, {from(0), from(1)}, {to(0), to(1)});
  } else {
    whiten(noise, from(0), to(0));
  }
  for (std::size_t i = first; i < first + count; ++i) silence(to_[i], stretch);
}

void put_later(std::span<const double> signal, std::span<double> later) {
  if (signal.empty()) return;
  later[0] = signal[0];
  std::copy(signal.begin(), signal.end() - 1, later.begin() + 1);
}

}  // namespace loopscope::core::model
