#include "core/model/valve_search/stiction_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "core/hos/numeric/normal_draw.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/fit/fit_variants.hpp"
#include "core/model/fit/trial.hpp"
#include "core/model/valve_search/valve_guess.hpp"

namespace loopscope::core::model {
namespace {

// Chosen on 192 sticking loops of tests/effects (seed 770000 on) by how much of what the best
// search finds was found (MEASURED.md).
constexpr std::size_t kFirstWindow = 640;
constexpr double kWindowGrowth = 1.42;
constexpr std::size_t kGuesses = 2000;
constexpr std::size_t kParents = 200;
constexpr std::size_t kFewestParents = 8;
constexpr double kParentsKept = 0.7;
constexpr std::size_t kChildren = 5;
constexpr int kGenerations = 2;
constexpr int kLastGenerations = 10;
/// Of the way between two guesses, at most.
constexpr double kLongestShare = 0.7;
/// Of how far guesses lie apart, in the first window; what it becomes from window to window.
constexpr double kFirstScale = 0.7;
constexpr double kCooling = 0.64;
/// From here on guesses of play tell that the valve has no more.
constexpr std::size_t kTellingRows = 1500;
/// From here on the noise is fitted again behind the best guess.
constexpr std::size_t kFitFrom = 1000;
/// From here on a search is given up whose best guess is so far behind the rival, in n ln.
constexpr std::size_t kRaceFrom = 900;
constexpr double kFarBehind = 40.0;

std::vector<Range> cut_off(std::vector<Range> ranges, std::size_t end) {
  for (Range& range : ranges) range.end = std::min(range.end, end);
  std::erase_if(ranges, [](const Range& range) { return range.first >= range.end; });
  return ranges;
}

LoopData beginning(const LoopData& data, std::size_t rows) {
  if (rows >= data.size()) return data;
  LoopData result = data;
  result.pv.resize(rows);
  result.op.resize(data.grid.sample_of(rows - 1) + 1);
  result.rows = {cut_off(data.rows.fit, rows), cut_off(data.rows.score, rows), {}};
  return result;
}

class Evolution {
 public:
  Evolution(const LoopData& data, Structure behind, double band, ValveLaw law, std::size_t attempt,
            const Structure* rival)
      : data_(data), start_(std::move(behind)), rival_(rival), law_(law), random_(attempt) {
    start_.two_taps = false;
    for (std::size_t i = 0; i < kGuesses; ++i)
      guesses_.push_back(drawn_genes(band, attempt * kGuesses + i));
  }

  GridResult run() {
    auto window = static_cast<double>(kFirstWindow);
    while (window < static_cast<double>(data_.size())) {
      const LoopData seen = beginning(data_, static_cast<std::size_t>(window));
      look_at(seen, kGenerations);
      if (seen.size() >= kRaceFrom && is_far_behind(seen)) return given_up();
      if (seen.size() >= kTellingRows && are_plays()) return found(0);
      if (seen.size() >= kFitFrom) start_.noise = fitted(seen, 3).structure.noise;
      window *= kWindowGrowth;
      scale_ *= kCooling;
      parents_ = std::max(kFewestParents,
                          static_cast<std::size_t>(kParentsKept * static_cast<double>(parents_)));
    }
    return found(kLastGenerations);
  }

 private:
  void look_at(const LoopData& seen, int generations) {
    const FitVariants variants(seen, start_);
    rate(guesses_, variants);
    keep_best();
    for (int i = 0; i < generations; ++i) {
      std::vector<ValveGuess> children = born();
      rate(children, variants);
      guesses_.insert(guesses_.end(), children.begin(), children.end());
      keep_best();
    }
  }

  [[nodiscard]] GridResult given_up() const {
    return {start_, std::numeric_limits<double>::infinity()};
  }

  /// Noise and rows are those of the guesses.
  [[nodiscard]] bool is_far_behind(const LoopData& seen) const {
    if (rival_ == nullptr) return false;
    Structure rival = *rival_;
    rival.noise = start_.noise;
    return guesses_.front().fit_error >
           error_after(seen, evaluate(seen, rival).fit_error, -kFarBehind);
  }

  /// The best quarter hardly jumps.
  [[nodiscard]] bool are_plays() const {
    const std::size_t best = std::max<std::size_t>(1, guesses_.size() / 4);
    return std::all_of(
        guesses_.begin(), guesses_.begin() + static_cast<std::ptrdiff_t>(best),
        [](const ValveGuess& guess) { return guess[Gene::jump_share] < ValveEffect::kPlay; });
  }

  std::vector<ValveGuess> born() {
    std::vector<ValveGuess> children;
    for (const ValveGuess& parent : guesses_) {
      for (std::size_t i = 0; i < kChildren; ++i) {
        const ValveGuess& from = any_guess();
        const ValveGuess& to = any_guess();
        const double share = kLongestShare * hos::uniform_draw(random_);
        children.push_back(varied(parent, {from, to, share}, scale_, children_++));
      }
    }
    return children;
  }

  GridResult found(int generations) {
    look_at(data_, generations);
    Fit fit = fitted(data_, 6);
    return {std::move(fit.structure), fit.fit_error};
  }

  const ValveGuess& any_guess() { return guesses_[random_() % guesses_.size()]; }

  void rate(std::vector<ValveGuess>& guesses, const FitVariants& variants) const {
    std::vector<ValveEffect> valves;
    std::vector<ProcessShape> processes;
    valves.reserve(guesses.size());
    for (const ValveGuess& guess : guesses) {
      valves.push_back(valve_of(guess, law_, data_.op.front()));
      processes.push_back(process_of(guess, start_.process));
    }
    std::vector<ValveAndProcess> pairs;
    for (std::size_t i = 0; i < guesses.size(); ++i) pairs.push_back({&valves[i], &processes[i]});
    const std::vector<double> errors = variants.fit_errors(pairs, Digits::single);
    for (std::size_t i = 0; i < guesses.size(); ++i) {
      guesses[i].fit_error = errors[i];
      // What has overflown comes last.
      if (std::isnan(errors[i])) guesses[i].fit_error = std::numeric_limits<double>::infinity();
    }
  }

  /// Of those that leave the same error the first ones.
  void keep_best() {
    std::vector<std::pair<double, std::size_t>> ranked;
    for (std::size_t i = 0; i < guesses_.size(); ++i) ranked.emplace_back(guesses_[i].fit_error, i);
    const std::size_t count = std::min(parents_, ranked.size());
    std::ranges::partial_sort(ranked, ranked.begin() + static_cast<std::ptrdiff_t>(count));
    std::vector<ValveGuess> best;
    for (std::size_t i = 0; i < count; ++i) best.push_back(guesses_[ranked[i].second]);
    guesses_ = std::move(best);
  }

  [[nodiscard]] Fit fitted(const LoopData& seen, int iterations) const {
    Structure best = start_;
    best.process = process_of(guesses_.front(), start_.process);
    best.effects.back() =
        std::make_shared<ValveEffect>(valve_of(guesses_.front(), law_, data_.op.front()));
    return polish(seen, best, iterations);
  }

  const LoopData& data_;
  Structure start_;         ///< with the noise as it was fitted last
  const Structure* rival_;  ///< nullptr = none
  ValveLaw law_;
  std::vector<ValveGuess> guesses_;
  std::size_t parents_ = kParents;
  std::size_t children_ = 0;
  std::mt19937_64 random_;
  double scale_ = kFirstScale;
};

}  // namespace

bool can_seek_sticking(const Structure& behind) {
  return std::all_of(behind.effects.begin(), behind.effects.end() - 1,
                     [](const EffectPtr& effect) { return is_from_outside(effect->kind()); });
}

GridResult find_stem(const LoopData& data, const Structure& behind, double band, ValveLaw law,
                     std::size_t attempt, const Structure* rival) {
  return Evolution(data, behind, band, law, attempt, rival).run();
}

}  // namespace loopscope::core::model
