#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "config/settings.hpp"
#include "core/plant/cascade.hpp"
#include "core/plant/event.hpp"
#include "core/plant/loop_records.hpp"
#include "core/plant/member_loop.hpp"
#include "daemon/plant/plant_series.hpp"
#include "storage/results/plant/plant_candidates.hpp"

namespace loopscope::daemon {

/// The loops of one comparison, read in three steps, so that ten thousand fit into memory:
/// everybody's error, packed; a longer span of those that swing too slowly for their window; error,
/// sp, pv and op of the members of what was found. Every step returns false when the
/// process shall end, and throws as read_plant_series(); read_longer() only says in the log that a
/// database has failed, and loops that were not read before that stay without longer spans. For one
/// thread.
class ComparedLoops {
 public:
  ComparedLoops(std::vector<storage::PlantCandidate> candidates, const config::Settings& settings,
                SharedServices& tools);

  [[nodiscard]] bool read_errors();
  [[nodiscard]] bool read_longer();
  /// The records of all loops but the members go.
  void keep_only(std::span<const core::plant::Event> events);
  [[nodiscard]] bool read_members(std::span<const core::plant::Event> events);
  /// Of the members, in their newest windows as they were sampled; once they are read.
  [[nodiscard]] std::span<const core::plant::CascadePair> cascades() const { return cascades_; }

  /// What is searched, in the order of the candidates; that of one whose rows are gone is empty,
  /// and after keep_only() that of all but members.
  [[nodiscard]] std::span<const core::plant::LoopRecords> records() const { return records_; }
  /// The same loops; only members have series, once they are read.
  [[nodiscard]] std::span<const core::plant::MemberLoop> loops() const { return loops_; }
  /// Whose rows were there; 0 before read_errors().
  [[nodiscard]] std::int64_t read() const { return read_; }
  [[nodiscard]] std::int64_t oscillating() const { return oscillating_; }

 private:
  [[nodiscard]] bool read_longer(std::span<const std::size_t> slow);
  [[nodiscard]] bool read_earlier(std::span<const std::size_t> slow);
  [[nodiscard]] bool read_members(std::span<const std::size_t> members, std::size_t windows);

  void show(std::size_t loop, PlantSeries series);
  void count_read();

  std::vector<storage::PlantCandidate> candidates_;
  const config::Settings& settings_;
  SharedServices& tools_;
  std::vector<core::plant::LoopRecords> records_;
  std::vector<core::plant::MemberLoop> loops_;  // views of series_
  std::vector<core::plant::CascadePair> cascades_;
  std::vector<PlantSeries> series_;  // of every loop; empty = not read
  std::int64_t read_ = 0, oscillating_ = 0;
};

}  // namespace loopscope::daemon
