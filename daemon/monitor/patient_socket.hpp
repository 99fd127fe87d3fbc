#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string_view>

namespace loopscope::daemon {

/// An accepted connection with an end to its claims: all that is read has to come within one
/// patience and one size, all that is written has to go within another patience. A timeout for
/// each read alone would let a client that sends a byte now and then hold a thread for ever, and
/// a line without an end would fill the memory.
class PatientSocket {
 public:
  /// How long a client is waited for. Asked again all the time: it may shrink while others wait.
  using Patience = std::function<std::chrono::milliseconds()>;

  /// Owns the descriptor.
  PatientSocket(int descriptor, Patience patience, std::size_t most_bytes);
  ~PatientSocket();
  PatientSocket(const PatientSocket&) = delete;
  PatientSocket& operator=(const PatientSocket&) = delete;

  /// At least one byte and at most `size`; 0 = the client is done, too slow or says too much.
  std::size_t read(char* to, std::size_t size);
  /// Whether the whole text went out.
  bool write(std::string_view text);
  /// Says that nothing more comes, and takes for a moment what the client still sends: closing at
  /// once would reset the connection, and the client might lose the answer. Nothing is done for a
  /// client that was too slow before.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { reading, writing, finishing };

  void enter(Phase phase);
  /// Whether the socket is ready before the phase's patience ends.
  bool await(short event);
  /// Fills the buffer; false = nothing comes any more.
  bool receive();

  int descriptor_;
  Patience patience_;
  std::size_t bytes_left_;
  Phase phase_ = Phase::reading;
  Clock::time_point phase_start_ = Clock::now();
  std::array<char, 4096> buffer_{};
  std::size_t buffer_at_ = 0;
  std::size_t buffer_end_ = 0;
  bool given_up_ = false;
};

}  // namespace loopscope::daemon
