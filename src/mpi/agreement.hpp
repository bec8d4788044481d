// What ranks do together.
#pragma once

#include <mpi.h>

#include <exception>
#include <new>
#include <string>

#include "vorocl/error.hpp"

namespace vorocl {

inline int rank_of(MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  return rank;
}

inline int ranks_of(MPI_Comm communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  return ranks;
}

inline MPI_Comm copy_of(MPI_Comm communicator) {
  MPI_Comm copy = MPI_COMM_NULL;
  MPI_Comm_dup(communicator, &copy);
  return copy;
}

/// Throws Error on all ranks if one gives a text that says what is wrong: that of the first such rank, with
/// its number.
void agree(MPI_Comm communicator, const std::string& wrong);

/// Does something on all ranks. If it throws on one, all throw.
template <typename Do>
void in_agreement(MPI_Comm communicator, Do what) {
  std::string wrong;
  try {
    what();
  } catch (const std::bad_alloc&) {
    wrong = "too little memory on the host";
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  agree(communicator, wrong);
}

}  // namespace vorocl
