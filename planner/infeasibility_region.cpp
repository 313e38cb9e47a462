#include "planner/infeasibility_region.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace surefoot::planner::proof {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

namespace {

constexpr int columns = 64;

/// Bits first .. last, ends included, of those within 0 .. 63.
std::uint64_t run_of(std::int64_t first, std::int64_t last) {
  first = std::max<std::int64_t>(first, 0);
  last = std::min<std::int64_t>(last, columns - 1);
  if (first > last) return 0;
  const std::uint64_t up_to_last = last == columns - 1 ? ~std::uint64_t{0} : (std::uint64_t{1} << (last + 1)) - 1;
  return up_to_last & ~((std::uint64_t{1} << first) - 1);
}

/// Least and greatest x of a convex polygon between two heights; the least is the greater where there is none.
std::pair<double, double> span_between(const Convex& polygon, double low, double high) {
  std::pair span(HUGE_VAL, -HUGE_VAL);
  const auto add = [&](double x) { span = {std::min(span.first, x), std::max(span.second, x)}; };
  const auto corners = polygon.corners();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d &a = corners[k], &b = corners[k + 1 < corners.size() ? k + 1 : 0];
    if (a.y() >= low && a.y() <= high) add(a.x());
    for (const double level : {low, high})
      if ((a.y() < level) != (b.y() < level)) add(a.x() + (b.x() - a.x()) * ((level - a.y()) / (b.y() - a.y())));
  }
  return span;
}

}  // namespace

unsigned Region::parts_in(const AlignedBox2d& box, double slack) const {
  if (bits_.empty()) return 1;
  const auto column = [&](double x) { return static_cast<std::int64_t>(std::floor((x - origin_.x()) / width_)) - i_; };
  const auto line = [&](double y) { return static_cast<std::int64_t>(std::floor((y - origin_.y()) / width_)) - j_; };
  const std::uint64_t run = run_of(column(box.min().x() - slack), column(box.max().x() + slack));
  const std::int64_t first = std::max<std::int64_t>(line(box.min().y() - slack), 0);
  const std::int64_t last = std::min<std::int64_t>(line(box.max().y() + slack), rows_ - 1);
  unsigned found = 0;
  for (int part = 0; part < parts_; ++part)
    for (std::int64_t at = first; at <= last; ++at)
      if (row(part, static_cast<int>(at)) & run) {
        found |= 1u << part;
        break;
      }
  return found;
}

bool Region::meets(int part, const Region& other, int other_part) const {
  if (bits_.empty() || other.bits_.empty()) return true;
  const std::int64_t shift = other.i_ - i_;
  if (shift <= -columns || shift >= columns) return false;
  for (int at = 0; at < rows_; ++at) {
    const std::int64_t there = at + j_ - other.j_;
    if (there < 0 || there >= other.rows_) continue;
    const std::uint64_t theirs = other.row(other_part, static_cast<int>(there));
    if (row(part, at) & (shift >= 0 ? theirs << shift : theirs >> -shift)) return true;
  }
  return false;
}

Field::Field(const gaits::Scene& scene, bool apart, double slack)
    : scene_(scene), apart_(apart && scene.robot.clearance > 0), slack_(slack), origin_(scene.terrain.bounds().min()) {
  // The reach of two feet, and a piece's length of a quarter of it, must fit into the columns of a row; where that
  // allows, a wall's clearance is several cells.
  const double reach = scene.robot.reach_max;
  width_ = std::clamp(scene.robot.clearance / 3, reach / 26, reach / 16);
}

bool Field::is_free(std::int64_t i, std::int64_t j) const {
  constexpr int halvings = 3;
  return is_free(origin_ + width_ * Vector2d(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5), width_,
                 halvings);
}

/// Whether a square about `centre` may hold a point with the clearance.
bool Field::is_free(const Vector2d& centre, double width, int halvings) const {
  const double clearance = scene_.robot.clearance, half_diagonal = width * 0.7072;
  const double here = scene_.terrain.distance(centre, clearance);
  if (here + half_diagonal < clearance - 4 * slack_) return false;
  if (here >= clearance || halvings == 0) return true;
  for (const double dx : {-width / 4, width / 4})
    for (const double dy : {-width / 4, width / 4})
      if (is_free(centre + Vector2d(dx, dy), width / 2, halvings - 1)) return true;
  return false;
}

/// Of the 64 cells from column i, those in `wanted` that are free.
std::uint64_t Field::free_cells(std::int64_t i, std::int64_t j, std::uint64_t wanted) {
  std::uint64_t result = 0;
  for (int at = 0; at < columns;) {  // two words of the cache at most
    const std::int64_t column = i + at, word_column = column >> 6;
    const int offset = static_cast<int>(column & (columns - 1)), length = std::min(columns - offset, columns - at);
    const std::uint64_t part = (wanted & run_of(at, at + length - 1)) >> at << offset;
    if (part != 0) {
      const std::uint64_t low_half = static_cast<std::uint64_t>(j) & 0xffffffffu;
      Word& word = words_[static_cast<std::uint64_t>(word_column) << 32 ^ low_half];
      for (std::uint64_t unknown = part & ~word.known; unknown != 0; unknown &= unknown - 1) {
        const int bit = std::countr_zero(unknown);
        if (is_free(word_column * columns + bit, j)) word.free |= std::uint64_t{1} << bit;
      }
      word.known |= part;
      result |= (word.free & part) >> offset << at;
    }
    at += length;
  }
  return result;
}

Region Field::region_of(const Convex& within) {
  Region region;
  if (!apart_ || within.empty()) return region;
  AlignedBox2d box;
  for (const Vector2d& corner : within.corners()) box.extend(corner);
  const auto line = [&](double at, int axis) { return std::floor((at - origin_[axis]) / width_); };
  const double first_column = line(box.min().x() - slack_, 0), last_column = line(box.max().x() + slack_, 0);
  const double first_row = line(box.min().y() - slack_, 1), last_row = line(box.max().y() + slack_, 1);
  constexpr double far = 1 << 30;  // rows and columns are numbered by 32 bits
  if (last_column - first_column >= columns || last_row - first_row >= columns || std::abs(first_column) > far ||
      std::abs(last_column) > far || std::abs(first_row) > far || std::abs(last_row) > far)
    return region;
  region.origin_ = origin_;
  region.width_ = width_;
  region.i_ = static_cast<std::int64_t>(first_column);
  region.j_ = static_cast<std::int64_t>(first_row);
  region.rows_ = static_cast<int>(last_row - first_row) + 1;
  std::vector<std::uint64_t> left(static_cast<std::size_t>(region.rows_));
  for (int at = 0; at < region.rows_; ++at) {
    const double low = origin_.y() + width_ * static_cast<double>(region.j_ + at);
    const auto [from, to] = span_between(within, low - slack_, low + width_ + slack_);
    if (from > to) continue;
    const auto column = [&](double x) { return static_cast<std::int64_t>(line(x, 0)) - region.i_; };
    left[static_cast<std::size_t>(at)] =
        free_cells(region.i_, region.j_ + at, run_of(column(from - slack_), column(to + slack_)));
  }
  split(region, std::move(left));
  return region;
}

/// Parts whose cells touch, at corners too.
void Field::split(Region& region, std::vector<std::uint64_t> left) const {
  const std::size_t rows = left.size();
  region.parts_ = 0;
  for (std::size_t seed = 0; seed < rows; ++seed) {
    while (left[seed] != 0) {
      std::vector<std::uint64_t> part(rows);
      part[seed] = left[seed] & (~left[seed] + 1);
      for (bool grows = true; grows;) {
        grows = false;
        const auto widen = [&](std::size_t at) {
          std::uint64_t near = part[at];
          if (at > 0) near |= part[at - 1];
          if (at + 1 < rows) near |= part[at + 1];
          const std::uint64_t grown = (near | near << 1 | near >> 1) & left[at];
          grows |= (grown & ~part[at]) != 0;
          part[at] |= grown;
        };
        for (std::size_t at = 0; at < rows; ++at) widen(at);
        for (std::size_t at = rows; at-- > 0;) widen(at);
      }
      for (std::size_t at = 0; at < rows; ++at) left[at] &= ~part[at];
      if (region.parts_ < most_parts) {
        region.bits_.insert(region.bits_.end(), part.begin(), part.end());
        ++region.parts_;
      } else {
        for (std::size_t at = 0; at < rows; ++at) region.bits_[(most_parts - 1) * rows + at] |= part[at];
      }
    }
  }
  if (region.bits_.empty()) region.parts_ = 0;  // no COM anywhere
}

}  // namespace surefoot::planner::proof
