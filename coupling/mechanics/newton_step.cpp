#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "coupling/mechanics/common_way.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/mechanics/left_where_held.h"
#include "coupling/mechanics/step.h"

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
constexpr double kLeastScale = 0.02;  // of forces before anything outside moved, over the residual after it: cells may have been at rest
constexpr int kMaxLinearIterations = 400;
constexpr int kMostWhereHeld = 12;     // iterations that may be done while obstacles or springs move, where `newton` allows for fewer
constexpr double kMuchTooFar = 4.0;    // first way of Newton's method, over what is allowed, from which on a step is not worth a search
constexpr double kShortestCut = 1e-3;  // a step that is no longer is not refused for the length of its way [s]

/// Which forces hold a node that nothing can move: words for the message.
std::string forces_at_worst(const Vec3d& contacts, const Vec3d& left) {
  char text[160];
  std::snprintf(text, sizeof text, "; at its worst node contacts act with %.3g nN, and %.3g nN are left without balance", norm(contacts),
                norm(left));
  return text;
}

/// Where a linear solve wants to go: velocities times a length of time, by point.
struct Direction {
  std::span<const Float4> velocity;
  double factor = 0.0;

  Vec3d operator[](std::size_t i) const { return Vec3d{velocity[i].x, velocity[i].y, velocity[i].z} * factor; }
};

/// A node that its residual drives back from the end of a trial.
struct DrivenBack {
  std::uint32_t node;
  Vec3d along;    ///< of that residual, of length 1
  double way;     ///< of the trial, against it [µm]
  double length;  ///< of the trial [µm]
  double back;    ///< force against the trial's way [nN]
};

/// How a search along a direction went.
struct Search {
  bool moved = false;              ///< Φ is lower, or no higher than allowed; else the points are back, but for rounding
  bool whole = false;              ///< it went all of its way
  bool held = false;               ///< it did not, and has nodes that are to be held in the next
  std::vector<DrivenBack> back{};  ///< these; of this rank
};

/// A cell that would have been moved against its own forces.
struct MovedAgainst {
  CellId cell;
  double work = 0.0;  ///< of its forces at the end of the trial, against the trial's way [nN·µm]
};

/// How an iteration went.
struct Iteration {
  bool moved = false;
  bool whole = false;      ///< by a search that went all of the way of Newton's direction
  bool converged = false;  ///< there was next to nothing to gain
  double longest = 0.0;    ///< way of a point that Newton's direction wanted [µm]
};

/// A step by Newton's method on Φ(x) = E(x) − f·d + dᵀΓ_n d/(2Δt), with backtracking (time_stepping.md §8, §9).
class NewtonStep {
 public:
  NewtonStep(Workspace& work, Tissue& tissue, const StepTask& task)
      : work_(work),
        tissue_(tissue),
        task_(task),
        control_(work.setting.model.step),
        range_(work.setting.model.contact.range),
        allowed_(allowed_ways(work.setting.model)) {
    // Without ghosts, spheres and nuclei the start is what the tissue holds.
    if (work.scene.point_count() != tissue.shells.node_count()) copy_ = work.scene.position();
  }

  Result<StepReport, StepFault> run(Evaluation now);

 private:
  [[nodiscard]] std::span<const Vec3d> start() const {
    return copy_.empty() ? std::span<const Vec3d>(tissue_.shells.position) : std::span<const Vec3d>(copy_);
  }
  [[nodiscard]] StepFault undo(StepFault fault) { return undo_step(work_, start(), std::move(fault)); }
  /// Energy and residual at the present positions; the room of the old residual is used again.
  Residual measure(std::optional<Residual>&& old);
  /// Solves for the residual with the matrix at the present positions.
  Result<Direction, StepFault> solve(double dt, double tolerance);
  /// Cut a direction so that no point goes further than `most`, no sphere further than twice that; gives how far it wanted to go, as a point.
  [[nodiscard]] double limit(Direction& direction, double most) const;
  /// How far a tissue goes by way(point).
  template <class Way>
  [[nodiscard]] WayOfBodies way_of_tissue(const Way& way) const {
    return work_.points().way_of_bodies(way, common_way_of_spheres(work_, way));
  }
  /// Move along `direction` until Φ is no higher than before, or by `allowed_rise` at most; a jump of the contact energy on the way is
  /// passed. `give_up_to_hold`: not more than the short search where nodes are held after it.
  Search search(const Direction& direction, int halvings, double allowed_rise, bool give_up_to_hold = false);
  /// Whether the first direction asks for a shorter step: as a tissue (OwnedPoints::way_of_bodies), or for a single point. `longest`: before it was cut.
  [[nodiscard]] bool wants_too_much(const Direction& direction, double longest) const;
  /// Whether a trial ended at a place where a tissue can be.
  [[nodiscard]] bool is_sound(const Residual& trial);
  /// The nodes in contact that a step along `direction` took over a kink, or into what is there: its residual drives them back. `any`: whether any rank
  /// has some. Collective.
  std::vector<DrivenBack> driven_back(const Direction& direction, const Residual& trial, bool& any);
  /// Hold such nodes in the matrix. First where they meet what is there: as far as that is from where they are now, whose residual drives them; then,
  /// and for good, where they are.
  void hold(std::span<const DrivenBack> nodes, bool for_good);
  Result<Iteration, StepFault> iterate(int number);
  /// Freeze rule (time_stepping.md §9.3): the gradient in the metric of friction, then a short Newton step with an allowed rise. Says whether
  /// that moved anything; if not, all is at rest.
  Result<bool, StepFault> thaw(const Direction& newton);
  /// Why nothing can move: the cell that would have passed through another, else that which failed trials went against the most.
  [[nodiscard]] StepFault stuck() const;
  /// The first cell of this rank with a force that is no number: no law may give one, and no shorter step helps.
  [[nodiscard]] StepFault not_numbers() const;
  /// The cell of this rank whose forces a trial's end drives back the most.
  [[nodiscard]] MovedAgainst most_against(const Direction& direction, const Residual& trial) const;
  /// Another iteration would move points by about the part of this one's way that the residual has left: where this is little, it is not
  /// worth a matrix and a solve, and the next step sees the residual (time_stepping.md §6.1, §10.5).
  [[nodiscard]] bool is_done(const Iteration& last) const;
  /// Whether the cells that moved obstacles touch, or springs that move hold, are so near to their balance that these forces can be told. Collective.
  [[nodiscard]] bool can_tell_forces() const;

  Workspace& work_;
  Tissue& tissue_;
  const StepTask& task_;
  const StepControl& control_;
  double range_;
  AllowedWays allowed_;
  std::vector<Vec3d> copy_;      ///< of the positions of the start, where the tissue has not all of them
  std::optional<Residual> now_;  ///< at the accepted positions; none while a search is under way, or after it failed
  double phi_ = 0.0;             ///< Φ at the accepted positions
  double force_norm_ = 0.0;      ///< of the residual at the start; where obstacles or springs have moved, of the forces before that
  double scale_ = 1.0;           ///< that over the residual at the start
  StepReport report_;
  CellId through_;        ///< of this rank, that a trial would have moved through another; of none not valid
  MovedAgainst against_;  ///< of the last search that failed
};

Residual NewtonStep::measure(std::optional<Residual>&& old) {
  std::vector<Vec3d> room;
  if (old) room = std::move(old->force);
  old.reset();
  return residual_of(work_, tissue_, task_, start(), evaluate(work_, tissue_, std::move(room)));
}

Result<Direction, StepFault> NewtonStep::solve(double dt, double tolerance) {
  auto solved = AssembledMatrix(work_, tissue_, dt).solve(now_->force, tolerance, kMaxLinearIterations);
  if (!solved) return StepFault{solved.error().what, {}, true};
  report_.linear_iterations += solved->iterations;
  const Direction direction{work_.solver.velocity, task_.dt};
  if (!std::isfinite(work_.points().largest(direction))) return StepFault{"the velocities are not numbers", {}, true};
  return direction;
}

double NewtonStep::limit(Direction& direction, double most) const {
  const double longest = work_.points().largest_of([&](std::uint32_t i) { return direction[i]; }, AllowedWays::kSphereCounts);
  if (longest > most) direction.factor *= most / longest;
  return longest;
}

bool NewtonStep::wants_too_much(const Direction& direction, double longest) const {
  if (longest > kMuchTooFar * allowed_.of_point) return true;
  if (longest <= kMuchTooFar * allowed_.of_body) return false;
  const double cut = std::min(1.0, range_ / longest);
  return way_of_tissue([&](std::uint32_t i) { return direction[i]; }).weighted > kMuchTooFar * cut * allowed_.of_body;
}

bool NewtonStep::is_sound(const Residual& trial) {
  const std::optional<CellId> through = find_crossed(work_, tissue_, start());
  report_.crossings += through.has_value();
  through_ = through.value_or(through_);
  return work_.setting.comm.all(std::isfinite(trial.phi) && !find_fault(work_, tissue_).has_value() && !through);
}

Search NewtonStep::search(const Direction& direction, int halvings, double allowed_rise, bool give_up_to_hold) {
  Search out;
  double at = 0.0, fraction = 1.0, before = std::numeric_limits<double>::infinity();
  const auto go_to = [&](double there) {
    work_.scene.move_points(
        [&](std::span<Vec3d> x) { work_.points().for_all([&](std::uint32_t i) { x[i] += direction[i] * (there - at); }); });
    at = there;
  };
  std::optional<Residual> trial = std::exchange(now_, std::nullopt);
  for (int k = 0; k <= halvings; ++k, fraction *= 0.5) {
    go_to(fraction);
    trial = measure(std::move(trial));
    const bool sound = is_sound(*trial);
    // Higher nearer to the start: a jump of the contact energy lies between, and beyond it the way leads down.
    const bool jumped = sound && trial->phi > before && before <= phi_ + kAllowedJump;
    if (jumped) {
      go_to(2.0 * fraction);
      trial = measure(std::move(trial));
    }
    if (sound && (jumped || trial->phi <= phi_ + allowed_rise)) {
      report_.halvings = std::max(report_.halvings, k);
      if (trial->phi > phi_) report_.allowed_rise += trial->phi - phi_;
      phi_ = trial->phi;
      now_ = std::move(trial);
      out.moved = true;
      out.whole = k == 0 || (jumped && k == 1);
      return out;
    }
    // Not before: where the matrix is only too soft, a quarter of the way does not go too far.
    if (k == kShortSearch && sound) out.back = driven_back({direction.velocity, direction.factor * fraction}, *trial, out.held);
    if (k == kShortSearch && out.held && give_up_to_hold) break;
    if (k == kShortSearch) hold(out.back, true);
    if (k == halvings) against_ = sound ? most_against({direction.velocity, direction.factor * fraction}, *trial) : MovedAgainst();
    before = sound ? trial->phi : std::numeric_limits<double>::infinity();
  }
  go_to(0.0);
  return out;
}

std::vector<DrivenBack> NewtonStep::driven_back(const Direction& direction, const Residual& trial, bool& any) {
  const std::vector<Vec3d>& of_contacts = work_.terms.contacts->found().force;
  std::vector<DrivenBack> out;
  for (const ContactBody& body : work_.scene.bodies())
    if (body.active() && body.first_point < work_.scene.owned_nodes())
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) {
        if (i >= of_contacts.size() || norm2(of_contacts[i]) == 0.0) continue;
        const Vec3d way = direction[i];
        const double length = norm(way), back = -dot(trial.force[i], way);
        if (!(back > 0.0)) continue;
        const Vec3d along = trial.force[i] * (1.0 / norm(trial.force[i]));
        out.push_back({i, along, -dot(along, way), length, back / length});
      }
  double most = 0.0;
  for (const DrivenBack& node : out) most = std::max(most, node.back);
  most = work_.setting.comm.max(most);
  std::erase_if(out, [&](const DrivenBack& node) { return node.back < kHeldShare * most; });
  any = most > 0.0;
  return out;
}

void NewtonStep::hold(std::span<const DrivenBack> nodes, bool for_good) {
  const double repulsion = stiffest_repulsion(work_.setting.model);
  for (const DrivenBack& node : nodes) {
    double stiffness = kHold * node.back / node.length;
    if (!for_good) {
      // What is there pushes back with k_r A for each length that the node is in it: so it began that much before the end of the trial.
      const double firm = repulsion * work_.geometry.now().node_area[node.node];
      const double gap = std::max(0.0, node.way - node.back / firm), drive = -dot(now_->force[node.node], node.along);
      stiffness = drive > 0.0 ? drive / (gap + drive / firm) : firm;
    }
    work_.terms.kinks->hold(node.node, node.along, stiffness);
  }
}

Result<Iteration, StepFault> NewtonStep::iterate(int number) {
  Iteration out;
  Direction direction;
  if (number > 0) std::fill(work_.solver.velocity.begin(), work_.solver.velocity.end(), Float4{});
  for (int holds = 0;; ++holds) {
    MORULA_TRY_ASSIGN(direction, solve(task_.dt, number == 0 ? control_.first_tolerance * scale_ : control_.later_tolerance));
    out.longest = limit(direction, range_);
    if (number + holds == 0 && task_.dt > kShortestCut && wants_too_much(direction, out.longest))
      return StepFault{"points would move too far in one step", {}, true};
    out.converged = 0.5 * work_.points().dot(now_->force, direction) <= 1e-12 * (1.0 + std::abs(phi_));
    const double rise = out.converged ? 1e-9 * (1.0 + std::abs(phi_)) : 0.0;
    const Search search = this->search(direction, kHalvings, rise, holds < kMostHolds);
    out.moved = search.moved;
    out.whole = search.whole;
    if (search.moved || !search.held || holds == kMostHolds) break;
    now_ = measure({});
    hold(search.back, holds > 0);
  }
  ++report_.newton;
  if (!out.moved) {
    MORULA_TRY_ASSIGN(out.moved, thaw(direction));
  }
  return out;
}

Result<bool, StepFault> NewtonStep::thaw(const Direction& newton) {
  now_ = measure({});
  const std::vector<Float4> newton_velocity(newton.velocity.begin(), newton.velocity.end());
  std::fill(work_.solver.velocity.begin(), work_.solver.velocity.end(), Float4{});
  MORULA_TRY_ASSIGN(Direction gradient, solve(0.0, control_.first_tolerance));
  (void)limit(gradient, range_);
  if (search(gradient, kGradientHalvings, 0.0).moved) return true;
  Direction last{newton_velocity, newton.factor};
  (void)limit(last, kLastResortStep * range_);
  if (search(last, 2, kAllowedRise).moved) return true;
  now_ = measure({});
  if (work_.points().largest(now_->force) > kStuckForce) return stuck();
  return false;
}

StepFault NewtonStep::stuck() const {
  const bool crossing = work_.setting.comm.any(through_.valid());
  const CellId named = crossing ? through_ : against_.cell;
  const bool is_named = work_.setting.comm.any(named.valid());  // else the cell with the largest force
  if (const auto shape = find_fault(work_, tissue_)) return *shape;
  StepFault fault{crossing ? "no step lowers the energy without a surface passing through another" : "no step lowers the energy", named};
  const std::vector<Vec3d>& left = now_->force;
  double most = 0.0;
  std::uint32_t at = 0;
  for (const ContactBody& body : work_.scene.bodies()) {
    if (!body.active() || (is_named && body.id != named)) continue;
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i)
      if (const double here = norm(left[i]); here > most || (here == most && here > 0.0 && body.id < fault.cell)) {
        most = here;
        fault.cell = body.id;
        at = i;
      }
  }
  if (fault.cell.valid()) fault.badness = !is_named ? most : crossing ? 1.0 : against_.work;
  const std::vector<Vec3d>& of_contacts = work_.terms.contacts->found().force;
  if (at < work_.scene.owned_nodes() && at < of_contacts.size()) fault.what += forces_at_worst(of_contacts[at], left[at]);
  return fault;
}

StepFault NewtonStep::not_numbers() const {
  StepFault out{"forces are not numbers", {}, false};
  for (const ContactBody& body : work_.scene.bodies()) {
    if (!body.active()) continue;
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i)
      if (!std::isfinite(norm2(now_->force[i])) && (!out.cell.valid() || body.id < out.cell)) out.cell = body.id, out.badness = 1.0;
  }
  return out;
}

MovedAgainst NewtonStep::most_against(const Direction& direction, const Residual& trial) const {
  MovedAgainst out;
  for (const ContactBody& body : work_.scene.bodies()) {
    if (!body.active()) continue;
    double work = 0.0;
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) work -= dot(trial.force[i], direction[i]);
    if (work > out.work || (work == out.work && work > 0.0 && body.id < out.cell)) out = {body.id, work};
  }
  return out;
}

bool NewtonStep::is_done(const Iteration& last) const {
  const double left = std::sqrt(work_.points().dot(now_->force, now_->force)) / force_norm_;
  if (left <= control_.newton_stop || last.converged) return true;
  return left <= kMostLeft * control_.newton_stop && left * last.longest <= kSmallCorrection * control_.newton_stop * range_;
}

bool NewtonStep::can_tell_forces() const {
  return !task_.forces_before || left_where_held(work_, tissue_, now_->force) <= control_.obstacle_stop;
}

Result<StepReport, StepFault> NewtonStep::run(Evaluation at_start) {
  const OwnedPoints points = work_.points();
  report_.step = task_.dt;
  now_ = residual_of(work_, tissue_, task_, start(), std::move(at_start), false);
  phi_ = now_->phi;
  force_norm_ = std::sqrt(points.dot(now_->force, now_->force));
  if (task_.forces_before && force_norm_ > 0.0) {
    scale_ = std::clamp(*task_.forces_before / force_norm_, kLeastScale, 1.0);
    force_norm_ *= scale_;
  }
  if (!std::isfinite(phi_) || !std::isfinite(force_norm_)) return undo(not_numbers());
  bool cut = false;    // the last iteration's way was cut to the contact range, gone to its end, and did not suffice
  bool ended = false;  // what is left of the residual is little
  const int most = task_.forces_before ? std::max(kMostWhereHeld, control_.max_newton) : control_.max_newton;
  for (int number = 0; number < most; ++number) {
    const auto done = iterate(number);
    if (!done) return undo(done.error());
    cut = false;
    ended = done->moved && is_done(*done);
    if (!done->moved || done->converged) break;
    cut = !ended && done->whole && done->longest > range_;
    if ((ended || number + 1 >= control_.max_newton) && can_tell_forces()) break;
  }
  const auto way = [&](std::uint32_t i) { return work_.scene.position()[i] - start()[i]; };
  report_.displacement = points.largest_of(way, AllowedWays::kSphereCounts);
  const WayOfBodies of_bodies = way_of_tissue(way);
  report_.way = std::max(of_bodies.weighted, report_.displacement * allowed_.of_body / allowed_.of_point);
  const double far = kFurtherThanAllowed * allowed_.of_body;
  if ((cut || report_.way > far) && task_.dt > kShortestCut) {
    // A few that jump end where they end in a shorter step, too: the others need not wait for them (decision 0093).
    if (cut || !ended || of_bodies.mean > far || points.largest_of(way) > kFurthestPoint * allowed_.of_point)
      return undo({"points moved too far in one step", {}, true});
    report_.way = of_bodies.mean;
  }
  finish_step(work_, tissue_, task_, now_->energy, report_);
  return report_;
}

}  // namespace

Result<StepReport, StepFault> implicit_step(Workspace& work, Tissue& tissue, const StepTask& task, Evaluation now) {
  return NewtonStep(work, tissue, task).run(std::move(now));
}

}  // namespace morula
