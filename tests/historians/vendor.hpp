#pragma once

#include <span>
#include <string>

#include "config/settings.hpp"

namespace loopscope::tests {

/// The tables of one vendor as his product makes them, and how they are filled from `truth`.
struct Vendor {
  const char* name;
  const char* preset;
  /// SQL that makes the tables and fills them from the table `truth` (truth.hpp).
  const char* tables;
  /// What a site adds to the preset.
  void (*site)(config::HistorianSettings& historian);
  /// How loops refer to the tag of a role: @LOOP@ and @ROLE@ (sp, pv, op) stand for themselves,
  /// @NUMBER@ for 10 x loop + 1, 2, 3.
  const char* tag;
};

/// Every vendor and layout that has a preset or follows from one.
[[nodiscard]] std::span<const Vendor> vendors();

/// That vendor. Throws std::invalid_argument.
[[nodiscard]] const Vendor& vendor(const std::string& name);

/// The settings of a historian with that vendor's tables in the database of `connection`.
[[nodiscard]] config::HistorianSettings settings_of(const Vendor& vendor,
                                                    const std::string& connection);

/// The tag of `role` (sp, pv, op) of loop number `loop` (from 1).
[[nodiscard]] std::string tag_of(const Vendor& vendor, int loop, const std::string& role);

}  // namespace loopscope::tests
