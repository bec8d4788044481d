// The vorocl command: parses, runs a subcommand, and turns what went wrong into one line and an exit code.
#include <exception>

#include "app/commands/commands.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/usage_error.hpp"

namespace {

constexpr int success = 0, failure = 1, usage = 2;

}  // namespace

int main(int argc, char** argv) {
  using namespace vorocl::command;
  open_standard_streams();
  remove_temporary_files_on_signals();
  try {
    run_command(argc, argv);
    flush_standard_output();
    return success;
  } catch (const UsageError& error) {
    print_error(error);
    return usage;
  } catch (const std::exception& error) {
    print_error(error);
  }
  return failure;
}
