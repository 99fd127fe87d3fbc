#include "core/model/controller/controller_moves.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace loopscope::core::model {
namespace {

/// op within this of 0 or 100 % stands at its limit; historians round to hundredths.
constexpr double kAtLimitPercent = 0.05;
/// A limit set inside the range shows as a highest (or lowest) value that op keeps for so large a
/// share of its samples. The peaks of a moving op pass their highest value in far less.
constexpr double kLimitShare = 0.05;
/// op that takes fewer values is coarsely rounded, and its highest value says nothing.
constexpr std::size_t kLeastValues = 20;

std::vector<std::size_t> counts_before(const std::vector<char>& marks) {
  std::vector<std::size_t> counts(marks.size() + 1, 0);
  for (std::size_t k = 0; k < marks.size(); ++k) counts[k + 1] = counts[k] + (marks[k] ? 1 : 0);
  return counts;
}

/// Marks op wherever it equals `extreme`, if it does so often enough for a limit.
void mark_if_limit(std::span<const double> op, double extreme, std::vector<char>& marks) {
  const auto hits = static_cast<double>(std::ranges::count(op, extreme));
  if (hits < kLimitShare * static_cast<double>(op.size())) return;
  for (std::size_t k = 0; k < op.size(); ++k)
    if (op[k] == extreme) marks[k] = 1;
}

bool takes_many_values(std::span<const double> op) {
  std::vector<double> seen;
  for (const double value : op) {
    if (std::isnan(value) || std::ranges::find(seen, value) != seen.end()) continue;
    seen.push_back(value);
    if (seen.size() >= kLeastValues) return true;
  }
  return false;
}

}  // namespace

ControllerMoves::ControllerMoves(const ControllerRecord& record) : record_(record) {
  const std::size_t n = record.error.size();
  const bool recorded = std::ranges::any_of(record.sp, [](double v) { return std::isfinite(v); });
  if (!recorded) record_.sp = {};
  if (record.op.size() != n || (has_setpoint() && record.sp.size() != n)) {
    throw std::invalid_argument("controller record: series of different lengths");
  }
  mark_gaps();
  mark_limits();
  bad_errors_ = counts_before(bad_error_);
  bad_ops_ = counts_before(bad_op_);
  leave_out({});
}

void ControllerMoves::mark_gaps() {
  const std::size_t n = record_.error.size();
  bad_error_.assign(n, 0);
  bad_op_.assign(n, 0);
  error_sum_.assign(n + 1, 0.0);
  double last = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < n; ++k) {
    bad_error_[k] =
        static_cast<char>(!std::isfinite(record_.error[k]) || !std::isfinite(setpoint(k)));
    bad_op_[k] = static_cast<char>(!std::isfinite(record_.op[k]));
    error_sum_[k + 1] = error_sum_[k] + (bad_error_[k] ? 0.0 : record_.error[k]);
    if (bad_error_[k]) continue;
    setpoint_moves_ = setpoint_moves_ || (std::isfinite(last) && setpoint(k) != last);
    last = setpoint(k);
  }
}

void ControllerMoves::mark_limits() {
  const std::span<const double> op = record_.op;
  for (std::size_t k = 0; record_.op_in_percent && k < op.size(); ++k) {
    if (op[k] <= kAtLimitPercent || op[k] >= 100.0 - kAtLimitPercent) bad_op_[k] = 1;
  }
  if (!takes_many_values(op)) return;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t k = 0; k < op.size(); ++k) {
    if (bad_op_[k]) continue;
    low = std::min(low, op[k]);
    high = std::max(high, op[k]);
  }
  mark_if_limit(op, low, bad_op_);
  mark_if_limit(op, high, bad_op_);
}

Move ControllerMoves::move(std::size_t at, std::size_t span, std::ptrdiff_t lag) const {
  const std::size_t now = at - static_cast<std::size_t>(lag);
  const std::size_t then = now - span;
  Move result;
  result.at = at;
  result.op = record_.op[at] - record_.op[at - span];
  result.seen[kGainTerm] = record_.error[now] - record_.error[then];
  result.seen[kSetpointTerm] =
      has_setpoint() ? setpoint(now) - setpoint(then) : static_cast<double>(span);
  result.seen[kIntegralTerm] = error_sum_[now + 1] - error_sum_[then + 1];
  result.seen[kDerivativeTerm] = (pv(then) - pv(then - 1)) - (pv(now) - pv(now - 1));
  return result;
}

bool ControllerMoves::known(std::size_t at, std::size_t span, std::ptrdiff_t lag) const {
  const std::size_t now = at - static_cast<std::size_t>(lag);
  return bad_ops_[at + 1] == bad_ops_[at - span] && jumps_[at] == jumps_[at - span] &&
         bad_errors_[now + 1] == bad_errors_[now - span - 1];
}

void ControllerMoves::leave_out(std::span<const std::size_t> jumps) {
  std::vector<char> marks(record_.op.size(), 0);
  for (const std::size_t at : jumps) marks[at] = 1;
  const std::vector<std::size_t> before = counts_before(marks);
  jumps_.assign(before.begin() + 1, before.end());
}

}  // namespace loopscope::core::model
