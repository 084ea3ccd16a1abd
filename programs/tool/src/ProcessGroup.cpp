#include "weft/tool/ProcessGroup.h"

#ifdef WEFT_MPI
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#endif

namespace weft {

#ifdef WEFT_MPI
namespace {

// Starting MPI costs a second and complains in containers, so only where a launcher asks for it:
// OpenMPI's, those that speak PMI (MPICH, Slurm).
bool startedByLauncher() {
  constexpr std::array variables{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
  return std::ranges::any_of(variables, [](const char* name) { return std::getenv(name) != nullptr; });
}

bool running() {
  int initialized = 0;
  MPI_Initialized(&initialized);
  return initialized != 0;
}

}  // namespace

ProcessGroup::ProcessGroup() {
  if (!startedByLauncher()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

ProcessGroup::~ProcessGroup() {
  if (running()) MPI_Finalize();
}

bool ProcessGroup::allSucceeded(bool success) const {
  if (!running()) return success;
  const int own = success ? 1 : 0;
  int all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return all == 1;
}
#else
ProcessGroup::ProcessGroup() = default;
ProcessGroup::~ProcessGroup() = default;

bool ProcessGroup::allSucceeded(bool success) const {
  return success;
}
#endif

}  // namespace weft
