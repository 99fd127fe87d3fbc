#include "core/signal/prepare.hpp"

#include <stdexcept>

#include "core/signal/gaps.hpp"
#include "core/signal/judge_quality.hpp"
#include "core/signal/op_scale.hpp"
#include "core/signal/spikes.hpp"
#include "core/signal/spread.hpp"

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
      !fits(window.mode.size())) {
    throw std::invalid_argument("LoopWindow: series of different lengths");
  }
  if (!(window.sample_interval_s > 0.0)) {
    throw std::invalid_argument("LoopWindow: sample_interval_s is not above 0");
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

/// sp - pv, or mean(pv) - pv where no setpoint was recorded.
Samples control_error(const Samples& sp, const Samples& pv) {
  const bool has_setpoint = count_recorded(sp) > 0;
  const std::optional<Spread> spread = measure_spread(pv);
  Samples error(pv.size(), kMissing);
  for (std::size_t k = 0; k < pv.size() && spread; ++k) {
    error[k] = (has_setpoint ? sp[k] : spread->mean) - pv[k];
  }
  return error;
}

/// With the controller in manual the error is not that of a control loop.
void mask_manual(const std::vector<ControlMode>& mode, Samples& error) {
  for (std::size_t k = 0; k < mode.size(); ++k) {
    if (mode[k] == ControlMode::manual) error[k] = kMissing;
  }
}

void scale_output(const LoopWindow& window, const PrepareSettings& settings, PreparedLoop& loop) {
  const Samples op = bridged(cut(window.op, settings), settings);
  const std::optional<OpRange> range = resolve_op_range(op, window.op_range);
  const std::optional<Spread> spread = measure_spread(op);
  loop.op_range_known = range.has_value();
  loop.op_moves = spread && !spread->constant();
  loop.op_percent = to_percent(op, range);
  loop.mv_percent = to_percent(bridged(cut(window.mv, settings), settings), range);
}

}  // namespace

PreparedLoop prepare(const LoopWindow& window, const PrepareSettings& settings) {
  require_equal_lengths(window);
  PreparedLoop loop;
  loop.sample_interval_s = window.sample_interval_s;
  loop.repeated_times = window.repeated_times;
  loop.mode = last_of(window.mode, settings.window_samples);
  loop.pv = cut(window.pv, settings);
  loop.pv_recorded = count_recorded(loop.pv);
  loop.spikes = discard_spikes(loop.pv);
  bridge_gaps(loop.pv, settings.max_filled_gap);
  loop.sp = cut(window.sp, settings);
  hold_gaps(loop.sp, settings.max_filled_gap);
  loop.error = control_error(loop.sp, loop.pv);
  mask_manual(loop.mode, loop.error);
  scale_output(window, settings, loop);
  loop.quality = judge_quality(loop, settings);
  return loop;
}

}  // namespace loopscope::core::signal
