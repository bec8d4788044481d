#include "mpi/agreement.hpp"

#include <algorithm>

#include "vorocl/mpi.hpp"
#include "vorocl/version.hpp"

namespace vorocl {

void agree(MPI_Comm communicator, const std::string& wrong) {
  const int ranks = ranks_of(communicator);
  int bad = wrong.empty() ? ranks : rank_of(communicator), first = ranks;
  MPI_Allreduce(&bad, &first, 1, MPI_INT, MPI_MIN, communicator);
  if (first == ranks) return;
  std::string text = wrong;
  auto length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, first, communicator);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, first, communicator);
  throw Error("rank " + std::to_string(first) + ": " + text);
}

void check_versions(MPI_Comm communicator) {
  char version[32] = VOROCL_VERSION, of_first[32] = VOROCL_VERSION;
  MPI_Bcast(of_first, sizeof of_first, MPI_CHAR, 0, communicator);
  const bool same = std::equal(std::begin(version), std::end(version), std::begin(of_first));
  agree(communicator, same ? ""
                           : "runs VoroCL " + std::string(version) + ", rank 0 runs " + of_first +
                                 "; install one version on all machines");
}

}  // namespace vorocl
