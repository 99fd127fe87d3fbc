#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "config/settings.hpp"
#include "daemon/monitor/http_server.hpp"
#include "daemon/report/live/annotate_pages.hpp"
#include "daemon/report/live/live_reader.hpp"
#include "daemon/report/live/page_worker.hpp"

namespace loopscope::daemon {

/// The pages that people read, from the results as they are now: `/` the plant, `/loops` every
/// loop, `/loop?name=NAME` one loop with its pictures, and `/annotate` (AnnotatePages). They take
/// one thread, one connection to the results while a page is made, and one to each historian that
/// was asked for.
class LivePages {
 public:
  /// `settings` is asked for each page: those in force. While it `rests`, nothing is read but for
  /// pages that are asked for. Both on any thread.
  LivePages(std::function<std::shared_ptr<const config::Settings>()> settings,
            std::function<bool()> rests);

  /// Adds the pages to a server that has not started yet and is stopped before this ends.
  void add_to(HttpServer& server);

 private:
  [[nodiscard]] LiveReader& reader();
  void keep_ready();
  /// Somebody has entered something: whoever asks from now on sees it. On any thread.
  void show_changes();

  std::function<std::shared_ptr<const config::Settings>()> settings_;
  std::function<bool()> rests_;
  std::shared_ptr<const config::Settings> read_with_;  ///< the worker's
  std::unique_ptr<LiveReader> reader_;                 ///< the worker's
  std::atomic<bool> changed_ = false;                  ///< since the reader last read the plant
  PageWorker worker_;                                  // it ends before what it uses
  AnnotatePages annotate_;                             // before the worker, whose pages it drops
};

}  // namespace loopscope::daemon
