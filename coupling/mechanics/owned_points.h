#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel/comm.h"
#include "core/parallel/order_free_sum.h"
#include "core/parallel/threads.h"
#include "coupling/mechanics/scene.h"

namespace morula {

/// Loops and sums over the points that are unknowns of this rank: those of bodies that move, and of what is within them.
struct OwnedPoints {
  const Scene& scene;
  const Comm& comm;
  int threads;

  /// function(thread, body) for the bodies that move; neighbours go to one thread.
  template <class F>
  void for_bodies(F&& function) const {
    const auto bodies = scene.bodies();
    const auto count = static_cast<std::size_t>(threads);
    on_each_thread(threads, [&](std::size_t t) {
      for (std::size_t k = bodies.size() * t / count; k < bodies.size() * (t + 1) / count; ++k)
        if (bodies[k].active()) function(t, bodies[k]);
    });
  }
  /// function(point) for the points within shells that move.
  template <class F>
  void for_inner(F&& function) const {
    for (const Scene::Inner& inner : scene.inner())
      if (scene.bodies()[inner.shell].active())
        for (std::uint32_t i = inner.first_point; i < inner.first_point + inner.point_count; ++i) function(i);
  }
  template <class F>
  void for_all(F&& function) const {
    for_inner(function);
    for_bodies([&](std::size_t, const ContactBody& body) {
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) function(i);
    });
  }

  /// Largest norm of vector(point) on all ranks; not a number wins. Collective.
  template <class Vector>
  [[nodiscard]] double largest_of(const Vector& vector) const {
    const auto more = [](double here, double most) { return !(here <= most) && !std::isnan(most); };
    std::vector<double> by_thread(static_cast<std::size_t>(threads), 0.0);
    for_bodies([&](std::size_t t, const ContactBody& body) {
      double most = by_thread[t];
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i)
        if (const double here = norm2(vector(i)); more(here, most)) most = here;
      by_thread[t] = most;
    });
    double most = 0.0;
    for (const double here : by_thread)
      if (more(here, most)) most = here;
    for_inner([&](std::uint32_t i) { most = std::max(most, norm2(vector(i))); });
    return std::sqrt(comm.max(most));
  }
  template <class Vectors>
  [[nodiscard]] double largest(const Vectors& by_point) const {
    return largest_of([&](std::uint32_t i) { return by_point[i]; });
  }
  /// Σ a·b of all ranks, the same bits on any number of threads and ranks. Collective.
  template <class Vectors>
  [[nodiscard]] double dot(const std::vector<Vec3d>& a, const Vectors& b) const {
    std::vector<OrderFreeSum> sums(static_cast<std::size_t>(threads));
    for_bodies([&](std::size_t t, const ContactBody& body) {
      double part = 0.0;
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) part += morula::dot(a[i], b[i]);
      sums[t].add(part);
    });
    for (std::size_t t = 1; t < sums.size(); ++t) sums[0] += sums[t];
    for_inner([&](std::uint32_t i) { sums[0].add(morula::dot(a[i], b[i])); });
    return comm.sum(sums[0]);
  }
};

}  // namespace morula
