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

/// Where the sums before and behind a mean stand.
struct MeanEnds {
  std::size_t first, last;
  [[nodiscard]] double width() const { return static_cast<double>(last - first); }
};

/// The short mean less the long one of series given by their sums, as many at a time as a Number
/// has.
template <typename Number>
class BandPass {
 public:
  BandPass(BandWidths widths, std::span<const double> sums, std::size_t stride, double* passed)
      : short_half_(widths.short_half),
        long_half_(widths.long_half),
        sums_(sums),
        stride_(stride),
        count_(sums.size() / stride - 1),
        passed_(passed) {}

  void run(Range samples) const {
    const std::size_t inner = std::clamp(long_half_, samples.first, samples.end);
    const std::size_t outer = std::clamp(count_ - std::min(count_, long_half_), inner, samples.end);
    for (std::size_t k = samples.first; k < inner; ++k) near_end(k);
    for (std::size_t k = inner; k < outer; ++k) inside(k);
    for (std::size_t k = outer; k < samples.end; ++k) near_end(k);
  }
  void run() const { run({0, count_}); }

 private:
  static constexpr std::size_t kBytes = sizeof(Number);

  /// passed(k) = difference(v), v the first of the series.
  template <typename Difference>
  void put(std::size_t k, Difference difference) const {
    for (std::size_t v = 0; v < stride_; v += kBytes / sizeof(double)) {
      const Number result = difference(v);
      std::memcpy(passed_ + k * stride_ + v, &result, sizeof(result));
    }
  }
  [[nodiscard]] Number sum_within(MeanEnds ends, std::size_t v) const {
    Number first, last;
    std::memcpy(&first, &sums_[ends.first * stride_ + v], sizeof(first));
    std::memcpy(&last, &sums_[ends.last * stride_ + v], sizeof(last));
    return last - first;
  }
  [[nodiscard]] MeanEnds ends_of(std::size_t k, std::size_t half) const {
    return {k - std::min(k, half), std::min(count_, k + half + 1)};
  }

  void inside(std::size_t k) const {
    put(k, [&](std::size_t v) {
      return sum_within({k - short_half_, k + short_half_ + 1}, v) * short_share_ -
             sum_within({k - long_half_, k + long_half_ + 1}, v) * long_share_;
    });
  }
  void near_end(std::size_t k) const {
    const MeanEnds narrow = ends_of(k, std::min({short_half_, k, count_ - 1 - k}));
    const MeanEnds wide = ends_of(k, long_half_);
    put(k, [&](std::size_t v) {
      return sum_within(narrow, v) / narrow.width() - sum_within(wide, v) / wide.width();
    });
  }

  std::size_t short_half_, long_half_;
  double short_share_ = 1.0 / static_cast<double>(2 * short_half_ + 1);
  double long_share_ = 1.0 / static_cast<double>(2 * long_half_ + 1);
  std::span<const double> sums_;
  std::size_t stride_;
  std::size_t count_;  ///< samples; of sums there is one more
  double* passed_;
};

void pass(BandWidths widths, std::span<const double> sums, std::size_t stride, double* passed) {
  if (stride == kSideBySide)
    BandPass<EightPart>(widths, sums, stride, passed).run();
  else
    BandPass<double>(widths, sums, stride, passed).run();
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
  const BandPass<EightPart> band(widths, flat(sums), kSideBySide, first_of(responses));
  EightNumbers nothing;
  std::ranges::fill(nothing.numbers, 0.0);
  std::fill_n(folds, delays.size(),
              std::array{FoldSums{nothing, nothing}, FoldSums{nothing, nothing}});
  for (std::size_t start = 0; start < count; start += pv.block) {
    const std::size_t end = std::min(count, start + pv.block);
    band.run({start, end});
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
