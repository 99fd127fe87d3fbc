#include "core/model/fit/design.hpp"

#include "core/model/response/whitening.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;

std::vector<double> ramp(std::size_t samples) {
  const auto values = Eigen::VectorXd::LinSpaced(static_cast<Index>(samples), -1.0, 1.0);
  return {values.begin(), values.end()};
}

}  // namespace

std::span<double> column(Eigen::MatrixXd& table, Index at) {
  return {table.col(at).data(), static_cast<std::size_t>(table.rows())};
}

DesignMaker::DesignMaker(const LoopData& data, const std::vector<EffectPtr>& effects)
    : data_(data), effects_(effects), flow_(data.op) {
  for (const EffectPtr& effect : effects_) effect->shape_flow(flow_);
}

std::vector<Column> DesignMaker::effect_columns(const ProcessShape& process,
                                                const std::vector<double>& response) const {
  std::vector<Column> columns;
  std::vector<double> answered;
  for (const EffectPtr& effect : effects_) {
    if (effect->column_count() == 0) continue;
    if (answered.empty()) {
      answered = response;
      weigh(process.numerator, answered);
    }
    effect->add_columns({flow_, answered, process}, columns);
  }
  return columns;
}

Design DesignMaker::make(const Structure& structure) const {
  Design design;
  make(structure, design);
  return design;
}

void DesignMaker::make(const Structure& structure, Design& design) const {
  std::vector<double> response(data_.samples());
  respond(structure.process, flow_, response);
  std::vector<Column> extra = effect_columns(structure.process, response);
  for (Column& signal : extra) keep_rows(data_.grid, signal);
  const bool integrating = structure.process.integrating;
  const std::vector<double> drift = integrating ? ramp(data_.size()) : std::vector<double>{};

  design.response.clear();
  if (!data_.grid.every_sample()) design.response = response;
  keep_rows(data_.grid, response);
  design.taps = structure.two_taps ? 2 : 1;
  const Index offset = 1 + design.taps + static_cast<Index>(extra.size());
  design.table.resize(static_cast<Index>(data_.size()), offset + (integrating ? 2 : 1));
  Whitening whitening;
  whitening.add(data_.pv, column(design.table, 0));
  whitening.add(response, column(design.table, 1));
  Index at = 1 + design.taps;
  for (const Column& signal : extra) whitening.add(signal, column(design.table, at++));
  if (integrating) whitening.add(drift, column(design.table, offset + 1));
  whitening.run(structure.noise);
  if (structure.two_taps) put_later(column(design.table, 1), column(design.table, 2));
  design.table.col(offset).setConstant(whitened_level(structure.noise));
}

}  // namespace loopscope::core::model
