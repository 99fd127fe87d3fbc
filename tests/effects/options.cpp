#include "tests/effects/options.hpp"

#include <algorithm>
#include <sstream>
#include <thread>

#include "tests/support/command_words.hpp"

namespace loopscope::tests::effects {
namespace {

class Reader {
 public:
  explicit Reader(const std::vector<std::string>& words) : words_(words) {}

  Options read() {
    options_.plan.threads = std::max(1U, std::thread::hardware_concurrency());
    while (!words_.done()) read_option(words_.next());
    refuse_what_is_not_heard();
    if (options_.plan.kinds.empty())
      for (const KindInfo& kind : all_kinds()) options_.plan.kinds.push_back(kind.name);
    return options_;
  }

 private:
  void read_option(const std::string& word) {
    if (word == "--help")
      options_.help = true;
    else if (word == "--list")
      options_.list = true;
    else if (word == "--json")
      options_.json = true;
    else if (word == "--records")
      options_.records = true;
    else if (word == "--residual-tests")
      options_.residual_tests = true;
    else if (word == "--field")
      options_.field = true;
    else if (word == "--recordings")
      options_.manifest = words_.value(word);
    else if (word == "--permuted")
      options_.plan.permuted = true;
    else if (word == "--without")
      options_.plan.without.leave_out(read_mechanism(words_.value(word)));
    else if (word == "--noise")
      read_noise(words_.value(word));
    else if (word == "--faint")
      options_.plan.size = Size::faint;
    else if (word == "--with-mv")
      options_.with_mv = true;
    else if (word == "--seed")
      options_.plan.seed = words_.count(word, 0);
    else if (word == "--draws")
      options_.plan.draws = words_.count(word, 1);
    else if (word == "--threads")
      options_.plan.threads = static_cast<unsigned>(words_.count(word, 1));
    else if (word == "--kinds")
      read_kinds(words_.value(word));
    else if (word == "--dump")
      read_dump(word);
    else
      throw WrongUsage("unknown option " + word);
  }

  static const std::string& known(const std::string& kind) {
    const std::vector<KindInfo>& all = all_kinds();
    if (std::none_of(all.begin(), all.end(), [&](const KindInfo& k) { return k.name == kind; }))
      throw WrongUsage("no kind " + kind + " (--list shows them)");
    return kind;
  }

  void read_kinds(const std::string& list) {
    std::istringstream text(list);
    for (std::string kind; std::getline(text, kind, ',');)
      options_.plan.kinds.push_back(known(kind));
  }

  /// Field records and recordings have loops, noise and effects of their own.
  void refuse_what_is_not_heard() const {
    if (options_.residual_tests && (options_.json || options_.records || options_.plan.permuted ||
                                    options_.plan.without.any()))
      throw WrongUsage(
          "--residual-tests goes with --seed, --draws, --threads, --kinds, --noise and --faint "
          "only");
    if (options_.field && !options_.manifest.empty())
      throw WrongUsage("--field and --recordings exclude each other");
    if (!options_.field && options_.manifest.empty()) return;
    const Plan& plan = options_.plan;
    if (options_.residual_tests || !plan.kinds.empty() || plan.noise != NoiseFamily::gaussian ||
        plan.permuted || plan.size != Size::realistic || options_.json ||
        !options_.dump_kind.empty())
      throw WrongUsage(
          "--field and --recordings go with --seed, --draws, --threads and --without only");
  }

  void read_noise(const std::string& family) {
    const auto noise = noise_family_of(family);
    if (!noise) throw WrongUsage("no noise " + family + ": gaussian, t5, bursts or garch");
    options_.plan.noise = *noise;
  }

  void read_dump(const std::string& word) {
    options_.dump_kind = known(words_.value(word));
    options_.dump_seed = words_.count(word, 0);
    options_.dump_file = words_.value(word);
  }

  CommandWords words_;
  Options options_;
};

}  // namespace

core::model::Mechanism read_mechanism(const std::string& name) {
  const auto mechanism = core::model::mechanism_of(name);
  if (!mechanism) throw WrongUsage("no mechanism " + name + " (effects_run --list shows them)");
  return *mechanism;
}

Options read_options(const std::vector<std::string>& words) {
  return Reader(words).read();
}

std::string usage() {
  return "effects_run [--seed N] [--draws M] [--kinds A,B] [--threads T] [--faint]\n"
         "            [--noise FAMILY] [--without MECHANISM] [--permuted] [--json | --records]\n"
         "effects_run --field | --recordings MANIFEST.csv [--seed N] [--draws M] [--without "
         "MECHANISM]\n"
         "    sticking or not, a line of JSON each; a manifest has the columns file, loop, type,\n"
         "    interval_s, samples, label (stiction or no_stiction); files (t_s,sp,pv,op) lie "
         "beside "
         "it\n"
         "effects_run --residual-tests [--seed N] [--draws M] [--kinds A,B] [--noise FAMILY]\n"
         "    in how many of 100 draws each residual test of the linear loop passes at 0.01\n"
         "effects_run --dump KIND SEED FILE.csv [--with-mv] [--faint]    one record, truth on "
         "standard error\n"
         "effects_run --list                                   kinds of records, mechanisms\n"
         "Draws loops with undeclared effects, diagnoses each and compares with the truth.\n"
         "Defaults: seed 1, 20 draws of every kind, one thread per processor.\n"
         "--faint draws effects however small instead of such that show in the one-step error.\n"
         "--noise gives load and readings the noise of a plant: t5, bursts or garch.\n"
         "--permuted lets each loop hear the residual tests of another.\n"
         "--without leaves a part of the search out; --records prints a line of JSON a draw.\n";
}

}  // namespace loopscope::tests::effects
