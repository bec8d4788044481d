// Low resolution with reconstruction: against a reference label for label, and how near it comes to the
// truth.
#define BOOST_TEST_MODULE low_resolution
#include "brute_force.hpp"
#include "fixture.hpp"
#include "reference_flood.hpp"
#include "vorocl/low_resolution.hpp"

using namespace vorocl;

namespace {

constexpr Metric euclidean = Metric::euclidean;

Labels labels_of(const Device& device, const Grid& grid, const std::vector<Pixel>& seeds) {
  Diagram diagram(device, grid);
  BOOST_TEST(low_resolution(Seeds(device, grid, centres(seeds), to_centres), diagram).waves() == 0);
  return diagram.read();
}

}  // namespace

BOOST_AUTO_TEST_CASE(edge_cases_against_a_reference) {
  for (const Case& c : all_edge_cases(euclidean)) {
    BOOST_TEST_CONTEXT(c.name) {
      const Labels labels = labels_of(test_device(), c.grid, c.seeds);
      BOOST_TEST((labels == reference_low_resolution(c.grid, c.seeds)));
      const Verdict verdict =
          judge(c.grid, c.seeds, euclidean, labels, brute_force(c.grid, c.seeds, euclidean));
      BOOST_TEST(verdict.unlabelled == 0);
      BOOST_TEST(verdict.invalid == 0);
      BOOST_TEST(verdict.too_near == 0);
      // Measured on these cases: at most 6 pixels of 255.
      BOOST_TEST(verdict.wrong <= c.grid.pixels() / 40);
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_that_share_coarse_pixels_keep_their_cells) {
  // One pixel in four holds a seed: four share a coarse pixel, and three have to be found again.
  const Grid grid(200, 150);
  const auto seeds = random_pixels(grid, grid.pixels() / 4, 5);
  const Verdict verdict = judge(grid, seeds, euclidean, labels_of(test_device(), grid, seeds),
                                brute_force(grid, seeds, euclidean));
  BOOST_TEST(verdict.wrong <= grid.pixels() / 10000);
}

BOOST_AUTO_TEST_CASE(evenly_spread_seeds_are_as_right_as_by_jfa) {
  const Grid grid(400, 300);
  for (const std::size_t pixels_per_seed : {16u, 64u, 1024u}) {
    std::size_t wrong = 0, by_jfa = 0;
    for (unsigned rng_seed = 1; rng_seed <= 5; ++rng_seed) {
      const auto pixels = random_pixels(grid, grid.pixels() / pixels_per_seed, rng_seed);
      const Seeds seeds(test_device(), grid, centres(pixels), to_centres);
      Diagram exact(test_device(), grid), diagram(test_device(), grid);
      exact_diagram(seeds, exact);
      const auto count = [&] { return judge(grid, pixels, euclidean, diagram.read(), exact.read()).wrong; };
      low_resolution(seeds, diagram);
      wrong += count();
      jump_flooding(seeds, diagram);
      by_jfa += count();
    }
    BOOST_TEST(wrong <= by_jfa, pixels_per_seed << " pixels per seed: " << wrong << ", JFA " << by_jfa);
  }
}

BOOST_AUTO_TEST_CASE(the_same_labels_for_every_kernel_shape) {
  const Grid grid(143, 61);
  const auto seeds = random_pixels(grid, 300, 6);
  const Labels expected = labels_of(test_device(), grid, seeds);
  for (const Tuning& shape :
       {Tuning{1, 32, 8}, Tuning{2, 64, 1}, Tuning{4, 1, 16}, Tuning{8, 64, 1}, Tuning{16, 5, 2}}) {
    BOOST_TEST_CONTEXT("vector width " << shape.vector_width) {
      BOOST_TEST((labels_of(test_device().with_tuning(shape), grid, seeds) == expected));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_workspace_fits_the_next_frame) {
  const Grid grid(90, 70);
  Diagram diagram(test_device(), grid);
  for (unsigned frame = 1; frame <= 3; ++frame) {
    const auto seeds = random_pixels(grid, std::size_t{40} * frame, frame);
    low_resolution(Seeds(test_device(), grid, centres(seeds), to_centres), diagram);
    BOOST_TEST((diagram.read() == reference_low_resolution(grid, seeds)));
  }
}

BOOST_AUTO_TEST_CASE(a_part_of_a_grid_is_not_flooded) {
  const Grid grid(8, 8);
  Diagram whole(test_device(), grid), part(test_device(), Window(grid, 2, 2, 4, 4));
  check_error([&] { low_resolution(Seeds(test_device(), grid, {{3, 3}}, to_centres), part); }, {"exact"});
  check_error(
      [&] {
        low_resolution(Seeds(test_device(), grid, {{3, 3}, {-1, 3}}, to_centres), whole);
      },
      {"exact"});
}
