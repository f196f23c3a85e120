/// What ranks say to each other: long messages go in parts, mail goes to whom it is for and to nobody else, and sums are exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "bench/mpi_traffic.h"
#include "core/parallel/comm.h"
#include "core/parallel/shared_sums.h"

namespace morula {
namespace {

constexpr std::size_t kSmall = 1000;  // a largest message that everything here is longer than [bytes]

/// Bytes that belong to a pair of ranks, so that none can be taken for others.
std::vector<std::byte> letter(int from, int to, std::size_t size, int round = 0) {
  std::vector<std::byte> out(size);
  for (std::size_t i = 0; i < size; ++i)
    out[i] = static_cast<std::byte>((i * 7 + i / 251) ^ static_cast<std::size_t>(17 * from + 5 * to + round));
  return out;
}

std::size_t length(int from, int to) { return 3141 + 1000 * static_cast<std::size_t>(from) + 77 * static_cast<std::size_t>(to); }

TEST(CommOnRanks, LongMailGoesInParts) {
  const Comm comm(MPI_COMM_WORLD, kSmall);
  Mail out;
  std::uint64_t parts = 0;
  for (int to = 0; to < comm.size(); ++to) {
    out[to] = letter(comm.rank(), to, length(comm.rank(), to));
    if (to != comm.rank()) parts += (out[to].size() + kSmall - 1) / kSmall;
  }
  const MpiTraffic before = mpi_traffic();
  const Mail in = comm.exchange(std::move(out));
  EXPECT_EQ(mpi_traffic().messages.calls - before.messages.calls, parts);
  ASSERT_EQ(in.size(), static_cast<std::size_t>(comm.size()));
  for (const auto& [from, bytes] : in) EXPECT_EQ(bytes, letter(from, comm.rank(), length(from, comm.rank()))) << from;
}

TEST(CommOnRanks, LongMessagesBetweenRanksThatKnowOfEachOtherGoInParts) {
  const Comm comm(MPI_COMM_WORLD, kSmall);
  std::vector<std::vector<std::byte>> out, in;
  for (int r = 0; r < comm.size(); ++r) {
    out.push_back(letter(comm.rank(), r, length(comm.rank(), r)));
    in.emplace_back(length(r, comm.rank()));
  }
  std::vector<Sending> sendings;
  std::vector<Receiving> receivings;
  for (int r = 0; r < comm.size(); ++r) {
    if (r == comm.rank()) continue;
    sendings.push_back({r, out[static_cast<std::size_t>(r)]});
    receivings.push_back({r, in[static_cast<std::size_t>(r)]});
  }
  comm.exchange(sendings, receivings);
  for (int r = 0; r < comm.size(); ++r)
    if (r != comm.rank()) {
      EXPECT_EQ(in[static_cast<std::size_t>(r)], letter(r, comm.rank(), length(r, comm.rank()))) << r;
    }
}

TEST(CommOnRanks, LongCollectivesGoInParts) {
  const Comm small(MPI_COMM_WORLD, kSmall), usual(MPI_COMM_WORLD);
  // One rank has nothing, and one less than its share of a round.
  const std::size_t size = small.rank() == 1 ? 0 : small.rank() == 2 ? 100 : length(small.rank(), 0);
  const std::vector<std::byte> mine = letter(small.rank(), 0, size);
  EXPECT_EQ(small.gather_to_all(mine), usual.gather_to_all(mine));

  std::vector<std::byte> told = small.rank() == small.size() - 1 ? letter(9, 9, 54321) : std::vector<std::byte>();
  small.broadcast(told, small.size() - 1);
  EXPECT_EQ(told, letter(9, 9, 54321));

  std::vector<std::int64_t> sum(777), before(777);
  std::vector<double> least(777);
  std::vector<OrderFreeSum> exact(7);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = before[i] = static_cast<std::int64_t>(i) * (small.rank() + 1);
    least[i] = static_cast<double>((i * 31 + static_cast<std::size_t>(small.rank()) * 17) % 100);
  }
  for (std::size_t i = 0; i < exact.size(); ++i) exact[i].add(0.1 * static_cast<double>(i));
  small.sum(sum);
  small.exclusive_scan(before);
  small.min(least);
  std::vector<double> total(exact.size());
  small.sum(exact, total);
  const std::int64_t all = small.size() * (small.size() + 1) / 2, those_before = small.rank() * (small.rank() + 1) / 2;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const auto factor = static_cast<std::int64_t>(i);
    EXPECT_EQ(sum[i], factor * all);
    EXPECT_EQ(before[i], factor * those_before);
    double expected = 100.0;
    for (int r = 0; r < small.size(); ++r)
      expected = std::min(expected, static_cast<double>((i * 31 + static_cast<std::size_t>(r) * 17) % 100));
    EXPECT_EQ(least[i], expected);
  }
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_DOUBLE_EQ(total[i], 0.1 * static_cast<double>(i) * small.size());
}

/// A line of ranks: mail goes to the next ones, and no other message is sent, however many ranks there are.
TEST(CommOnRanks, MailIsOneMessageForEachRankItIsFor) {
  const Comm comm(MPI_COMM_WORLD);
  std::vector<int> next;
  for (const int rank : {comm.rank() - 1, comm.rank() + 1})
    if (rank >= 0 && rank < comm.size()) next.push_back(rank);
  Mail out;
  for (const int rank : next) out[rank] = letter(comm.rank(), rank, 5000);
  const MpiTraffic before = mpi_traffic();
  const Mail in = comm.exchange(std::move(out));
  const MpiTraffic after = mpi_traffic();
  EXPECT_EQ(after.messages.calls - before.messages.calls, next.size());
  EXPECT_EQ(after.messages.bytes - before.messages.bytes, 5000 * next.size());
  EXPECT_EQ(after.collectives.calls - before.collectives.calls, comm.size() > 1 ? 1u : 0u);
  EXPECT_EQ(in.size(), next.size());
  for (const int rank : next) EXPECT_EQ(in.at(rank), letter(rank, comm.rank(), 5000));
}

/// Ranks of which some have far more to do than others: mail of one exchange is never taken for that of the next.
TEST(CommOnRanks, ExchangesThatFollowEachOtherAreNotMixedUp) {
  const Comm comm(MPI_COMM_WORLD);
  const auto sends = [&](int from, int to, int round) { return from == to || (from * 3 + to * 5 + round) % 3 != 0; };
  for (int round = 0; round < 40; ++round) {
    Mail out;
    for (int to = 0; to < comm.size(); ++to)
      if (sends(comm.rank(), to, round)) out[to] = letter(comm.rank(), to, 40 + static_cast<std::size_t>(round), round);
    const Mail in = comm.exchange(std::move(out));
    for (int from = 0; from < comm.size(); ++from) {
      ASSERT_EQ(in.contains(from), sends(from, comm.rank(), round)) << round;
      if (!in.contains(from)) continue;
      ASSERT_EQ(in.at(from), letter(from, comm.rank(), 40 + static_cast<std::size_t>(round), round)) << round;
    }
  }
}

/// Keys that one rank, some ranks or all have. The same totals whether they are added up at a home or over all ranks.
TEST(SharedSumsOnRanks, AreExactSumsOverTheRanksThatHaveAKey) {
  const Comm comm(MPI_COMM_WORLD);
  constexpr std::uint64_t kKeys = 200;
  constexpr std::size_t kTerms = 3;
  const auto has = [](int rank, std::uint64_t key) { return key % 7 == 0 || (key + static_cast<std::uint64_t>(rank)) % 3 == 0; };
  const auto term = [](int rank, std::uint64_t key, std::size_t t) {
    return (rank % 2 == 0 ? 1e16 : -1e16) + 0.1 * static_cast<double>(key) + static_cast<double>(t);
  };
  std::vector<std::uint64_t> keys;
  for (std::uint64_t key = 0; key < kKeys; ++key)
    if (has(comm.rank(), key)) keys.push_back(key);
  std::vector<OrderFreeSum> local(keys.size() * kTerms);
  for (std::size_t k = 0; k < keys.size(); ++k)
    for (std::size_t t = 0; t < kTerms; ++t) local[k * kTerms + t].add(term(comm.rank(), keys[k], t));
  for (const int few_ranks : {0, 2, 4}) {  // all keys over all ranks; those of more than two; none
    SharedSums sums;
    sums.find(keys, comm, few_ranks);
    const std::vector<double> totals = sums.totals(local, kTerms, comm);
    ASSERT_EQ(totals.size(), local.size());
    for (std::size_t k = 0; k < keys.size(); ++k)
      for (std::size_t t = 0; t < kTerms; ++t) {
        OrderFreeSum expected;
        for (int rank = 0; rank < comm.size(); ++rank)
          if (has(rank, keys[k])) expected.add(term(rank, keys[k], t));
        EXPECT_EQ(totals[k * kTerms + t], expected.value()) << few_ranks << ' ' << keys[k];
      }
  }
}

}  // namespace
}  // namespace morula
