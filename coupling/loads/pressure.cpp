#include <array>

#include "coupling/loads/load_keys.h"
#include "coupling/loads/loads.h"
#include "coupling/loads/surface.h"
#include "coupling/model.h"

namespace morula {
namespace {

double pressure_at(const CellLoad& load, const Vec3d& x) { return load.size + dot(load.gradient, x - load.origin); }

bool follows(const CellLoad& load) { return load.mark < 0 && load.part >= 1.0 && !load.within; }

/// ∫ p dV over the volume of the shell: a sum over tetrahedra to its first node, over each of which a linear p has its mean at the centroid.
double energy(const CellLoad& load, const LoadedShell& shell) {
  const std::span<const Vec3d> x = shell.position;
  const Vec3d from = x[0];
  double sum = 0.0;
  for (const Triangle& t : shell.shape.topology->faces()) {
    const Vec3d &a = x[t[0]], &b = x[t[1]], &c = x[t[2]];
    sum += dot(a - from, cross(b - from, c - from)) * pressure_at(load, (from + a + b + c) * 0.25);
  }
  return sum * (shell.strength / 6.0);
}

/// On all faces: −∂/∂x_i ∫ p dV = −n ∫ p φ_i dA = −A_T n (2 p_i + p_j + p_k)/12.
void push_everywhere(const CellLoad& load, const LoadedShell& shell, std::span<Vec3d> force) {
  const std::span<const Vec3d> x = shell.position;
  for_faces(*shell.shape.topology, x, [&](const Triangle& t, const Vec3d& area) {
    const std::array<double, 3> p{pressure_at(load, x[t[0]]), pressure_at(load, x[t[1]]), pressure_at(load, x[t[2]])};
    const double sum = p[0] + p[1] + p[2];
    for (std::size_t corner = 0; corner < 3; ++corner) force[t[corner]] -= area * (shell.strength * (sum + p[corner]) / 12.0);
  });
}

void push(const CellLoad& load, const LoadedShell& shell, std::span<Vec3d> force) {
  if (follows(load)) return push_everywhere(load, shell, force);
  const std::span<const Vec3d> x = shell.position;
  const auto press = [&](const Triangle& t, const Vec3d& area) {
    const Vec3d at = face_middle(t, x);
    if (load.within && !lies_within(load, at)) return;
    add_to_corners(t, area * (-shell.strength * pressure_at(load, at)), force);
  };
  if (load.mark >= 0) return for_marked_faces(*shell.shape.topology, x, shell.marks, load.mark, press);
  std::vector<char> chosen(x.size(), load.part >= 1.0);
  const auto choose = [&](const Vec3d& outward) {
    for (const std::uint32_t node : end_nodes(shell.shape, outward, load.part)) chosen[node] = 1;
  };
  if (load.part < 1.0 && load.end != LoadEnd::kLow) choose(load.axis);
  if (load.part < 1.0 && load.end != LoadEnd::kHigh) choose(load.axis * -1.0);
  for_faces(*shell.shape.topology, x, [&](const Triangle& t, const Vec3d& area) {
    if (chosen[t[0]] && chosen[t[1]] && chosen[t[2]]) press(t, area);
  });
}

void build(const OwnValues& values, CellLoad& out) {
  out.size = values("value");
  keys::set_ends(values, out);
  out.gradient = values.vector("gradient");
  out.origin = values.vector("origin");
  out.within = values.flag("within");
  out.low_end = values.vector("within.from");
  out.high_end = values.vector("within.to");
  if (out.within) out.radius = values("within.radius");
}

std::vector<LawProblem> judge(const CellLoad& load, const Model& model) {
  std::vector<LawProblem> out;
  const std::pair<const char*, bool> at_axis{"axis", load.axis == Vec3d{1, 0, 0}}, at_ends{"ends", load.end == LoadEnd::kBoth};
  const bool whole = load.part == 1.0;
  keys::judge_marked(load, model, {at_axis, {"part", whole}, at_ends}, out);
  if (load.mark < 0 && whole)
    for (const auto& [key, usual] : {at_ends, at_axis})
      if (!usual)
        out.push_back(
            {515, key, std::string("'") + key + "' has no effect here", "give `part`: without it the pressure acts on the whole surface"});
  if (norm2(load.gradient) == 0.0 && norm2(load.origin) > 0.0)
    out.push_back({515, "origin", "'origin' has no effect here", "it is where a pressure with a `gradient` has its `value`"});
  for (int axis = 0; axis < 3; ++axis)
    if (load.gradient[static_cast<std::size_t>(axis)] != 0.0 && model.space.periodic(axis))
      out.push_back({570, "gradient", std::string("the pressure changes along ") + "xyz"[axis] + ", along which the domain is periodic",
                     "use `open` or `wall` faces"});
  if (load.within && model.space.any_periodic())
    out.push_back({570, "within.from",
                   "the cylinder has no images beyond the periodic faces of the domain: cells there would not bear the pressure",
                   "use `open` or `wall` faces"});
  if (load.within && norm2(load.high_end - load.low_end) == 0.0)
    out.push_back({302, "within.to", "'from' and 'to' are the same point", "give the two ends of the cylinder's axis"});
  return out;
}

OwnKey within() {
  using keys::Kind;
  return {Kind::kGroup,
          {.name = "within",
           .doc = "Only faces whose middle lies in this cylinder bear the pressure: suction in a pipette.",
           .example = "{from: [0 um, 0 um, 0 um], to: [0 um, 0 um, 15 um], radius: 2.75 um}"},
          {keys::required(Kind::kVector, "from", "Centre of one end of the cylinder.", Quantity::kLength, "[0 um, 0 um, 0 um]"),
           keys::required(Kind::kVector, "to", "Centre of the other end.", Quantity::kLength, "[0 um, 0 um, 0 um]"),
           {Kind::kQuantity,
            {.name = "radius",
             .doc = "Radius.",
             .quantity = Quantity::kLength,
             .required = true,
             .low = 0.0,
             .low_open = true,
             .example = "3 um"}}}};
}

}  // namespace

std::shared_ptr<const Load> pressure_load() {
  using keys::Kind;
  static const auto load = std::make_shared<const Load>(Load{
      .info = {.name = "pressure",
               .title = "Pressure on a cell, on its ends or on marked faces",
               .equation = "F_T = −p A_T n_T, p = p0 + g·(x_T − x0) at the middle x_T of the face; on the whole surface −∂/∂x ∫ p dV",
               .source = "choice of this project",
               .parameters = {given_by_study("value", "pressure", "kPa", "p0, against the outward normal."),
                              given_by_study("gradient", "pressure per length", "kPa/µm", "Size of the gradient g."),
                              keys::part_of_nodes()}},
      .section = {.name = "pressure",
                  .doc =
                      "A pressure against the outward normal, on the whole surface, at the ends of an axis or on marked faces, uniform or "
                      "with a gradient in space; negative: suction.",
                  .example = "{value: 10 Pa}"},
      .keys = {keys::required(Kind::kQuantity, "value", "The pressure.", Quantity::kPressure, "10 Pa"),
               {Kind::kVector,
                {.name = "gradient",
                 .doc = "How the pressure changes in space; `value` is that at `origin`. The weight of a medium, the field of a flow.",
                 .quantity = Quantity::kPressurePerLength,
                 .fallback = "[0 Pa/um, 0 Pa/um, 0 Pa/um]",
                 .example = "[0 Pa/um, 0 Pa/um, -1 Pa/um]",
                 .source = "chosen"}},
               {Kind::kVector,
                {.name = "origin",
                 .doc = "Where the pressure is `value`.",
                 .quantity = Quantity::kLength,
                 .fallback = "[0 um, 0 um, 0 um]",
                 .example = "[0 um, 0 um, 0 um]",
                 .source = "chosen"}},
               keys::load_axis("Axis that tells the ends."),
               keys::load_part("100 %", "Part of the nodes at each end; faces between such nodes bear the pressure."),
               keys::load_ends(),
               keys::load_mark("In place of `axis`, `part` and `ends`: faces with this mark bear the pressure."),
               within()},
      .build = &build,
      .judge = &judge,
      .of_chosen_nodes = [](const CellLoad& one) { return one.mark < 0 && one.part < 1.0; },
      .push = &push,
      .follows = &follows,
      .energy = &energy});
  return load;
}

}  // namespace morula
