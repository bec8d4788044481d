#include "formats/workers.hpp"

#include <sched.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace vorocl::command {

namespace {

/// The cores that this process may use: processes that share a machine are often bound to some of them.
std::size_t cores() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<std::size_t>(CPU_COUNT(&set));
  return std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
}

}  // namespace

Workers::Workers(std::size_t most) {
  const std::size_t count = std::min(cores(), most);
  threads_.reserve(count);
  try {
    for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this] { run(); });
  } catch (const std::system_error&) {
    // As many as the system allows.
  }
}

Workers::~Workers() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::add(std::function<void()> work) {
  if (threads_.empty()) {
    work();
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.size() + busy_ < threads_.size() || thrown_; });
  rethrow();
  waiting_.push_back(std::move(work));
  changed_.notify_all();
}

void Workers::wait() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.empty() && busy_ == 0; });
  rethrow();
}

void Workers::rethrow() {
  if (thrown_) std::rethrow_exception(thrown_);
}

void Workers::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::function<void()> work = std::move(waiting_.front());
    waiting_.pop_front();
    ++busy_;
    lock.unlock();
    std::exception_ptr thrown;
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    --busy_;
    if (thrown) thrown_ = thrown;
    changed_.notify_all();
  }
}

}  // namespace vorocl::command
