#include "core/mesh/split_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace morula {

std::vector<SplitSurface> split_by_label(const TriangleMesh& mesh, std::span<const double> label_of_face) {
  std::map<double, std::vector<std::uint32_t>> faces_of;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) faces_of[label_of_face[f]].push_back(f);
  std::vector<SplitSurface> out;
  std::vector<std::uint32_t> new_number(mesh.position.size());
  for (auto& [label, faces] : faces_of) {
    SplitSurface& surface = out.emplace_back();
    surface.label = label;
    for (const std::uint32_t f : faces) surface.node.insert(surface.node.end(), mesh.faces[f].begin(), mesh.faces[f].end());
    std::sort(surface.node.begin(), surface.node.end());
    surface.node.erase(std::unique(surface.node.begin(), surface.node.end()), surface.node.end());
    for (std::uint32_t n = 0; n < surface.node.size(); ++n) {
      new_number[surface.node[n]] = n;
      surface.mesh.position.push_back(mesh.position[surface.node[n]]);
    }
    for (const std::uint32_t f : faces)
      surface.mesh.faces.push_back({new_number[mesh.faces[f][0]], new_number[mesh.faces[f][1]], new_number[mesh.faces[f][2]]});
    surface.face = std::move(faces);
  }
  return out;
}

std::vector<double> components_of_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.position.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  for (const Triangle& face : mesh.faces)
    for (std::size_t c = 1; c < 3; ++c) {
      const std::uint32_t a = root(face[0]), b = root(face[c]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<double> out;
  std::map<std::uint32_t, double> number;
  for (const Triangle& face : mesh.faces)
    out.push_back(number.try_emplace(root(face[0]), static_cast<double>(number.size())).first->second);
  return out;
}

}  // namespace morula
