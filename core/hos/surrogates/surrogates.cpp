#include "core/hos/surrogates/surrogates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/hos/numeric/normal_draw.hpp"

namespace loopscope::core::hos {

Surrogates::Surrogates(std::span<const double> signal, const Innovations& innovations, Null null,
                       std::uint64_t seed)
    : signal_(signal), innovations_(&innovations), null_(null), random_(seed) {
  for (std::size_t t = 0; t < signal.size(); ++t) {
    if (std::isfinite(innovations.values()[t])) {
      known_.push_back(innovations.values()[t]);
      places_.push_back(t);
    } else {
      unknown_.push_back(t);
    }
  }
}

std::size_t Surrogates::below(std::size_t count) {
  return static_cast<std::size_t>(uniform_draw(random_) * static_cast<double>(count));
}

void Surrogates::flip_signs(std::vector<double>& record) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (i % 64 == 0) bits = random_();
    record[places_[i]] = known_[i] * (1.0 - 2.0 * static_cast<double>(bits & 1U));
    bits >>= 1U;
  }
}

void Surrogates::permute(std::vector<double>& record) {
  for (std::size_t left = known_.size(); left > 1; --left) {
    std::swap(known_[left - 1], known_[below(left)]);
  }
  for (std::size_t i = 0; i < places_.size(); ++i) record[places_[i]] = known_[i];
}

void Surrogates::draw(std::vector<double>& record) {
  record.resize(signal_.size());
  for (const std::size_t t : unknown_) record[t] = known_[below(known_.size())];
  if (null_ == Null::permuted) {
    permute(record);
  } else {
    flip_signs(record);
  }
  const LinearModel& model = innovations_->model();
  for (std::size_t t = 0; t < std::min(model.coefficients().size(), record.size()); ++t) {
    record[t] = std::isfinite(signal_[t]) ? signal_[t] - model.mean() : 0.0;
  }
  model.drive(record);
  for (std::size_t t = 0; t < record.size(); ++t) {
    if (!std::isfinite(signal_[t])) record[t] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace loopscope::core::hos
