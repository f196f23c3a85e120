#include "coupling/mechanics/following_loads.h"

#include "core/parallel/threads.h"
#include "coupling/loads/loads.h"

namespace morula {

void FollowingLoads::begin_step(const World& world, StepStart&) {
  loaded_.clear();
  threads_ = world.threads;
  if (!on_) return;
  const dcm::Shells& shells = world.tissue.shells;
  for (const CellLoad& load : world.model.loads) {
    const double strength = load.course.at(world.time);
    if (strength == 0.0 || !follows_surface(load)) continue;
    for (std::size_t s = 0; s < shells.size(); ++s) {
      if (shells.type[s] != load.type) continue;
      const std::uint32_t first = shells.first_node[s];
      Loaded one{&load, shells.shape[s].get(), strength, first, shells.first_node[s + 1] - first, 0.0};
      one.energy = load.what->energy(load, one.at(world.position()));
      loaded_.push_back(one);
    }
  }
}

void FollowingLoads::add_outside(const Way& way, double dt, std::span<Vec3d> out, OrderFreeSum& work) {
  std::vector<double> done(loaded_.size());
  // One after the other on a shell: several loads may press on it.
  for (std::size_t first = 0, last; first < loaded_.size(); first = last) {
    for (last = first + 1; last < loaded_.size() && loaded_[last].load == loaded_[first].load;) ++last;
    parallel_for(threads_, last - first, [&](std::size_t i) {
      const Loaded& one = loaded_[first + i];
      const LoadedShell now = one.at(way.position);
      std::vector<Vec3d> force(one.count);
      one.load->what->push(*one.load, now, force);
      for (std::uint32_t k = 0; k < one.count; ++k) out[one.first + k] -= force[k] * dt;
      done[first + i] = one.energy - one.load->what->energy(*one.load, now);
    });
  }
  for (const double energy : done) work.add(energy);
}

}  // namespace morula
