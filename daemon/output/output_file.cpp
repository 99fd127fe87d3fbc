#include "daemon/output/output_file.hpp"

#include <cerrno>
#include <fmt/format.h>
#include <system_error>
#include <utility>

#include "daemon/output/output_target.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

/// Pieces are lines, of a hundred bytes or so.
constexpr std::size_t kMostPending = 65'536;

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw std::system_error(errno, std::generic_category());
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

template <typename Work>
void OutputFile::attempt(Work&& work) {
  try {
    work();
  } catch (const std::system_error& error) {
    throw Failure(ExitCode::usage,
                  fmt::format("cannot write {}: {}", file_.string(), error.code().message()),
                  "name a file in a folder that exists, may be written to and has room left");
  }
}

OutputFile::OutputFile(std::filesystem::path file) : file_(std::move(file)) {
  attempt([&] { open(); });
}

void OutputFile::open() {
  OutputTarget target = find_output_target(file_);
  if (target.replaceable) {
    partial_.emplace(std::move(target.path));
  } else {
    in_place_ = open_in_place(target);
  }
}

void OutputFile::write(std::string_view text) {
  pending_ += text;
  if (pending_.size() >= kMostPending) attempt([&] { flush(); });
}

void OutputFile::flush() {
  write_all(partial_ ? partial_->descriptor() : in_place_.number(), pending_);
  pending_.clear();
}

void OutputFile::finish() {
  attempt([&] {
    flush();
    if (partial_) partial_->replace_target();
  });
}

void write_file(const std::filesystem::path& file, const std::string& content) {
  OutputFile output(file);
  output.write(content);
  output.finish();
}

}  // namespace loopscope::daemon
