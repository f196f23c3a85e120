#pragma once
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

/// Loops over threads. With one thread they are plain loops: a parallel region ends with a call of the system even then, which takes as
/// long as a small tissue's share of the work. With several, neighbouring numbers go to one thread.
namespace morula {

/// function(k) for 0 <= k < count.
template <class Function>
void parallel_for(int threads, std::size_t count, Function&& function) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t k = 0; k < count; ++k) function(k);
    return;
  }
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t k = 0; k < count; ++k) function(k);
}

/// function(k, workspace) for 0 <= k < count; each thread has one Workspace.
template <class Workspace, class Function>
void parallel_for_with(int threads, std::size_t count, Function&& function) {
  if (threads <= 1 || count <= 1) {
    Workspace workspace;
    for (std::size_t k = 0; k < count; ++k) function(k, workspace);
    return;
  }
#pragma omp parallel num_threads(threads)
  {
    Workspace workspace;
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < count; ++k) function(k, workspace);
  }
}

/// function(t) for each thread t: for work that was divided beforehand.
template <class Function>
void on_each_thread(int threads, Function&& function) {
  if (threads <= 1) return function(std::size_t{0});
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (int t = 0; t < threads; ++t) function(static_cast<std::size_t>(t));
}

/// Numbers 0 <= k < count for whoever has time, a portion of neighbours at once: for work of unequal weight, within on_each_thread().
class WorkQueue {
 public:
  WorkQueue(std::size_t count, std::size_t portion) : count_(count), portion_(portion) {}

  /// function(k) as long as there are numbers left.
  template <class Function>
  void work_off(Function&& function) {
    for (;;) {
      const std::size_t first = next_.fetch_add(portion_, std::memory_order_relaxed), last = std::min(count_, first + portion_);
      if (first >= count_) return;
      for (std::size_t k = first; k < last; ++k) function(k);
    }
  }

 private:
  std::size_t count_, portion_;
  std::atomic<std::size_t> next_{0};
};

/// function(k) for 0 <= k < count, each number for whoever has time, the first ones first: for long work of unequal weight, which then makes its own loops on
/// one thread.
template <class Function>
void one_by_one(int threads, std::size_t count, Function&& function) {
  WorkQueue queue(count, 1);
  on_each_thread(static_cast<int>(std::min(static_cast<std::size_t>(std::max(threads, 1)), count)),
                 [&](std::size_t) { queue.work_off(function); });
}

/// What function(k, out) appends to a std::vector<T> `out` for 0 <= k < count, in the order of k.
template <class T, class Function>
std::vector<T> gather(int threads, std::size_t count, Function&& function) {
  const auto parts = static_cast<std::size_t>(std::max(threads, 1));
  std::vector<std::vector<T>> found(parts);
  on_each_thread(threads, [&](std::size_t t) {
    for (std::size_t k = count * t / parts; k < count * (t + 1) / parts; ++k) function(k, found[t]);
  });
  std::vector<T> out = std::move(found.front());
  for (std::size_t t = 1; t < parts; ++t) out.insert(out.end(), found[t].begin(), found[t].end());
  return out;
}

/// Largest function(k) of 0 <= k < count, and 0.
template <class Function>
double parallel_max(int threads, std::size_t count, Function&& function) {
  double most = 0.0;
  if (threads <= 1 || count <= 1) {
    for (std::size_t k = 0; k < count; ++k) most = std::max(most, function(k));
    return most;
  }
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : most)
  for (std::size_t k = 0; k < count; ++k) most = std::max(most, function(k));
  return most;
}

}  // namespace morula
