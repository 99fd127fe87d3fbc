#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>

#include "config/read_settings.hpp"
#include "daemon/catalogue/annotation_wish.hpp"
#include "daemon/catalogue/on_behalf_of.hpp"
#include "daemon/catalogue/unknown_loop.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/output/annotation_text.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "storage/results/catalogue/annotations.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

struct AnnotateOptions {
  std::string config, loop, code, until, reason;
  std::optional<std::string> on_behalf_of;
};

using SharedAnnotateOptions = std::shared_ptr<AnnotateOptions>;

struct AnnotationWork {
  explicit AnnotationWork(const AnnotateOptions& options)
      : AnnotationWork(options, config::read_settings(options.config)) {}
  AnnotationWork(const AnnotateOptions& options, const config::Settings& settings)
      : zone(settings.plant.time_zone),
        connection(engineer_connection(settings)),
        annotations(connection) {
    if (options.loop.empty()) return;
    storage::Catalogue catalogue(connection);
    require_loop(options.loop, catalogue);
  }
  TimeZone zone;
  storage::ConnectionSettings connection;
  storage::Annotations annotations;
};

void require_loop_option(const AnnotateOptions& options) {
  if (options.loop.empty()) {
    throw Failure(ExitCode::usage, "--loop is missing", "name the loop: --loop NAME");
  }
}

/// In the name that the options say.
void say(const AnnotateOptions& options, storage::Annotation annotation, AnnotationWork& opened) {
  annotation.on_behalf_of = options.on_behalf_of;
  const std::optional<storage::OthersInForce> others = opened.annotations.add(annotation);
  if (!others) {
    throw Failure(ExitCode::usage,
                  fmt::format("loop \"{}\" has just been removed", annotation.loop_name),
                  "loopscope loops --config F lists them");
  }
  std::cout << annotation_line(annotation, opened.zone) << '\n'
            << others_in_force(*others, opened.zone);
}

void annotate(const AnnotateOptions& options, const char* kind) {
  require_loop_option(options);
  const config::Settings settings = config::read_settings(options.config);
  const AnnotationWish wish{options.loop, kind, options.code, options.until, options.reason};
  check_wish(wish, {}, TimeZone(settings.plant.time_zone));
  AnnotationWork opened(options, settings);
  say(options, annotation_meant(wish, {}, opened.zone, opened.annotations), opened);
}

void acknowledge(const AnnotateOptions& options) {
  annotate(options, "acknowledged");
}

void call_false(const AnnotateOptions& options) {
  annotate(options, "false_positive");
}

void suppress(const AnnotateOptions& options) {
  annotate(options, "suppressed");
}

void withdraw(const AnnotateOptions& options) {
  require_loop_option(options);
  AnnotationWork opened(options);
  const bool all = options.code.empty() || options.code == kAnyCode;
  const std::size_t count = opened.annotations.withdraw(
      options.loop, all ? std::nullopt : std::optional(options.code), options.on_behalf_of);
  if (count == 0) {
    throw Failure(ExitCode::usage, fmt::format("nothing to withdraw of loop \"{}\"", options.loop),
                  "loopscope annotate --config F list shows what holds");
  }
  std::cout << fmt::format("withdrew {} of {}\n", count, printable(options.loop));
}

void list(const AnnotateOptions& options) {
  AnnotationWork opened(options);
  std::vector<storage::Annotation> annotations = opened.annotations.in_force();
  if (!options.loop.empty()) {
    std::erase_if(annotations, [&](const storage::Annotation& annotation) {
      return annotation.loop_name != options.loop;
    });
  }
  std::cout << annotation_table(annotations, opened.zone);
}

CLI::App& add_action(CLI::App& annotate, const char* name, const char* description,
                     const SharedAnnotateOptions& options,
                     void (*carry_out)(const AnnotateOptions&)) {
  CLI::App& command = *annotate.add_subcommand(name, description);
  command.fallthrough();
  command.callback([options, carry_out] { carry_out(*options); });
  return command;
}

/// An action that writes, in somebody's name.
CLI::App& add_statement(CLI::App& annotate, const char* name, const char* description,
                        const SharedAnnotateOptions& options,
                        void (*carry_out)(const AnnotateOptions&)) {
  CLI::App& command = add_action(annotate, name, description, options, carry_out);
  command.callback([options, carry_out] {
    options->on_behalf_of = on_behalf_of(options->on_behalf_of);
    carry_out(*options);
  });
  command.add_option("--on-behalf-of", options->on_behalf_of, kOnBehalfOfHelp);
  return command;
}

void add_code(CLI::App& command, const SharedAnnotateOptions& options, const char* without) {
  command.add_option("--code", options->code,
                     fmt::format("Verdict that it is about, or any (default: {})", without));
}

CLI::Option* add_reason(CLI::App& command, const SharedAnnotateOptions& options) {
  return command.add_option("--reason", options->reason, "Why, for those who ask later");
}

}  // namespace

void add_annotate(CLI::App& program) {
  CLI::App& annotate = *program.add_subcommand(
      "annotate", "Acknowledges, suppresses or calls false what was found of a loop");
  const auto options = std::make_shared<AnnotateOptions>();
  annotate.add_option("--config", options->config, "Settings file")->required();
  annotate.add_option("--loop", options->loop, "Loop");
  annotate.require_subcommand(1);
  constexpr const char* kNewest = "the newest";
  constexpr const char* kWhatever = "any";
  CLI::App& known = add_statement(annotate, "acknowledge",
                                  "Known, work is planned: off the list until work done since is "
                                  "entered (maintenance) and a window lies wholly after it, or "
                                  "until withdrawn",
                                  options, acknowledge);
  add_code(known, options, kNewest);
  add_reason(known, options);
  CLI::App& quiet = add_statement(annotate, "suppress", "Off the list until a time, for a reason",
                                  options, suppress);
  quiet
      .add_option(
          "--until", options->until,
          "ISO 8601; without an offset in the plant's zone; a date alone is its first moment")
      ->required();
  add_reason(quiet, options)->required();
  add_code(quiet, options, kWhatever);
  CLI::App& wrong =
      add_statement(annotate, "false-positive",
                    "The verdict is wrong: off the list until withdrawn", options, call_false);
  add_code(wrong, options, kNewest);
  add_reason(wrong, options);
  CLI::App& back =
      add_statement(annotate, "withdraw", "Withdraws an active annotation", options, withdraw);
  add_code(back, options, kWhatever);
  add_action(annotate, "list", "What holds, and who said it", options, list);
}

}  // namespace loopscope::daemon
