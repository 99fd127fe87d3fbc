#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "storage/results/plant/plant_picture.hpp"

namespace loopscope::storage {

class Transaction;

/// A loop that takes part in a shared oscillation.
struct PlantMember {
  std::int64_t loop_id = 0;
  std::string role;             ///< source, victim, cascade_slave, cascade_master or member
  double strength = 0.0;        ///< share of the error's variance at the period, 0 to 1
  double lag_s = 0.0;           ///< how much later than the source it swings, seconds
  std::optional<double> score;  ///< probability of being the source, 0 to 1
  std::vector<std::string> reasons = {};  ///< what speaks for and against it, sentences
};

/// An oscillation that loops share.
struct PlantEvent {
  double period_s = 0.0;                       ///< > 0
  std::optional<std::int64_t> source_loop_id;  ///< nullopt = outside or unknown
  std::string statement;                       ///< why that loop, in words
  std::optional<double> p;           ///< that loops which have nothing in common agree so well
  std::vector<PlantMember> members;  ///< two at least
  std::optional<double> outside =
      {};  ///< probability that no member is the source; nullopt = unknown
  std::vector<PlantLead> leads = {};    ///< who foretells whom, strongest first
  std::vector<PlantTrace> traces = {};  ///< what is drawn, strongest member first
};

/// One comparison across all loops, with or without a finding.
struct PlantRoundRecord {
  std::int64_t slot_end_us = 0;  ///< microseconds UTC; the key together with the revision
  int algorithm_revision = core::kAlgorithmRevision;
  std::int64_t loops = 0;        ///< looked at
  std::int64_t oscillating = 0;  ///< of these
  std::vector<PlantEvent> events;
};

/// Writes the round; one of the same slot and revision is replaced. From then on it is the round
/// that holds, unless there is one of a later slot. Events are numbered by the number of their
/// members, most first. In the caller's transaction, by Session::transact().
void write_plant_round(Transaction& transaction, const PlantRoundRecord& round);

}  // namespace loopscope::storage
