#include "tests/plants/network/options.hpp"

#include <algorithm>
#include <optional>
#include <thread>

#include "tests/support/command_words.hpp"

namespace loopscope::tests::network {
namespace {

class Reader {
 public:
  explicit Reader(const std::vector<std::string>& words) : words_(words) {}

  Options read() {
    options_.threads = std::max(1U, std::thread::hardware_concurrency());
    while (!words_.done()) read_option(words_.next());
    options_.outside = outside_.value_or(options_.plants / 4);
    return options_;
  }

 private:
  void read_option(const std::string& word) {
    if (word == "--help")
      options_.help = true;
    else if (word == "--json")
      options_.json = true;
    else if (word == "--criteria")
      options_.criteria = true;
    else if (word == "--evidence")
      options_.evidence_file = words_.value(word);
    else if (word == "--seed")
      options_.seed = words_.count(word, 0);
    else if (word == "--plants")
      options_.plants = words_.count(word, 0);
    else if (word == "--outside")
      outside_ = words_.count(word, 0);
    else if (word == "--independent")
      options_.independent = words_.count(word, 1);
    else if (word == "--threads")
      options_.threads = static_cast<unsigned>(words_.count(word, 1));
    else
      throw WrongUsage("unknown option " + word);
  }

  CommandWords words_;
  std::optional<std::size_t> outside_;
  Options options_;
};

}  // namespace

Options read_options(const std::vector<std::string>& words) {
  return Reader(words).read();
}

std::string usage() {
  return "plant_sources [--seed N] [--plants M] [--outside K] [--threads T] [--json]\n"
         "              [--criteria] [--evidence FILE.csv] [--independent N]\n"
         "Draws M plants of thirty loops that one sticking valve shakes (one in eight at a "
         "recycle) "
         "and K\nthat something outside does, diagnoses every loop and says who is the source.\n"
         "Defaults: seed 1, 40 plants, a quarter as many outside, one thread per processor.\n"
         "--criteria adds what each published figure alone would have ranked first.\n"
         "--independent: of N plants whose loops share nothing, how many show an event.\n"
         "--evidence writes what the ranking weighs, for fit_weights.\n";
}

}  // namespace loopscope::tests::network
