#include "core/model/design.hpp"

#include <algorithm>
#include <span>

namespace loopscope::core::model {
namespace {

using Eigen::Index;

std::span<double> column(Design& design, Index at) {
  return {design.table.col(at).data(), static_cast<std::size_t>(design.table.rows())};
}

/// One sample later; before the record as in its first row. Whitening such a signal gives the same.
void put_later(std::span<const double> signal, std::span<double> later) {
  if (signal.empty()) return;
  later[0] = signal[0];
  std::copy(signal.begin(), signal.end() - 1, later.begin() + 1);
}

/// Columns to be whitened, taken two at a time.
struct Whitening {
  std::vector<std::span<const double>> from;
  std::vector<std::span<double>> to;

  void add(std::span<const double> signal, std::span<double> whitened) {
    from.push_back(signal);
    to.push_back(whitened);
  }

  void run(const NoiseModel& noise) const {
    std::size_t at = 0;
    for (; at + 2 <= from.size(); at += 2) {
      whiten(noise, {from[at], from[at + 1]}, {to[at], to[at + 1]});
    }
    if (at < from.size()) whiten(noise, from[at], to[at]);
  }
};

std::vector<double> ramp(std::size_t samples) {
  const auto values = Eigen::VectorXd::LinSpaced(static_cast<Index>(samples), -1.0, 1.0);
  return {values.begin(), values.end()};
}

}  // namespace

std::vector<Signal> Design::columns() const {
  std::vector<Signal> result;
  for (Index at = 0; at < table.cols(); ++at) result.push_back(table.col(at).data());
  return result;
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
  std::vector<double> response(data_.size());
  respond(structure.process, flow_, response);
  const std::vector<Column> extra = effect_columns(structure.process, response);
  const bool integrating = structure.process.integrating;
  const std::vector<double> drift = integrating ? ramp(data_.size()) : std::vector<double>{};

  Design design;
  design.taps = structure.two_taps ? 2 : 1;
  const Index offset = 1 + design.taps + static_cast<Index>(extra.size());
  design.table.resize(static_cast<Index>(data_.size()), offset + (integrating ? 2 : 1));
  Whitening whitening;
  whitening.add(data_.pv, column(design, 0));
  whitening.add(response, column(design, 1));
  Index at = 1 + design.taps;
  for (const Column& signal : extra) whitening.add(signal, column(design, at++));
  if (integrating) whitening.add(drift, column(design, offset + 1));
  whitening.run(structure.noise);
  if (structure.two_taps) put_later(column(design, 1), column(design, 2));
  design.table.col(offset).setConstant(whitened_level(structure.noise));
  return design;
}

}  // namespace loopscope::core::model
