#include <algorithm>
#include <exception>
#include <list>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/snapping.hpp"
#include "mpi/agreement.hpp"
#include "mpi/block_tree.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/error.hpp"
#include "vorocl/mpi.hpp"

namespace vorocl {

/// A value of some bytes as MPI sends it.
class ByteType {
 public:
  explicit ByteType(std::size_t bytes) {
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ByteType() { MPI_Type_free(&type_); }
  ByteType(const ByteType&) = delete;
  ByteType& operator=(const ByteType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

namespace {

constexpr std::size_t block_size = 512;
constexpr std::size_t most_fetched = (std::size_t{64} << 20) / (block_size * sizeof(PlaneSeed));  // blocks

std::vector<int> starts_of(const std::vector<int>& counts) {
  std::vector<int> starts(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  return starts;
}

/// The values of all ranks, in the order of the ranks.
template <typename T>
std::vector<T> gathered(MPI_Comm communicator, const std::vector<T>& values, std::vector<int>& counts) {
  const int count = static_cast<int>(values.size());
  counts.resize(static_cast<std::size_t>(ranks_of(communicator)));
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  const std::vector<int> starts = starts_of(counts);
  std::vector<T> all(static_cast<std::size_t>(starts.back()) + static_cast<std::size_t>(counts.back()));
  const ByteType type(sizeof(T));
  MPI_Allgatherv(values.data(), count, type, all.data(), counts.data(), starts.data(), type, communicator);
  return all;
}

/// A place on the Z-curve, for so many seeds around it.
struct Sample {
  std::uint64_t place;
  double seeds;
};

std::uint64_t order_of(const PlaneSeed& seed) { return z_order(seed.x, seed.y); }

/// Puts seeds in the order of the Z-curve, with one at each place, that of the lowest id. In place.
void put_in_order(std::vector<PlaneSeed>& seeds) {
  // Halves of places stand where the coordinates did: comparing them is faster than making them.
  static_assert(sizeof(PlaneSeed) == 16);
  for (PlaneSeed& seed : seeds) {
    const std::uint64_t place = order_of(seed);
    seed.x = static_cast<std::int32_t>(place);
    seed.y = static_cast<std::int32_t>(place >> 32);
  }
  const auto place = [](const PlaneSeed& seed) {
    return std::uint64_t{static_cast<std::uint32_t>(seed.y)} << 32 | static_cast<std::uint32_t>(seed.x);
  };
  std::sort(seeds.begin(), seeds.end(), [&](const PlaneSeed& a, const PlaneSeed& b) {
    return std::tuple(place(a), a.part_y, a.part_x, a.id) < std::tuple(place(b), b.part_y, b.part_x, b.id);
  });
  const auto same_place = [](const PlaneSeed& a, const PlaneSeed& b) {
    return a.x == b.x && a.y == b.y && a.part_x == b.part_x && a.part_y == b.part_y;
  };
  seeds.erase(std::unique(seeds.begin(), seeds.end(), same_place), seeds.end());
  for (PlaneSeed& seed : seeds) {
    const std::uint64_t order = place(seed);
    seed.x = x_of_z_order(order);
    seed.y = y_of_z_order(order);
  }
}

/// Where the parts of all ranks but the first begin on the Z-curve, so that they have about as many seeds.
std::vector<std::uint64_t> splitters(MPI_Comm communicator, const std::vector<PlaneSeed>& sorted) {
  constexpr std::size_t samples_of_rank = 1024;
  std::vector<Sample> samples;
  const std::size_t count = std::min(samples_of_rank, sorted.size());
  for (std::size_t i = 0; i < count; ++i) {
    samples.push_back({order_of(sorted[i * sorted.size() / count]),
                       static_cast<double>(sorted.size()) / static_cast<double>(count)});
  }
  std::vector<int> counts;
  std::vector<Sample> all = gathered(communicator, samples, counts);
  std::sort(all.begin(), all.end(), [](const Sample& a, const Sample& b) { return a.place < b.place; });
  double seeds = 0;
  for (const Sample& sample : all) seeds += sample.seeds;
  std::vector<std::uint64_t> places;
  const auto ranks = static_cast<std::size_t>(ranks_of(communicator));
  double before = 0;
  for (const Sample& sample : all) {
    while (places.size() + 1 < ranks &&
           before >= seeds * static_cast<double>(places.size() + 1) / static_cast<double>(ranks)) {
      places.push_back(sample.place);
    }
    before += sample.seeds;
  }
  places.resize(ranks - 1, UINT64_MAX);
  return places;
}

/// Sends each rank its part of sorted seeds, and returns this rank's part of all.
std::vector<PlaneSeed> exchanged(MPI_Comm communicator, std::vector<PlaneSeed>&& sorted) {
  const std::vector<std::uint64_t> places = splitters(communicator, sorted);
  const auto ranks = places.size() + 1;
  std::vector<int> counts(ranks), received(ranks);
  auto begin = sorted.begin();
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    const auto end = rank < places.size() ? std::lower_bound(begin, sorted.end(), places[rank],
                                                             [](const PlaneSeed& seed, std::uint64_t place) {
                                                               return order_of(seed) < place;
                                                             })
                                          : sorted.end();
    counts[rank] = static_cast<int>(end - begin);
    begin = end;
  }
  MPI_Alltoall(counts.data(), 1, MPI_INT, received.data(), 1, MPI_INT, communicator);
  const std::vector<int> from = starts_of(counts), to = starts_of(received);
  std::vector<PlaneSeed> part;
  in_agreement(communicator, [&] {
    part.resize(static_cast<std::size_t>(to.back()) + static_cast<std::size_t>(received.back()));
  });
  const ByteType type(sizeof(PlaneSeed));
  MPI_Alltoallv(sorted.data(), counts.data(), from.data(), type, part.data(), received.data(), to.data(),
                type, communicator);
  return part;
}

std::vector<SeedBlock> blocks_of(const std::vector<PlaneSeed>& seeds) {
  std::vector<SeedBlock> blocks;
  for (std::size_t first = 0; first < seeds.size(); first += block_size) {
    const std::size_t end = std::min(first + block_size, seeds.size());
    SeedBlock block;
    for (std::size_t i = first; i < end; ++i) block.box.add({seeds[i].x, seeds[i].y, seeds[i].x, seeds[i].y});
    block.sample = seeds[(first + end) / 2];
    block.count = static_cast<std::uint32_t>(end - first);
    blocks.push_back(block);
  }
  return blocks;
}

}  // namespace

struct SharedSeedsState {
  SharedSeedsState(MPI_Comm communicator_of_caller, const Grid& grid_of_seeds, Snap snap_is)
      : communicator(copy_of(communicator_of_caller)), grid(grid_of_seeds), snap(snap_is), blocks(grid) {
    check_versions(communicator);
  }

  ~SharedSeedsState() {
    // An error on one rank ends all of them, and this one must not wait for the others.
    if (std::uncaught_exceptions() > exceptions) return;
    if (window != MPI_WIN_NULL) {
      MPI_Win_unlock_all(window);
      MPI_Win_free(&window);
    }
    MPI_Comm_free(&communicator);
  }

  void share() {
    std::uint64_t count = added.size();
    MPI_Allreduce(MPI_IN_PLACE, &ids, 1, MPI_UINT64_T, MPI_MAX, communicator);
    MPI_Allreduce(&count, &size, 1, MPI_UINT64_T, MPI_SUM, communicator);
    put_in_order(added);  // in place
    std::vector<PlaneSeed> part = exchanged(communicator, std::exchange(added, {}));
    put_in_order(part);
    std::vector<int> counts;
    const std::vector<SeedBlock> all_blocks = gathered(communicator, blocks_of(part), counts);
    for (const SeedBlock& block : all_blocks) counts_of_blocks.push_back(block.count);
    blocks.make(all_blocks);
    for (const int start : starts_of(counts)) first_blocks.push_back(static_cast<std::size_t>(start));
    // Memory of MPI's own: ranks of one machine then read it without the help of the one that holds it.
    MPI_Win_allocate(static_cast<MPI_Aint>(part.size() * sizeof(PlaneSeed)), sizeof(PlaneSeed), MPI_INFO_NULL,
                     communicator, &held, &window);
    held_count = part.size();
    MPI_Win_lock_all(0, window);
    std::copy(part.begin(), part.end(), held);
    MPI_Win_sync(window);
    MPI_Barrier(communicator);
    shared = true;
  }

  /// The seeds near a window, or more.
  PlaneSeeds fetch(const Window& shown, Metric metric) {
    std::vector<std::size_t> near;
    for (const PlaneRectangle& part : parts_of(shown)) {
      const std::vector<std::size_t> near_part = blocks.find_near(part, metric);
      near.insert(near.end(), near_part.begin(), near_part.end());
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::size_t block : near) request(block);
    MPI_Win_flush_all(window);
    PlaneSeeds seeds(grid, {Outside::count, snap});
    seeds.reserve(near.size() * block_size);
    for (const std::size_t block : near) {
      const std::size_t rank = owner_of(block);
      const PlaneSeed* const first =
          rank == this_rank() ? held + place_in(rank, block) : fetched.at(block).seeds.data();
      seeds.add(first, counts_of_blocks[block]);
    }
    forget_old_ones();
    return seeds;
  }

  MPI_Comm communicator;
  Grid grid;
  Snap snap;
  std::vector<PlaneSeed> added;  // until they are shared out
  bool shared = false;
  std::uint64_t size = 0, ids = 0;
  BlockTree blocks;
  PlaneSeed* held = nullptr;  // in the window
  std::size_t held_count = 0;

 private:
  struct Fetched {
    std::vector<PlaneSeed> seeds;
    std::list<std::size_t>::iterator use;
  };

  std::size_t this_rank() const { return static_cast<std::size_t>(rank_of(communicator)); }
  std::size_t owner_of(std::size_t block) const {
    return static_cast<std::size_t>(std::upper_bound(first_blocks.begin(), first_blocks.end(), block) -
                                    first_blocks.begin() - 1);
  }
  std::size_t place_in(std::size_t rank, std::size_t block) const {
    return (block - first_blocks[rank]) * block_size;
  }

  /// Enqueues that a block comes, unless it is there.
  void request(std::size_t block) {
    const std::size_t rank = owner_of(block);
    if (rank == this_rank()) return;
    const auto known = fetched.find(block);
    if (known != fetched.end()) {
      uses.splice(uses.end(), uses, known->second.use);
      return;
    }
    Fetched& here = fetched[block];
    here.seeds.resize(counts_of_blocks[block]);
    here.use = uses.insert(uses.end(), block);
    MPI_Get(here.seeds.data(), static_cast<int>(here.seeds.size()), type, static_cast<int>(rank),
            static_cast<MPI_Aint>(place_in(rank, block)), static_cast<int>(here.seeds.size()), type, window);
  }

  void forget_old_ones() {
    while (fetched.size() > most_fetched) {
      fetched.erase(uses.front());
      uses.pop_front();
    }
  }

  int exceptions = std::uncaught_exceptions();
  MPI_Win window = MPI_WIN_NULL;
  ByteType type = ByteType(sizeof(PlaneSeed));
  std::vector<std::size_t> first_blocks;  // by rank
  std::vector<std::uint32_t> counts_of_blocks;
  std::unordered_map<std::size_t, Fetched> fetched;
  std::list<std::size_t> uses;  // of what was fetched, the oldest first
};

SharedSeeds::SharedSeeds(MPI_Comm communicator, const Grid& grid, Snap snap)
    : state_(std::make_unique<SharedSeedsState>(communicator, grid, snap)) {
  refuse_volume(grid, "a plane of tiles");
  refuse_tilted(grid, "a plane of tiles");
}
SharedSeeds::~SharedSeeds() = default;

void SharedSeeds::add(const PlaneSeed* seeds, std::size_t count) {
  if (state_->shared) throw Error("these seeds were shared out already; add all of them before");
  for (std::size_t i = 0; i < count; ++i) check(seeds[i], state_->grid);
  for (std::size_t i = 0; i < count; ++i) state_->added.push_back(placed(seeds[i], state_->snap));
  for (std::size_t i = 0; i < count; ++i)
    state_->ids = std::max<std::uint64_t>(state_->ids, seeds[i].id + 1ull);
}

void SharedSeeds::add(const Points& points, std::uint64_t first) {
  if (points.weights() != nullptr) throw Error("tiles know no weights of points; diagrams of the whole do");
  const Snapping snapping(state_->grid, Outside::count);
  std::vector<PlaneSeed> seeds;
  seeds.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint64_t id = first + i;
    if (id >= no_label) throw Error("there are more than 2^32 - 1 seeds; ids end there");
    if (!points.is_present(i)) continue;
    const Place at = snapping(id, point_on(state_->grid, points, i), state_->snap);
    seeds.push_back(seed_at(at, static_cast<std::uint32_t>(id)));
  }
  add(seeds.data(), seeds.size());
}

void SharedSeeds::reserve(std::size_t count) { state_->added.reserve(count); }

void SharedSeeds::share() { state_->share(); }
const Grid& SharedSeeds::grid() const { return state_->grid; }
std::uint64_t SharedSeeds::id_end() const { return state_->ids; }
Snap SharedSeeds::snap() const { return state_->snap; }
std::uint64_t SharedSeeds::size() const { return state_->size; }
std::uint64_t SharedSeeds::held() const { return state_->held_count; }
double SharedSeeds::expected(const Window& window) const {
  double seeds = 0;
  for (const PlaneRectangle& part : parts_of(window)) seeds += state_->blocks.expected(part);
  return seeds;
}

void SharedSeeds::find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const {
  if (!state_->shared) throw Error("these seeds are not shared out yet; call share() on all ranks");
  state_->fetch(window, metric).find_near(window, metric, seeds);
}

}  // namespace vorocl
