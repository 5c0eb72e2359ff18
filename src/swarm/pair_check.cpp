// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/swarm/pair_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "swarm_planner/swarm/clearance_proof.hpp"

namespace swarm_planner {
namespace {

constexpr double kTimeTolerance = CommittedMotion::kTimeTolerance;
/// Shares of a doubt that are tried, the largest first.
constexpr std::array<double, 4> kShares{1.0, 0.75, 0.5, 0.25};

/// One motion against another UAV's, on the union of their knots. Times are in seconds after the first one's epoch.
class PairCheck {
 public:
  PairCheck(const CommittedMotion& motion, const OtherMotion& other, const CheckLimits& limits)
      : motion_(motion),
        other_(*other.motion),
        doubt_(other.doubt),
        offset_(other.motion->epoch() - motion.epoch()),
        end_(other.valid_until - motion.epoch()),
        limits_(limits),
        proof_(limits.pair_horizontal, limits.pair_vertical),
        widest_(proofWith(other.doubt.limit)) {}

  CheckVerdict run(const Vector3& committed) {
    // Before its epoch the other one may be anywhere along its first piece, drawn out.
    if (end_ < 0.0 || (offset_ <= kTimeTolerance && widest_.areApart(motion_.box(), other_.box()))) return {};
    relieve(committed);
    for (int first = 0; first < motion_.pieces(); first += CommittedMotion::kGroup) {
      const int last = std::min(first + CommittedMotion::kGroup, motion_.pieces());
      if (first * motion_.dt() > end_) return {};
      if (areApart(first, last)) continue;
      for (int k = first; k < last && k * motion_.dt() <= end_; ++k) {
        if (areApart(k, k + 1)) continue;
        const CheckVerdict verdict = checkPiece(k, k * motion_.dt(), (k + 1) * motion_.dt());
        if (!verdict.accepted()) return verdict;
      }
    }
    if (motion_.duration() > end_) return {};
    // The other one may fly on while this one rests; once both rest nothing changes any more.
    const double end = motion_.duration();
    const double other_end = std::max(offset_ + other_.duration(), end);
    if (offset_ <= end &&
        widest_.areApart(motion_.pieceBox(motion_.pieces()), other_.boxOver(end - offset_, other_end - offset_))) {
      return {};
    }
    return checkPiece(motion_.pieces(), end, other_end + motion_.dt());
  }

 private:
  /// Whether pieces [first, last) are certainly clear of the other UAV at those times.
  bool areApart(int first, int last) const {
    const double from = first * motion_.dt() - offset_;
    const double to = last * motion_.dt() - offset_;
    if (from < -kTimeTolerance) return false;
    const Box& own = last - first == 1 ? motion_.pieceBox(first) : motion_.groupBox(first / CommittedMotion::kGroup);
    return widest_.areApart(own, other_.boxOver(from, to));
  }

  PairProof proofWith(double extra) const {
    return PairProof(limits_.pair_horizontal + extra, limits_.pair_vertical + extra);
  }

  /// Whether UAVs `d` apart are outside of the ellipsoid with `extra` on its semi-axes.
  bool isOutside(const Vector3& d, double extra) const {
    const Vector3 scaled(d.x() / (limits_.pair_horizontal + extra), d.y() / (limits_.pair_horizontal + extra),
                         d.z() / (limits_.pair_vertical + extra));
    return scaled.squaredNorm() >= 1.0;
  }

  /// Takes from the semi-axes what the committed motion lacks of them, if the start lacks something.
  void relieve(const Vector3& committed) {
    double extra = -kDistanceTolerance;
    const Vector3 other = other_.after(-offset_).p;
    if (!isOutside(motion_.start() - other, extra) && !isOutside(committed - other, 0.0)) {
      double inside = 0.0;
      double outside = (kLeastScale - 1.0) * std::min(limits_.pair_horizontal, limits_.pair_vertical);
      for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (inside + outside);
        (isOutside(committed - other, middle) ? outside : inside) = middle;
      }
      extra += outside;
    }
    extra_ = extra;
    proof_ = proofWith(extra);
    widest_ = proofWith(extra + doubt_.limit);
  }

  /// The most that the doubt is while piece k, the rest included, is flown until `end` [m].
  double doubtUntil(int k, double end) const {
    return k < motion_.pieces() ? doubt_.at(motion_.epoch() + end) : doubt_.limit;
  }

  /// Where the other UAV is in `piece` (its index) over [from, to], extrapolated if need be.
  BernsteinPoints<4> otherCurve(int piece, double from, double to) const {
    const BernsteinPoints<4> points = other_.piece(piece);
    if (piece >= other_.pieces()) return points;
    const double begin = (from - offset_) / other_.dt() - piece;
    const double end = (to - offset_) / other_.dt() - piece;
    const double tolerance = kTimeTolerance / other_.dt();
    if (std::abs(begin) < tolerance && std::abs(end - 1.0) < tolerance) return points;
    return subcurve(points, begin, end);
  }

  /// `k`: of the first motion, over [from, to].
  CheckVerdict checkPiece(int k, double from, double to) {
    const BernsteinPoints<4> own = motion_.piece(k);
    const double scaled = (from - offset_ + kTimeTolerance) / other_.dt();
    int piece = scaled > 0.0 ? static_cast<int>(std::min(scaled, static_cast<double>(other_.pieces()))) : 0;
    for (double begin = from; begin < to - kTimeTolerance; ++piece) {
      const double knot = offset_ + (piece + 1) * other_.dt();
      const double end = piece < other_.pieces() && knot < to - kTimeTolerance ? knot : to;
      if (offset_ <= begin && widest_.areApart(motion_.pieceBox(k), other_.pieceBox(piece))) {
        begin = end;
        continue;
      }
      const bool whole = (begin == from && end == to) || k == motion_.pieces();
      BernsteinPoints<4> relative =
          whole ? own : subcurve(own, (begin - from) / motion_.dt(), (end - from) / motion_.dt());
      const BernsteinPoints<4> other = otherCurve(piece, begin, end);
      for (std::size_t i = 0; i < relative.size(); ++i) relative[i] -= other[i];
      if (!doubt_.isNone()) proof_ = proofWith(extra_ + doubtUntil(k, end));
      const ClearanceFinding finding = proof_.prove(relative, begin, end);
      if (!finding.clear) return {CheckReason::kUav, finding.time, -1, finding.undecided};
      begin = end;
    }
    return {};
  }

  /// Of the least semi-axes; UAVs closer than that would divide by nothing.
  static constexpr double kLeastScale = 1e-3;

  const CommittedMotion& motion_;
  const CommittedMotion& other_;
  const MotionDoubt doubt_;
  double offset_;  ///< the other's epoch minus the first one's [s]
  double end_;     ///< until when the other one may be flown [s]
  const CheckLimits& limits_;
  double extra_ = 0.0;  ///< demanded on top of the least semi-axes, without the doubt [m]
  PairProof proof_;     ///< of what is demanded now
  PairProof widest_;    ///< of the most that is ever demanded
};

}  // namespace

CheckVerdict checkPair(const CommittedMotion& motion, const OtherMotion& other, const Vector3& committed,
                       const CheckLimits& limits) {
  return PairCheck(motion, other, limits).run(committed);
}

double bearableShare(const CommittedMotion& flown, const OtherMotion& other, const CheckLimits& limits) {
  for (const double share : kShares) {
    const OtherMotion less{other.motion, other.valid_until, other.doubt.times(share)};
    if (checkPair(flown, less, flown.start(), limits).accepted()) return share;
  }
  return 0.0;
}

void limitDoubts(double epoch, const CommittedMotion& flown, const CheckLimits& limits, CommittedMotion& rest,
                 std::vector<OtherMotion>& others) {
  bool has_rest = false;
  for (OtherMotion& other : others) {
    if (other.doubt.isNone()) continue;
    if (!has_rest) {
      rest = flown;
      rest.dropPieces(rest.endedPieces(epoch));
      has_rest = true;
    }
    other.doubt = other.doubt.times(bearableShare(rest, other, limits));
  }
}

}  // namespace swarm_planner
