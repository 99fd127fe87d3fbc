#include "tests/fuzz/damage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "tests/fuzz/odd_number.hpp"

namespace loopscope::tests::fuzz {
namespace {

using core::signal::ControlMode;
using core::signal::kMissing;
using core::signal::LoopWindow;
using core::signal::Samples;

/// Part of a series: begin and length in 255ths of the whole.
template <typename Value>
std::span<Value> stretch_of(std::vector<Value>& values, ByteSource& source) {
  const std::size_t first = values.size() * source.byte() / 256;
  const std::size_t length = (values.size() * source.byte() + 254) / 255;
  return std::span(values).subspan(first, std::min(length, values.size() - first));
}

void every_nth(std::span<double> part, ByteSource& source) {
  const std::size_t n = 2 + source.byte() % 32;
  const bool hold = source.truth();
  for (std::size_t k = 0; k < part.size(); ++k)
    if (k % n != 0) part[k] = hold ? part[k - k % n] : kMissing;
}

void add_wave(std::span<double> part, ByteSource& source) {
  const double period = 2.0 + source.byte();
  const double amplitude = odd_number(source);
  for (std::size_t k = 0; k < part.size(); ++k)
    part[k] += amplitude * std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / period);
}

/// Gaps of a length each, from a generator whose seed is a byte.
void scatter_gaps(std::span<double> part, ByteSource& source) {
  std::uint32_t state = 1U + source.byte();
  const std::uint32_t one_in = 1U + source.byte();
  for (double& value : part) {
    state = state * 1'664'525U + 1'013'904'223U;
    if ((state >> 16U) % one_in == 0) value = kMissing;
  }
}

void spoil(std::span<double> part, ByteSource& source) {
  const std::uint8_t kind = source.byte() % 10;
  if (kind == 0) return every_nth(part, source);
  if (kind == 1) return add_wave(part, source);
  if (kind == 2) return scatter_gaps(part, source);
  const double value = odd_number(source);
  for (double& sample : part) {
    if (kind == 3) sample = value;
    if (kind == 4) sample = kMissing;
    if (kind == 5) sample += value;
    if (kind == 6) sample *= value;
    if (kind == 7) sample = std::round(sample / value) * value;
    if (kind == 8) sample = std::min(sample, value);
    if (kind == 9) sample = std::max(sample, value);
  }
  if (!part.empty() && kind == 5) part.back() = value;
}

void replace(LoopWindow& window, ByteSource& source) {
  const std::array<Samples*, 4> series = {&window.sp, &window.pv, &window.op, &window.mv};
  const Samples& from = *series[source.byte() % series.size()];
  Samples& to = *series[source.byte() % series.size()];
  if (to.size() == from.size()) to = from;
}

}  // namespace

void damage(LoopWindow& window, ByteSource& source) {
  const std::array<Samples*, 5> series = {&window.pv, &window.op, &window.sp, &window.mv,
                                          &window.pv_rows};
  const std::size_t choice = source.byte() % 7;
  if (choice < series.size()) return spoil(stretch_of(*series[choice], source), source);
  if (choice == 5) return replace(window, source);
  const auto mode = static_cast<ControlMode>(source.byte() % 4);
  std::ranges::fill(stretch_of(window.mode, source), mode);
}

}  // namespace loopscope::tests::fuzz
