#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/model/fit/fit.hpp"
#include "core/model/response/products.hpp"

namespace loopscope::core::model {

/// A column of a table that holds a row for each row of the record.
[[nodiscard]] std::span<double> column(Eigen::MatrixXd& table, Eigen::Index at);

/// The whitened columns of a structure: pv, numerator, effects, offset (and ramp, integrating), one
/// after the other.
struct Design {
  Eigen::MatrixXd table;  ///< a row for each row of the record
  Eigen::Index taps = 1;  ///< columns after pv that are the answer of the process to flow
  /// By sample, before the numerator, where the rows are fewer; else empty, the columns tell.
  std::vector<double> response;
  [[nodiscard]] Eigen::Index terms() const { return table.cols() - 1; }  ///< pv left out
  [[nodiscard]] auto answers() const { return table.middleCols(1, taps); }
  [[nodiscard]] auto regressors() const { return table.rightCols(terms()); }
  [[nodiscard]] std::vector<Signal> columns() const { return columns_of(table); }
};

/// Makes the columns of structures that differ in process and noise alone.
class DesignMaker {
 public:
  DesignMaker(const LoopData& data, const std::vector<EffectPtr>& effects);
  [[nodiscard]] Design make(const Structure& structure) const;
  /// The same in the place of another design, whose memory serves again.
  void make(const Structure& structure, Design& design) const;

 private:
  [[nodiscard]] std::vector<Column> effect_columns(const ProcessShape& process,
                                                   const std::vector<double>& response) const;

  const LoopData& data_;
  const std::vector<EffectPtr>& effects_;
  std::vector<double> flow_;
};

}  // namespace loopscope::core::model
