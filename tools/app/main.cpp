// The vorocl command.
#include "app/commands/commands.hpp"

int main(int argc, char** argv) {
  return vorocl::command::run_program(vorocl::command::run_command, argc, argv);
}
