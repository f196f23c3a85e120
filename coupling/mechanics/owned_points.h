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
  /// Largest of all bodies and ranks. That of a body is 1.7 times the mean (Σ |vector|⁴/n)^(1/4) over its points, and no more than the largest of them:
  /// where a tenth of them go, or all, it is theirs; one of 162 that goes alone counts half (decision 0052). Collective.
  template <class Vector>
  [[nodiscard]] double largest_way_of_body(const Vector& vector) const {
    constexpr double kTimes4 = 1.7 * 1.7 * 1.7 * 1.7;
    const auto fourth_power = [&](std::uint32_t first, std::uint32_t count) {
      double sum = 0.0, largest = 0.0;
      for (std::uint32_t i = first; i < first + count; ++i) {
        const double square = norm2(vector(i)), fourth = square * square;
        sum += fourth;
        largest = std::max(largest, fourth);
      }
      return std::min(kTimes4 * sum / count, largest);
    };
    std::vector<double> by_thread(static_cast<std::size_t>(threads), 0.0);
    for_bodies([&](std::size_t t, const ContactBody& body) {
      by_thread[t] = std::max(by_thread[t], fourth_power(body.first_point, body.point_count));
    });
    double most = 0.0;
    for (const double here : by_thread) most = std::max(most, here);
    for (const Scene::Inner& inner : scene.inner())
      if (scene.bodies()[inner.shell].active()) most = std::max(most, fourth_power(inner.first_point, inner.point_count));
    return std::sqrt(std::sqrt(comm.max(most)));
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
