#include "runtime/binary_cache.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>

#include "runtime/opencl_info.hpp"
#include "runtime/process.hpp"
#include "vorocl/error.hpp"

#if VOROCL_IS_UNIX
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#endif

namespace vorocl {

namespace {

/// Finds damage, not malice: a folder that others could write to is not read.
std::uint64_t checksum(const std::string& text) {
  std::uint64_t sum = 0xcbf29ce484222325 ^ text.size();
  for (std::size_t i = 0; i < text.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data() + i, std::min(sizeof word, text.size() - i));
    sum = (sum ^ word) * 0x9e3779b97f4a7c15;
    sum ^= sum >> 32;
  }
  return sum;
}

std::string hexadecimal(std::uint64_t number) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(number));
  return digits.data();
}

std::string path_of(const std::string& key) { return binary_folder() + '/' + hexadecimal(checksum(key)); }

/// What a file begins with: the checksum of the rest, which is the key and the binary.
constexpr const char* magic = "VoroCL binary 1 ";

std::string file_of(const std::string& key, const std::string& binary) {
  const std::string rest = std::to_string(key.size()) + '\n' + key + binary;
  return magic + hexadecimal(checksum(rest)) + '\n' + rest;
}

/// The binary in a file; none if the file is damaged or of another key.
std::optional<std::string> binary_in(const std::string& file, const std::string& key) {
  const std::string first = std::to_string(key.size()) + '\n' + key;
  const std::size_t begin = std::strlen(magic) + 17;  // of the rest
  if (file.size() <= begin + first.size() || file.compare(begin, first.size(), first) != 0) return {};
  std::string binary = file.substr(begin + first.size());
  if (file.compare(0, begin, file_of(key, binary), 0, begin) != 0) return {};
  return binary;
}

}  // namespace

std::string binary_folder() {
  if (!VOROCL_IS_UNIX || environment("VOROCL_BINARY_CACHE") == "0") return "";
  if (const std::string caches = environment("XDG_CACHE_HOME"); !caches.empty() && caches[0] == '/')
    return caches + "/vorocl/binaries";
  const std::string home = environment("HOME");
  return home.empty() ? "" : home + "/.cache/vorocl/binaries";
}

bool is_pocl(const Device& device) { return device.platform_name() == "Portable Computing Language"; }

bool keeps_binaries(const Device& device) { return is_pocl(device) && !binary_folder().empty(); }

std::string binary_key(const Device& device, const std::string& source, const std::string& options) {
  if (!keeps_binaries(device)) return "";
  const auto platform = device_info<cl_platform_id>(device.cl_device()(), CL_DEVICE_PLATFORM);
  std::string key;
  for (const std::string& part :
       {info<std::string>(clGetPlatformInfo, platform, CL_PLATFORM_VERSION), device.name(),
        device_info<std::string>(device.cl_device()(), CL_DEVICE_VERSION), device.driver_version(),
        processor_features(), options, std::to_string(source.size()), hexadecimal(checksum(source))}) {
    key += part + '\n';
  }
  return key;
}

#if VOROCL_IS_UNIX

namespace {

constexpr std::time_t hour = 3600, half_a_year = std::time_t{183} * 24 * hour;
constexpr const char* unfinished = "new-";  // begins the names of files that are being written

/// Closes a file at the end of a scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

bool is_mine_alone(const struct stat& status, mode_t others_may_not) {
  return status.st_uid == geteuid() && (status.st_mode & others_may_not) == 0;
}

bool is_safe_folder(const std::string& folder) {
  struct stat status = {};
  return lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && is_mine_alone(status, 077);
}

[[noreturn]] void refuse_to_keep(const std::string& why) {
  throw Error("cannot keep binaries of programs in " + binary_folder() + ": " + why, ErrorKind::file);
}

void make_folder(const std::string& folder) {
  // Those above it that cannot be made are there, or the last one cannot be made.
  for (std::size_t end = folder.find('/', 1); end != std::string::npos; end = folder.find('/', end + 1))
    mkdir(folder.substr(0, end).c_str(), 0700);
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) refuse_to_keep(std::strerror(errno));
  if (!is_safe_folder(folder)) {
    refuse_to_keep("it must be a folder of this user's that nobody else can open (chmod 700)");
  }
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_to_keep(std::strerror(errno));
    done += static_cast<std::size_t>(count);
  }
}

/// Removes files that are as old as that, whether complete or not.
void remove_old_files(const std::string& folder) {
  DIR* const entries = opendir(folder.c_str());
  if (entries == nullptr) return;
  const std::time_t now = std::time(nullptr);
  while (const dirent* const entry = readdir(entries)) {
    const std::string path = folder + '/' + entry->d_name;
    const bool is_unfinished = std::strncmp(entry->d_name, unfinished, std::strlen(unfinished)) == 0;
    struct stat status = {};
    if (lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
        now - status.st_mtime > (is_unfinished ? hour : half_a_year)) {
      unlink(path.c_str());
    }
  }
  closedir(entries);
}

}  // namespace

std::optional<std::string> kept_binary(const std::string& key) {
  if (key.empty() || !is_safe_folder(binary_folder())) return {};
  // A pipe in its place is not waited for.
  const Descriptor file(open(path_of(key).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status = {};
  if (file.number() < 0 || fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode) ||
      !is_mine_alone(status, 022)) {
    return {};
  }
  constexpr off_t largest = 64 << 20;
  std::string text(static_cast<std::size_t>(std::min(status.st_size, largest)), '\0');
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = read(file.number(), text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return {};
    done += static_cast<std::size_t>(count);
  }
  return binary_in(text, key);
}

void open_binary_folder() {
  make_folder(binary_folder());
  remove_old_files(binary_folder());
}

void keep_binary(const std::string& key, const std::string& binary) {
  std::random_device random;
  const std::string part =
      binary_folder() + '/' + unfinished + hexadecimal((std::uint64_t{random()} << 32) | random());
  const Descriptor file(open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (file.number() < 0) refuse_to_keep(std::strerror(errno));
  try {
    write_all(file.number(), file_of(key, binary));
    if (rename(part.c_str(), path_of(key).c_str()) != 0) refuse_to_keep(std::strerror(errno));
  } catch (...) {
    unlink(part.c_str());
    throw;
  }
}

void use_binary(const std::string& key) {
  utimensat(AT_FDCWD, path_of(key).c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
}

#else

std::optional<std::string> kept_binary(const std::string&) { return {}; }
void open_binary_folder() {}
void keep_binary(const std::string&, const std::string&) {}
void use_binary(const std::string&) {}

#endif

}  // namespace vorocl
