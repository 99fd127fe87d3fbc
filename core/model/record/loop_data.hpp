#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/model/record/row_grid.hpp"
#include "core/model/results/mechanism.hpp"

namespace loopscope::core::model {

struct CycleCause;

/// What was recorded of one loop, on one grid, equally long. NaN = missing.
struct ModelInput {
  std::span<const double> pv;      ///< pv units
  std::span<const double> op;      ///< % of its range, or op units where no range is known
  std::span<const double> sp;      ///< pv units; empty = not recorded
  std::span<const double> error;   ///< sp - pv, pv units; NaN in manual too
  double sample_interval_s = 1.0;  ///< > 0
  bool op_in_percent = true;
  std::uint64_t seed = 0;  ///< of the simulations behind p-values
  Without without{};       ///< tests only
  /// What judge_limit_cycle() says of these series, where it was asked before; nullptr = ask it.
  const CycleCause* cycle = nullptr;
};

/// Rows from `first` up to, not including, `end`.
struct Range {
  std::size_t first = 0;
  std::size_t end = 0;
  [[nodiscard]] std::size_t size() const { return end - first; }
};

/// The rows whose errors a fit may see, and those that it is scored on: alternating blocks, so
/// that an effect that sits in one place is seen by both, with a guard gap before each block. A row
/// that touches a missing sample belongs to neither. Ranges ascend.
struct Rows {
  std::vector<Range> fit;
  std::vector<Range> score;
  /// Before each block: no fit sees them and none is scored on them. Residual tests see them too: a
  /// sudden effect that begins there would else be missed, one of twelve (of a held sensor one of
  /// six).
  std::vector<Range> guard;
  [[nodiscard]] std::size_t fit_count() const;
  [[nodiscard]] std::size_t score_count() const;
};

/// How many of so many rows no fit counts at the start of a record: filters begin at rest, and what
/// they remember of the unknown past is gone by then.
[[nodiscard]] std::size_t warm_up_rows(const RowGrid& grid, std::size_t rows);

/// What a loop model is fitted to. No NaN: gaps are bridged and left out of `rows`. op, and all
/// that it passes through, has a value for each sample; pv, the noise and the errors have one for
/// each row, of which a held sensor has fewer.
struct LoopData {
  double sample_interval_s = 1.0;
  std::vector<double> pv;  ///< by row; distance from its mean, in units of `pv_scale`
  std::vector<double> op;  ///< by sample; % of its range, distance from `op_mean`
  double pv_mean = 0.0;    ///< pv units
  double pv_scale = 1.0;   ///< pv units; standard deviation of pv, > 0
  double op_mean = 0.0;    ///< %
  Rows rows;
  RowGrid grid;
  Without without{};                                            ///< tests only
  [[nodiscard]] std::size_t size() const { return pv.size(); }  ///< rows
  [[nodiscard]] std::size_t samples() const { return op.size(); }
};

/// Bridges gaps (NaN) and lays out the rows. Series of equal length, a value for each sample; pv
/// not constant. What pv is between the rows of `grid` is not looked at.
[[nodiscard]] LoopData make_loop_data(std::span<const double> pv, std::span<const double> op,
                                      double sample_interval_s, const RowGrid& grid = {});

/// The fit sees what it was scored on, and the other way round.
[[nodiscard]] LoopData on_other_fold(LoopData data);

/// The fit sees the rows of both kinds; the score is what it was.
[[nodiscard]] LoopData seen_whole(LoopData data);

/// The same rows, with the `length` rows from `at` on in both kinds. A sudden step shows in a
/// single one-step error, which has to be among the rows of the fit and of the score. The score
/// flatters such an effect by one part in the number of rows for each of its coefficients.
[[nodiscard]] Rows seen_by_both(const Rows& rows, std::size_t at, std::size_t length);

}  // namespace loopscope::core::model
