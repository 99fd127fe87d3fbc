#include "daemon/report/live/live_reader.hpp"

#include <utility>

#include "core/text/counted.hpp"
#include "daemon/report/figures/draw_figures.hpp"
#include "daemon/report/live/live_trend.hpp"
#include "daemon/report/loop_report.hpp"
#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/sections/loop_list.hpp"
#include "daemon/report/sections/plant_section.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

/// What is new on a page without a beginning of its own.
constexpr std::int64_t kNewWithinUs = std::int64_t{7} * 86'400 * 1'000'000;
constexpr std::size_t kMostSeen = 8;

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

PlantFacts LiveReader::plant_facts() const {
  storage::ReportDatabase database(results_connection(*settings_));
  const std::int64_t since_us = database.now_us() - kNewWithinUs;
  PlantFacts facts{settings_->report.plant,       since_us,
                   database.counts(since_us),     database.flagged(),
                   database.plant_oscillations(), database.repairs(since_us)};
  facts.zone = zone_;
  return facts;
}

LivePage LiveReader::plant(const std::stop_token& stop) {
  PlantFacts facts = plant_facts();
  draw_events(facts, stop);
  const std::string now = minute_in_zone(facts.since_us + kNewWithinUs, zone_);
  return {page({titled(facts.plant, "Control loops"), {"as of " + now}, true, zone_.name()},
               {plant_section(facts, LoopLinks::pages)})};
}

LivePage LiveReader::loops(storage::LoopQuery query) {
  storage::ReportDatabase database(results_connection(*settings_));
  storage::LoopListing listing = database.loops(query);
  if (listing.loops.empty() && listing.fitting > 0) {  // a page behind the last one
    query.skip = (listing.fitting - 1) / query.most * query.most;
    listing = database.loops(query);
  }
  return {page({titled(settings_->report.plant, "All loops"),
                {core::text::counted(listing.all, "loop", "loops")},
                true,
                zone_.name()},
               {loop_list(listing, query, zone_)})};
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
    storage::ReportDatabase database(results_connection(*settings_));
    const auto row = database.latest(name);
    if (!row) return no_such_loop(name, zone_);
    loop_report = read_loop_report(database, *row, zone_);
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
