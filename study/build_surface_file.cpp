#include "core/mesh/mesh_check.h"
#include "core/mesh/surface_bytes.h"
#include "core/mesh/surface_file.h"
#include "study/build.h"
#include "study/input_file.h"
#include "study/mesh_problem_codes.h"

namespace morula::scenarios {

int code_of(MeshProblemKind kind) {
  switch (kind) {
    case MeshProblemKind::kHole:
      return 621;
    case MeshProblemKind::kNonManifoldEdge:
    case MeshProblemKind::kNonManifoldNode:
      return 625;
    case MeshProblemKind::kFlippedFaces:
    case MeshProblemKind::kNotOrientable:
    case MeshProblemKind::kInsideOut:
      return 622;
    case MeshProblemKind::kSelfIntersection:
      return 623;
    case MeshProblemKind::kDegenerateFace:
    case MeshProblemKind::kDuplicateFace:
      return 624;
    case MeshProblemKind::kEmpty:
    case MeshProblemKind::kBadIndex:
    case MeshProblemKind::kNotFinite:
    case MeshProblemKind::kUnusedNode:
      return 620;
  }
  return 620;
}

TriangleMesh surface_from_file(BuildContext& c, Given<std::string>& written, const Given<double>& scale) {
  if (!written.known() || !scale.known()) return {};
  const std::string shown = written.value;
  const std::filesystem::path path = add_input_file(c, written);
  if (!check_input_file(path, shown, kMaxSurfaceBytes, written.place, c.diagnostics)) return {};
  auto mesh = read_surface(path, {.scale = scale.value});
  if (!mesh.ok()) {
    c.diagnostics.error(620, written.place, mesh.error().message, mesh.error().help);
    return {};
  }
  const std::vector<MeshProblem> problems = check_mesh(mesh->position, mesh->faces);
  for (const MeshProblem& problem : problems)
    c.diagnostics.error(code_of(problem.kind), written.place, "surface '" + shown + "': " + problem.message,
                        "mend the surface, for example in MeshLab or Blender");
  if (!problems.empty()) return {};
  return std::move(mesh).value();
}

}  // namespace morula::scenarios
