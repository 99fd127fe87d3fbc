#include "daemon/commands/recording_options.hpp"

#include <iostream>

#include "daemon/text/printable.hpp"

namespace loopscope::daemon {

void add_recording_options(CLI::App& command, RecordingOptions& options) {
  command
      .add_option("FILE", options.file,
                  "CSV: t_s or time, sp, pv, op, optional mv, mode, quality; cells separated by "
                  "commas, semicolons or tabs")
      ->required();
  command.add_option("--columns", options.columns,
                     "Columns by other names: time=NAME,sp=NAME,pv=NAME,op=NAME,... "
                     "(t_s=NAME: a time in seconds)");
  command
      .add_option("--decimal-sign", options.decimal_sign,
                  "point or comma (default: as the numbers show it)")
      ->check(CLI::IsMember({"point", "comma"}));
  command
      .add_option("--date-order", options.date_order,
                  "Of dates such as 03/04/2026: dmy, or mdy as in the United States")
      ->check(CLI::IsMember({"dmy", "mdy"}));
}

Recording read_recording(const RecordingOptions& options, const TimeZone& zone) {
  RecordingForm form;
  form.columns = parse_columns(options.columns);
  if (!options.decimal_sign.empty())
    form.decimal_sign = options.decimal_sign == "comma" ? ',' : '.';
  if (!options.date_order.empty())
    form.date_order = options.date_order == "dmy" ? DateOrder::day_first : DateOrder::month_first;
  Recording recording = read_recording(std::filesystem::path(options.file), form, zone);
  for (const std::string& note : recording.notes)
    std::cerr << "note: " << printable(recording.name) << ": " << printable(note) << '\n';
  return recording;
}

}  // namespace loopscope::daemon
