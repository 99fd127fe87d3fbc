#pragma once

// Signals and valves go side by side in vectors as wide as the processor's, so the headers of what
// does so are compiled once for each kind of processor, all that stands in them in a namespace of
// its own: an inline function of two kinds under one name would be one of them on every processor.
//
// What they stand on is compiled once, for any processor. The file of a kind of processor includes
// all of that first (lane_foundations.hpp), says what its namespace is, and includes them behind a
// pragma that names the processor; anybody else just includes them.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/model/vectors/number_pair.hpp"

#define LOOPSCOPE_PATH portable
