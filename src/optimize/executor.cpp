#include "optimize/executor.hpp"

#include <algorithm>
#include <thread>

#ifdef FORMOTION_EXECUTOR_std
#include <atomic>
#include <exception>
#include <mutex>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace formotion {
namespace {

int thread_count(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

#ifdef FORMOTION_EXECUTOR_std

void run_parallel(int count, int threads, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto drain = [&] {
    for (int i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        next = count;
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
      }
    }
  };
  std::vector<std::jthread> helpers;
  for (int t = 1; t < std::min(thread_count(threads), count); ++t) helpers.emplace_back(drain);
  drain();
  helpers.clear();  // joins
  if (failure) std::rethrow_exception(failure);
}

#else

void run_parallel(int count, int threads, const std::function<void(int)>& work) {
  // The limit is raised, too: more threads than cores are odd but may be asked for.
  const auto limit = static_cast<std::size_t>(thread_count(threads));
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);
  tbb::task_arena arena(static_cast<int>(limit));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, count, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int i = range.begin(); i < range.end(); ++i) work(i);
        },
        tbb::simple_partitioner());
  });
}

#endif

}  // namespace formotion
