// vorocl prepare: compiles the kernels that later runs need, in as many processes as there are processors.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/samples.hpp"
#include "vorocl/preparation.hpp"

#ifdef __linux__
#include <sys/prctl.h>

#include <csignal>
#endif

namespace vorocl::command {

namespace {

struct PrepareOptions {
  std::string device;
  bool json = false;
};

/// What a process tells the one that made it, in one piece.
struct Answer {
  bool is_error = false;
  std::size_t binaries = 0;
  char text[1024] = "";  // the device's name, or the error
};

/// Prepares a part, in a process of its own.
Answer prepare_part(const std::string& request, const PreparationPart& part) {
  Answer answer;
  const auto say = [&answer](const std::string& text) {
    std::snprintf(answer.text, sizeof answer.text, "%s", text.c_str());
  };
  try {
    const Device device = Device::select(request);
    const FinishAtEnd finish(device);
    answer.binaries = prepare_programs(device, part);
    say(device.name());
  } catch (const std::exception& error) {
    answer.is_error = true;
    say(message_of(error));
  }
  return answer;
}

/// Processes, because a driver compiles in one thread at a time. They are forked, so the process that makes
/// them must not have used a driver.
class Processes {
 public:
  Processes(const std::string& request, std::size_t count) {
    int ends[2];
    if (pipe(ends) != 0) throw Error(std::string("cannot make a pipe: ") + std::strerror(errno));
    answers_ = ends[0];
    const pid_t parent = getpid();
    for (std::size_t i = 0; i < count; ++i) {
      const pid_t child = fork();
      if (child == 0) {
#ifdef __linux__
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() != parent) std::_Exit(1);  // it ended before that
#endif
        const Answer answer = prepare_part(request, {i, count});
        // What this process has of the other one's is not its own to end.
        std::_Exit(write(ends[1], &answer, sizeof answer) == sizeof answer ? 0 : 1);
      }
      if (child > 0) children_.push_back(child);
    }
    close(ends[1]);
  }
  ~Processes() {
    close(answers_);
    for (const pid_t child : children_) waitpid(child, nullptr, 0);
  }
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  /// Waits for all. Throws the error of one that failed.
  std::vector<Answer> wait() {
    std::vector<Answer> answers;
    for (Answer answer; read(answers_, &answer, sizeof answer) == sizeof answer;) {
      if (answer.is_error) throw Error(answer.text);
      answers.push_back(answer);
    }
    return answers;
  }

 private:
  int answers_ = -1;
  std::vector<pid_t> children_;
};

void run(const PrepareOptions& options) {
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t parts = std::min(processors, most_preparation_parts());
  const Stopwatch stopwatch;
  Processes processes(options.device, parts);
  const std::vector<Answer> answers = processes.wait();
  if (answers.size() < parts) {
    throw Error(fmt::format("{} of {} ended before their work was done; the same command goes on",
                            parts - answers.size(), counted(parts, "process", "processes")));
  }
  std::size_t binaries = 0;
  for (const Answer& answer : answers) binaries += answer.binaries;
  const std::string device = answers.front().text;
  if (options.json) {
    print_json({{"device", device},
                {"binaries", binaries},
                {"folder", binaries > 0 ? binaries_folder() : ""},
                {"processes", parts},
                {"seconds", stopwatch.seconds()}});
    return;
  }
  print("prepared the kernels of {} in {:.0f} s\n", device, stopwatch.seconds());
  if (binaries > 0) print("{} in {}\n", counted(binaries, "binary", "binaries"), binaries_folder());
}

}  // namespace

void add_prepare(CommandLine& line) {
  const auto options = std::make_shared<PrepareOptions>();
  Command command = line.add("prepare", "Compile the kernels that later runs need, once per user and device");
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([options] { run(*options); });
}

}  // namespace vorocl::command
