// The points in samples/, as pixels of a grid.
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "brute_force.hpp"

namespace vorocl {

/// The pixel of a point (x in 0 to width, y in 0 to height, or a little outside).
inline Pixel pixel_in(const Grid& grid, double x, double y, double width, double height) {
  const auto along = [](double at, double extent, std::int64_t pixels) {
    return std::clamp<std::int64_t>(static_cast<int>(at * static_cast<double>(pixels) / extent), 0,
                                    pixels - 1);
  };
  return {along(x, width, grid.width()), along(y, height, grid.height())};
}

/// The world's cities, from longitudes and latitudes to a grid of all of them, the northern ones first.
inline std::vector<Pixel> cities(const Grid& grid) {
  std::ifstream file(VOROCL_SAMPLES "/cities-5000.csv");
  std::string line;
  std::getline(file, line);
  std::vector<Pixel> pixels;
  for (double x = 0, y = 0; std::getline(file, line);) {
    BOOST_TEST_REQUIRE(std::sscanf(line.c_str(), "%lf,%lf", &x, &y) == 2);
    const Axis columns(grid.width(), -180, 180), rows = Axis(grid.height(), -90, 90).reversed();
    pixels.push_back({static_cast<int>(columns.pixel(x)), static_cast<int>(rows.pixel(y))});
  }
  BOOST_TEST_REQUIRE(pixels.size() == 5000);
  return pixels;
}

/// The particles of the last frame of a LAMMPS dump in samples/, whose box begins at 0, 0.
inline std::vector<Pixel> particles(const std::string& name, const Grid& grid) {
  std::ifstream file(VOROCL_SAMPLES "/" + name);
  std::vector<Pixel> pixels;
  double width = 0, height = 0, x = 0, y = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("ITEM: BOX BOUNDS", 0) == 0) {
      file >> x >> width >> y >> height;
      pixels.clear();
    } else if (std::sscanf(line.c_str(), "%*d %*d %lf %lf", &x, &y) == 2) {
      pixels.push_back(pixel_in(grid, x, y, width, height));
    }
  }
  BOOST_TEST_REQUIRE(pixels.size() > 1000);
  return pixels;
}

}  // namespace vorocl
