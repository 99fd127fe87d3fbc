#include "daemon/output/window_csv.hpp"

#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/signal/grid.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::ControlMode;
using core::signal::Samples;

struct Column {
  std::string_view name;
  const Samples* samples;
};

std::vector<Column> recorded_columns(const core::signal::LoopWindow& window) {
  std::vector<Column> columns;
  for (const Column& column :
       {Column{"sp", &window.sp}, {"pv", &window.pv}, {"op", &window.op}, {"mv", &window.mv}}) {
    if (!column.samples->empty()) columns.push_back(column);
  }
  return columns;
}

std::string_view mode_word(ControlMode mode) {
  switch (mode) {
    case ControlMode::manual:
      return "MAN";
    case ControlMode::automatic:
      return "AUTO";
    case ControlMode::cascade:
      return "CAS";
    case ControlMode::unknown:
      return "";
  }
  return "";
}

}  // namespace

std::string window_csv(const core::signal::LoopWindow& window) {
  const std::vector<Column> columns = recorded_columns(window);
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  std::string text = "time";
  for (const Column& column : columns) text.append(",").append(column.name);
  if (!window.mode.empty()) text += ",mode";
  text += '\n';
  auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < window.size(); ++k) {
    text += format_time(grid.time_us(k));
    for (const Column& column : columns) {
      const double value = (*column.samples)[k];
      std::isfinite(value) ? fmt::format_to(out, ",{}", value) : fmt::format_to(out, ",");
    }
    if (!window.mode.empty()) text.append(",").append(mode_word(window.mode[k]));
    text += '\n';
  }
  return text;
}

}  // namespace loopscope::daemon
