#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/contact/common_drift.h"
#include "core/parallel/comm.h"
#include "core/parallel/order_free_sum.h"
#include "core/parallel/threads.h"
#include "coupling/mechanics/scene.h"

namespace morula {

/// How far the bodies of a tissue go, of shells and of spheres that which is more; never more than the largest way of a body [µm].
struct WayOfBodies {
  double weighted = 0.0;  ///< 1.7 (Σ way⁴/n)^(1/4): few that go far count more than many that do not
  double mean = 0.0;      ///< of shells 1.7 (Σ way²/n)^(1/2); spheres have no contact lines that snap, and count as before
};

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

  /// Largest norm of vector(point) on all ranks, that of a sphere times `of_sphere`; not a number wins. Collective.
  template <class Vector>
  [[nodiscard]] double largest_of(const Vector& vector, double of_sphere = 1.0) const {
    const auto more = [](double here, double most) { return !(here <= most) && !std::isnan(most); };
    std::vector<double> by_thread(static_cast<std::size_t>(threads), 0.0);
    for_bodies([&](std::size_t t, const ContactBody& body) {
      double most = by_thread[t];
      const double counts = body.shape == BodyShape::kSurface ? 1.0 : of_sphere * of_sphere;
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i)
        if (const double here = counts * norm2(vector(i)); more(here, most)) most = here;
      by_thread[t] = most;
    });
    double most = 0.0;
    for (const double here : by_thread)
      if (more(here, most)) most = here;
    for_inner([&](std::uint32_t i) { most = std::max(most, norm2(vector(i))); });
    return std::sqrt(comm.max(most));
  }
  /// How far a tissue goes, of all ranks: the larger of what its shells and what its spheres do. A mean weighs what is far more than what is many, and
  /// is never more than the largest: 1.7 (Σ way⁴/n)^(1/4). That over the points is the way of a body, and that over the ways of bodies the way of all:
  /// where a tenth of them go, or all, it is the largest; one of 162 that goes alone counts half (decisions 0052, 0058). What all spheres do in common does
  /// not count (common_way.h). Collective.
  template <class Vector>
  [[nodiscard]] WayOfBodies way_of_bodies(const Vector& vector, const CommonDrift& of_spheres) const {
    struct Kind {
      OrderFreeSum sum{};
      double largest = 0.0;  ///< both of fourth powers
      std::int64_t count = 0;
      void add(double fourth) { sum.add(fourth), largest = std::max(largest, fourth), ++count; }
    };
    struct Ways {
      Kind shells, spheres;  ///< shells and what is in them
      OrderFreeSum squares;  ///< of shells
      void add_shell(double fourth) { shells.add(fourth), squares.add(std::sqrt(fourth)); }
    };
    constexpr double kTimes2 = 1.7 * 1.7, kTimes4 = kTimes2 * kTimes2;
    const auto fourth_power = [&](std::uint32_t first, std::uint32_t count) {
      double sum = 0.0, largest = 0.0;
      for (std::uint32_t i = first; i < first + count; ++i) {
        const double square = norm2(vector(i)), fourth = square * square;
        sum += fourth;
        largest = std::max(largest, fourth);
      }
      return std::min(kTimes4 * sum / count, largest);
    };
    std::vector<Ways> by_thread(static_cast<std::size_t>(threads));
    for_bodies([&](std::size_t t, const ContactBody& body) {
      if (body.shape == BodyShape::kSurface) return by_thread[t].add_shell(fourth_power(body.first_point, body.point_count));
      const double square = norm2(vector(body.first_point) - of_spheres.at(scene.position()[body.first_point]));
      by_thread[t].spheres.add(square * square);
    });
    for (const Scene::Inner& inner : scene.inner())
      if (scene.bodies()[inner.shell].active()) by_thread[0].add_shell(fourth_power(inner.first_point, inner.point_count));
    OrderFreeSum sums[3];
    double largest[2] = {0.0, 0.0}, totals[3];
    std::int64_t count[2] = {0, 0};
    for (const Ways& one : by_thread) {
      sums[0] += one.shells.sum, sums[1] += one.spheres.sum, sums[2] += one.squares;
      count[0] += one.shells.count, count[1] += one.spheres.count;
      largest[0] = std::max(largest[0], one.shells.largest), largest[1] = std::max(largest[1], one.spheres.largest);
    }
    comm.sum(sums, totals);
    comm.sum(count);
    double weighted[2] = {0.0, 0.0}, mean_of_shells = 0.0;
    for (std::size_t kind = 0; kind < 2; ++kind) {
      if (count[kind] == 0) continue;
      const double most = comm.max(largest[kind]), n = static_cast<double>(count[kind]);
      weighted[kind] = std::sqrt(std::sqrt(std::min(kTimes4 * totals[kind] / n, most)));
      if (kind == 0) mean_of_shells = std::sqrt(std::min(kTimes2 * totals[2] / n, std::sqrt(most)));
    }
    return {std::max(weighted[0], weighted[1]), std::max(mean_of_shells, weighted[1])};
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
