#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/friction/contact_element.h"

namespace morula {

/// Contact points of many pairs, each pair's in one piece, in a few large pieces of memory that never move: what was handed out stays where it
/// is until clear().
class ElementStore {
 public:
  [[nodiscard]] std::span<const ContactElement> keep(std::span<const ContactElement> elements) {
    if (elements.empty()) return {};
    if (chunks_.empty() || chunks_.back().size - used_ < elements.size()) {
      const std::size_t size = std::max(kChunk, elements.size());
      chunks_.push_back({std::make_unique_for_overwrite<ContactElement[]>(size), size});
      used_ = 0;
    }
    ContactElement* const at = chunks_.back().elements.get() + used_;
    std::copy(elements.begin(), elements.end(), at);
    used_ += elements.size();
    return {at, elements.size()};
  }
  void clear() {
    std::vector<Chunk>().swap(chunks_);
    used_ = 0;
  }
  [[nodiscard]] std::size_t memory() const {
    std::size_t total = chunks_.capacity() * sizeof(Chunk);
    for (const Chunk& chunk : chunks_) total += chunk.size * sizeof(ContactElement);
    return total;
  }

 private:
  static constexpr std::size_t kChunk = 2048;  // 32 kB
  struct Chunk {
    std::unique_ptr<ContactElement[]> elements;
    std::size_t size;
  };
  std::vector<Chunk> chunks_;
  std::size_t used_ = 0;  ///< of the last one
};

}  // namespace morula
