#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "config/settings.hpp"
#include "daemon/report/evidence/window_source.hpp"
#include "daemon/report/live/plant_snapshot.hpp"
#include "daemon/report/sections/loop_query.hpp"
#include "daemon/report/sections/loop_section.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

struct LivePage {
  std::string html;
  bool found = true;  ///< false: there is no such loop or oscillation, or none was found yet
};

/// Reads and writes the daemon's pages; for one thread at a time. A loop that was looked at a
/// moment ago is not looked at again before it has another analysis. Every function throws
/// storage::DatabaseError when the results are away, and std::system_error when the plotting
/// program cannot be started.
class LiveReader {
 public:
  explicit LiveReader(std::shared_ptr<const config::Settings> settings)
      : settings_(std::move(settings)), zone_(settings_->plant.time_zone), windows_(*settings_) {}

  /// The first screen, with what is new since a week.
  [[nodiscard]] LivePage plant();
  /// Loops of the catalogue; behind the last page that one.
  [[nodiscard]] LivePage loops(const LoopQuery& query);
  /// One shared oscillation; without a plotting program no trends and spectra of it.
  [[nodiscard]] LivePage oscillation(std::int64_t number, const std::stop_token& stop);
  /// One loop with its pictures; without a plotting program its words and figures.
  [[nodiscard]] LivePage loop(const std::string& name, const std::stop_token& stop);
  /// To be called between pages: reads the plant anew where a page is likely to need it soon, so
  /// that whoever comes does not wait for the database. Throws as the others.
  void keep_ready();
  /// The plant is read anew for the next page.
  void forget_plant() { snapshot_.reset(); }

 private:
  /// The costly part of a report, by the analysis that it belongs to.
  struct Seen {
    std::int64_t analysis_id = 0;
    int input_revision = 0;
    LoopReport loop_report;
  };

  /// The plant as it is shown now: a minute old for whoever comes first, seconds for whoever loads
  /// a page again; two minutes at most, where the database was away meanwhile. Where a look
  /// takes longer than three seconds (tens of thousands of loops), it is up to twenty times as old
  /// as that, ten minutes at most, and twice as old where the database was away.
  const PlantSnapshot& snapshot();
  void renew();
  /// As LoopRow::searched has them.
  [[nodiscard]] std::string in_small_letters(const std::string& words) const;
  /// Once for each round: a page is asked for more often than a round is made.
  void draw_events(PlantFacts& facts, const std::stop_token& stop);
  void look(LoopReport& loop_report, const std::stop_token& stop);
  [[nodiscard]] const Seen* seen(const storage::FlaggedRow& row) const;

  std::shared_ptr<const config::Settings> settings_;
  TimeZone zone_;
  std::optional<PlantSnapshot> snapshot_;
  /// When a page last wanted it, and before when it is not tried to be read without one.
  PlantSnapshot::Clock::time_point asked_at_ = PlantSnapshot::Clock::now(), not_before_ = {};
  PlantSnapshot::Clock::time_point gave_back_at_ = {};
  WindowSource windows_;
  std::deque<Seen> seen_;  ///< newest first
  EventAlbum album_;       ///< that was drawn last
};

}  // namespace loopscope::daemon
