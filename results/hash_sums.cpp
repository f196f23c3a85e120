#include "results/hash_sums.h"

#include <vector>

namespace morula::scenarios {
namespace {

constexpr std::uint64_t kDigit = 0xFFFFFFFFu;  // 32 bits, so that 2^31 ranks can be added up in 64

}  // namespace

void sum_over_ranks(std::span<Hash128> hashes, const Comm& comm) {
  if (comm.size() == 1) return;
  std::vector<std::int64_t> digits;
  for (const Hash128& hash : hashes)
    for (const std::uint64_t digit : {hash.low & kDigit, hash.low >> 32, hash.high & kDigit, hash.high >> 32})
      digits.push_back(static_cast<std::int64_t>(digit));
  comm.sum(digits);
  auto next = digits.begin();
  for (Hash128& hash : hashes) {
    std::uint64_t out[4], carried = 0;
    for (std::uint64_t& digit : out) {
      carried += static_cast<std::uint64_t>(*next++);
      digit = carried & kDigit;
      carried >>= 32;
    }
    hash = {out[0] | out[1] << 32, out[2] | out[3] << 32};
  }
}

}  // namespace morula::scenarios
