#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/parallel/threads.h"
#include "coupling/mechanics/mechanics.h"

namespace morula {
namespace {

constexpr int kHalvings = 8;
constexpr int kGradientHalvings = 20;
// A step whose residual is not below `newton_stop` may end all the same where little motion is left; both in units of newton_stop:
constexpr double kMostLeft = 2.5;          // of the residual
constexpr double kSmallCorrection = 0.15;  // motion that another iteration would bring, in units of the contact range
constexpr double kStuckForce = 1e-3;       // largest residual that counts as rest [nN]
constexpr double kAllowedRise = 0.2;       // of Φ, in the last resort of the freeze rule [nN·µm]
constexpr double kAllowedJump = 0.02;      // of Φ, where a point of contact takes another nearest face [nN·µm]
constexpr int kShortSearch = 2;            // halvings before nodes at kinks are held
constexpr int kMostHolds = 3;              // times that nodes may be held in one iteration
constexpr double kHeldShare = 0.1;         // of the force that drives a node back, over the largest such force, from which on it is held
constexpr double kHold = 100.0;            // stiffness that holds a node, over the secant one
constexpr double kLastResortStep = 0.2;    // in units of the contact range
constexpr int kMaxLinearIterations = 400;
// Explicit Euler is the reference and has no second solve: forces on nodes without contact may be a thousandth of those in it (dcm.md §1).
constexpr double kExplicitTolerance = 1e-6;
constexpr int kMostExplicitIterations = 4000;

/// Which forces hold a node that nothing can move: words for the message.
std::string forces_at_worst(const Vec3d& contacts, const Vec3d& left) {
  char text[160];
  std::snprintf(text, sizeof text, "; at its worst node contacts act with %.3g nN, and %.3g nN are left without balance", norm(contacts),
                norm(left));
  return text;
}

}  // namespace

/// Where a linear solve wants to go: velocities times a length of time, by point.
struct Mechanics::Direction {
  std::span<const Float4> velocity;
  double factor;

  Vec3d operator[](std::size_t i) const { return Vec3d{velocity[i].x, velocity[i].y, velocity[i].z} * factor; }
};

/// One Newton iteration's search along a direction. Φ(x) = E(x) − f·d + dᵀΓ_n d/(2Δt).
struct Mechanics::Trial {
  Mechanics& m;
  const Tissue& tissue;
  std::span<const Vec3d> start;  ///< x_n by point
  std::span<const Vec3d> external;
  double dt;
  double phi;  ///< at the accepted state
  StepReport& report;
  bool held = false;   ///< a search that did not end well has nodes to be held in the next
  bool whole = false;  ///< the last search went all of its way

  [[nodiscard]] double measure() {
    m.evaluate(tissue);
    const double work = m.friction_residual(start, external, dt);
    return m.energy_ - work + m.friction_energy_ / (2.0 * dt);
  }

  /// Move along `direction` until Φ is no higher than before, or by `allowed_rise` at most; a jump of the contact energy on the way is
  /// passed. On success the workspace is evaluated at the new state; else positions are restored, but
  /// for rounding. `give_up_to_hold`: not more than the short search where nodes are held after it.
  bool search(const Direction& direction, int halvings, double allowed_rise, bool give_up_to_hold = false) {
    double at = 0.0, fraction = 1.0, before = std::numeric_limits<double>::infinity();
    whole = false;
    const auto go_to = [&](double there) {
      auto& x = m.scene_.position();
      m.for_owned_points([&](std::uint32_t i) { x[i] += direction[i] * (there - at); });
      at = there;
    };
    for (int k = 0; k <= halvings; ++k, fraction *= 0.5) {
      go_to(fraction);
      double next = measure();
      const SurfacePair* crossed = m.contacts_.crossed(m.contact_scene(), start);
      const bool through = crossed != nullptr || m.nuclei_.crossed();
      const bool sound = m.comm_.all(std::isfinite(next) && !m.find_fault().has_value() && !through);
      report.crossings += through;
      // Higher nearer to the start: a jump of the contact energy lies between, and beyond it the way leads down.
      const bool jumped = sound && next > before && before <= phi + kAllowedJump;
      if (jumped) {
        go_to(2.0 * fraction);
        next = measure();
      }
      if (sound && (jumped || next <= phi + allowed_rise)) {
        report.halvings = std::max(report.halvings, k);
        whole = k == 0 || (jumped && k == 1);
        if (next > phi) report.allowed_rise += next - phi;
        phi = next;
        return true;
      }
      // Not before: where the matrix is only too soft, a quarter of the way does not go too far.
      if (k == kShortSearch) held = sound && m.hold_driven_back({direction.velocity, direction.factor * fraction});
      if (k == kShortSearch && held && give_up_to_hold) break;
      before = sound ? next : std::numeric_limits<double>::infinity();
    }
    go_to(0.0);
    return false;
  }
};

bool Mechanics::hold_driven_back(const Direction& direction) {
  const auto for_nodes_back = [&](auto&& function) {  // function(node, way, force against it), for nodes that touch something
    for (const ContactBody& body : scene_.bodies())
      if (body.active() && body.first_point < scene_.owned_nodes())
        for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) {
          if (i >= gradient_.force.size() || norm2(gradient_.force[i]) == 0.0) continue;
          const Vec3d way = direction[i];
          const double length = norm(way), back = -morula::dot(force_[i], way);
          if (back > 0.0) function(i, length, back / length);
        }
  };
  double most = 0.0;
  for_nodes_back([&](std::uint32_t, double, double back) { most = std::max(most, back); });
  most = comm_.max(most);
  for_nodes_back([&](std::uint32_t i, double length, double back) {
    if (back >= kHeldShare * most) held_.hold(i, force_[i] * (1.0 / norm(force_[i])), kHold * back / length);
  });
  return most > 0.0;
}

double Mechanics::friction_residual(std::span<const Vec3d> start, std::span<const Vec3d> external, double dt, bool moved) {
  auto timed = timer_.scope(Stage::kAdvance);
  const auto& x = scene_.position();
  for_owned_points([&](std::uint32_t i) {  // −Δt (F + external), to which Γ_n d is added
    force_[i] = (force_[i] + external_on(external, i)) * -dt;
  });
  for (const Anchor& anchor : anchors_) force_[anchor.node] += (x[anchor.node] - anchor.target) * (anchor.stiffness * dt);
  spent_ = true;
  OrderFreeSum sums[2];
  if (moved) shells_.add_step_friction(x, force_, sums[0]);
  if (moved) interior_.add_step_friction(start, x, force_, sums[0]);
  if (moved) nuclei_.add_step_friction(start, x, force_, sums[0]);
  contacts_.add_step_friction(contact_scene(), start, moved, force_, sums[0]);
  const auto medium = system_.point_friction();
  for (std::size_t i = 0; moved && i < scene_.owned_spheres(); ++i) {
    const std::size_t point = scene_.sphere_point() + i;
    const Vec3d d = x[point] - start[point];
    force_[point] += d * static_cast<double>(medium[i]);
    sums[0].add(static_cast<double>(medium[i]) * norm2(d));
  }
  if (moved) spheres_.pairs().add_friction(start, x, force_, sums[0]);
  std::vector<OrderFreeSum> works(static_cast<std::size_t>(threads_));
  for_active_bodies([&](std::size_t t, const ContactBody& body) {
    double work = 0.0;
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) {
      work += morula::dot(external_on(external, i), x[i] - start[i]);
      force_[i] *= -1.0 / dt;
    }
    works[t].add(work);
  });
  for (const OrderFreeSum& work : works) sums[1] += work;
  for_nuclei([&](std::uint32_t i) { force_[i] *= -1.0 / dt; });
  for (const Anchor& anchor : anchors_)  // what the springs have given: their energy at the start less that at x
    sums[1].add(0.5 * anchor.stiffness * (norm2(start[anchor.node] - anchor.target) - norm2(x[anchor.node] - anchor.target)));
  double totals[2];
  comm_.sum(sums, totals);
  friction_energy_ = totals[0];
  return totals[1];
}

void Mechanics::give_residual() {
  const std::span<Float4> right = system_.right();
  for_owned_points([&](std::uint32_t i) {
    right[i] = {static_cast<float>(force_[i].x), static_cast<float>(force_[i].y), static_cast<float>(force_[i].z), 0.0f};
  });
}

Result<StepReport, StepFault> Mechanics::implicit_step(Tissue& tissue, double dt, std::span<const Vec3d> external) {
  const StepControl& control = model_.step;
  const double range = model_.contact.range;
  begin_step(tissue, dt);
  // Without ghosts, spheres and nuclei the start is what the tissue holds.
  std::vector<Vec3d> copy;
  if (scene_.point_count() != tissue.shells.node_count()) copy = scene_.position();
  const std::span<const Vec3d> start = copy.empty() ? std::span<const Vec3d>(tissue.shells.position) : copy;
  StepReport report;
  report.step = dt;
  Trial trial{*this, tissue, start, external, dt, 0.0, report};
  const double work = friction_residual(start, external, dt, false);
  trial.phi = energy_ - work + friction_energy_ / (2.0 * dt);
  const double force_norm = std::sqrt(dot(force_, force_));
  if (!std::isfinite(trial.phi) || !std::isfinite(force_norm)) return StepFault{"forces are not numbers", {}, false};

  Direction direction{solution_, dt};
  const auto solve = [&](double step, double tolerance) -> Result<SolveReport, StepFault> {
    assemble(tissue, step);
    auto timed = timer_.scope(Stage::kSolve);
    give_residual();
    auto solved = system_.solve(solution_, tolerance, kMaxLinearIterations, comm_);
    drop_matrix();
    if (!solved) return StepFault{solved.error().what, {}, true};
    conserve_momentum();
    report.linear_iterations += solved->iterations;
    direction = {solution_, dt};  // after the freeze rule it was that of a copy
    if (!std::isfinite(largest(direction))) return StepFault{"the velocities are not numbers", {}, true};
    return *solved;
  };
  const auto limit_direction = [&](double most) {
    const double longest = largest(direction);
    if (longest > most) direction.factor *= most / longest;
    return longest;
  };
  const double allowed = control.max_displacement * range;

  bool cut = false;  // the last iteration's way was cut to the contact range, gone to its end, and did not suffice
  for (int iteration = 0; iteration < control.max_newton; ++iteration) {
    bool moved = false, converged = false;
    cut = false;
    double longest = 0.0;
    if (iteration > 0) std::fill(solution_.begin(), solution_.end(), Float4{});
    for (int holds = 0;; ++holds) {
      auto solved = solve(dt, iteration == 0 ? control.first_tolerance : control.later_tolerance);
      if (!solved) return undo(start, solved.error());
      longest = limit_direction(range);
      if (iteration + holds == 0 && longest > 4.0 * allowed && dt > 1e-3) {
        return undo(start, StepFault{"points would move too far in one step", {}, true});
      }
      converged = 0.5 * dot(force_, direction) <= 1e-12 * (1.0 + std::abs(trial.phi));
      const double rise = converged ? 1e-9 * (1.0 + std::abs(trial.phi)) : 0.0;
      moved = trial.search(direction, kHalvings, rise, holds < kMostHolds);
      if (moved || !trial.held || holds == kMostHolds) break;
      evaluate(tissue);
      (void)friction_residual(start, external, dt);
    }
    ++report.newton;
    if (!moved) {
      // Freeze rule (time_stepping.md §9.3): the gradient in the metric of friction, then a short Newton step with an allowed rise.
      evaluate(tissue);
      (void)friction_residual(start, external, dt);
      const std::vector<Float4> newton_solution = solution_;
      const double newton_factor = direction.factor;
      std::fill(solution_.begin(), solution_.end(), Float4{});
      auto solved = solve(0.0, control.first_tolerance);
      if (!solved) return undo(start, solved.error());
      limit_direction(range);
      moved = trial.search(direction, kGradientHalvings, 0.0);
      if (!moved) {
        direction = {newton_solution, newton_factor};
        limit_direction(kLastResortStep * range);
        moved = trial.search(direction, 2, kAllowedRise);
      }
      trial.whole = false;  // of another way than the iteration's
      if (!moved) {
        evaluate(tissue);
        (void)friction_residual(start, external, dt);
        if (largest(force_) > kStuckForce) {
          StepFault fault{comm_.any(report.crossings > 0) ? "no step lowers the energy without a surface passing through another"
                                                          : "no step lowers the energy",
                          {},
                          true};
          if (const auto shape = find_fault()) fault = *shape;
          double worst = 0.0;
          std::uint32_t at = 0;
          for (const ContactBody& body : scene_.bodies())
            for (std::uint32_t i = body.first_point; body.active() && i < body.first_point + body.point_count; ++i)
              if (norm2(force_[i]) > worst) {
                worst = norm2(force_[i]);
                fault.cell = body.id;
                at = i;
              }
          if (at < scene_.owned_nodes() && at < gradient_.force.size()) fault.what += forces_at_worst(gradient_.force[at], force_[at]);
          return undo(start, fault);
        }
        break;
      }
    }
    // Another iteration would move points by about the part of this one's way that the residual has left: where this is little, it is not
    // worth a matrix and a solve, and the next step sees the residual (time_stepping.md §6.1, §10.5).
    const double left = std::sqrt(dot(force_, force_)) / force_norm;
    if (left <= control.newton_stop || converged) break;
    if (left <= kMostLeft * control.newton_stop && left * longest <= kSmallCorrection * control.newton_stop * range) break;
    cut = trial.whole && longest > range;
  }
  report.displacement = furthest(start);
  if ((cut || report.displacement > 1.5 * allowed) && dt > 1e-3) {
    return undo(start, StepFault{"points moved too far in one step", {}, true});
  }
  finish(tissue, dt, report);
  return report;
}

Result<StepReport, StepFault> Mechanics::explicit_step(Tissue& tissue, double dt, std::span<const Vec3d> external) {
  begin_step(tissue, dt);
  const std::vector<Vec3d> start = scene_.position();
  StepReport report;
  report.step = dt;
  (void)friction_residual(start, external, dt, false);
  assemble(tissue, 0.0);
  give_residual();
  auto solved = system_.solve(solution_, kExplicitTolerance, kMostExplicitIterations, comm_);
  drop_matrix();
  if (!solved) return undo(start, StepFault{solved.error().what, {}, true});
  conserve_momentum();
  if (!solved->converged)
    return undo(start, StepFault{"the velocities are not found in " + std::to_string(kMostExplicitIterations) + " iterations", {}, false});
  report.linear_iterations = solved->iterations;
  report.newton = 1;
  auto& x = scene_.position();
  for_owned_points([&](std::uint32_t i) { x[i] += Vec3d{solution_[i].x, solution_[i].y, solution_[i].z} * dt; });
  report.displacement = furthest(start);
  if (!std::isfinite(report.displacement) || report.displacement > model_.contact.range) {
    return undo(start, StepFault{"points moved too far in one explicit step", {}, true});
  }
  evaluate(tissue);
  if (comm_.any(contacts_.crossed(contact_scene(), start) != nullptr || nuclei_.crossed()))
    return undo(start, StepFault{"a surface would pass through another", {}, true});
  if (const auto fault = find_fault(); comm_.any(fault.has_value())) {
    return undo(start, fault.value_or(StepFault{"a cell on another rank is too distorted", {}, true}));
  }
  finish(tissue, dt, report);
  return report;
}

}  // namespace morula
