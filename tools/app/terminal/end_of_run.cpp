#include "app/terminal/end_of_run.hpp"

#include <atomic>
#include <csignal>

#include "formats/output_file.hpp"

namespace vorocl::command {

namespace {

// Two threads may handle one signal each at the same time.
std::atomic<bool> is_deferred = false, signal_came = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not lock");

void end(int signal) {
  if (is_deferred && !signal_came.exchange(true)) return;
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
  signal_came = false;
  is_deferred = true;
}

Interruption::~Interruption() { is_deferred = false; }

bool Interruption::came() { return signal_came; }

}  // namespace vorocl::command
