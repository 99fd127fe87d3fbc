#include "core/model/limit_cycle/kernels/cycle_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "core/model/limit_cycle/kernels/cycle_kernel.cpp"  // once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <algorithm>
#include <cstring>
#include <hwy/highway.h>
#include <vector>

#include "core/model/record/loop_data.hpp"
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

/// The sums before and behind a mean, and its width.
struct MeanEnds {
  std::size_t first, last;
  [[nodiscard]] double width() const { return static_cast<double>(last - first); }
};

/// Where a mean around k ends at an end of the record.
MeanEnds ends_near(std::size_t k, std::size_t half, std::size_t count) {
  return {k - std::min(k, half), std::min(count, k + half + 1)};
}

/// As many series at a time as a Number has. Samples first to end - 1.
template <typename Number>
void pass_some(BandWidths widths, std::span<const double> sums, std::size_t stride, Range some,
               double* passed) {
  constexpr std::size_t kBytes = sizeof(Number);
  const std::size_t long_half = widths.long_half, short_half = widths.short_half;
  const std::size_t count = sums.size() / stride - 1;
  const auto each = [&](std::size_t k, auto difference) {
    for (std::size_t v = 0; v < stride; v += kBytes / sizeof(double)) {
      const auto sum = [&](std::size_t at) {
        Number number;
        std::memcpy(&number, &sums[at * stride + v], kBytes);
        return number;
      };
      const Number result = difference(sum);
      std::memcpy(passed + k * stride + v, &result, kBytes);
    }
  };
  const auto near_end = [&](std::size_t k) {
    const MeanEnds s = ends_near(k, std::min({short_half, k, count - 1 - k}), count);
    const MeanEnds l = ends_near(k, long_half, count);
    each(k, [&](const auto& sum) {
      return (sum(s.last) - sum(s.first)) / s.width() - (sum(l.last) - sum(l.first)) / l.width();
    });
  };
  const std::size_t inner = std::clamp(long_half, some.first, some.end);
  const std::size_t outer = std::clamp(count - std::min(count, long_half), inner, some.end);
  const double short_share = 1.0 / static_cast<double>(2 * short_half + 1);
  const double long_share = 1.0 / static_cast<double>(2 * long_half + 1);
  for (std::size_t k = some.first; k < inner; ++k) near_end(k);
  for (std::size_t k = inner; k < outer; ++k) {
    each(k, [&](const auto& sum) {
      return (sum(k + short_half + 1) - sum(k - short_half)) * short_share -
             (sum(k + long_half + 1) - sum(k - long_half)) * long_share;
    });
  }
  for (std::size_t k = outer; k < some.end; ++k) near_end(k);
}

void pass(BandWidths widths, std::span<const double> sums, std::size_t stride, double* passed) {
  const Range all{0, sums.size() / stride - 1};
  if (stride == kSideBySide)
    pass_some<EightPart>(widths, sums, stride, all, passed);
  else
    pass_some<double>(widths, sums, stride, all, passed);
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

/// Of one block and one delay, whose responses lie ready.
Products products_in(Range block, std::span<const EightNumbers> responses, std::size_t delay,
                     std::size_t part, const WeighedPv& pv) {
  return sum_up(block.end - block.first, [&](std::size_t i) {
    const std::size_t k = block.first + i;
    const EightPart response = part_of(responses[k - delay], part);
    return Products{response * pv.weighted[k], pv.weights[k] * response * response};
  });
}

void add(const Products& products, std::size_t part, FoldSums& sums) {
  put_part(sums.cross, part, part_of(sums.cross, part) + products.cross);
  put_part(sums.square, part, part_of(sums.square, part) + products.square);
}

/// Each block of responses is used for all delays while the caches hold it.
void multiply(BandWidths widths, std::span<const EightNumbers> sums,
              std::span<const std::size_t> delays, const WeighedPv& pv,
              std::array<FoldSums, 2>* folds) {
  const std::size_t count = pv.weights.size();
  std::vector<EightNumbers> responses(count);
  EightNumbers nothing;
  std::ranges::fill(nothing.numbers, 0.0);
  std::fill_n(folds, delays.size(),
              std::array{FoldSums{nothing, nothing}, FoldSums{nothing, nothing}});
  for (std::size_t start = 0; start < count; start += pv.block) {
    const std::size_t end = std::min(count, start + pv.block);
    pass_some<EightPart>(widths, flat(sums), kSideBySide, {start, end}, first_of(responses));
    for (std::size_t d = 0; d < delays.size(); ++d) {
      const Range block{std::max(start, delays[d]), end};
      if (block.first >= end) continue;
      FoldSums& fold = folds[d][(start / pv.block) % 2];
      for (std::size_t part = 0; part < kVectorsOfEight; ++part)
        add(products_in(block, responses, delays[d], part, pv), part, fold);
    }
  }
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
