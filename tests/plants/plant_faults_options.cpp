#include "tests/plants/plant_faults_options.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <thread>

namespace loopscope::tests::plants {
namespace {

using Task = Options::Task;

const std::map<std::string, Task>& tasks() {
  static const std::map<std::string, Task> kTasks = {
      {"--help", Task::help},
      {"--history", Task::history},
      {"--earlier-history", Task::earlier_history},
      {"--catalogue", Task::catalogue},
      {"--earlier-catalogue", Task::earlier_catalogue},
      {"--score", Task::score},
  };
  return kTasks;
}

template <typename Number>
Number number(const std::string& option, const std::string& text, const char* wanted) {
  Number result{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (error != std::errc() || end != text.data() + text.size())
    throw WrongUsage(option + " wants " + wanted + ", not " + text);
  return result;
}

double rate(const std::string& option, const std::string& text) {
  constexpr const char* kWanted = "a share above 0 and below 1";
  const auto result = number<double>(option, text, kWanted);
  if (!(result > 0.0 && result < 1.0))
    throw WrongUsage(option + " wants " + kWanted + ", not " + text);
  return result;
}

void set_number(Options& options, const std::string& option, std::uint64_t value) {
  if (option == "--seed")
    options.seed = value;
  else if (option == "--plants")
    options.plants = value;
  else if (option == "--loops")
    options.size.loops = value;
  else if (option == "--faulty")
    options.size.faulty = value;
  else if (option == "--threads")
    options.threads = static_cast<unsigned>(std::max<std::uint64_t>(value, 1));
  else if (option == "--end")
    options.end_us = static_cast<std::int64_t>(value) * 1000000;
  else
    throw WrongUsage("unknown option " + option);
}

void set(Options& options, const std::string& option, const std::string& text) {
  if (option == "--rate")
    options.rule.false_discovery_rate = rate(option, text);
  else
    set_number(options, option, number<std::uint64_t>(option, text, "a whole number"));
}

}  // namespace

Options read_options(const std::vector<std::string>& words) {
  Options options;
  options.threads = std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (const auto task = tasks().find(words[i]); task != tasks().end())
      options.task = task->second;
    else if (words[i] == "--json")
      options.json = true;
    else if (!words[i].starts_with("--"))
      throw WrongUsage("unknown word " + words[i]);
    else {
      if (i + 1 == words.size()) throw WrongUsage(words[i] + " lacks a value");
      set(options, words[i], words[i + 1]);
      ++i;
    }
  }
  if (options.size.faulty > options.size.loops) throw WrongUsage("more --faulty than --loops");
  return options;
}

std::string usage() {
  return "plant_faults [--seed N] [--plants M] [--threads T] [--rate Q] [--json]\n"
         "    diagnoses the plants of seeds N to N + M - 1 in memory and scores their flags;\n"
         "    --rate: share of the flags that may be false, else the default of the settings\n"
         "plant_faults --seed N --history|--earlier-history --end SECONDS   rows for COPY\n"
         "plant_faults --seed N --catalogue|--earlier-catalogue             CSV for loops load\n"
         "plant_faults --seed N --score [--json]        scores \"NAME VERDICT\" lines read\n"
         "--loops L (500), --faulty F (25): another size of plant, with every task\n"
         "Times are seconds since 1970. Defaults: seed 1, one plant, a thread per processor.\n";
}

}  // namespace loopscope::tests::plants
