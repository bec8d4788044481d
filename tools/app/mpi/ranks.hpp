// The processes that run together, and what they do: vorocl-mpi tiles.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>

#include "app/options/command_line.hpp"

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

/// Adds the subcommand, which has the options of vorocl tiles. MPI must be initialised when it runs. It calls
/// `before` when its options have been parsed and checked.
void add_shared_tiles(CommandLine& line, const std::function<void()>& before);

}  // namespace vorocl::command
