#pragma once

#include <array>
#include <cstdint>

namespace loopscope::storage {

inline constexpr std::int64_t kHour_us = std::int64_t{3600} * 1'000'000;
inline constexpr std::int64_t kDay_us = std::int64_t{24} * kHour_us;

/// How far back a row before the window is looked for: a setpoint may stand still for months.
inline constexpr std::int64_t kReachBefore_us = std::int64_t{366} * kDay_us;

/// The spans in which a newest row is looked for, one after the other: each begins earlier and all
/// end at one time, so that the first that has a row gives the same as the last. A server that
/// sorts what it is asked for, or opens every partition of it, then has to do with few rows more
/// than lie between two rows of the tag. A tag that is recorded has a row in an hour, a step of a
/// setpoint or a day's batch in a day; a month and a year are what historians keep in one
/// partition.
inline constexpr std::array<std::int64_t, 4> kGrowingSpans_us{
    kHour_us, kDay_us, std::int64_t{31} * kDay_us, kReachBefore_us};

}  // namespace loopscope::storage
