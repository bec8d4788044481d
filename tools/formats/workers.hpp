// Threads that do what a caller need not wait for.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace vorocl::command {

class Workers {
 public:
  /// As many as this process has cores, and at most so many; fewer where the system allows no more. Without
  /// any, the caller does the work itself.
  explicit Workers(std::size_t most);

  /// Ends when all is done. What still fails then, nobody hears of: wait() before.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Takes work, and waits until a thread is free to do it. Throws what earlier work has thrown, each time
  /// from then on.
  void add(std::function<void()> work);

  /// Waits until all is done. Throws what it has thrown.
  void wait();

 private:
  void run();
  void rethrow();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::size_t busy_ = 0;
  bool ends_ = false;
  std::exception_ptr thrown_;
  std::vector<std::thread> threads_;
};

}  // namespace vorocl::command
