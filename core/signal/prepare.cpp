#include "core/signal/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/signal/archive.hpp"
#include "core/signal/gaps.hpp"
#include "core/signal/holes.hpp"
#include "core/signal/judge_quality.hpp"
#include "core/signal/op_scale.hpp"
#include "core/signal/order/spread.hpp"
#include "core/signal/spikes.hpp"

namespace loopscope::core::signal {
namespace {

template <typename Values>
Values last_of(const Values& values, std::size_t count) {
  if (values.size() <= count) return values;
  return Values(values.end() - static_cast<std::ptrdiff_t>(count), values.end());
}

void require_equal_lengths(const LoopWindow& window) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == window.pv.size(); };
  if (!fits(window.sp.size()) || !fits(window.op.size()) || !fits(window.mv.size()) ||
      !fits(window.mode.size()) || !fits(window.pv_rows.size())) {
    throw std::invalid_argument("LoopWindow: series of different lengths");
  }
  if (!(window.sample_interval_s > 0.0) || !std::isfinite(window.sample_interval_s)) {
    throw std::invalid_argument("LoopWindow: sample_interval_s is not above 0 or not finite");
  }
}

Samples cut(const Samples& series, const PrepareSettings& settings) {
  Samples samples = last_of(series, settings.window_samples);
  discard_infinite(samples);
  return samples;
}

Samples bridged(Samples samples, const PrepareSettings& settings) {
  bridge_gaps(samples, settings.max_filled_gap);
  return samples;
}

/// sp - pv, or mean(pv) - pv where no setpoint was recorded; `values` stand in for those of pv.
Samples control_error(const Samples& sp, const Samples& pv, const Samples& values) {
  const bool has_setpoint = count_recorded(sp) > 0;
  const std::optional<Spread> spread = measure_spread(pv);
  Samples error(values.size(), kMissing);
  for (std::size_t k = 0; k < values.size() && spread; ++k) {
    error[k] = (has_setpoint ? sp[k] : spread->mean) - values[k];
  }
  return error;
}

/// With the controller in manual the error is not that of a control loop. Where it is so most of
/// the time nothing else is left: then the statistics are those of the process alone.
void mask_manual(const std::vector<ControlMode>& mode, Samples& error) {
  for (std::size_t k = 0; k < mode.size(); ++k) {
    if (mode[k] == ControlMode::manual) error[k] = kMissing;
  }
}

bool stores_all(Archive archive) {
  return archive == Archive::complete || archive == Archive::rounded;
}

/// The archive says what lies between the samples that it stored.
bool archive_known(Archive archive) {
  return archive == Archive::on_change || archive == Archive::dead_band ||
         archive == Archive::swinging_door;
}

void scale_output(const LoopWindow& window, Samples recorded_op, const PrepareSettings& settings,
                  PreparedLoop& loop) {
  // An archive that leaves out rows of pv leaves out the same ones of op where a file has both.
  PrepareSettings rule = settings;
  if (archive_known(loop.archive)) rule.max_filled_gap = kLongestBandedHole;
  Samples op = bridged(std::move(recorded_op), rule);
  const std::optional<Spread> spread = measure_spread(op);
  loop.op_range = find_op_range(op, window.op_range);
  loop.op_moves = spread && !spread->constant();
  loop.op_percent = to_percent(std::move(op), loop.op_range.range);
  loop.mv_percent = to_percent(bridged(cut(window.mv, settings), rule), loop.op_range.range);
}

/// pv, sp and op of the window as they were recorded.
struct Recorded {
  Samples pv, sp, op;
};

/// Outliers are looked for in what the stored samples say of all (`whole`), which is made anew
/// where there are any; returns how many were taken out.
std::size_t discard_stored_spikes(const Recorded& recorded, StoredSamples& stored,
                                  Reconstruction& whole) {
  const std::vector<bool> spikes = find_spikes(whole.value, recorded.op, recorded.sp);
  const auto found = static_cast<std::size_t>(std::count(spikes.begin(), spikes.end(), true));
  if (found == 0) return 0;
  for (std::size_t k = 0; k < spikes.size(); ++k) {
    if (spikes[k]) stored.value[k] = kMissing;
  }
  whole = reconstruct(stored);
  return found;
}

/// pv as recorded, less what `stored` lacks of its own values: outliers and frozen stretches, but
/// not what was put between the rows of a record that is not frozen.
Samples recorded_pv(Samples pv, const StoredSamples& stored, const Samples& whole) {
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (std::isnan(whole[k]) || stores_all(stored.archive)) pv[k] = stored.value[k];
  }
  return pv;
}

void take_pv(const LoopWindow& window, const Recorded& recorded, const PrepareSettings& settings,
             PreparedLoop& loop, Reconstruction& whole) {
  const Samples& pv = recorded.pv;
  loop.pv_recorded = count_recorded(pv);
  StoredSamples stored = find_stored(pv, cut(window.pv_rows, settings));
  whole = reconstruct(stored);
  loop.spikes = discard_stored_spikes(recorded, stored, whole);
  loop.archive = stored.archive;
  loop.band = stored.band;
  loop.pv_stored = count_recorded(stored.value);
  loop.pv_gaps = pv.size() - count_recorded(whole.value);
  loop.pv = archive_known(stored.archive) ? whole.value
                                          : bridged(recorded_pv(pv, stored, whole.value), settings);
}

/// Whether a controller acts, and whether pv stands still while one does: by pv as it was recorded,
/// whatever was discarded of it.
void judge_states(const LoopWindow& window, const Recorded& series, PreparedLoop& loop) {
  const RecordedLoop recorded{
      series.pv, series.sp,      loop.op_percent,       loop.op_in_percent(),
      loop.mode, window.pv_past, loop.sample_interval_s};
  loop.still = find_stand_still(recorded);
  loop.past = past_with(recorded);
  const Samples error = control_error(loop.sp, series.pv, series.pv);
  loop.control = find_control_state({loop.op_percent, error, loop.mode, loop.op_range.source});
}

/// The error where pv is guessed too, and the bounds of the guesses.
PreparedLoop::Drawable drawable_error(Samples sp, const PreparedLoop& loop,
                                      const Reconstruction& whole) {
  if (whole.low.empty()) return {};
  hold_gaps(sp, kLongestBandedHole);
  PreparedLoop::Drawable drawable{control_error(sp, whole.value, whole.value),
                                  control_error(sp, whole.value, whole.high),
                                  control_error(sp, whole.value, whole.low)};
  if (loop.control.controlling()) mask_manual(loop.mode, drawable.error);
  return drawable;
}

}  // namespace

PreparedLoop prepare(const LoopWindow& window, const PrepareSettings& settings) {
  require_equal_lengths(window);
  PreparedLoop loop;
  Reconstruction whole;
  loop.sample_interval_s = window.sample_interval_s;
  loop.repeated_times = window.repeated_times;
  loop.mode = last_of(window.mode, settings.window_samples);
  Recorded recorded{cut(window.pv, settings), cut(window.sp, settings), cut(window.op, settings)};
  take_pv(window, recorded, settings, loop, whole);
  loop.sp = recorded.sp;
  hold_gaps(loop.sp, settings.max_filled_gap);
  loop.error = control_error(loop.sp, loop.pv, loop.pv);
  scale_output(window, std::move(recorded.op), settings, loop);
  judge_states(window, recorded, loop);
  if (loop.control.controlling()) mask_manual(loop.mode, loop.error);
  loop.drawable = drawable_error(std::move(recorded.sp), loop, whole);
  loop.quality = judge_quality(loop, settings);
  return loop;
}

}  // namespace loopscope::core::signal
