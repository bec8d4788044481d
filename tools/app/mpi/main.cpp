// The vorocl-mpi command: what several processes do together. An error of one ends all of them.
#include <mpi.h>

#include <cstdint>
#include <exception>
#include <string>

#include "app/mpi/ranks.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "formats/values.hpp"
#include "vorocl/mpi.hpp"
#include "vorocl/version.hpp"

namespace {

using namespace vorocl::command;

constexpr int success = 0, failure = 1, usage = 2;

/// Lets one process alone say what went wrong: others often find the same, or end because of it.
class FirstToSpeak {
 public:
  explicit FirstToSpeak(const Ranks& ranks) {
    MPI_Win_allocate(ranks.rank == 0 ? sizeof(std::uint64_t) : 0, sizeof(std::uint64_t), MPI_INFO_NULL,
                     ranks.communicator, &spoken_, &window_);
    MPI_Win_lock_all(0, window_);
    if (ranks.rank == 0) *spoken_ = 0;
    MPI_Win_sync(window_);
    MPI_Barrier(ranks.communicator);
  }
  ~FirstToSpeak() {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  FirstToSpeak(const FirstToSpeak&) = delete;
  FirstToSpeak& operator=(const FirstToSpeak&) = delete;

  void say(const std::exception& error) const {
    const std::uint64_t one = 1;
    std::uint64_t before = 0;
    MPI_Fetch_and_op(&one, &before, MPI_UINT64_T, 0, 0, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    if (before == 0) print_error(error);
  }

 private:
  std::uint64_t* spoken_ = nullptr;
  MPI_Win window_ = MPI_WIN_NULL;
};

/// How a process takes its command line: all must take the same one in the same way, or some would wait for
/// the others for ever.
class SameCommandLine {
 public:
  SameCommandLine(const Ranks& ranks, int argc, char** argv) : ranks_(ranks) {
    for (int i = 1; i < argc; ++i) {
      for (const char letter : std::string(argv[i]) + '\0') hash_.add(static_cast<unsigned char>(letter));
    }
  }

  enum class Outcome : std::uint64_t { runs, ends, refused };

  /// Once, on all. Throws UsageError if others have another outcome, or other options.
  void agree(Outcome outcome) {
    agreed_ = true;
    hash_.add(static_cast<std::uint64_t>(outcome));
    const std::uint64_t here = hash_.value();
    if (ranks_.reduced(here, MPI_UINT64_T, MPI_MIN) == ranks_.reduced(here, MPI_UINT64_T, MPI_MAX)) return;
    throw UsageError("the processes were started with different options; give all of them the same");
  }

  bool agreed() const { return agreed_; }

 private:
  Ranks ranks_;
  Hash hash_;
  bool agreed_ = false;
};

void run_command_of_all(int argc, char** argv, SameCommandLine& same) {
  CommandLine line("Raster Voronoi diagrams of planes that several processes share, by MPI.", "vorocl-mpi",
                   "vorocl-mpi " VOROCL_VERSION);
  add_shared_tiles(line, [&] { same.agree(SameCommandLine::Outcome::runs); });
  line.run(argc, argv);
  if (!same.agreed()) same.agree(SameCommandLine::Outcome::ends);
  flush_standard_output();
}

int run(int argc, char** argv) {
  const Ranks ranks(MPI_COMM_WORLD);
  if (ranks.rank > 0) say_errors_alone();
  const FirstToSpeak first(ranks);
  SameCommandLine same(ranks, argc, argv);
  try {
    vorocl::check_versions(ranks.communicator);
    run_command_of_all(argc, argv, same);
    return success;
  } catch (const UsageError& error) {  // before anything is done
    first.say(error);
    try {
      if (!same.agreed()) same.agree(SameCommandLine::Outcome::refused);
    } catch (const UsageError&) {  // one was said
    }
    return usage;
  } catch (const std::exception& error) {
    first.say(error);
    MPI_Abort(ranks.communicator, failure);
  }
  return failure;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  remove_temporary_files_on_signals();
  const int code = run(argc, argv);
  MPI_Finalize();
  return code;
}
