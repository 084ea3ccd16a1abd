#pragma once

namespace weft {

/// From now on what ends a program from outside (Ctrl-C, SIGTERM, a hang-up, limits of a batch
/// system) first removes what AtomicFile has not committed; writing into a closed pipe or beyond a
/// file's largest size fails instead of ending the program. Signals that are ignored stay so, as
/// under nohup.
///
/// Call it before any other thread is started, MPI's and GL's included: only one thread may receive
/// signals.
void endCleanlyWhenInterrupted();

}  // namespace weft
