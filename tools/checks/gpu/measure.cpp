// Measures one case on a device and prints it as JSON, for tools/gpu_report.sh:
//   measure device                          what the device is
//   measure check                           which known diagrams it gets wrong
//   measure still SIDES SOURCE MS           each method on seeds that stand still, or on a mask
//   measure moving SIDES SOURCE MS FRAMES   the same of seeds that move by up to a pixel a frame and axis
//   measure kernels SIDES SOURCE MS         the time of every kernel of these methods
// SIDES are those of a grid: 2048, 600x300 or 256x256x256. SOURCE is a number of random seeds or a file:
//   .npy      pairs of doubles in pixels, of seeds at the centres of their pixels
//   .points   triples of doubles in pixels, of the points themselves: exact and jfa
//   .mask     a byte per pixel, whose zeros are marked: its distance transform goes by the name of exact
// Each method runs for MS milliseconds, after others to warm up; for 0 it runs once, for its labels.
// VOROCL_DEVICE names the device. It links the library's core alone.
#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <sstream>

#include "checks/known_answers.hpp"
#include "formats/values.hpp"
#include "vorocl/vorocl.hpp"

using namespace vorocl;
using command::Hash;

namespace {

constexpr double warm_up_milliseconds = 200;
constexpr int step_length = 1;  // of moving seeds, in pixels

using Labels = std::vector<std::uint32_t>;

// --- JSON ---

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + '"';
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value;
  return text.str();
}

std::string hexadecimal(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << value;
  return quoted(text.str());
}

/// Members in their order, whose values are JSON already.
using Members = std::vector<std::pair<std::string, std::string>>;

std::string object(const Members& members) {
  std::string text;
  for (const auto& [name, value] : members) text += (text.empty() ? "" : ", ") + quoted(name) + ": " + value;
  return "{" + text + "}";
}

std::string list(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return "[" + text + "]";
}

// --- sources, labels ---

std::string extension_of(const std::string& source) { return source.substr(source.rfind('.') + 1); }
bool is_between_centres(const std::string& source) { return extension_of(source) == "points"; }

Grid grid_of(const std::string& sides) {
  std::vector<int> pixels;
  for (const auto side : command::parts_of(sides, 'x'))
    pixels.push_back(command::parse_number<int>(side).value());
  return {pixels[0], pixels.size() > 1 ? pixels[1] : pixels[0], pixels.size() > 2 ? pixels[2] : 1};
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path + " cannot be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The points of an .npy file of version 1, pairs of little-endian doubles behind a header, or of a .points
/// file.
std::vector<Point> points_of(const std::string& path) {
  const std::string bytes = bytes_of(path);
  std::vector<Point> points;
  if (is_between_centres(path)) {
    points.resize(bytes.size() / sizeof(Point));
    std::memcpy(points.data(), bytes.data(), points.size() * sizeof(Point));
    return points;
  }
  constexpr std::size_t preamble = 10;
  if (bytes.size() < preamble) throw Error(path + " is no .npy file");
  const std::size_t begin = preamble + static_cast<unsigned char>(bytes[8]) +
                            std::size_t{256} * static_cast<unsigned char>(bytes[9]);
  if (bytes.substr(0, begin).find("<f8") == std::string::npos) throw Error(path + " holds no doubles");
  std::vector<double> pairs((bytes.size() - begin) / sizeof(double));
  std::memcpy(pairs.data(), bytes.data() + begin, pairs.size() * sizeof(double));
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) points.push_back({pairs[i], pairs[i + 1]});
  return points;
}

Seeds make_seeds(const Device& device, const Grid& grid, const std::string& source) {
  if (const auto count = command::parse_number<std::size_t>(source))
    return Seeds::random(device, grid, *count, 1);
  const Snap snap = is_between_centres(source) ? Snap::none : Snap::to_pixels;
  return {device, grid, points_of(source), {Outside::refuse, snap}};
}

std::string hash_of(const Labels& labels) {
  Hash hash;
  for (const std::uint32_t label : labels) hash.add(label);
  return hexadecimal(hash.value());
}

/// Of pixels, or of positions between their centres.
std::string hash_of(const Seeds& seeds, const std::string& source) {
  const double units = is_between_centres(source) ? 4096 : 1;  // in a pixel
  Hash hash;
  for (const std::optional<Point>& position : seeds.read_pixels()) {
    hash.add(static_cast<std::uint32_t>(position.value().x * units));
    hash.add(static_cast<std::uint32_t>(position->y * units));
    if (seeds.grid().is_volume()) hash.add(static_cast<std::uint32_t>(position->z * units));
  }
  return hexadecimal(hash.value());
}

/// The pixels whose seed is farther than the nearest one.
std::size_t wrong_pixels(const Seeds& seeds, const Diagram& diagram) {
  Diagram labels(seeds.device(), seeds.grid()), exact(seeds.device(), seeds.grid());
  labels.write(diagram.labels(), seeds, Metric::euclidean);
  exact_diagram(seeds, exact);
  DistanceErrorsResult result;
  distance_errors(labels, exact, result);
  return result.read().wrong_pixels;
}

// --- times ---

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::string median_and_least(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return object({{"median", number(values[values.size() / 2])}, {"least", number(values.front())}});
}

/// What is timed, what has to be done before each run of it, and what is to be told of the last one's labels.
struct Subject {
  std::function<void()> prepare;
  std::function<double()> run;  // enqueues, waits, and returns the time by the device's events
  std::function<Members()> judge;
};

/// Runs for so many milliseconds; returns how often, and the times per `share` of a run.
Members times_of(const Device& device, const Subject& subject, double budget, int share = 1) {
  constexpr std::size_t most_runs = 2000;
  std::vector<double> wall, events;
  const auto run = [&] {
    subject.prepare();
    device.finish();
    const auto start = std::chrono::steady_clock::now();
    const double event = subject.run();
    wall.push_back(milliseconds_since(start) / share);
    events.push_back(event / share);
  };
  const auto run_for = [&](double milliseconds) {
    wall.clear();
    events.clear();
    const auto start = std::chrono::steady_clock::now();
    do run();
    while (milliseconds_since(start) < milliseconds && wall.size() < most_runs);
  };
  run_for(0);  // builds what is missing
  if (budget <= 0) return {};
  run_for(warm_up_milliseconds);
  run_for(budget);
  return {{"runs", std::to_string(wall.size())},
          {"wall_ms", median_and_least(wall)},
          {"event_ms", median_and_least(events)}};
}

/// Without dJFA where points lie between centres: it snaps them, and they move by parts of a pixel.
std::vector<std::string> methods_of(const std::string& source) {
  if (is_between_centres(source)) return {"exact", "jfa"};
  return {"exact", "jfa", "djfa"};
}

/// A method on seeds that stand still. dJFA goes on from the JFA of the seeds a random step away.
Subject still_subject(const Method& method, const Seeds& seeds, Diagram& diagram) {
  const auto judge = [&seeds, &diagram]() -> Members {
    return {{"labels", hash_of(diagram.read())},
            {"wrong_pixels", std::to_string(wrong_pixels(seeds, diagram))}};
  };
  const auto run = [&method, &seeds, &diagram] {
    const Report report = method.run(seeds, diagram, {});
    diagram.wait();
    return report.milliseconds();
  };
  if (!method.continues) return {[] {}, run, judge};
  const auto moving = std::make_shared<Seeds>(seeds.clone());
  const auto now = seeds.read();
  random_step(*moving, 5, Border::reflect, 1, 0);
  const auto before = moving->read();
  const auto prepare = [moving, before, now, &diagram] {
    moving->move_to(before);
    jump_flooding(*moving, diagram);
    moving->move_to(now);
  };
  const auto go_on = [&method, moving, &diagram] {
    const Report report = method.run(*moving, diagram, {});
    diagram.wait();
    return report.milliseconds();
  };
  return {prepare, go_on, judge};
}

using Measure = std::function<std::string(const Subject&)>;

std::string measured_mask(const Device& device, const Grid& grid, const std::string& source,
                          const Measure& measure) {
  std::string mask = bytes_of(source);
  std::vector<float> found(mask.size());
  const cl::Buffer pixels(device.context(), mask.begin(), mask.end(), true);
  const cl::Buffer distances(device.context(), found.begin(), found.end(), false);
  DistanceTransform transform(device, grid);
  TransformTargets targets;
  targets.distances = {distances, PixelType::float32};
  const auto run = [&] {
    const Report report = transform.run({pixels, PixelType::uint8}, targets);
    device.finish();
    return report.milliseconds();
  };
  const auto judge = [&]() -> Members {
    cl::copy(device.queue(), distances, found.begin(), found.end());
    Labels squares;
    for (const double distance : found)
      squares.push_back(static_cast<std::uint32_t>(std::lround(distance * distance)));
    const auto sum = std::accumulate(squares.begin(), squares.end(), std::uint64_t{0});
    return {{"labels", hash_of(squares)}, {"squares", std::to_string(sum)}};
  };
  Hash hash;
  hash.add_text(mask);
  return object({{"seed_count", std::to_string(std::count(mask.begin(), mask.end(), 0))},
                 {"seeds", hexadecimal(hash.value())},
                 {"methods", object({{"exact", measure({[] {}, run, judge})}})}});
}

/// What is measured of each method.
std::string measured(const Device& device, const Grid& grid, const std::string& source,
                     const Measure& measure) {
  if (extension_of(source) == "mask") return measured_mask(device, grid, source, measure);
  const Seeds seeds = make_seeds(device, grid, source);
  Diagram diagram(device, grid);
  Members methods;
  for (const std::string& name : methods_of(source)) {
    methods.emplace_back(name, measure(still_subject(method(name), seeds, diagram)));
  }
  return object({{"seed_count", std::to_string(seeds.alive())},
                 {"seeds", hash_of(seeds, source)},
                 {"methods", object(methods)}});
}

std::string still(const Device& device, const Grid& grid, const std::string& source, double budget) {
  return measured(device, grid, source, [&](const Subject& subject) {
    Members found = times_of(device, subject, budget);
    for (auto& member : subject.judge()) found.push_back(std::move(member));
    return object(found);
  });
}

/// Random steps; or from points to others and back, which both lie in buffers of the device.
Simulation::Motion motion_of(const Device& device, const std::string& source) {
  if (!is_between_centres(source)) {
    return [](Seeds& moved, Window&, int frame) {
      random_step(moved, step_length, Border::reflect, 1, static_cast<std::uint32_t>(frame));
    };
  }
  std::vector<Point> points = points_of(source);
  const cl::Buffer first(device.context(), points.begin(), points.end(), true);
  std::mt19937_64 random(1);  // the same numbers with every standard library
  const auto step = [&] { return step_length * static_cast<double>(random() >> 11) * 0x1p-53; };
  for (Point& point : points) point = {std::abs(point.x - step()), std::abs(point.y - step()), point.z};
  const cl::Buffer moved(device.context(), points.begin(), points.end(), true);
  return [first, moved, count = points.size()](Seeds& seeds, Window&, int frame) {
    seeds.move_to(PointBuffer(frame % 2 == 0 ? moved : first, count, PointFormat::doubles_xyz));
  };
}

/// Frames 1 to `frames`, each from the one before; their times are per frame, and that on the wall has the
/// motion.
std::string moving(const Device& device, const Grid& grid, const std::string& source, double budget,
                   int frames) {
  const Seeds seeds = make_seeds(device, grid, source);
  const Simulation::Motion motion = motion_of(device, source);
  std::string seeds_at_end;
  Members methods;
  for (const std::string& name : methods_of(source)) {
    std::optional<Simulation> simulation;
    const auto prepare = [&] {
      simulation.emplace(seeds.clone(), motion);
      simulation->add_engine(engine(method(name)));
      simulation->step();
    };
    const auto run = [&] {
      for (int frame = 1; frame <= frames; ++frame) simulation->step();
      device.finish();
      return simulation->milliseconds();
    };
    Members found = times_of(device, {prepare, run, {}}, budget, frames);
    found.emplace_back("labels", hash_of(simulation->diagram().read()));
    seeds_at_end = hash_of(simulation->seeds(), source);
    methods.emplace_back(name, object(found));
  }
  return object(
      {{"seed_count", std::to_string(seeds.alive())}, {"seeds", seeds_at_end}, {"methods", object(methods)}});
}

// --- kernels ---

struct Launch {
  std::string kernel;
  std::size_t items, group;
  cl::Event event;
};

/// Where launches are written down; null while they are not.
std::vector<Launch>* launches = nullptr;

std::string name_of(cl_kernel kernel) {
  char name[100] = "";
  clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, nullptr);
  return name;
}

double microseconds_of(const cl::Event& event) {
  cl_ulong start = 0, end = 0;
  clGetEventProfilingInfo(event(), CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr);
  clGetEventProfilingInfo(event(), CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr);
  return static_cast<double>(end - start) * 1e-3;
}

/// The medians of the launches of one diagram, which are the same in every run.
std::string kernels_of(const Device& device, const Subject& subject, double budget) {
  times_of(device, subject, std::min(budget, 1.0));  // warms up
  std::vector<Launch> first;
  std::vector<std::vector<double>> times;
  const auto start = std::chrono::steady_clock::now();
  do {
    subject.prepare();
    device.finish();
    std::vector<Launch> run;
    launches = &run;
    subject.run();
    launches = nullptr;
    times.resize(run.size());
    for (std::size_t i = 0; i < run.size(); ++i) times[i].push_back(microseconds_of(run[i].event));
    first = std::move(run);
  } while (milliseconds_since(start) < budget);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < first.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    found.push_back(object({{"kernel", quoted(first[i].kernel)},
                            {"items", std::to_string(first[i].items)},
                            {"group", std::to_string(first[i].group)},
                            {"median_us", number(times[i][times[i].size() / 2])}}));
  }
  return list(found);
}

std::string kernels(const Device& device, const Grid& grid, const std::string& source, double budget) {
  return measured(device, grid, source, [&](const Subject& s) { return kernels_of(device, s, budget); });
}

// --- the device ---

template <typename T>
T asked(const Device& device, cl_device_info what) {
  T value{};
  clGetDeviceInfo(device.cl_device()(), what, sizeof value, &value, nullptr);
  return value;
}

std::string describe(const Device& device) {
  return object({{"device", quoted(device.name())},
                 {"platform", quoted(device.platform_name())},
                 {"driver", quoted(device.driver_version())},
                 {"compute_units", std::to_string(asked<cl_uint>(device, CL_DEVICE_MAX_COMPUTE_UNITS))},
                 {"megahertz", std::to_string(asked<cl_uint>(device, CL_DEVICE_MAX_CLOCK_FREQUENCY))},
                 {"memory_bytes", std::to_string(asked<cl_ulong>(device, CL_DEVICE_GLOBAL_MEM_SIZE))},
                 {"local_memory_bytes", std::to_string(asked<cl_ulong>(device, CL_DEVICE_LOCAL_MEM_SIZE))},
                 {"group_items", std::to_string(asked<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE))}});
}

std::string check_known_answers(const Device& device) {
  std::vector<std::string> wrong = command::wrong_answers(device);
  std::transform(wrong.begin(), wrong.end(), wrong.begin(), quoted);
  return object({{"checked", std::to_string(command::known_answers().size())}, {"wrong", list(wrong)}});
}

std::string measure(const Device& device, const std::vector<std::string>& arguments) {
  const std::string& what = arguments.at(0);
  if (what == "device") return describe(device);
  if (what == "check") return check_known_answers(device);
  const Grid grid = grid_of(arguments.at(1));
  const std::string& source = arguments.at(2);
  const double budget = command::parse_number<double>(arguments.at(3)).value();
  if (what == "still") return still(device, grid, source, budget);
  if (what == "kernels") return kernels(device, grid, source, budget);
  if (what == "moving")
    return moving(device, grid, source, budget, command::parse_number<int>(arguments.at(4)).value());
  throw Error("there is nothing to measure called \"" + what + "\"");
}

}  // namespace

/// The loader's call, with an event that is kept while launches are written down.
extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL clEnqueueNDRangeKernel(
    cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset, const size_t* global,
    const size_t* local, cl_uint count, const cl_event* waits, cl_event* event) {
  static const auto next =
      reinterpret_cast<decltype(&clEnqueueNDRangeKernel)>(dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel"));
  cl::Event own;
  cl_event* const out = event != nullptr ? event : &own();
  const cl_int code = next(queue, kernel, dimensions, offset, global, local, count, waits, out);
  if (code != CL_SUCCESS || launches == nullptr) return code;
  const auto product = [&](const size_t* sizes) {
    return std::accumulate(sizes, sizes + dimensions, std::size_t{1}, std::multiplies<>());
  };
  launches->push_back({name_of(kernel), product(global), local != nullptr ? product(local) : 0,
                       event != nullptr ? cl::Event(*event, true) : own});
  return code;
}

int main(int argc, char** argv) {
  try {
    const Device device = Device::select();
    const std::string found = measure(device, {argv + std::min(argc, 1), argv + argc});
    device.finish();
    std::puts(found.c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measure: %s\n", error.what());
    return 1;
  }
}
