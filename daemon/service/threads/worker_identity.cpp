#include "daemon/service/threads/worker_identity.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

namespace loopscope::daemon {
namespace {

constexpr std::size_t kLanesPerWorker = 2;
/// A batch that waits for its core behind more others may outlast its lease.
constexpr std::size_t kMostLanesPerWorker = 8;

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::size_t worker_count(const config::DaemonSettings& settings) {
  if (settings.workers > 0) return static_cast<std::size_t>(settings.workers);
  return std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
}

std::size_t lane_count(const config::DaemonSettings& settings) {
  const std::size_t workers = worker_count(settings);
  if (settings.batches_in_flight == 0) return kLanesPerWorker * workers;
  return std::clamp(static_cast<std::size_t>(settings.batches_in_flight), workers,
                    kMostLanesPerWorker * workers);
}

std::string process_name() {
  return fmt::format("{}/{}", host_name(), getpid());
}

std::string worker_name(std::size_t index) {
  return fmt::format("{}/{}", process_name(), index);
}

void add(storage::WriteCount& sum, const storage::WriteCount& more) {
  sum.inserted += more.inserted;
  sum.revised += more.revised;
  sum.unchanged += more.unchanged;
  sum.failed += more.failed;
  sum.fenced_off += more.fenced_off;
  sum.not_judged += more.not_judged;
  sum.revised_earlier += more.revised_earlier;
}

std::string count_text(const storage::WriteCount& count) {
  const std::size_t all =
      count.inserted + count.revised + count.unchanged + count.failed + count.fenced_off;
  std::string text = fmt::format("{} loops: {} new, {} revised, {} unchanged, {} failed", all,
                                 count.inserted, count.revised, count.unchanged, count.failed);
  if (count.not_judged > 0) {
    text += fmt::format(", {} could not be judged (loopscope.data_problem)", count.not_judged);
  }
  if (count.revised_earlier > 0) {
    text += fmt::format(", {} earlier slots revised", count.revised_earlier);
  }
  if (count.fenced_off > 0) text += fmt::format(", {} taken over by others", count.fenced_off);
  return text;
}

}  // namespace loopscope::daemon
