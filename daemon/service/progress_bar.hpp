#pragma once

#include <cstddef>
#include <string>

namespace loopscope::daemon {

/// A progress bar on standard error, drawn only on a terminal. Not thread-safe.
class ProgressBar {
 public:
  explicit ProgressBar(std::size_t total);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void advance(std::size_t steps);

 private:
  bool terminal_;
  std::size_t total_;
  std::size_t done_ = 0;
};

/// "[#####.....]  12/24 loops": the bar as text, `width` characters between the brackets.
[[nodiscard]] std::string progress_text(std::size_t done, std::size_t total, std::size_t width);

}  // namespace loopscope::daemon
