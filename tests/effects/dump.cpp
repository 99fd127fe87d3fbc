#include "tests/effects/dump.hpp"

#include <limits>

namespace loopscope::tests::effects {

void write_csv(std::ostream& out, const Record& record, bool with_mv) {
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "t_s,sp,pv,op" << (with_mv ? ",mv" : "") << "\n";
  for (std::size_t k = 0; k < record.pv.size(); ++k) {
    out << static_cast<double>(k) * record.interval_s << ',' << record.sp[k] << ',' << record.pv[k]
        << ',' << record.op[k];
    if (with_mv) out << ',' << record.mv[k];
    out << '\n';
  }
}

void write_truth(std::ostream& out, const Truth& truth) {
  for (const TrueEffect& effect : truth.effects) {
    out << effect.effect << " (" << effect.law << ")";
    for (const TrueParameter& parameter : effect.parameters)
      out << "  " << parameter.name << " " << parameter.value << " " << parameter.unit;
    out << "\n";
  }
  const TrueLoop& loop = truth.loop;
  out << (loop.integrating ? "integrating" : "self-regulating") << ", gain " << loop.gain
      << ", time constants " << loop.time_constant_s << " s, " << loop.second_time_constant_s
      << " s, delay " << loop.delay_s << " s; PI gain " << loop.controller_gain
      << ", integral time " << loop.integral_time_s << " s, Ms " << loop.peak_sensitivity << "\n"
      << "floor " << truth.floor << ", noise std of pv " << truth.noise_std << ", explainable "
      << truth.explainable << "\n";
}

}  // namespace loopscope::tests::effects
