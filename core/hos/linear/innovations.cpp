#include "core/hos/linear/innovations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace loopscope::core::hos {
namespace {

/// Squares of the known values, and how many these are.
struct Squares {
  double sum = 0.0;
  double count = 0.0;

  Squares& operator+=(const Squares& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
};

Squares squares_of(std::span<const double> values) {
  Squares squares;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    squares += {value * value, 1.0};
  }
  return squares;
}

std::vector<Squares> squares_of_blocks(std::span<const double> values) {
  constexpr std::size_t kBlock = Innovations::kBlock;
  std::vector<Squares> blocks;
  for (std::size_t first = 0; first < values.size(); first += kBlock) {
    blocks.push_back(squares_of(values.subspan(first, std::min(kBlock, values.size() - first))));
  }
  return blocks;
}

std::vector<double> local_scale(const std::vector<double>& values) {
  const std::vector<Squares> blocks = squares_of_blocks(values);
  Squares all;
  for (const Squares& block : blocks) all += block;
  const double prior = Innovations::kPriorSamples * all.sum / std::max(all.count, 1.0);
  std::vector<double> scale(values.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Squares around = blocks[b];
    if (b > 0) around += blocks[b - 1];
    if (b + 1 < blocks.size()) around += blocks[b + 1];
    const double square = (around.sum + prior) / (around.count + Innovations::kPriorSamples);
    const std::size_t first = b * Innovations::kBlock;
    std::fill_n(scale.begin() + static_cast<std::ptrdiff_t>(first),
                std::min(Innovations::kBlock, values.size() - first), std::sqrt(square));
  }
  return scale;
}

}  // namespace

Innovations::Innovations(LinearModel model, std::vector<double> values)
    : model_(std::move(model)), values_(std::move(values)), scale_(local_scale(values_)) {}

std::optional<Innovations> Innovations::of(std::span<const double> signal, const Kernels& kernels,
                                           const OrderChoice& order) {
  std::optional<LinearModel> model = LinearModel::fit(signal, kernels, order);
  if (!model) return std::nullopt;
  std::vector<double> values = model->errors(signal, kernels);
  const bool driven = std::ranges::any_of(
      values, [](double value) { return std::isfinite(value) && value != 0.0; });
  if (!driven) return std::nullopt;
  return Innovations(std::move(*model), std::move(values));
}

double Innovations::scatter() const {
  double blocks = 0.0;
  double square = 0.0;
  double fourth = 0.0;
  for (std::size_t t = 0; t < scale_.size(); t += kBlock) {
    const double variance = scale_[t] * scale_[t];
    blocks += 1.0;
    square += variance;
    fourth += variance * variance;
  }
  return std::max(1.0, blocks * fourth / (square * square));
}

Innovations Innovations::reweighted(std::span<const double> signal, const Kernels& kernels) const {
  LinearModel once = model_.reweighted(signal, values_, scale_, kernels);
  std::vector<double> values = once.errors(signal, kernels);
  const Innovations first(std::move(once), std::move(values));
  LinearModel twice = first.model_.reweighted(signal, first.values_, first.scale_, kernels);
  values = twice.errors(signal, kernels);
  return {std::move(twice), std::move(values)};
}

}  // namespace loopscope::core::hos
