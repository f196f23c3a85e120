#include "coupling/mechanics/marked_nodes.h"

#include <algorithm>

#include "coupling/face_marks.h"

namespace morula {

NodesByShell<MarkedNode> marked_nodes(const dcm::Shells& shells, int mark) {
  NodesByShell<MarkedNode> out;
  const std::vector<double> area = marked_node_areas(shells, mark);
  for (std::uint32_t s = 0; s < shells.size(); ++s)
    for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i)
      if (area[i] > 0.0) out.add(s, {i, area[i]});
  return out;
}

std::vector<char> moving_shells(const Scene& scene) {
  std::vector<char> out(scene.owned_shells());
  std::ranges::transform(scene.bodies().first(out.size()), out.begin(), &ContactBody::active);
  return out;
}

}  // namespace morula
