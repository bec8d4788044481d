#include "app/mpi/shared_plane_writer.hpp"

#include <cstring>
#include <limits>
#include <utility>

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr int written = 1, all_written = 2;  // tags of messages to rank 0

void put(std::vector<char>& message, std::uint64_t number) {
  const char* const bytes = reinterpret_cast<const char*>(&number);
  message.insert(message.end(), bytes, bytes + sizeof number);
}

std::uint64_t get(const std::vector<char>& message, std::size_t& place) {
  std::uint64_t number = 0;
  std::memcpy(&number, message.data() + place, sizeof number);
  place += sizeof number;
  return number;
}

}  // namespace

SharedPlaneWriter::SharedPlaneWriter(const Ranks& ranks, PlaneWriterOptions options, const Tiling& tiling,
                                     const std::optional<Georeference>& georeference, const std::string& run)
    : communicator_(ranks.communicator),
      rank_(ranks.rank),
      ranks_(ranks.count),
      has_tables_(!options.cells.empty() || !options.adjacency.empty()) {
  if (rank_ == 0) {
    check_journal(options);
    options.resume = true;
    writer_ = std::make_unique<PlaneWriter>(options, tiling, georeference, run);
  } else {
    files_ = plane_files(options, tiling, georeference);
  }
}

void SharedPlaneWriter::begin(const std::string& seeds) {
  std::vector<std::uint64_t> made;
  if (rank_ == 0) {
    writer_->begin(seeds);
    made.assign(writer_->made_before().begin(), writer_->made_before().end());
  }
  std::uint64_t count = made.size();
  MPI_Bcast(&count, 1, MPI_UINT64_T, 0, communicator_);  // the files are there from here on
  made.resize(count);
  MPI_Bcast(made.data(), static_cast<int>(count), MPI_UINT64_T, 0, communicator_);
  made_before_.insert(made.begin(), made.end());
  known_ = made.size();
  for (const auto& file : files_) file->join();
}

PlaneCells* SharedPlaneWriter::cells() {
  if (rank_ == 0) return writer_->cells();
  return has_tables_ ? &cells_ : nullptr;
}

void SharedPlaneWriter::add(const TileLabels& tile) {
  if (rank_ == 0) {
    writer_->add(tile);
    ++known_;
    for (;;) {
      int there = 0;
      MPI_Status status;
      MPI_Iprobe(MPI_ANY_SOURCE, written, communicator_, &there, &status);  // ends are for end()
      if (there == 0) return;
      receive(status);
    }
  }
  TileJournal::Entry entry;
  entry.number = tile.number;
  for (const auto& file : files_) entry.bytes.push_back(file->write(tile).bytes);
  entries_.push_back(std::move(entry));
  int is_sent = 0;  // the last message: a rank 0 that makes a tile takes none
  MPI_Test(&sending_, &is_sent, MPI_STATUS_IGNORE);
  if (is_sent != 0 && stopwatch_.seconds() >= next_checkpoint_) checkpoint();
}

void SharedPlaneWriter::checkpoint() {
  if (rank_ == 0) {
    writer_->checkpoint();
    return;
  }
  if (entries_.empty()) return;
  const double begin = stopwatch_.seconds();
  send(written);
  const double end = stopwatch_.seconds();
  next_checkpoint_ = end + time_between_checkpoints * (end - begin);
}

void SharedPlaneWriter::wait_for_message() {
  // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): the last call of send() began it
  MPI_Wait(&sending_, MPI_STATUS_IGNORE);
}

/// Tells rank 0 of the tiles that it does not know yet, when the disk has them.
void SharedPlaneWriter::send(int tag) {
  for (const auto& file : files_) file->sync();
  wait_for_message();
  message_.clear();
  put(message_, entries_.size());
  for (const TileJournal::Entry& entry : entries_) {
    put(message_, entry.number);
    put(message_, entry.bytes.size());
    for (const std::uint64_t bytes : entry.bytes) put(message_, bytes);
  }
  entries_.clear();
  if (has_tables_) {
    const std::vector<char> sums = cells_.take();
    message_.insert(message_.end(), sums.begin(), sums.end());
  }
  if (message_.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw Error("the cells of the tiles since the last checkpoint take more than 2 GiB; take smaller tiles");
  }
  MPI_Isend(message_.data(), static_cast<int>(message_.size()), MPI_BYTE, 0, tag, communicator_, &sending_);
}

void SharedPlaneWriter::receive(const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::vector<char> message(static_cast<std::size_t>(size));
  MPI_Recv(message.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, communicator_,
           MPI_STATUS_IGNORE);
  std::size_t place = 0;
  std::vector<TileJournal::Entry> entries(get(message, place));
  for (TileJournal::Entry& entry : entries) {
    entry.number = get(message, place);
    entry.bytes.resize(get(message, place));
    for (std::uint64_t& bytes : entry.bytes) bytes = get(message, place);
  }
  known_ += entries.size();
  writer_->add(entries, {message.begin() + static_cast<std::ptrdiff_t>(place), message.end()});
}

std::string SharedPlaneWriter::kept() const {
  return rank_ == 0 ? writer_->kept()
                    : "with --resume the same command goes on with the tiles that are not complete";
}

// Before anything that ranks do together: the others' messages end when rank 0 takes them.
void SharedPlaneWriter::end() {
  if (rank_ > 0) {
    send(all_written);
    wait_for_message();
    return;
  }
  writer_->checkpoint();
  for (int ended = 1; ended < ranks_;) {
    MPI_Status status;
    MPI_Probe(MPI_ANY_SOURCE, MPI_ANY_TAG, communicator_, &status);
    receive(status);
    writer_->checkpoint();
    ended += status.MPI_TAG == all_written ? 1 : 0;
  }
}

void SharedPlaneWriter::finish(const Units& units, const EachSeed& seeds) {
  if (rank_ == 0) writer_->finish(units, seeds);
  MPI_Barrier(communicator_);
}

}  // namespace vorocl::command
