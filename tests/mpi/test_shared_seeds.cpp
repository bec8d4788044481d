// Seeds shared among ranks, and tiles handed out to them: labels as on one device, for any number of ranks.
#define BOOST_TEST_MODULE shared_seeds
#include <algorithm>
#include <cstdint>
#include <random>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "vorocl/mpi.hpp"

using namespace vorocl;

namespace {

struct Mpi {
  Mpi() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  }
  ~Mpi() { MPI_Finalize(); }
};
BOOST_TEST_GLOBAL_FIXTURE(Mpi);

int rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int ranks() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

/// Adds this rank's slice of the seeds. `shuffled`: each rank has some of everywhere.
void add_slice(SharedSeeds& seeds, const std::vector<Pixel>& pixels, bool shuffled) {
  for (std::size_t id = 0; id < pixels.size(); ++id) {
    const std::size_t owner = shuffled ? id % static_cast<std::size_t>(ranks())
                                       : id * static_cast<std::size_t>(ranks()) / pixels.size();
    if (owner != static_cast<std::size_t>(rank())) continue;
    const PlaneSeed seed = {static_cast<std::int32_t>(pixels[id].x), static_cast<std::int32_t>(pixels[id].y),
                            static_cast<std::uint32_t>(id)};
    seeds.add(&seed, 1);
  }
}

/// The labels that all ranks make together, on all of them.
std::vector<std::uint32_t> labels_of(const SharedSeeds& seeds, const Grid& grid, int side, Metric metric) {
  const Tiling tiling(seeds.grid(), side);
  TileCounter counter(MPI_COMM_WORLD, seeds, tiling);
  // A label is written by one rank; pixels of none would be 0 here, and so would those of two be wrong.
  std::vector<std::uint32_t> own(grid.pixels(), 0), all(grid.pixels());
  std::uint64_t made = 0, made_by_all = 0;
  const auto use = [&](const TileLabels& tile) {
    ++made;
    for (std::int64_t y = 0; y < tile.tile.height(); ++y) {
      for (std::int64_t x = 0; x < tile.tile.width(); ++x) {
        own[static_cast<std::size_t>((tile.tile.y() + y) * grid.width() + tile.tile.x() + x)] =
            tile.labels[y * tile.tile.width() + x] + 1;
      }
    }
  };
  exact_tiles(test_device(), seeds, tiling, [&] { return counter.next(); }, use, {metric});
  MPI_Allreduce(own.data(), all.data(), static_cast<int>(own.size()), MPI_UINT32_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(&made, &made_by_all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  BOOST_TEST(made_by_all == tiling.count());
  for (std::uint32_t& label : all) --label;
  return all;
}

std::vector<Pixel> cluster(const Grid& grid, std::size_t count, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  std::vector<Pixel> pixels;
  const auto around = [&](std::int64_t middle) {
    return static_cast<int>(middle) - 20 + static_cast<int>(rng() % 40);
  };
  for (std::size_t i = 0; i < count; ++i) {
    pixels.push_back({around(grid.width() / 3), around(grid.height() / 4)});
  }
  return pixels;
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_those_of_one_device) {
  for (const Axes axes : {Axes::none, Axes::x, Axes::xy}) {
    const Grid grids[] = {{300, 210, axes}, {997, 503, axes}, {1, 700, axes}};
    for (const Grid& grid : grids) {
      const std::vector<Pixel> planes[] = {
          {},
          {{static_cast<int>(grid.width() / 2), static_cast<int>(grid.height() / 2)}},
          random_pixels(grid, 3, 1),
          random_pixels(grid, 20000, 2),
          random_pixels(grid, 300, 3),
          cluster({300, 300}, grid.width() > 1 ? 5000 : 0, 4)};
      for (const std::vector<Pixel>& pixels : planes) {
        const Metric metric = pixels.size() % 2 == 0 ? Metric::euclidean : Metric::manhattan;
        Diagram diagram(test_device(), grid);
        exact_diagram(Seeds(test_device(), grid, centres(pixels), to_centres), diagram, {metric});
        const std::vector<std::uint32_t> expected = diagram.read();
        SharedSeeds seeds(MPI_COMM_WORLD, grid, Snap::to_pixels);
        add_slice(seeds, pixels, grid.width() == 300);
        seeds.share();
        BOOST_TEST(seeds.size() == pixels.size());
        BOOST_TEST(seeds.id_end() == pixels.size());
        std::size_t wrong = 0;
        const std::vector<std::uint32_t> labels = labels_of(seeds, grid, 128, metric);
        for (std::size_t i = 0; i < labels.size(); ++i) wrong += labels[i] != expected[i] ? 1 : 0;
        BOOST_TEST(wrong == 0u, grid.width() << "x" << grid.height() << ", axes " << static_cast<int>(axes)
                                             << ", " << pixels.size() << " seeds: " << wrong << " wrong");
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_of_points_are_those_of_one_device) {
  for (const Axes axes : {Axes::none, Axes::xy}) {
    const Grid grid(300, 210, axes);
    for (const std::size_t count : {3u, 400u, 30000u}) {
      std::mt19937 rng(9);
      std::vector<Point> points;
      for (std::size_t i = 0; i < count; ++i) {
        // Half of them in one place of 20 x 20 pixels.
        const double side = i % 2 == 0 ? 20 : 300, other = i % 2 == 0 ? 20 : 210;
        points.push_back(
            {static_cast<double>(rng()) * 0x1p-32 * side, static_cast<double>(rng()) * 0x1p-32 * other});
      }
      Diagram diagram(test_device(), grid);
      exact_diagram(Seeds(test_device(), grid, points, {Outside::count, Snap::none}), diagram);
      SharedSeeds seeds(MPI_COMM_WORLD, grid, Snap::none);
      for (std::size_t i = static_cast<std::size_t>(rank()); i < count;
           i += static_cast<std::size_t>(ranks()))
        seeds.add(std::vector<Point>{points[i]}, i);
      seeds.share();
      BOOST_TEST((seeds.snap() == Snap::none));
      const std::vector<std::uint32_t> labels = labels_of(seeds, grid, 64, Metric::euclidean);
      BOOST_TEST((labels == diagram.read()), count << " points");
    }
  }
}

BOOST_AUTO_TEST_CASE(each_rank_holds_as_many) {
  const Grid grid(4000, 4000);
  for (const bool clustered : {false, true}) {
    SharedSeeds seeds(MPI_COMM_WORLD, grid, Snap::to_pixels);
    std::vector<Pixel> pixels = random_pixels(clustered ? Grid(700, 700) : grid, 200000, 6);
    add_slice(seeds, pixels, false);
    seeds.share();
    BOOST_TEST(static_cast<double>(seeds.held()) * ranks() < 1.05 * 200000);
  }
}

BOOST_AUTO_TEST_CASE(an_error_of_one_rank_is_one_of_all) {
  const Grid grid(100, 100);
  SharedSeeds seeds(MPI_COMM_WORLD, grid, Snap::to_pixels);
  std::vector<PlaneSeed> near;
  check_error([&] { seeds.find_near(Window(grid, 0, 0, 9, 9), Metric::euclidean, near); }, {"share()"});
  seeds.share();
  const PlaneSeed seed = {1, 1, 0};
  check_error([&] { seeds.add(&seed, 1); }, {"shared out already"});
}
