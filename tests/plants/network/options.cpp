#include "tests/plants/network/options.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <thread>

namespace loopscope::tests::network {
namespace {

class Reader {
 public:
  explicit Reader(const std::vector<std::string>& words) : words_(words) {}

  Options read() {
    options_.threads = std::max(1U, std::thread::hardware_concurrency());
    while (place_ < words_.size()) read_option(words_[place_++]);
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
      options_.evidence_file = value(word);
    else if (word == "--seed")
      options_.seed = number(word, 0);
    else if (word == "--plants")
      options_.plants = number(word, 0);
    else if (word == "--outside")
      outside_ = number(word, 0);
    else if (word == "--threads")
      options_.threads = static_cast<unsigned>(number(word, 1));
    else
      throw WrongUsage("unknown option " + word);
  }

  const std::string& value(const std::string& option) {
    if (place_ >= words_.size()) throw WrongUsage(option + " lacks a value");
    return words_[place_++];
  }

  std::uint64_t number(const std::string& option, std::uint64_t least) {
    const std::string& text = value(option);
    std::uint64_t result = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || result < least)
      throw WrongUsage(option + " wants a number of at least " + std::to_string(least) + ", not " +
                       text);
    return result;
  }

  const std::vector<std::string>& words_;
  std::size_t place_ = 0;
  std::optional<std::size_t> outside_;
  Options options_;
};

}  // namespace

Options read_options(const std::vector<std::string>& words) {
  return Reader(words).read();
}

std::string usage() {
  return "plant_sources [--seed N] [--plants M] [--outside K] [--threads T] [--json]\n"
         "              [--criteria] [--evidence FILE.csv]\n"
         "Draws M plants of thirty loops that one sticking valve shakes (one in eight at a "
         "recycle) "
         "and K\nthat something outside does, diagnoses every loop and says who is the source.\n"
         "Defaults: seed 1, 40 plants, a quarter as many outside, one thread per processor.\n"
         "--criteria adds what each published figure alone would have ranked first.\n"
         "--evidence writes what the ranking weighs, for fit_weights.\n";
}

}  // namespace loopscope::tests::network
