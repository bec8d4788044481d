// .vti and .pvd files, with a straight parser; check_vtk.sh reads them with VTK.
#define BOOST_TEST_MODULE vtk_files
#include "fixture.hpp"
#include "formats/raster_files.hpp"
#include "raw_images.hpp"

using namespace vorocl;
using namespace vorocl::command;

BOOST_AUTO_TEST_CASE(images_keep_every_value_and_lie_where_their_data_do) {
  const TemporaryFolder folder;
  const std::vector<std::uint32_t> labels = {0, 1, 2147483648u, 16777217, 4294967294u, no_label};
  write_labels(folder / "a.vti", Size(3, 2), labels);
  const auto image = read_raw_vti<std::uint32_t>(folder / "a.vti");
  BOOST_TEST(image.type == "UInt32");
  BOOST_TEST(image.name == "label");
  BOOST_TEST((image.width == 3u && image.height == 2u));
  BOOST_TEST(image.values == labels, boost::test_tools::per_element());
  // Where y points up, the last row comes first in the file, behind the size of the values.
  for (const bool y_up : {false, true}) {
    write_labels(folder / "b.vti", Raster(Size(3, 2), {{10, -4, 16, 4}, y_up, {}}), labels);
    const std::string content = content_of(folder / "b.vti");
    BOOST_TEST(found_in(content, "Origin=\"([^\"]*)\"") == "10 -4 0");
    BOOST_TEST(found_in(content, "Spacing=\"([^\"]*)\"") == "2 4 1");
    const std::string first = y_up ? std::string("\x01\0\0\x01", 4) : std::string("\0\0\0\0", 4);
    BOOST_TEST(content.find(std::string("_\x18\0\0\0\0\0\0\0", 9) + first) != std::string::npos);
  }

  const std::vector<float> distances = {0, 1.5f, 2};
  write_vti(folder / "d.vti", "distance", Size(1, 3), distances);
  BOOST_TEST(read_raw_vti<float>(folder / "d.vti").values == distances, boost::test_tools::per_element());
  BOOST_TEST(read_raw_vti<float>(folder / "d.vti").name == "distance");
  check_error([&] { write_labels(folder / "missing/a.vti", Size(3, 2), labels); },
              {"cannot write", "missing"});
}

BOOST_AUTO_TEST_CASE(collections_list_files_with_their_times) {
  const TemporaryFolder folder;
  write_pvd(folder / "a.pvd", {{-5, "a&b\"<0.vti"}, {3000000000, "a1.vti"}});
  const std::string content = content_of(folder / "a.pvd");
  BOOST_TEST(found_in(content, "<VTKFile type=\"([^\"]*)\"") == "Collection");
  BOOST_TEST(found_in(content, "<DataSet timestep=\"-5\" part=\"0\" file=\"([^\"]*)\"/>") ==
             "a&amp;b&quot;&lt;0.vti");
  BOOST_TEST(found_in(content, "<DataSet timestep=\"3000000000\" part=\"0\" file=\"([^\"]*)\"/>") ==
             "a1.vti");
  write_pvd(folder / "none.pvd", {});
  BOOST_TEST(content_of(folder / "none.pvd").find("DataSet") == std::string::npos);
}
