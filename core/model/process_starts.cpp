#include "core/model/process_starts.hpp"

#include <algorithm>

#include "core/model/products.hpp"
#include "core/model/whitening.hpp"

namespace loopscope::core::model {
namespace {

/// A signal of which every delay up to the longest is asked; nothing before the record.
class Delayed {
 public:
  Delayed(const std::vector<double>& signal, std::size_t longest)
      : longest_(longest), padded_(longest + signal.size()), squares_(padded_.size() + 1) {
    std::ranges::copy(signal, padded_.begin() + static_cast<std::ptrdiff_t>(longest));
    for (std::size_t k = 0; k < padded_.size(); ++k) {
      squares_[k + 1] = squares_[k] + padded_[k] * padded_[k];
    }
  }

  [[nodiscard]] Signal by(std::size_t delay) const { return &padded_[longest_ - delay]; }

  [[nodiscard]] double squares(std::size_t delay, const std::vector<Range>& rows) const {
    double sum = 0.0;
    for (const Range& range : rows) {
      sum += squares_[range.end + longest_ - delay] - squares_[range.first + longest_ - delay];
    }
    return sum;
  }

 private:
  std::size_t longest_;
  std::vector<double> padded_;
  std::vector<double> squares_;  ///< sums of those before
};

/// Error of pv on s(k-d) for every delay d: dead time is a shift of the whitened column.
void try_delays(const LoopData& data, const std::vector<double>& pv, const std::vector<double>& s,
                ProcessShape shape, std::size_t longest, std::vector<ProcessStart>& starts) {
  const auto& rows = data.rows.fit;
  const Delayed delayed(s, longest);
  std::vector<Signal> all;
  for (std::size_t d = 1; d <= longest; ++d) all.push_back(delayed.by(d));
  const Signal output = pv.data();
  const Eigen::MatrixXd right = products({&output, 1}, all, rows);
  const double total = sum_of_squares(output, rows);
  for (std::size_t d = 1; d <= longest; ++d) {
    const double square = delayed.squares(d, rows);
    const double both = right(0, static_cast<Eigen::Index>(d - 1));
    shape.delay_samples = d;
    starts.push_back({shape, total - (square > 0.0 ? both * both / square : 0.0), total});
  }
}

}  // namespace

std::vector<ProcessStart> process_starts(const LoopData& data, const Structure& structure,
                                         std::size_t longest,
                                         std::span<const ProcessShape> shapes) {
  std::vector<double> flow = data.op;
  for (const EffectPtr& effect : structure.effects) effect->shape_flow(flow);
  std::vector<std::vector<double>> signals(shapes.size() + 1, data.pv);
  Whitening whitening;
  whitening.add(signals.back(), signals.back());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    respond(shapes[i], flow, signals[i]);
    whitening.add(signals[i], signals[i]);
  }
  whitening.run(structure.noise);
  std::vector<ProcessStart> starts;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    try_delays(data, signals.back(), signals[i], shapes[i], longest, starts);
  }
  return starts;
}

}  // namespace loopscope::core::model
