#include "daemon/simulate/record_csv.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <system_error>
#include <unistd.h>

#include "daemon/failure.hpp"

namespace loopscope::daemon {

namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& file, const std::string& why) {
  throw Failure(ExitCode::usage, fmt::format("cannot write {}: {}", file.string(), why),
                "name a file in a folder that exists and may be written to");
}

}  // namespace

std::string record_csv(const core::simulate::LoopRecord& record, bool with_mv) {
  const bool has_op = !record.op.empty();
  const bool has_mv = with_mv && !record.mv.empty();
  std::string text = fmt::format("t_s,sp,pv{}{}\n", has_op ? ",op" : "", has_mv ? ",mv" : "");
  auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < record.pv.size(); ++k) {
    const double time_s = static_cast<double>(k) * record.sample_interval_s;
    fmt::format_to(out, "{},{},{}", time_s, record.sp[k], record.pv[k]);
    if (has_op) fmt::format_to(out, ",{}", record.op[k]);
    if (has_mv) fmt::format_to(out, ",{}", record.mv[k]);
    text.push_back('\n');
  }
  return text;
}

void write_whole_file(const std::filesystem::path& file, const std::string& content) {
  // The process number keeps two writers of one file apart.
  const std::filesystem::path partial = fmt::format("{}.{}.partial", file.string(), getpid());
  errno = 0;
  std::ofstream stream(partial, std::ios::binary | std::ios::trunc);
  stream << content;
  stream.close();
  std::error_code error;
  if (stream.fail()) {
    const std::string why = std::strerror(errno);
    std::filesystem::remove(partial, error);
    cannot_write(file, why);
  }
  std::filesystem::rename(partial, file, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    cannot_write(file, error.message());
  }
}

}  // namespace loopscope::daemon
