#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// A progress bar on standard error, drawn only on a terminal. Not thread-safe.
class ProgressBar {
 public:
  /// `unit`, in the plural, must outlive the bar.
  explicit ProgressBar(std::size_t total, std::string_view unit = "loops");
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void advance(std::size_t steps);

 private:
  bool terminal_;
  std::size_t total_;
  std::string_view unit_;
  std::size_t done_ = 0;
};

/// "[#####.....]  12/24 loops": the bar as text, `width` characters between the brackets.
[[nodiscard]] std::string progress_text(std::size_t done, std::size_t total, std::size_t width,
                                        std::string_view unit = "loops");

}  // namespace loopscope::daemon
