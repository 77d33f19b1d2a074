// Without MPI nothing launches a team; -DPFAFF_MPI=ON builds mpi.cpp in the place of this file.
#include <cstdlib>
#include <string>

#include <pfaff/bench/experiment/team.hpp>
#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

std::unique_ptr<Team> launched_team() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name); size != nullptr && size != std::string("1"))
      throw InputError(
          "started " + std::string(size) +
          " times by a launcher of MPI, and built without it; expected one process, or a build with "
          "-DPFAFF_MPI=ON");
  return nullptr;
}

}  // namespace pfaff
