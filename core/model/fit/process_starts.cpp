#include "core/model/fit/process_starts.hpp"

#include <algorithm>

#include "core/model/response/products.hpp"
#include "core/model/response/whitening.hpp"

namespace loopscope::core::model {
namespace {

/// A signal of which every delay up to the longest is asked; nothing before the record.
class Delayed {
 public:
  Delayed(const std::vector<double>& signal, std::size_t longest)
      : longest_(longest), padded_(longest + signal.size()) {
    std::ranges::copy(signal, padded_.begin() + static_cast<std::ptrdiff_t>(longest));
  }

  [[nodiscard]] Signal by(std::size_t delay) const { return &padded_[longest_ - delay]; }

  /// By how much the sum of squares over the rows grows with a delay of one more: each range takes
  /// in the sample before it and lets its last one go.
  [[nodiscard]] double more_squares(std::size_t delay, const std::vector<Range>& rows) const {
    const Signal before = by(delay + 1);
    double sum = 0.0;
    for (const Range& range : rows) {
      const double come = before[range.first], gone = before[range.end];
      sum += come * come - gone * gone;
    }
    return sum;
  }

 private:
  std::size_t longest_;
  std::vector<double> padded_;
};

/// Error of pv on s, which is `later` samples late already, for every delay from there on, a row
/// apart, up to the longest: dead time is a shift of the whitened column.
void try_delays(const LoopData& data, const std::vector<double>& pv, const std::vector<double>& s,
                ProcessShape shape, std::size_t later, std::size_t longest,
                std::vector<ProcessStart>& starts) {
  const auto& rows = data.rows.fit;
  const std::size_t apart = data.grid.samples_per_row;
  const std::size_t first = later == 0 ? 1 : 0;  // in rows; no delay at all is none to try
  const std::size_t last = (longest - later) / apart;
  if (first > last) return;
  const Delayed delayed(s, last);
  std::vector<Signal> all;
  for (std::size_t d = first; d <= last; ++d) all.push_back(delayed.by(d));
  const Signal output = pv.data();
  const Eigen::MatrixXd right = products({&output, 1}, all, rows);
  const double total = sum_of_squares(output, rows);
  double square = sum_of_squares(delayed.by(first), rows);
  for (std::size_t d = first; d <= last; ++d) {
    const double both = right(0, static_cast<Eigen::Index>(d - first));
    shape.delay_samples = later + d * apart;
    starts.push_back({shape, total - (square > 0.0 ? both * both / square : 0.0), total});
    if (d < last) square += delayed.more_squares(d, rows);
  }
}

}  // namespace

std::vector<ProcessStart> process_starts(const LoopData& data, const Structure& structure,
                                         std::size_t longest,
                                         std::span<const ProcessShape> shapes) {
  std::vector<double> flow = data.op;
  for (const EffectPtr& effect : structure.effects) effect->shape_flow(flow);
  // Delays within a row have to be tried apart: the rows see other samples.
  const std::size_t phases = std::min(data.grid.samples_per_row, longest + 1);
  std::vector<std::vector<double>> signals{data.pv};
  std::vector<double> response(flow.size());
  for (const ProcessShape& shape : shapes) {
    respond(shape, flow, response);
    for (std::size_t later = 0; later < phases; ++later)
      signals.push_back(at_rows(data.grid, response, later));
  }
  Whitening whitening;
  for (std::vector<double>& signal : signals) whitening.add(signal, signal);
  whitening.run(structure.noise);
  std::vector<ProcessStart> starts;
  for (std::size_t i = 0; i + 1 < signals.size(); ++i) {
    try_delays(data, signals.front(), signals[i + 1], shapes[i / phases], i % phases, longest,
               starts);
  }
  return starts;
}

}  // namespace loopscope::core::model
