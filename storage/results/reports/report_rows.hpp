#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/results/plant/plant_picture.hpp"

namespace loopscope::storage {

// Times are microseconds UTC since 1970; figures and p that are nullopt were not computed.

/// A row of the view `flagged_loop`: a loop that somebody should act on.
struct FlaggedRow {
  std::int64_t rank = 0;  ///< 1 = act here first; 0 = not flagged (ReportDatabase::latest)
  std::int64_t loop_id = 0;
  std::string loop_name, source;
  std::optional<std::string> loop_type;  ///< flow, pressure, ...; nullopt = not said
  std::optional<std::string> area = std::nullopt, unit = std::nullopt, description = std::nullopt;
  std::string pv_unit;       ///< of sp and pv; empty = not said
  std::string code;          ///< the verdict
  double score = 0.0;        ///< severity x importance x kind_weight x believed()
  double severity = 0.0;     ///< 0 to 1
  double importance = 0.0;   ///< > 0, 1 = ordinary
  double kind_weight = 0.0;  ///< > 0; 0 = the verdict is no fault
  double confidence = 0.0;   ///< 0 to 1, by the newest window
  /// The same by all windows together; nullopt = the code is no cause, or nothing was combined.
  std::optional<double> combined_confidence;
  std::optional<double> fault_probability;  ///< that anything is wrong; nullopt = not weighed
  std::optional<double> p;                  ///< of the test behind the verdict; nullopt = a fact
  std::optional<double> nonlinear_p;
  std::string status;         ///< "watch" or "confirmed"
  std::int64_t since_us = 0;  ///< slot of the first verdict of the run, or of the stay on the list
  bool or_earlier = false;    ///< no window before it was judged
  std::int64_t slot_end_us = 0;
  int algorithm_revision = 0, input_revision = 0;
  std::int64_t analysis_id = 0;
  std::string summary;
  std::vector<std::string> reasons;
  std::string action;
  std::optional<double> ngi, nli;
  std::optional<double> oscillation_period_s;  ///< seconds
  std::optional<double> harris_low, harris_high;
  std::optional<std::int64_t> plant_oscillation_number;  ///< of the one that it is the source of

  [[nodiscard]] double believed() const { return combined_confidence.value_or(confidence); }
  /// Whether it is known to have begun after that time.
  [[nodiscard]] bool began_after(std::int64_t time_us) const {
    return since_us > time_us && !or_earlier;
  }
};

/// Why loops cannot be judged, in words, with what mends it.
struct UnjudgedReason {
  std::string words, remedy;
  std::int64_t loops = 0;
  std::vector<std::string> names = {};  ///< of the first twenty loops
};

/// A loop on which no controller acts.
struct NotControllingRow {
  std::int64_t loop_id = 0;
  std::string loop_name;
  std::optional<std::string> area;
  std::string lost_by;                   ///< mode or constant_output
  std::optional<std::int64_t> since_us;  ///< nullopt = not known
  std::optional<double> week_fraction;   ///< share of the last seven days with a controller
};

/// What keeps a loop's newest fault from the list (view hidden_loop).
struct HiddenRow {
  std::string hidden_by;  ///< acknowledged, suppressed, false_positive, victim, probability, chance
  std::string reason;     ///< "" = none was given
  std::string author;     ///< "" = the program
  std::int64_t entered_us = 0;           ///< 0 = never: it follows from the newest window
  std::optional<std::int64_t> until_us;  ///< nullopt = when withdrawn, or the next plant round
  std::optional<std::int64_t> plant_oscillation_number;  ///< that it is a victim of
  std::optional<std::string> source_name;                ///< of that; nullopt = outside or unknown
  /// In whose name, as the author says; nullopt = in the author's own.
  std::optional<std::string> on_behalf_of = std::nullopt;
};

/// A row of the view `hidden_loop`: a finding that is kept off the list.
struct HiddenLoopRow {
  std::int64_t loop_id = 0;
  std::string loop_name;
  std::string code;  ///< the newest verdict
  HiddenRow said;
  /// By which somebody took it off; nullopt = it follows from the newest windows.
  std::optional<std::int64_t> annotation_id = std::nullopt;
};

/// How the plant stands, for the first screen of a report. Enabled loops fall into `judged`,
/// `not_controlling`, `unjudgeable` and `never_analysed`, whose sum is `enabled`.
struct PlantCounts {
  std::int64_t loops = 0;                ///< in the catalogue
  std::int64_t enabled = 0;              ///< of these
  std::int64_t judged = 0;               ///< enabled, with a verdict on the loop
  std::int64_t not_controlling = 0;      ///< enabled, no controller acts on them
  std::optional<double> service_factor;  ///< mean share of the week with a controller, 0 to 1
  std::int64_t flagged = 0;              ///< rows of flagged_loop
  std::int64_t new_flags = 0;            ///< of those: known to have begun after `since_us`
  std::int64_t fixed = 0;                ///< jobs with work after `since_us` whose word is "fixed"
  std::int64_t unjudgeable = 0;          ///< enabled, the newest window was not usable
  std::int64_t never_analysed = 0;       ///< enabled, without any verdict
  std::int64_t victims = 0;              ///< enabled, hidden as victims of a shared oscillation
  std::int64_t annotated = 0;            ///< enabled, with a fault that an annotation hides
  std::int64_t unlisted = 0;             ///< enabled, a fault is probable, not enough for the list
  std::vector<UnjudgedReason> reasons;   ///< of the unjudgeable, most loops first
  std::vector<NotControllingRow> without_controller;  ///< by area and name
  std::int64_t annotations = 0;  ///< behind `annotated`; several may hide a finding
  std::vector<HiddenLoopRow> newest_annotations;  ///< of those, at most thirty, the newest first
  std::int64_t now_us = 0;  ///< the database's clock at the beginning of the view
};

/// One slot of a loop's history: the newest revision of it, oldest slot first.
struct HistoryPoint {
  std::int64_t slot_end_us = 0;
  std::string code;
  double confidence = 0.0;  ///< 0 to 1
  std::optional<double> ngi, nli, nonlinear_p;
  std::optional<double> error_std;  ///< pv units
  std::optional<double> harris_low, harris_high;
  std::optional<double> oscillation_period_s;  ///< seconds
};

/// One figure before and after a repair, each the mean of some windows (of ratios: the geometric
/// one) with its 90 % interval (view maintenance_figure).
struct RepairFigure {
  std::string name;  ///< of figure_kind: "error_std", "valve_stiction.S", ...
  std::string unit, meaning;
  std::optional<double> before, before_low, before_high;
  std::optional<double> after, after_low, after_high;
  bool is_ratio = false;  ///< whether `change` is after over before, else after minus before
  std::optional<double> change, change_low, change_high;
};

/// One maintenance event and what it changed, newest first.
struct RepairRow {
  std::int64_t maintenance_event_id = 0, loop_id = 0;
  std::string loop_name;
  std::int64_t done_at_us = 0;
  std::string kind, description;
  std::optional<std::string>
      word;               ///< fixed, improved, unchanged, worse; nullopt = not (yet) known
  std::string statement;  ///< why that word
  std::optional<std::string> code_before, code_after;  ///< of the nearest windows
  std::vector<RepairFigure> figures;                   ///< by name; empty = none can be compared
  /// That were compared; nullopt = not judged yet.
  std::optional<std::int64_t> windows_before = std::nullopt, windows_after = std::nullopt;
  std::string author = {};  ///< login that entered it
  /// In whose name, as the login says; nullopt = in its own.
  std::optional<std::string> on_behalf_of = std::nullopt;
};

/// One oscillation that loops share, of the newest plant round; the one with most loops first.
struct PlantOscillationRow {
  struct Member {
    std::int64_t loop_id = 0;
    std::string loop_name;
    std::string role;       ///< source, victim, cascade_slave, cascade_master, member
    double strength = 0.0;  ///< share of the error's variance at the period, 0 to 1
    double lag_s = 0.0;     ///< how much later than the source it swings, seconds, within half a
                            ///< period either way
    std::optional<double> score;  ///< probability of being the source, 0 to 1; of a program before
                                  ///< revision 26: higher = more
    std::vector<std::string> reasons = {};  ///< for and against it as the source
  };
  std::int64_t number = 0;
  double period_s = 0.0;
  std::optional<std::string> source_name;  ///< nullopt = outside or unknown
  std::string statement;
  std::vector<Member> members;  ///< source first, then by strength
  std::int64_t slot_end_us = 0;
  std::optional<double> p;        ///< that so many loops share a period by chance
  std::optional<double> outside;  ///< probability that no member is the source; nullopt = not said,
                                  ///< as leads and traces are empty: a program before schema 27
  std::vector<PlantLead> leads = {};    ///< strongest first
  std::vector<PlantTrace> traces = {};  ///< of the strongest members, strongest first
};

/// The shared oscillation that a loop follows, without being its source.
struct FollowedRow {
  std::int64_t number = 0;
  double period_s = 0.0;
  std::optional<std::string> source_name;  ///< nullopt = outside or unknown
  std::string role;                        ///< victim, cascade_slave, cascade_master, member
  double strength = 0.0;                   ///< share of the error's variance, 0 to 1
  /// What the loop's newest verdict is shown as: its code, but external_disturbance for a healthy
  /// loop that the oscillation shakes.
  std::string shown_code;
};

/// What is wrong with a loop's newest data, and what mends it.
struct DataProblemRow {
  std::string code, role, tag;  ///< role and tag are empty where they are not known
  std::string words, remedy;
  std::int64_t since_us = 0;
  bool judged = false;  ///< whether the loop could be judged all the same
};

/// A loop under other thresholds beside the present ones.
struct WhatIfRow {
  /// As it would stand; where `change` is "lost", as it stands today.
  FlaggedRow flagged;
  std::string change;  ///< "kept", "gained" or "lost"
};

}  // namespace loopscope::storage
