#include "daemon/lab/calibrate/plants.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>

#include "core/plant/false_discovery.hpp"
#include "daemon/lab/calibrate/record_seed.hpp"
#include "daemon/service/threads/in_threads.hpp"

namespace loopscope::daemon {
namespace {

using core::simulate::CalibrationFamily;
using core::simulate::FamilyKind;

std::vector<CalibrationFamily> families_of(FamilyKind kind) {
  std::vector<CalibrationFamily> chosen;
  std::ranges::copy_if(core::simulate::calibration_families(), std::back_inserter(chosen),
                       [kind](const auto& family) { return family.kind == kind; });
  return chosen;
}

const CalibrationFamily& family_of(bool faulty, std::size_t loop) {
  static const auto healthy = families_of(FamilyKind::linear_gaussian);
  static const auto broken = families_of(FamilyKind::nonlinear);
  const auto& families = faulty ? broken : healthy;
  return families[loop % families.size()];
}

std::size_t faulty_loops(const PlantSettings& settings, double share) {
  return static_cast<std::size_t>(std::lround(share * static_cast<double>(settings.loops)));
}

std::size_t most_faulty_loops(const PlantSettings& settings) {
  return faulty_loops(settings, *std::ranges::max_element(settings.fault_shares));
}

/// Plant by plant its healthy loops, then its faulty ones.
std::size_t loops_of_pool(const PlantSettings& settings) {
  return settings.loops + most_faulty_loops(settings);
}

/// The family of faulty loop `i` of a plant. Each plant starts ten families further, as many as the
/// smaller share has faulty loops in a plant of 10 000: so these see every family in a few plants.
const CalibrationFamily& faulty_family(std::size_t plant, std::size_t i) {
  constexpr std::size_t kStep = 10;
  return family_of(true, kStep * plant + i);
}

/// A plant at one fault share while it is judged.
class JudgedPlant {
 public:
  JudgedPlant(const PlantPool& pool, std::size_t plant, std::size_t faulty, double rate)
      : plant_(plant), faulty_(faulty), healthy_(pool.healthy.size() - faulty) {
    p_.assign(pool.healthy.begin(), pool.healthy.end() - static_cast<std::ptrdiff_t>(faulty));
    p_.insert(p_.end(), pool.faulty.begin(),
              pool.faulty.begin() + static_cast<std::ptrdiff_t>(faulty));
    flagged_ = core::plant::control_false_discovery(p_, rate).flagged;
  }

  [[nodiscard]] double flags() const { return count(0, p_.size()); }
  [[nodiscard]] double false_share() const {
    return flags() > 0.0 ? count(0, healthy_) / flags() : 0.0;
  }
  [[nodiscard]] double found_share() const {
    return faulty_ > 0 ? count(healthy_, p_.size()) / static_cast<double>(faulty_) : 0.0;
  }
  void add_to(PlantSummary& summary) const {
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const bool faulty = i >= healthy_;
      const CalibrationFamily& of =
          faulty ? faulty_family(plant_, i - healthy_) : family_of(false, i);
      FamilyFlags& family = summary.families[of.name];
      ++family.loops;
      family.flagged += flagged_[i] ? 1U : 0U;
      summary.untested += std::isnan(p_[i]) ? 1U : 0U;
    }
  }

 private:
  [[nodiscard]] double count(std::size_t begin, std::size_t end) const {
    const auto from = flagged_.begin();
    return static_cast<double>(std::count(from + static_cast<std::ptrdiff_t>(begin),
                                          from + static_cast<std::ptrdiff_t>(end), true));
  }

  std::size_t plant_, faulty_, healthy_;
  std::vector<double> p_;
  std::vector<bool> flagged_;
};

PlantMean mean_of(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  PlantMean result;
  // Divided once at the end: a mean of ones is 1.
  for (const double value : values) result.mean += value;
  result.mean /= count;
  double square = 0.0;
  for (const double value : values) square += (value - result.mean) * (value - result.mean);
  if (values.size() > 1) result.standard_error = std::sqrt(square / (count - 1.0) / count);
  return result;
}

PlantSummary judge(const PlantSettings& settings, std::span<const PlantPool> pools, double share) {
  PlantSummary summary;
  summary.fault_share = share;
  summary.plants = pools.size();
  summary.loops = settings.loops;
  summary.faulty = faulty_loops(settings, share);
  std::vector<double> flags, false_shares, found_shares;
  for (std::size_t plant = 0; plant < pools.size(); ++plant) {
    const JudgedPlant judged(pools[plant], plant, summary.faulty, settings.rate);
    flags.push_back(judged.flags());
    false_shares.push_back(judged.false_share());
    found_shares.push_back(judged.found_share());
    judged.add_to(summary);
  }
  summary.flags = mean_of(flags);
  summary.false_share = mean_of(false_shares);
  summary.found_share = mean_of(found_shares);
  return summary;
}

}  // namespace

std::size_t drawn_loops(const PlantSettings& settings) {
  return settings.plants * loops_of_pool(settings);
}

std::vector<PlantPool> draw_plants(const PlantSettings& settings, std::size_t threads,
                                   const std::function<RecordP()>& make_p,
                                   const std::function<void()>& loop_done) {
  const std::size_t faulty = most_faulty_loops(settings);
  const PlantPool empty{std::vector<double>(settings.loops), std::vector<double>(faulty)};
  std::vector<PlantPool> pools(settings.plants, empty);
  std::mutex mutex;
  in_threads(drawn_loops(settings), threads, [&]() -> IndexedTask {
    return [&, p_of = make_p()](std::size_t index) {
      const std::size_t plant = index / loops_of_pool(settings);
      const std::size_t place = index % loops_of_pool(settings);
      const bool is_faulty = place >= settings.loops;
      const CalibrationFamily& family =
          is_faulty ? faulty_family(plant, place - settings.loops) : family_of(false, place);
      const std::uint64_t seed = record_seed("plant/" + family.name, index);
      const double p = p_of(family.draw(family.samples, seed));
      (is_faulty ? pools[plant].faulty[place - settings.loops] : pools[plant].healthy[place]) = p;
      const std::lock_guard lock(mutex);
      loop_done();
    };
  });
  return pools;
}

std::vector<PlantSummary> judge_plants(const PlantSettings& settings,
                                       std::span<const PlantPool> pools) {
  std::vector<PlantSummary> summaries;
  for (const double share : settings.fault_shares) {
    summaries.push_back(judge(settings, pools, share));
  }
  return summaries;
}

}  // namespace loopscope::daemon
