#include "tests/plants/plant_faults_options.hpp"

#include <algorithm>
#include <map>
#include <thread>

#include "tests/effects/options.hpp"
#include "tests/support/command_words.hpp"

namespace loopscope::tests::plants {
namespace {

using Task = Options::Task;

const std::map<std::string, Task>& tasks() {
  static const std::map<std::string, Task> known = {
      {"--help", Task::help},
      {"--history", Task::history},
      {"--earlier-history", Task::earlier_history},
      {"--catalogue", Task::catalogue},
      {"--earlier-catalogue", Task::earlier_catalogue},
      {"--score", Task::score},
  };
  return known;
}

double rate(CommandWords& words, const std::string& option) {
  const std::string wanted = "a share above 0, at most 1";
  const auto result = words.number<double>(option, wanted);
  if (!(result > 0.0 && result <= 1.0))
    throw WrongUsage(option + " wants " + wanted + ", not " + std::to_string(result));
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

void set(Options& options, const std::string& option, CommandWords& words) {
  if (option == "--rate")
    options.rule.false_discovery_rate = rate(words, option);
  else if (option == "--share")
    options.rule.list_false_share = rate(words, option);
  else if (option == "--without")
    options.without.leave_out(effects::read_mechanism(words.value(option)));
  else
    set_number(options, option, words.number<std::uint64_t>(option, "a whole number"));
}

}  // namespace

Options read_options(const std::vector<std::string>& words) {
  Options options;
  options.threads = std::max(1U, std::thread::hardware_concurrency());
  for (CommandWords left(words); !left.done();) {
    const std::string& word = left.next();
    if (const auto task = tasks().find(word); task != tasks().end())
      options.task = task->second;
    else if (word == "--json")
      options.json = true;
    else if (!word.starts_with("--"))
      throw WrongUsage("unknown word " + word);
    else
      set(options, word, left);
  }
  if (options.size.faulty > options.size.loops) throw WrongUsage("more --faulty than --loops");
  if (options.without.any() && options.task != Task::diagnose && options.task != Task::help)
    throw WrongUsage("--without goes with diagnosing only");
  return options;
}

std::string usage() {
  return "plant_faults [--seed N] [--plants M] [--threads T] [--share S] [--rate Q]\n"
         "             [--without MECHANISM] [--json]\n"
         "    diagnoses the plants of seeds N to N + M - 1 in memory and scores their flags;\n"
         "    --share: of loops without a fault on the list; --rate: of the flags that may "
         "be\n"
         "    false; else the defaults of the settings;\n"
         "    --without: a part of the model's search left out\n"
         "plant_faults --seed N --history|--earlier-history --end SECONDS   rows for COPY\n"
         "plant_faults --seed N --catalogue|--earlier-catalogue             CSV for loops load\n"
         "plant_faults --seed N --score [--json]        scores \"NAME VERDICT\" lines read\n"
         "--loops L (500), --faulty F (25): another size of plant, with every task\n"
         "Times are seconds since 1970. Defaults: seed 1, one plant, a thread per processor.\n";
}

}  // namespace loopscope::tests::plants
