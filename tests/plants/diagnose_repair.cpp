#include "tests/plants/diagnose_repair.hpp"

#include <cmath>
#include <utility>

#include "daemon/service/batches/loop_task.hpp"
#include "tests/effects/window_of.hpp"

namespace loopscope::tests::repairs {
namespace {

/// 2026-03-01 00:00 UTC; any time in the past would do.
constexpr std::int64_t kDoneAtUs = 1'772'323'200'000'000;
/// The loop is out of service while it is worked on.
constexpr std::int64_t kHandsOnUs = 3'600'000'000;

std::int64_t in_us(double seconds) {
  return std::llround(seconds * 1e6);
}

storage::AnalysisRecord analyse(const storage::CatalogueEntry& loop, const effects::Series& series,
                                double interval_s, std::int64_t start_us) {
  daemon::LoopWindowAtSlot at_slot;
  at_slot.window = effects::window_of(series, interval_s, start_us);
  at_slot.slot_end_us = start_us + in_us(interval_s * static_cast<double>(series.pv.size() - 1));
  daemon::StageDriver driver;
  return daemon::analyse_window(loop, daemon::prepare_input(std::move(at_slot), {}), {}, "{}",
                                driver);
}

storage::CatalogueEntry entry_of(const Repair& repair, const std::string& name) {
  storage::CatalogueEntry loop;
  loop.name = name;
  loop.sp_tag = name + ".SP";
  loop.pv_tag = name + ".PV";
  loop.op_tag = name + ".OP";
  loop.interval_s = repair.interval_s;
  loop.op_range = core::signal::OpRange{};
  loop.loop_type = repair.integrating ? "level" : "flow";
  return loop;
}

}  // namespace

DiagnosedRepair diagnose_repair(const Repair& repair, const std::string& loop_name) {
  DiagnosedRepair done{entry_of(repair, loop_name),
                       repair.fault,
                       repair.word,
                       repair.event_kind,
                       repair.work,
                       kDoneAtUs,
                       {},
                       {}};
  const std::int64_t span_us = in_us(repair.interval_s * effects::kSamples);
  std::int64_t start_us = kDoneAtUs - kHandsOnUs;
  for (const effects::Series& series : repair.before)
    done.before.push_back(analyse(done.loop, series, repair.interval_s, start_us -= span_us));
  start_us = kDoneAtUs + kHandsOnUs;
  for (const effects::Series& series : repair.after) {
    done.after.push_back(analyse(done.loop, series, repair.interval_s, start_us));
    start_us += span_us;
  }
  return done;
}

}  // namespace loopscope::tests::repairs
