#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "daemon/report/plant/plant_section.hpp"
#include "daemon/report/sections/loop_section.hpp"

namespace loopscope::daemon {

/// What a report's page takes at most, pictures included: what a mail server lets through.
inline constexpr std::size_t kMostPageBytes = 5'000'000;

/// Why a loop of a long list has none.
inline constexpr const char* kNoRoomForPictures =
    "the file has room for those of the worst loops; the daemon's page /loop has those of any.";

struct ReportPage {
  std::string html;
  std::size_t sections = 0;  ///< loops that have one
  std::size_t pictured = 0;  ///< of these, with their pictures
};

/// The whole page: the first screen, then a section for each of `loops` (the flagged ones in the
/// order of their ranks, with their pictures) as far as `most_bytes` reach, area by area where the
/// catalogue has areas. The list and the loops' table of contents are whole whatever they take.
/// Loops without a section lead to the daemon's page of them at `pages_address`; empty = nowhere.
[[nodiscard]] ReportPage report_page(const PlantFacts& facts, std::span<const LoopReport> loops,
                                     const std::string& pages_address = "",
                                     std::size_t most_bytes = kMostPageBytes);

}  // namespace loopscope::daemon
