#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/contact/contact_body.h"

namespace morula {

/// Which bodies of a scene have come and gone when it was built again. A body stays if its id, its mesh, its material and all its positions are
/// what they were; bodies that stay come in the same canonical order as before.
struct BodyChanges {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::vector<ContactBody> before;   ///< the bodies of the old scene
  std::size_t shells_before = 0;     ///< of them, the first ones
  std::vector<std::uint32_t> now;    ///< by old number: the new one, or kNone
  std::vector<std::uint32_t> was;    ///< by new number: the old one, or kNone
  std::vector<std::uint32_t> fresh;  ///< new numbers of those that were not there, increasing
  /// Old and new numbers of those that are the same, but count as gone and come again (ContactLayer::add_strays); increasing.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> strays;
  std::uint64_t positions_number = 0;  ///< of the old scene's positions: what was found at them holds for bodies that stay
};

}  // namespace morula
