#pragma once

/// What check-config asks of the databases.
#include "storage/finding.hpp"
#include "storage/historian/check_historian.hpp"
#include "storage/results/check_results.hpp"
