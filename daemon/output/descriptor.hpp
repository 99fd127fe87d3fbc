#pragma once

#include <system_error>
#include <unistd.h>
#include <utility>

namespace loopscope::daemon {

/// Throws what the system has said by errno.
[[noreturn]] inline void fail(int error) {
  throw std::system_error(error, std::generic_category());
}

/// A descriptor that is closed at the end.
class Descriptor {
 public:
  Descriptor() = default;  ///< not open
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    close();
    number_ = other.release();
    return *this;
  }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  /// The number, for somebody else to close.
  [[nodiscard]] int release() { return std::exchange(number_, -1); }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool open() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

}  // namespace loopscope::daemon
