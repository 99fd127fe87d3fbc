#include "daemon/report/live/live_reader.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <utility>

#include "core/text/counted.hpp"
#include "daemon/report/figures/draw_figures.hpp"
#include "daemon/report/live/live_trend.hpp"
#include "daemon/report/loop_report.hpp"
#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/plant/event_box.hpp"
#include "daemon/report/plant/plant_section.hpp"
#include "daemon/report/sections/loop_list.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/threads/memory.hpp"
#include "daemon/service/threads/rest_after.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/reports/report_database.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::size_t kMostSeen = 8;

/// Results change by slots of minutes and more, but whoever loads a page again wants to see what
/// has happened since he did so before.
constexpr PlantSnapshot::Clock::duration kFresh = std::chrono::seconds(5);
/// So often without a reader, for so long after the last one: half a second of the database each.
constexpr PlantSnapshot::Clock::duration kReadEvery = std::chrono::seconds(60);
constexpr auto kReadyFor = std::chrono::hours(12);
/// A database that is away, or hangs, must not keep the thread that makes pages of what is at hand.
constexpr auto kPauseAfterFailure = std::chrono::seconds(30);

std::string titled(const std::string& plant, const std::string& words) {
  return plant.empty() ? words : plant + ": " + words;
}

LivePage no_such_loop(const std::string& name, const TimeZone& zone) {
  return {page({"No such loop", {}, true, zone.name()}, {render("no_such_loop", {{"name", name}})}),
          false};
}

}  // namespace

void LiveReader::draw_events(PlantFacts& facts, const std::stop_token& stop) {
  EventAlbum album = event_album(facts.oscillations, zone_);
  if (album.figures.empty()) return;
  try {
    if (!album_.shows_the_same(album)) {
      album.pictures = draw_figures(album.figures, find_gnuplot(), stop);
      album_ = std::move(album);
    }
    facts.album = album_;
  } catch (const Failure& failure) {
    // Tried again when the page is asked for again.
    facts.picture_trouble = failure.what();
  }
}

const PlantSnapshot& LiveReader::snapshot() {
  asked_at_ = PlantSnapshot::Clock::now();
  // Older than what is kept ready is by itself: nobody has read for long, or the database was away.
  if (!snapshot_ || asked_at_ - snapshot_->read_at > 2 * rest_after(snapshot_->took, kReadEvery))
    renew();
  return *snapshot_;
}

void LiveReader::keep_ready() {
  const auto now = PlantSnapshot::Clock::now();
  if (now - asked_at_ > kReadyFor || now < not_before_) return;
  const bool was_shown = snapshot_ && snapshot_->read_at <= asked_at_;
  if (snapshot_ &&
      now - snapshot_->read_at < rest_after(snapshot_->took, was_shown ? kFresh : kReadEvery))
    return;
  not_before_ = now + kPauseAfterFailure;
  renew();
  not_before_ = {};
}

void LiveReader::renew() {
  snapshot_ = read_plant(*settings_);
  // Of the reading, as much as the snapshot takes and more. Not every few seconds, which would slow
  // the workers down.
  if (snapshot_->read_at - gave_back_at_ < kReadEvery) return;
  give_back_freed_memory();
  gave_back_at_ = snapshot_->read_at;
}

std::string LiveReader::in_small_letters(const std::string& words) const {
  const auto is_ascii = [](char character) { return static_cast<unsigned char>(character) < 128; };
  if (!std::ranges::all_of(words, is_ascii))  // what is a small letter there, the database knows
    return storage::ReportDatabase(results_connection(*settings_)).in_small_letters(words);
  std::string small = words;
  for (char& character : small)
    if (character >= 'A' && character <= 'Z') character += 'a' - 'A';
  return small;
}

LivePage LiveReader::plant() {
  const PlantFacts& facts = snapshot().facts;
  return {page({titled(facts.plant, "Control loops"),
                {"as of " + minute_in_zone(facts.counts.now_us, zone_)},
                true,
                zone_.name()},
               {plant_section(facts, LoopLinks::pages())})};
}

LivePage LiveReader::loops(const LoopQuery& query) {
  const PlantFacts& facts = snapshot().facts;
  const LoopListing listing = choose_loops(facts.loops, query, in_small_letters(query.part));
  return {page({titled(facts.plant, "All loops"),
                {core::text::counted(listing.all, "loop", "loops") + ",",
                 "as of " + minute_in_zone(facts.counts.now_us, zone_)},
                true,
                zone_.name()},
               {loop_list(listing, query, zone_)})};
}

LivePage LiveReader::oscillation(std::int64_t number, const std::stop_token& stop) {
  const std::vector<storage::PlantOscillationRow>& all = snapshot().facts.oscillations;
  const auto event = std::ranges::find(all, number, &storage::PlantOscillationRow::number);
  const std::string words = fmt::format("Oscillation {}", number);
  const std::string title = titled(snapshot_->facts.plant, words);
  if (event == all.end())
    return {page({title, {}, true, zone_.name()}, {render("no_such_oscillation", {})}), false};
  PlantFacts facts;
  facts.oscillations = {*event};
  draw_events(facts, stop);
  return {page({title, {"as of " + minute_in_zone(event->slot_end_us, zone_)}, true, zone_.name()},
               {event_boxes(facts.oscillations, facts.album, facts.picture_trouble,
                            LoopLinks::pages(), zone_)})};
}

const LiveReader::Seen* LiveReader::seen(const storage::FlaggedRow& row) const {
  for (const Seen& one : seen_) {
    if (one.analysis_id == row.analysis_id && one.input_revision == row.input_revision) return &one;
  }
  return nullptr;
}

void LiveReader::look(LoopReport& loop_report, const std::stop_token& stop) {
  if (const Seen* before = seen(loop_report.row)) {
    loop_report.evidence = before->loop_report.evidence;
    loop_report.pictures = before->loop_report.pictures;
    loop_report.chain = before->loop_report.chain;
    return;
  }
  const auto entry =
      storage::Catalogue(results_connection(*settings_)).find(loop_report.row.loop_name);
  if (!entry) return;
  try {
    const std::filesystem::path gnuplot = find_gnuplot();
    add_figures(loop_report, *entry, windows_.read(*entry, loop_report.row.slot_end_us),
                settings_->analysis, gnuplot, stop);
  } catch (const Failure& failure) {
    loop_report.trouble = failure.what();
  }
  // What failed is tried again when the page is asked for again.
  if (!loop_report.evidence || !loop_report.trouble.empty()) return;
  seen_.push_front({loop_report.row.analysis_id, loop_report.row.input_revision, loop_report});
  if (seen_.size() > kMostSeen) seen_.pop_back();
}

LivePage LiveReader::loop(const std::string& name, const std::stop_token& stop) {
  LoopReport loop_report;
  {
    const PlantSnapshot& plant = snapshot();
    storage::ReportDatabase database(results_connection(*settings_));
    const storage::FlaggedRow* const listed = plant.flagged(name);
    const auto row = listed ? std::optional(*listed) : database.newest(name);
    if (!row) return no_such_loop(name, zone_);
    loop_report = read_loop_report(database, *row, zone_);
    if (!listed) loop_report.hidden = plant.hidden_by(row->loop_id);
    if (settings_->daemon.acknowledge.on()) loop_report.annotate_address = annotate_link(name);
  }
  look(loop_report, stop);
  const Markup trend = loop_report.evidence
                           ? live_trend(*loop_report.evidence, loop_report.row.pv_unit, zone_)
                           : Markup();
  return {page({titled(settings_->report.plant, name),
                {"window until " + minute_in_zone(loop_report.row.slot_end_us, zone_)},
                true,
                zone_.name(),
                !trend.html.empty()},
               {loop_section(loop_report, trend)})};
}

}  // namespace loopscope::daemon
