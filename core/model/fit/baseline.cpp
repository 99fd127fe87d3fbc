#include "core/model/fit/baseline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/fit/process_starts.hpp"
#include "core/model/fit/trial.hpp"

namespace loopscope::core::model {
namespace {

/// Time constants of 0, 1.4, 3, 6, 14, 33, 100 samples, and an integrator.
constexpr std::array kPoles = {0.0, 0.5, 0.72, 0.85, 0.93, 0.97, 0.99, 1.0};
/// Two lags: one of them a half to all of the other.
constexpr std::array kPolePairs = {std::pair{0.8, 0.7},   std::pair{0.9, 0.85},
                                   std::pair{0.95, 0.92}, std::pair{0.975, 0.96},
                                   std::pair{0.985, 0.9}, std::pair{1.0, 0.85}};

/// A pole of 1 is an integrator; without delay, which is tried afterwards.
ProcessShape undelayed(double pole, double second_pole = 0.0) {
  ProcessShape shape;
  shape.integrating = pole == 1.0;
  shape.pole = pole;
  shape.second_pole = second_pole;
  shape.delay_samples = 0;
  return shape;
}

std::vector<ProcessStart> ranked_starts(const LoopData& data, const Structure& structure,
                                        std::size_t longest, std::span<const double> poles) {
  std::vector<ProcessShape> shapes;
  for (const double pole : poles) shapes.push_back(undelayed(pole));
  std::vector<ProcessStart> starts = process_starts(data, structure, longest, shapes);
  std::ranges::sort(starts, {}, &ProcessStart::error);
  return starts;
}

/// The best (delay, pole pair) of second order, polished.
Fit second_order_fit(const LoopData& data, const Structure& start, std::size_t longest,
                     double to_beat) {
  std::vector<ProcessShape> shapes;
  for (const auto& [slow, fast] : kPolePairs) shapes.push_back(undelayed(slow, fast));
  const std::vector<ProcessStart> starts = process_starts(data, start, longest, shapes);
  Structure structure = start;
  structure.process = std::ranges::min_element(starts, {}, &ProcessStart::error)->shape;
  structure.second_order = true;
  return polish(data, structure, 6, to_beat);
}

/// The best starts that differ: neighbours in delay at the same pole lead to the same fit.
std::vector<ProcessShape> distinct(const std::vector<ProcessStart>& starts, int count) {
  std::vector<ProcessShape> chosen;
  for (const ProcessStart& start : starts) {
    const bool near = std::ranges::any_of(chosen, [&](const ProcessShape& shape) {
      return shape.integrating == start.shape.integrating &&
             std::abs(static_cast<long>(shape.delay_samples) -
                      static_cast<long>(start.shape.delay_samples)) <= 1;
    });
    if (!near) chosen.push_back(start.shape);
    if (static_cast<int>(chosen.size()) == count) break;
  }
  return chosen;
}

/// Another structure, polished, if it earns its penalty; else the fit.
Fit the_better(const LoopData& data, Fit fit, const Structure& other, int iterations,
               double penalty) {
  const double to_beat = error_after(data, fit.fit_error, penalty);
  Fit tried = polish(data, other, iterations, to_beat);
  return tried.fit_error < to_beat ? std::move(tried) : std::move(fit);
}

Fit try_delay_neighbours(const LoopData& data, Fit fit) {
  for (const int move : {-1, 1}) {
    Structure structure = fit.structure;
    if (move < 0 && structure.process.delay_samples == 1) continue;
    structure.process.delay_samples =
        static_cast<std::size_t>(static_cast<long>(structure.process.delay_samples) + move);
    fit = the_better(data, std::move(fit), structure, 3, 0.5);
  }
  return fit;
}

/// BIC: a second lag costs one parameter, a second pair of noise roots two.
Fit try_orders(const LoopData& data, Fit fit) {
  const auto count = static_cast<double>(data.rows.fit_count());
  Structure richer = fit.structure;
  // Between rows that lie apart a second tap says nothing that the delay does not.
  if (!richer.two_taps && data.grid.every_sample()) {
    richer.two_taps = true;
    fit = the_better(data, std::move(fit), richer, 5, std::log(count));
    if (fit.structure.two_taps) fit = try_delay_neighbours(data, std::move(fit));
    richer = fit.structure;
  }
  while (fit.structure.noise.order < kMostNoiseOrder) {
    const std::size_t order = fit.structure.noise.order;
    richer = fit.structure;
    richer.noise = extended(richer.noise, 0.7, 0.6);
    fit = the_better(data, std::move(fit), richer, 8, 2.0 * std::log(count));
    if (fit.structure.noise.order == order) break;
  }
  richer = fit.structure;
  if (!richer.second_order) {
    richer.two_taps = false;
    const std::size_t longest = std::min<std::size_t>(12, data.samples() / 16);
    const double penalty = (fit.structure.two_taps ? 0.0 : 1.0) * std::log(count);
    const double to_beat = error_after(data, fit.fit_error, penalty);
    Fit second = second_order_fit(data, richer, longest, to_beat);
    if (second.fit_error < to_beat) fit = try_delay_neighbours(data, std::move(second));
  }
  return fit;
}

}  // namespace

Fit settle(const LoopData& data, const Fit& fit) {
  return try_delay_neighbours(data, polish(data, fit.structure, 5));
}

ProcessShape glance(const LoopData& data, const Structure& structure) {
  constexpr std::array kFew = {0.4, 0.8, 0.95, 1.0};
  const std::size_t longest = std::min<std::size_t>(15, data.samples() / 16);
  return ranked_starts(data, structure, longest, kFew).front().shape;
}

Fit search_process(const LoopData& data, const Structure& start, const ProcessSearch& search) {
  std::optional<Fit> best;
  const std::size_t longest = std::min(search.longest_delay, data.samples() / 16);
  for (const ProcessShape& shape :
       distinct(ranked_starts(data, start, longest, kPoles), search.starts)) {
    Structure structure = start;
    structure.process = shape;
    structure.process.pole =
        std::min(structure.process.pole, structure.process.integrating ? 1.0 : 0.99);
    Fit fit = best ? polish(data, structure, 8, best->fit_error) : polish(data, structure);
    if (!best || fit.fit_error < best->fit_error) best = std::move(fit);
  }
  return try_orders(data, try_delay_neighbours(data, std::move(*best)));
}

}  // namespace loopscope::core::model
