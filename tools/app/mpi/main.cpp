// The vorocl-mpi command: what several processes do together. An error of one ends all of them.
#include <mpi.h>

#include <cstdint>
#include <exception>

#include "app/mpi/tiles.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/usage_error.hpp"
#include "vorocl/version.hpp"

namespace {

constexpr int success = 0, failure = 1, usage = 2;

/// Lets one process alone say what went wrong: others often find the same, or end because of it.
class FirstToSpeak {
 public:
  FirstToSpeak() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Win_allocate(rank == 0 ? sizeof(std::uint64_t) : 0, sizeof(std::uint64_t), MPI_INFO_NULL,
                     MPI_COMM_WORLD, &spoken_, &window_);
    MPI_Win_lock_all(0, window_);
    if (rank == 0) *spoken_ = 0;
    MPI_Win_sync(window_);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~FirstToSpeak() {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  FirstToSpeak(const FirstToSpeak&) = delete;
  FirstToSpeak& operator=(const FirstToSpeak&) = delete;

  /// Whether this is the first process that asks.
  bool may() const {
    const std::uint64_t one = 1;
    std::uint64_t before = 0;
    MPI_Fetch_and_op(&one, &before, MPI_UINT64_T, 0, 0, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    return before == 0;
  }

 private:
  std::uint64_t* spoken_ = nullptr;
  MPI_Win window_ = MPI_WIN_NULL;
};

int run(int argc, char** argv) {
  using namespace vorocl::command;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank > 0) say_errors_alone();
  const FirstToSpeak first;
  try {
    CommandLine line("Raster Voronoi diagrams of planes that several processes share, by MPI.", "vorocl-mpi",
                     "vorocl-mpi " VOROCL_VERSION);
    add_shared_tiles(line);
    line.run(argc, argv);
    flush_standard_output();
    return success;
  } catch (const UsageError& error) {  // which all processes find, before they do anything
    if (rank == 0) print_error(error);
    return usage;
  } catch (const std::exception& error) {
    if (first.may()) print_error(error);
    MPI_Abort(MPI_COMM_WORLD, failure);
  }
  return failure;
}

}  // namespace

int main(int argc, char** argv) {
  vorocl::command::open_standard_streams();
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  vorocl::command::remove_temporary_files_on_signals();
  const int code = run(argc, argv);
  MPI_Finalize();
  return code;
}
