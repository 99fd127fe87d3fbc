#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/model/controller/controller_law.hpp"

namespace loopscope::core::model {

/// What may move op, in the order of the columns of a Move.
enum MoveTerm : int { kGainTerm, kSetpointTerm, kIntegralTerm, kDerivativeTerm, kMoveTerms };

using MoveVector = Eigen::Matrix<double, kMoveTerms, 1>;

/// One move of op over some samples and what the controller saw meanwhile.
struct Move {
  std::size_t at = 0;  ///< sample at its end
  MoveVector seen;  ///< change of e; of sp (without sp: the span, for the offset); sum of e; change
                    ///< of the negative slope of pv; all in pv units
  double op = 0.0;  ///< its change, %
};

/// The recorded moves of op over any span of samples.
class ControllerMoves {
 public:
  /// Throws std::invalid_argument for series of different lengths.
  explicit ControllerMoves(const ControllerRecord& record);

  /// Moves over `span` samples that touch no gap and no limit of op, at most four for each span.
  /// A negative lag looks ahead: op before the error that follows it. Calls visit(Move) in
  /// ascending time.
  template <typename Visit>
  void visit(std::size_t span, std::ptrdiff_t lag, Visit&& visit) const;
  /// Leaves out every move that spans the step of op onto one of these samples.
  void leave_out(std::span<const std::size_t> jumps);
  [[nodiscard]] std::size_t size() const { return record_.error.size(); }
  [[nodiscard]] bool setpoint_moves() const { return setpoint_moves_; }
  [[nodiscard]] bool has_setpoint() const { return !record_.sp.empty(); }

 private:
  /// Longer spans overlap almost wholly when every sample starts one.
  static constexpr std::size_t kMovesPerSpan = 4;
  /// Every span starts behind so many samples, so that all lags compare the same moves.
  static constexpr std::size_t kMostLag = 1;

  [[nodiscard]] bool known(std::size_t at, std::size_t span, std::ptrdiff_t lag) const;
  [[nodiscard]] Move move(std::size_t at, std::size_t span, std::ptrdiff_t lag) const;
  [[nodiscard]] double setpoint(std::size_t at) const {
    return has_setpoint() ? record_.sp[at] : 0.0;
  }
  [[nodiscard]] double pv(std::size_t at) const { return setpoint(at) - record_.error[at]; }
  void mark_gaps();
  void mark_limits();

  ControllerRecord record_;
  bool setpoint_moves_ = false;
  std::vector<char> bad_error_, bad_op_;
  std::vector<double> error_sum_;                  ///< of the samples before
  std::vector<std::size_t> bad_errors_, bad_ops_;  ///< before each sample
  std::vector<std::size_t> jumps_;                 ///< up to and with each sample
};

template <typename Visit>
void ControllerMoves::visit(std::size_t span, std::ptrdiff_t lag, Visit&& visit) const {
  const std::size_t stride = std::max<std::size_t>(1, span / kMovesPerSpan);
  const auto ahead = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -lag));
  for (std::size_t at = span + kMostLag + 1; at + ahead < size(); at += stride) {
    if (known(at, span, lag)) visit(move(at, span, lag));
  }
}

}  // namespace loopscope::core::model
