#include "daemon/plant/plant_watch.hpp"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <utility>

#include "core/text/counted.hpp"
#include "daemon/plant/judge_repairs.hpp"
#include "daemon/plant/plant_round.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/observe/stage_timings.hpp"
#include "daemon/service/threads/rest_after.hpp"
#include "daemon/service/threads/worker_identity.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"

namespace loopscope::daemon {
namespace {

constexpr const char* kRoundSubject = "plant round";
constexpr const char* kRepairsSubject = "repairs";
/// Another worker that is at it may be lost with its turn: so long, and others look again.
constexpr double kLookAgain_s = 60.0;

/// A round reads every oscillating loop: one that fails is not tried again at once.
constexpr std::chrono::minutes kAfterFailure{5};

/// Whether the step ends without an exception; one is a fault of the subject for the log.
template <typename Step>
bool goes_well(FaultLog& faults, const char* subject, Step step) {
  try {
    step();
    return true;
  } catch (const storage::DatabaseError& error) {
    faults.fault(subject, std::string(error.what()) + " HINT: " + error.hint());
  } catch (const Failure& failure) {
    faults.fault(subject, std::string(failure.what()) + " HINT: " + failure.hint());
  } catch (const std::exception& error) {
    faults.fault(subject, error.what());
  }
  return false;
}

/// A round reads and compares ten thousand loops for minutes, and its lease is not extended.
constexpr double kLeastHold_s = 1200.0;

/// A round of a large plant may take as many looks; beyond them its holder is worth a line.
constexpr int kRefusalsToSay = 10;

storage::PlantTurn round_when_due(storage::PlantRounds& rounds, double every_s,
                                  const config::Settings& settings, SharedServices& tools) {
  storage::PlantTurn turn =
      rounds.take_turn(every_s, process_name(), std::max(settings.schedule.lease_s, kLeastHold_s));
  if (turn.wait_s != 0.0) return turn;
  /// Of a round that is not stored.
  struct GiveBack {
    storage::PlantRounds& rounds;
    ~GiveBack() { rounds.give_turn_back(); }
  } const afterwards{rounds};
  Stopwatch watch;
  if (const auto round = make_plant_round(rounds, settings, tools))
    spdlog::info("plant round: {} ({:.1f} s)", printable(round_text(*round)), watch.lap_s());
  turn.wait_s = every_s;
  return turn;
}

void announce(storage::PlantRounds& rounds) {
  const storage::FlagAnnouncement news = rounds.announce_flags();
  for (const storage::FlagNotice& notice : news.flagged)
    spdlog::info("newly flagged: {}, {} ({:.2f})", printable(notice.loop_name), notice.code,
                 notice.confidence);
  if (news.untold)
    spdlog::warn("flags: {} noted, but listeners were not told: {} HINT: {}",
                 core::text::counted(news.messages.size(), "change", "changes"),
                 news.untold->what(), news.untold->hint());
}

}  // namespace

PlantWatch::PlantWatch(std::shared_ptr<const config::Settings> settings, SharedServices& tools)
    : tools_(tools),
      settings_(std::move(settings)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void PlantWatch::use(std::shared_ptr<const config::Settings> settings) {
  const std::lock_guard lock(mutex_);
  settings_ = std::move(settings);
  changed_.notify_all();
}

void PlantWatch::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_);
    const auto in_force = settings_;
    lock.unlock();
    const std::chrono::duration<double> pause(look(*in_force));
    lock.lock();
    const bool changed =
        changed_.wait_for(lock, stop, pause, [&] { return settings_ != in_force; });
    lock.unlock();
    if (!changed) continue;
    // What failed under other settings may go well under these.
    next_round_ = next_notice_ = {};
    rounds_.reset();
  }
}

std::optional<double> PlantWatch::compare(storage::PlantRounds& rounds,
                                          const config::Settings& settings) {
  double wait_s = kLookAgain_s;
  const auto round = [&] {
    const storage::PlantTurn turn =
        round_when_due(rounds, settings.plant.round_s, settings, tools_);
    count_refusal(turn.holder);
    wait_s = turn.wait_s.value_or(wait_s);
  };
  if (goes_well(tools_.faults, kRoundSubject, round)) return wait_s;
  next_round_ = Clock::now() + kAfterFailure;
  return std::nullopt;
}

void PlantWatch::count_refusal(const std::string& holder) {
  refusals_ = holder.empty() ? 0 : refusals_ + 1;
  if (refusals_ == kRefusalsToSay)
    spdlog::warn("plant round: {} has had the turn at {} polls in a row", printable(holder),
                 refusals_);
}

double PlantWatch::look(const config::Settings& settings) {
  const double pause_s = look_at_plant(settings);
  if (goes_well(tools_.faults, kRepairsSubject, [&] { judge_repairs(settings, tools_); }))
    tools_.faults.recovered(kRepairsSubject);
  return pause_s;
}

void PlantWatch::connect(const config::Settings& settings) {
  if (rounds_ && rounds_->answers()) return;
  rounds_.emplace(results_connection(settings), tools_.clocks.check());
}

double PlantWatch::announce_when_due(double every_s) {
  const Clock::time_point start = Clock::now();
  if (start >= next_notice_) {
    announced_ = goes_well(tools_.faults, kRoundSubject, [&] { announce(*rounds_); });
    const std::chrono::duration<double> wanted(announced_ ? every_s
                                                          : std::min(every_s, kLookAgain_s));
    const auto least = std::chrono::duration_cast<Clock::duration>(wanted);
    const Clock::time_point end = Clock::now();
    next_notice_ = end + (announced_ ? rest_after(end - start, least) : least);
  }
  return std::max(0.0, std::chrono::duration<double>(next_notice_ - Clock::now()).count());
}

double PlantWatch::look_at_plant(const config::Settings& settings) {
  const config::PlantSettings& plant = settings.plant;
  double pause_s = kLookAgain_s;
  if (plant.round_s <= 0.0 && plant.notice_s <= 0.0) return pause_s;
  if (!goes_well(tools_.faults, kRoundSubject, [&] { connect(settings); })) {
    rounds_.reset();
    return settings.schedule.poll_s;
  }
  const bool has_failed_lately = Clock::now() < next_round_;
  bool went_well = true;
  if (plant.round_s > 0.0 && !has_failed_lately) {
    const auto wait_s = compare(*rounds_, settings);
    went_well = wait_s.has_value();
    pause_s = std::min(pause_s, wait_s.value_or(kLookAgain_s));
  }
  if (plant.notice_s > 0.0) {
    // Whatever became of the round: the loops of a historian that answers are flagged meanwhile.
    pause_s = std::min(pause_s, announce_when_due(plant.notice_s));
    went_well &= announced_;
  }
  if (!went_well) rounds_.reset();
  if (went_well && !has_failed_lately) tools_.faults.recovered(kRoundSubject);
  return pause_s;
}

void compare_all_loops(const config::Settings& settings, SharedServices& tools) {
  std::exception_ptr unjudged;  // the comparison does not wait for it
  goes_well(tools.faults, kRepairsSubject, [&] {
    try {
      judge_repairs(settings, tools);
    } catch (...) {
      unjudged = std::current_exception();
      throw;
    }
  });
  storage::PlantRounds rounds(results_connection(settings), tools.clocks.check());
  if (settings.plant.round_s > 0.0) {
    const storage::PlantTurn turn = round_when_due(rounds, 0.0, settings, tools);
    if (!turn.holder.empty())
      spdlog::info("plant round: left to {}, who has the turn", printable(turn.holder));
  }
  if (settings.plant.notice_s > 0.0) announce(rounds);
  if (unjudged) std::rethrow_exception(unjudged);
}

}  // namespace loopscope::daemon
