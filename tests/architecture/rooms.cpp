#include "tests/architecture/rooms.hpp"

#include <algorithm>
#include <array>

namespace loopscope::tests::architecture {

namespace {

/// What lies below config/ and storage/: core/ without core/simulate, which stands beside.
const std::vector<std::string_view> kCore = {"core/text",  "core/signal",   "core/hos",
                                             "core/loop",  "core/model",    "core/repair",
                                             "core/plant", "core/diagnosis"};

/// What runs unattended: without simulated records and what judges them.
const std::vector<std::string_view> kBelowTheDaemon = {
    "core/text",   "core/signal", "core/hos",       "core/loop", "core/model",
    "core/repair", "core/plant",  "core/diagnosis", "config",    "storage"};

const std::array kRooms = {
    Room{"core/text", {}, {}, true},
    Room{"core/signal", {}, {}, true},
    Room{"core/hos", {}, {"FFTW", "Eigen", "Highway", "Boost.Math"}, true},
    Room{"core/loop", {"core/signal", "core/hos"}, {"Eigen"}, true},
    Room{"core/model", {"core/text", "core/signal", "core/hos"}, {"Eigen", "Highway"}, true},
    Room{"core/repair", {"core/text"}, {"Boost.Math"}, true},
    Room{"core/plant",
         {"core/text", "core/signal", "core/hos", "core/loop", "core/model"},
         {"Eigen"},
         true},
    Room{"core/diagnosis",
         {"core/text", "core/signal", "core/hos", "core/loop", "core/model", "core/plant"},
         {},
         true},
    Room{"core/simulate", {}, {}, true},
    Room{"config", kCore, {"nlohmann-json", "date"}},
    Room{"storage", kCore, {"libpqxx", "libpq", "utfcpp"}, false, true},
    Room{"daemon/lab",
         {"core", "config", "storage", "daemon"},
         {"fmt", "CLI11", "nlohmann-json", "Boost.Math"},
         false,
         true},
    Room{"daemon",
         kBelowTheDaemon,
         {"Asio", "spdlog", "fmt", "CLI11", "nlohmann-json", "date", "Boost.Beast",
          "prometheus-cpp", "zlib", "libsystemd", "mustache"},
         false,
         true},
};

struct Library {
  std::string_view name;
  std::string_view prefix;  ///< of its headers
};

constexpr std::array kLibraries = {
    Library{"FFTW", "fftw3.h"},
    Library{"Eigen", "Eigen/"},
    Library{"Eigen", "unsupported/Eigen/"},
    Library{"NLopt", "nlopt."},
    Library{"Boost.Math", "boost/math/"},
    Library{"Highway", "hwy/"},
    Library{"nlohmann-json", "nlohmann/"},
    Library{"libpqxx", "pqxx/"},
    Library{"libpq", "libpq-fe.h"},
    Library{"utfcpp", "utf8.h"},
    Library{"Asio", "asio"},
    Library{"spdlog", "spdlog/"},
    Library{"fmt", "fmt/"},
    Library{"CLI11", "CLI/"},
    Library{"date", "date/"},
    Library{"prometheus-cpp", "prometheus/"},
    Library{"Boost.Beast", "boost/beast/"},
    Library{"Boost.Beast", "boost/asio/buffer.hpp"},  // what its parser reads from
    Library{"zlib", "zlib.h"},
    Library{"libsystemd", "systemd/"},
    Library{"mustache", "kainjow/"},
    Library{"GoogleTest", "gtest/"},
    Library{"GoogleTest", "gmock/"},
};

/// A list of what is allowed, so that a header that nobody has thought of is refused.
constexpr std::array<std::string_view, 49> kPureHeaders = {
    "algorithm",     "array",    "bit",         "bitset",     "cassert",
    "cctype",        "cfloat",   "charconv",    "climits",    "cmath",
    "compare",       "complex",  "concepts",    "cstddef",    "cstdint",
    "cstring",       "deque",    "exception",   "functional", "initializer_list",
    "iomanip",       "iterator", "limits",      "list",       "locale",
    "map",           "memory",   "new",         "numbers",    "numeric",
    "optional",      "ostream",  "queue",       "random",     "set",
    "span",          "sstream",  "stack",       "stdexcept",  "string",
    "string_view",   "tuple",    "type_traits", "typeindex",  "unordered_map",
    "unordered_set", "utility",  "variant",     "vector",
};

constexpr std::array kExceptions = {
    Exception{"config/read_bounded.cpp", "fcntl.h",
              "a pipe that is given as the settings file must not hold the program up"},
    Exception{"config/read_bounded.cpp", "poll.h",
              "a pipe that is given as the settings file must not hold the program up"},
    Exception{"config/read_bounded.cpp", "sys/stat.h",
              "a pipe that is given as the settings file must not hold the program up"},
    Exception{"config/read_bounded.cpp", "unistd.h",
              "a pipe that is given as the settings file must not hold the program up"},
    Exception{"core/hos/kernels/plan_cache.hpp", "mutex",
              "FFTW's planner is the one thing in core/ that all threads of a program share"},
    Exception{"config/http_address.cpp", "arpa/inet.h",
              "what is an address, and of the loopback, the system's own reader says"},
    Exception{"config/ip_network.cpp", "arpa/inet.h",
              "what is an address, and which bits it has, the system's own reader says"},
    Exception{"daemon/main.cpp", "daemon/lab/commands/commands.hpp",
              "the program has all commands; the daemon's library knows nothing of the lab"},
};

}  // namespace

bool lies_below(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) && path.substr(folder.size()).starts_with('/');
}

const Room* room_of(std::string_view path) {
  const auto* found = std::find_if(kRooms.begin(), kRooms.end(), [path](const Room& room) {
    return lies_below(path, room.path);
  });
  return found == kRooms.end() ? nullptr : found;
}

std::string_view library_of(std::string_view header) {
  const auto* found =
      std::find_if(kLibraries.begin(), kLibraries.end(),
                   [header](const Library& library) { return header.starts_with(library.prefix); });
  return found == kLibraries.end() ? std::string_view() : found->name;
}

bool is_pure_header(std::string_view header) {
  return std::find(kPureHeaders.begin(), kPureHeaders.end(), header) != kPureHeaders.end();
}

std::span<const Exception> exceptions() {
  return kExceptions;
}

}  // namespace loopscope::tests::architecture
