#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/signal/loop_window.hpp"

namespace loopscope::storage {

/// One loop of the catalogue (table loopscope.loop). Names and tags may hold any text.
struct CatalogueEntry {
  std::int64_t loop_id = 0;          ///< 0 = not stored yet
  std::string name;                  ///< unique, not empty
  std::string source = "plant";      ///< name of a historian in the settings
  std::string sp_tag;                ///< empty = not recorded
  std::string pv_tag;                ///< not empty
  std::string op_tag;                ///< empty = not recorded
  std::string mv_tag;                ///< empty = not recorded
  std::string mode_tag;              ///< empty = not recorded
  std::optional<double> interval_s;  ///< seconds, 0.001 to 86400; nullopt = found from the rows
  double period_s = 3600.0;          ///< seconds between two analyses, 1 to 2592000
  std::optional<core::signal::OpRange> op_range;
  std::optional<core::signal::OpRange> pv_range;  ///< of the transmitter, pv units; low < high
  std::string loop_type;    ///< flow, pressure, level, temperature, ... or empty
  std::string area;         ///< of the plant; this and the next four: empty = not said
  std::string unit;         ///< process unit within the area
  std::string description;  ///< what the loop controls
  std::string pv_unit;      ///< of sp and pv, such as m3/h
  std::string owner;        ///< who is responsible for the loop
  double importance = 1.0;  ///< weight in the ranking, > 0
  bool enabled = true;
  std::int64_t registered_us = 0;  ///< when it was added, microseconds UTC
};

}  // namespace loopscope::storage
