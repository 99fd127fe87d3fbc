#include "daemon/report/live/live_trend.hpp"

#include <fmt/format.h>
#include <string_view>
#include <vector>

#include "core/signal/grid.hpp"
#include "daemon/report/figures/signal_figures.hpp"
#include "daemon/report/live/sample_text.hpp"
#include "daemon/report/page/template.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::LoopWindow;
using core::signal::Samples;

std::string series_text(std::string_view name, const Samples& samples) {
  return samples.empty() ? "" : fmt::format(",\"{}\":{}", name, sample_text(samples));
}

/// Samples of the window; the stretch is one of what was prepared of it, its end.
std::string stretch_text(const LoopEvidence& evidence) {
  const Stretch stretch = telling_stretch(evidence);
  const std::size_t cut = evidence.at_slot.window.size() - evidence.prepared.pv.size();
  return fmt::format(",\"stretch\":[{},{}]", cut + stretch.from, stretch.samples);
}

std::string op_range_text(const LoopEvidence& evidence) {
  const auto& range = evidence.prepared.op_range.range;
  return range ? fmt::format(",\"op_range\":[{},{}]", range->low, range->high) : "";
}

std::string window_text(const LoopEvidence& evidence) {
  const LoopWindow& window = evidence.at_slot.window;
  const std::string rows = window.pv_rows.empty() ? "" : presence_text(window.pv_rows);
  return fmt::format("{{\"start_us\":{},\"interval_s\":{},\"samples\":{}", window.start_us,
                     window.sample_interval_s, window.size()) +
         stretch_text(evidence) + op_range_text(evidence) + series_text("sp", window.sp) +
         series_text("pv", window.pv) + series_text("op", window.op) +
         series_text("mv", window.mv) + (rows.empty() ? "" : ",\"pv_rows\":" + rows) + "}";
}

/// What the clock of the zone shows in the window.
List clocks(const LoopWindow& window, const TimeZone& zone) {
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  const auto periods = zone.periods(window.start_us, grid.time_us(window.size() - 1));
  return rows(periods, [](const TimeZone::Period& period) -> Fields {
    return {
        {"begin_us", period.begin_us}, {"offset_us", period.offset_us}, {"words", period.words}};
  });
}

}  // namespace

Markup live_trend(const LoopEvidence& evidence, const std::string& pv_unit, const TimeZone& zone) {
  const LoopWindow& window = evidence.at_slot.window;
  if (window.size() == 0) return {};
  return render("live_trend", {{"window", window_text(evidence)},
                               {"pv_unit", pv_unit},
                               {"op_unit", evidence.prepared.op_in_percent() ? "%" : "op units"},
                               {"clocks", clocks(window, zone)}});
}

}  // namespace loopscope::daemon
