#include "app/terminal/interruption.hpp"

#include <csignal>

#include "formats/temporary_names.hpp"

namespace vorocl::command {

namespace {

volatile std::sig_atomic_t is_deferred = 0, signal_came = 0;

void end(int signal) {
  if (is_deferred != 0 && signal_came == 0) {
    signal_came = 1;
    return;
  }
  remove_temporary_files();
  std::signal(signal, SIG_DFL);
  raise(signal);  // comes when the handler returns
}

}  // namespace

void remove_temporary_files_on_signals() {
  struct sigaction action = {};
  action.sa_handler = end;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

Interruption::Interruption() {
  signal_came = 0;
  is_deferred = 1;
}

Interruption::~Interruption() { is_deferred = 0; }

bool Interruption::came() const { return signal_came != 0; }

}  // namespace vorocl::command
