#include "daemon/lab/simulate/record_csv.hpp"

#include <fmt/format.h>
#include <iterator>

namespace loopscope::daemon {

std::string record_csv(const core::simulate::LoopRecord& record, bool with_mv) {
  const bool has_op = !record.op.empty();
  const bool has_mv = with_mv && !record.mv.empty();
  std::string text = fmt::format("t_s,sp,pv{}{}\n", has_op ? ",op" : "", has_mv ? ",mv" : "");
  auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < record.pv.size(); ++k) {
    const double time_s = static_cast<double>(k) * record.sample_interval_s;
    fmt::format_to(out, "{},{},{}", time_s, record.sp[k], record.pv[k]);
    if (has_op) fmt::format_to(out, ",{}", record.op[k]);
    if (has_mv) fmt::format_to(out, ",{}", record.mv[k]);
    text.push_back('\n');
  }
  return text;
}

}  // namespace loopscope::daemon
