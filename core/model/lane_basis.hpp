#pragma once

// Signals and valves go side by side in vectors as wide as the processor's, so the headers of what
// does so are compiled once for each kind of processor, all that stands in them in a namespace of
// its own: an inline function of two kinds under one name would be one of them on every processor.
//
// What they stand on is compiled once, for any processor, and all of it is named here: none of
// these headers includes anything else but its like. The file of a kind of processor includes this
// first, says what its namespace is, and includes them between two pragmas that name the processor;
// anybody else just includes them.
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

#include "core/model/lane_kernel.hpp"
#include "core/model/loop_data.hpp"
#include "core/model/noise_model.hpp"
#include "core/model/number_pair.hpp"
#include "core/model/op_step.hpp"
#include "core/model/process_shape.hpp"
#include "core/model/stem_friction.hpp"
#include "core/model/valve_law.hpp"

#define LOOPSCOPE_PATH portable
