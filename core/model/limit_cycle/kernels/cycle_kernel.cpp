#include "core/model/limit_cycle/kernels/cycle_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "core/model/limit_cycle/kernels/cycle_kernel.cpp"  // once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <algorithm>
#include <cstring>
#include <hwy/highway.h>

#include "core/model/vectors/eight_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model::HWY_NAMESPACE {
namespace {

/// As many series at a time as a Number has.
template <typename Number>
void take_means(std::span<const double> samples, std::size_t stride, std::size_t factor,
                double* kept) {
  constexpr std::size_t kBytes = sizeof(Number);
  const std::size_t count = samples.size() / stride / factor;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t v = 0; v < stride; v += kBytes / sizeof(double)) {
      Number sum{}, sample;
      for (std::size_t k = i * factor; k < (i + 1) * factor; ++k) {
        std::memcpy(&sample, &samples[k * stride + v], sizeof(sample));
        sum += sample;
      }
      sum /= static_cast<double>(factor);
      std::memcpy(kept + i * stride + v, &sum, sizeof(sum));
    }
  }
}

void resample(std::span<const double> samples, std::size_t stride, std::size_t factor,
              double* kept) {
  if (stride == kSideBySide)
    take_means<EightPart>(samples, stride, factor, kept);
  else
    take_means<double>(samples, stride, factor, kept);
}

EightPart mean_of(std::span<const EightNumbers> inputs, std::size_t part) {
  EightPart sum{};
  for (const EightNumbers& input : inputs) sum += part_of(input, part);
  return sum / static_cast<double>(std::max<std::size_t>(1, inputs.size()));
}

/// No lag waits for another.
template <std::size_t lag_count>
void respond_together(std::span<const EightNumbers> inputs, const LagStep* lags,
                      EightNumbers* const* sums, std::size_t part) {
  const EightPart mean = mean_of(inputs, part);
  EightPart state[lag_count] = {}, sum[lag_count] = {};
  for (std::size_t i = 0; i < lag_count; ++i) {
    put_part(sums[i][0], part, sum[i]);
    if (!lags[i].at_rest && !inputs.empty()) state[i] = part_of(inputs[0], part) - mean;
  }
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const EightPart input = part_of(inputs[k], part) - mean;
#pragma GCC unroll 8
    for (std::size_t i = 0; i < lag_count; ++i) {
      state[i] = lags[i].pole * state[i] + lags[i].share * input;
      sum[i] += state[i];
      put_part(sums[i][k + 1], part, sum[i]);
    }
  }
}

constexpr std::size_t kLagsTogether = 5;

void respond(std::span<const EightNumbers> inputs, std::span<const LagStep> lags,
             EightNumbers* const* sums) {
  for (std::size_t part = 0; part < kVectorsOfEight; ++part) {
    std::size_t i = 0;
    for (; i + kLagsTogether <= lags.size(); i += kLagsTogether)
      respond_together<kLagsTogether>(inputs, &lags[i], sums + i, part);
    for (; i < lags.size(); ++i) respond_together<1>(inputs, &lags[i], sums + i, part);
  }
}

/// Where a mean ends at an end of the record.
void pass_near_end(BandWidths widths, std::span<const double> sums, std::size_t stride,
                   std::size_t k, double* passed) {
  const std::size_t count = sums.size() / stride - 1;
  const auto ends = [&](std::size_t half) {
    return std::array{k - std::min(k, half), std::min(count, k + half + 1)};
  };
  const auto [short_first, short_last] = ends(std::min({widths.short_half, k, count - 1 - k}));
  const auto [long_first, long_last] = ends(widths.long_half);
  const auto short_width = static_cast<double>(short_last - short_first);
  const auto long_width = static_cast<double>(long_last - long_first);
  for (std::size_t v = 0; v < stride; ++v) {
    const double* sum = &sums[v];
    passed[k * stride + v] = (sum[short_last * stride] - sum[short_first * stride]) / short_width -
                             (sum[long_last * stride] - sum[long_first * stride]) / long_width;
  }
}

void pass(BandWidths widths, std::span<const double> sums, std::size_t stride, double* passed) {
  const auto [long_half, short_half] = widths;
  const std::size_t count = sums.size() / stride - 1;
  const std::size_t inner = std::min(count, long_half);
  const std::size_t outer = std::max(inner, count - std::min(count, long_half));
  for (std::size_t k = 0; k < inner; ++k) pass_near_end(widths, sums, stride, k, passed);
  const double short_share = 1.0 / static_cast<double>(2 * short_half + 1);
  const double long_share = 1.0 / static_cast<double>(2 * long_half + 1);
  if (outer > inner) {
    const double* short_last = &sums[(inner + short_half + 1) * stride];
    const double* short_first = &sums[(inner - short_half) * stride];
    const double* long_last = &sums[(inner + long_half + 1) * stride];
    const double* long_first = &sums[(inner - long_half) * stride];
    double* __restrict to = passed + inner * stride;
    for (std::size_t i = 0; i < (outer - inner) * stride; ++i)
      to[i] = (short_last[i] - short_first[i]) * short_share -
              (long_last[i] - long_first[i]) * long_share;
  }
  for (std::size_t k = outer; k < count; ++k) pass_near_end(widths, sums, stride, k, passed);
}

struct Products {
  EightPart cross, square;
  Products& operator+=(const Products& other) {
    cross += other.cross;
    square += other.square;
    return *this;
  }
};

/// Of product(0) to product(count - 1), count > 0. Four sums side by side, as two pairs of numbers
/// that are added by turns, whatever the processor has.
template <typename Product>
Products sum_up(std::size_t count, Product product) {
  Products first = product(0);
  if (count == 1) return first;
  Products second = product(1);
  std::size_t k = 2;
  if (count >= 4) {
    Products third = product(2), fourth = product(3);
    for (k = 4; k + 4 <= count; k += 4) {
      first += product(k);
      second += product(k + 1);
      third += product(k + 2);
      fourth += product(k + 3);
    }
    first += third;
    second += fourth;
    if (k + 2 <= count) {
      first += product(k);
      second += product(k + 1);
      k += 2;
    }
  }
  first += second;
  if (k < count) first += product(k);
  return first;
}

std::array<FoldSums, 2> multiply(std::span<const EightNumbers> responses, std::size_t delay,
                                 std::span<const double> weighted_pv,
                                 std::span<const double> weights, std::size_t block) {
  std::array<FoldSums, 2> result;
  for (std::size_t part = 0; part < kVectorsOfEight; ++part) {
    Products folds[2] = {};
    for (std::size_t start = 0; start < weights.size(); start += block) {
      const std::size_t end = std::min(weights.size(), start + block);
      const std::size_t first = std::max(start, delay);
      if (first >= end) continue;
      folds[(start / block) % 2] += sum_up(end - first, [&](std::size_t k) {
        const EightPart response = part_of(responses[first + k - delay], part);
        return Products{response * weighted_pv[first + k],
                        weights[first + k] * response * response};
      });
    }
    for (std::size_t fold = 0; fold < 2; ++fold) {
      put_part(result[fold].cross, part, folds[fold].cross);
      put_part(result[fold].square, part, folds[fold].square);
    }
  }
  return result;
}

constexpr CycleKernel kCycleKernel{resample, respond, pass, multiply};

}  // namespace

const CycleKernel* cycle_kernel() {
  return &kCycleKernel;
}

}  // namespace loopscope::core::model::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace loopscope::core::model {

HWY_EXPORT(cycle_kernel);

const CycleKernel& best_cycle_kernel() {
  return *HWY_DYNAMIC_DISPATCH(cycle_kernel)();
}

}  // namespace loopscope::core::model

#endif
