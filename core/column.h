#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace morula {

/// How many values of a column a body has: one, or one for each of its nodes, edges or faces.
enum class Domain : std::uint8_t { kBody, kNode, kEdge, kFace };

/// Which bodies have values of a column.
enum class Fill : std::uint8_t {
  kAll,        ///< every body, as many as the domain says
  kAllOrNone,  ///< a body has as many as the domain says, or none, which stands for the usual value
  kAny,        ///< every body has a list of any length
};

/// What becomes of a column when the surface of a shell gets another mesh, as at a division by cut.
enum class OnNewMesh : std::uint8_t {
  kMade,        ///< follows from the new mesh; whoever makes it sets it
  kKept,        ///< the body has its old value, or its mother's
  kByVolume,    ///< shared like the volume
  kMean,        ///< every node has the mean of the old ones
  kByPlace,     ///< a face has what the old face nearest to its middle has
  kByCoverage,  ///< bits of faces, each by itself: the faces that cover its old area best
};

/// What events and steps do with a column, beside carrying it along.
struct ColumnRules {
  bool grows = false;  ///< changed before the mechanics of a step: a refused step takes it back
  OnNewMesh on_new_mesh = OnNewMesh::kKept;
};

/// One value of each body. `all`: the column of a table; `one`: where a record of one body keeps its value.
template <class T, class Table, class Record>
struct ColumnOfBodies {
  using Value = T;
  static constexpr Domain kDomain = Domain::kBody;
  static constexpr Fill kFill = Fill::kAll;
  const char* name;
  const char* unit;
  std::vector<T> Table::*all;
  T Record::*one;
  ColumnRules rules{};

  [[nodiscard]] std::span<const T> values(const Table& table, std::size_t i) const { return {&(table.*all)[i], 1}; }
  [[nodiscard]] std::span<const T> values(const Record& record) const { return {&(record.*one), 1}; }
  void append(Table& table, std::span<const T> values) const { (table.*all).push_back(values[0]); }
  /// The values of the bodies first, …, last − 1 of another table.
  void append(Table& table, const Table& from, std::size_t first, std::size_t last) const {
    const std::span<const T> values = std::span(from.*all).subspan(first, last - first);
    (table.*all).insert((table.*all).end(), values.begin(), values.end());
  }
  void give(Record& record, std::span<const T> values) const { record.*one = values[0]; }
  /// The values of all bodies of another table.
  void copy(Table& table, const Table& from) const { table.*all = from.*all; }
  void reserve(Table& table, std::size_t count) const { (table.*all).reserve(count); }
  [[nodiscard]] std::size_t memory(const Table& table) const { return (table.*all).capacity() * sizeof(T); }
};

}  // namespace morula
