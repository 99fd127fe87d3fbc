#include "core/hos/surrogates/surrogate_test.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::hos {
namespace {

constexpr std::size_t kEnough = 2;

double evidence_of(double p) {
  return -std::log(above_zero(p));
}

/// One of the statistics, where it is to be looked at.
std::optional<SurrogateP> ask(std::optional<double> p, double unclear) {
  return p && *p < unclear ? std::optional<SurrogateP>(*p) : std::nullopt;
}

bool waits(const std::optional<SurrogateP>& asked) {
  return asked && !asked->settled();
}

}  // namespace

SurrogateP::SurrogateP(double first_pass_p)
    : first_pass_p_(first_pass_p), evidence_(evidence_of(first_pass_p)) {}

void SurrogateP::add(double first_pass_p) {
  if (settled_) return;
  draws_.push_back(evidence_of(first_pass_p));
  const bool exceeds = draws_.back() >= evidence_;
  if (exceeds) ++exceeding_;
  const bool early = exceeds && draws_.size() <= kEarly;
  settled_ = early || exceeding_ >= kEnough || draws_.size() >= kMost;
}

double SurrogateP::tail_p() const {
  std::vector<double> sorted = draws_;
  std::ranges::sort(sorted, std::greater<>());
  const std::size_t in_tail = sorted.size() / 4;
  const double begin = sorted[in_tail];
  double excess = 0.0;
  for (std::size_t i = 0; i < in_tail; ++i) excess += sorted[i] - begin;
  const auto count = static_cast<double>(in_tail);
  // One standard error on the safe side; Gaussian noise has 1.
  const double scale = std::max(1.0, excess / count * (1.0 + 1.0 / std::sqrt(count)));
  const double share = count / static_cast<double>(sorted.size());
  return share * std::exp(-std::max(0.0, evidence_ - begin) / scale);
}

double SurrogateP::p() const {
  if (draws_.empty()) return first_pass_p_;
  const auto count = static_cast<double>(draws_.size());
  const double share = static_cast<double>(exceeding_) / count;
  const double p = draws_.size() < kMost || exceeding_ >= kEnough ? share : tail_p();
  return above_zero(std::max(p, first_pass_p_));
}

CouplingTests against_surrogates(const CouplingTests& found, double unclear,
                                 const std::function<CouplingTests(bool harmonics)>& next) {
  std::optional<SurrogateP> mean = ask(found.mean_p, unclear);
  std::optional<SurrogateP> nli = ask(found.nli_p, unclear);
  std::optional<SurrogateP> cubic = ask(found.cubic_p, unclear);
  while (waits(mean) || waits(nli) || waits(cubic)) {
    const CouplingTests drawn = next(waits(nli) || waits(cubic));
    if (mean) mean->add(drawn.mean_p);
    if (nli) nli->add(drawn.nli_p);
    if (cubic) cubic->add(drawn.cubic_p.value_or(1.0));
  }
  CouplingTests held = found;
  if (mean) held.mean_p = mean->p();
  if (nli) held.nli_p = nli->p();
  if (cubic) held.cubic_p = cubic->p();
  return held;
}

}  // namespace loopscope::core::hos
