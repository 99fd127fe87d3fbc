#pragma once

namespace loopscope::daemon {

/// The scheduler prefers the threads that analyse to this one and to the programs that it starts. A
/// sandbox may refuse: then it is one thread among others.
void yield_to_analysis();

}  // namespace loopscope::daemon
