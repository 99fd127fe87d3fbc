#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/plant/packed_error.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::plant {

/// Means of `of` >= 1 samples each, of those that are known; NaN where none is. What is left over
/// at the beginning goes.
[[nodiscard]] signal::Samples means_of(std::span<const double> samples, std::size_t of);

/// Microseconds UTC since 1970 of the first mean of `samples` samples from `start_us` on: the
/// middle of what it is made of.
[[nodiscard]] std::int64_t start_of_means(std::int64_t start_us, std::size_t samples,
                                          std::size_t of, double sample_interval_s);

/// A loop's error before its record: means, `start_us` of the first.
struct EarlierMeans {
  std::span<const double> values;
  std::int64_t start_us = 0;
};

/// Microseconds UTC since 1970: where earlier samples are to end, so that their means of `of` are
/// in the record's phase and rows that lie far apart are connected across its beginning (256
/// samples at most; `record` is not empty).
[[nodiscard]] std::int64_t end_of_earlier(const PackedError& record, std::size_t of);

/// Those and the means of the record itself, `of` samples each, as one: what is known of the record
/// need not be read once more. Steps that lie in neither are missing; one that lies in both is the
/// record's.
[[nodiscard]] PackedError longer_record(const EarlierMeans& earlier, const PackedError& record,
                                        std::size_t of);

}  // namespace loopscope::core::plant
