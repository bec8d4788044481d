// The vorocl-study program.
#include "studies/study_line.hpp"

int main(int argc, char** argv) {
  return vorocl::command::run_program(vorocl::command::run_study, argc, argv);
}
