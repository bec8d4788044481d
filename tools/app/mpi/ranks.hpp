// The processes that run together.
#pragma once

#include <mpi.h>

#include <cstdint>

namespace vorocl::command {

struct Ranks {
  explicit Ranks(MPI_Comm of) : communicator(of) {
    MPI_Comm_rank(of, &rank);
    MPI_Comm_size(of, &count);
  }

  std::uint64_t sum(std::uint64_t number) const { return reduced(number, MPI_UINT64_T, MPI_SUM); }

  template <typename T>
  T reduced(T value, MPI_Datatype type, MPI_Op operation) const {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, type, operation, communicator);
    return value;
  }

  MPI_Comm communicator;
  int rank = 0, count = 1;
};

}  // namespace vorocl::command
