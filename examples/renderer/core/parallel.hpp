// SPDX-License-Identifier: MIT
// Work shared among the threads of the arena that it is called from. TBB's parallel_for; under the
// thread sanitizer, plain threads: TBB's library isn't compiled with it, so that what TBB does to
// hand results from one thread to another would not be seen, and every result look like a race.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#define RENDERER_PLAIN_THREADS
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define RENDERER_PLAIN_THREADS
#endif
#endif

#ifdef RENDERER_PLAIN_THREADS
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>
#endif

namespace renderer {

/// Calls work(first, last) for parts of [0, count) of about `grain` or more, in any order; returns
/// when all is done.
template <class Work>
void parallel_for(std::size_t count, std::size_t grain, const Work& work) {
#ifdef RENDERER_PLAIN_THREADS
  std::atomic<std::size_t> next{0};
  const auto take_parts = [&] {
    for (std::size_t first = next.fetch_add(grain); first < count; first = next.fetch_add(grain))
      work(first, std::min(first + grain, count));
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < tbb::this_task_arena::max_concurrency(); ++i)
    threads.emplace_back(take_parts);
  take_parts();
  for (std::thread& thread : threads) thread.join();
#else
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [&](const tbb::blocked_range<std::size_t>& part) { work(part.begin(), part.end()); });
#endif
}

}  // namespace renderer
