// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swarm_planner/problem/segment.hpp"

namespace swarm_planner {

/// For every box of a set the other boxes that it overlaps, by a grid: the cost grows with the number of neighbours,
/// not with the square of the number of boxes. Memory is reused from call to call.
class NeighbourLists {
 public:
  /// Indices of the neighbours of one box, ascending.
  struct List {
    const std::uint32_t* first;
    const std::uint32_t* last;
    const std::uint32_t* begin() const { return first; }
    const std::uint32_t* end() const { return last; }
  };

  /// Memory for sets of `boxes` boxes, however crowded up to a thousand.
  void reserve(std::size_t boxes);
  /// Empty boxes (as Box is constructed) have no neighbours.
  void build(const std::vector<Box>& boxes);
  List of(std::size_t box) const {
    return {neighbours_.data() + offsets_[box], neighbours_.data() + offsets_[box + 1]};
  }
  std::size_t size() const { return offsets_.empty() ? 0 : offsets_.size() - 1; }

 private:
  using Cell = std::array<std::int64_t, 3>;

  /// A box as its bucket holds it, so that a bucket is read from one end to the other.
  struct Member {
    Cell cell;  ///< of the box's centre
    Box box;
    std::uint32_t index;
  };

  void sortIntoBuckets(const std::vector<Box>& boxes);
  void findNeighbours(const Box& box, std::size_t index);
  void sortLists(std::size_t boxes);
  std::size_t bucketOf(const Cell& cell) const;

  std::vector<Cell> cells_;                  ///< of each box's centre
  std::vector<std::uint32_t> bucket_begin_;  ///< bucket b holds members_[bucket_begin_[b] .. bucket_begin_[b + 1])
  std::vector<Member> members_;
  std::vector<std::uint32_t> found_;  ///< as neighbours_, each list in any order
  std::vector<std::uint32_t> filled_;
  std::vector<std::uint32_t> offsets_;
  std::vector<std::uint32_t> neighbours_;
};

}  // namespace swarm_planner
