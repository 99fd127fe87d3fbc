#include "daemon/service/observe/log.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <string>

#include "daemon/text/printable.hpp"

namespace loopscope::daemon {
namespace {

constexpr const char* kLogger = "loopscope";

using ShowMessage = std::string (*)(const std::string&);

/// The message as a JSON string, which reads back as it was. What would steer a terminal is written
/// as \uXXXX, and then everything beyond ASCII is.
std::string as_json(const std::string& text) {
  const bool ascii_only = printable(text) != text;
  return nlohmann::json(text).dump(-1, ' ', ascii_only, nlohmann::json::error_handler_t::replace);
}

/// The message as one line, whatever names of loops and tags are in it.
std::string as_line(const std::string& text) {
  return printable(text);
}

template <ShowMessage show>
class Message : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& destination) override {
    const std::string shown = show(std::string(message.payload.begin(), message.payload.end()));
    destination.append(shown.data(), shown.data() + shown.size());
  }

  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<Message>();
  }
};

std::unique_ptr<spdlog::formatter> json_formatter() {
  auto formatter = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
  formatter->add_flag<Message<as_json>>('*').set_pattern(
      R"({"ts":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l","pid":%P,"thread":%t,"message":%*})");
  return formatter;
}

std::unique_ptr<spdlog::formatter> text_formatter() {
  auto formatter = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
  formatter->add_flag<Message<as_line>>('*').set_pattern("%Y-%m-%dT%H:%M:%SZ %l: %*");
  return formatter;
}

}  // namespace

void set_up_log(const config::DaemonSettings& settings) {
  std::shared_ptr<spdlog::logger> logger = spdlog::default_logger();
  // Other threads may be at the logger of before: it is changed, which is safe, and not replaced.
  const bool first = logger == nullptr || logger->name() != kLogger;
  if (first) {
    logger = std::make_shared<spdlog::logger>(kLogger,
                                              std::make_shared<spdlog::sinks::stderr_sink_mt>());
  }
  logger->set_formatter(settings.log_format == "json" ? json_formatter() : text_formatter());
  logger->set_level(spdlog::level::from_str(settings.log_level));
  logger->flush_on(spdlog::level::info);
  if (first) spdlog::set_default_logger(std::move(logger));
}

}  // namespace loopscope::daemon
