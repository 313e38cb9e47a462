// The single checks that the verifier puts together: each looks at one rule at one place of a plan, by brute force, and
// notes what is broken. Part of the verifier; the search must not use it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gaits/verifier.hpp"
#include "gaits/verifier_geometry.hpp"

namespace surefoot::gaits::bare {

/// A foot rebuilt from (chain, s) of the plan.
struct Foot {
  double s = 0;  ///< [m]
  const terrain::Segment* segment = nullptr;
  Point position = Point::Zero();
};
using Posture = std::array<std::optional<Foot>, leg_count>;

class Checks {
 public:
  explicit Checks(const Scene& scene)
      : scene_(scene), strips_(scene.terrain), slack_(verifier_slack * scene.robot.reach_max) {}

  template <typename... Parts>
  void note(Rule rule, const std::string& place, fmt::format_string<Parts...> format, Parts&&... parts) {
    faults_.push_back({rule, place, fmt::format(format, std::forward<Parts>(parts)...)});
  }
  /// The same for a safety factor that the plan states and the scene does not have.
  template <class... Parts>
  void note_stated(Rule rule, const std::string& place, fmt::format_string<Parts...> format, Parts&&... parts) {
    note(rule, place, format, std::forward<Parts>(parts)...);
    faults_.back().stated = true;
  }

  /// The foot at (chain, s); also compares the segment with what is stated. Nothing where no foot can be, or where the
  /// position stated is another one: a lost foot. `stated` is referred to until tell_lost_feet and
  /// tell_renumbered_feet.
  std::optional<Foot> rebuild(const std::string& place, int leg, const terrain::Foothold& stated);
  /// Notes all feet lost so far, and what has come between them and the ground where that can be told.
  void tell_lost_feet();
  /// Notes all feet so far that stand where the plan says, but on another segment.
  void tell_renumbered_feet();
  void check_reach(const std::string& place, const Posture& feet, const Point& from, const Point& to);
  void check_clearance(const std::string& place, const Point& from, const Point& to);
  void check_leg(const std::string& place, const char* when, int leg, const Point& com, const Foot& foot);
  void check_swing(const std::string& place, const Point& com, const Foot& old_foot, const Foot& new_foot);
  void check_stance_stability(const std::string& place, const Posture& feet, const Point& com, double stated);
  void check_line_stability(const std::string& place, const Posture& feet, const Point& from, const Point& to,
                            double stated);

  double slack() const { return slack_; }                ///< [m]
  double least_factor() const { return least_factor_; }  ///< of all stances and lines checked so far
  std::vector<Fault>& faults() { return faults_; }

 private:
  struct LostFoot {
    std::string place;
    int leg;
    const terrain::Foothold* stated;
    std::string message;
  };
  struct StandingFoot {
    std::string place;
    int leg;
    const terrain::Foothold* stated;
    int segment;  ///< on which it stands
    std::int64_t too_high() const { return std::int64_t{stated->segment} - segment; }
  };
  static bool vertices_explain(std::vector<const StandingFoot*> feet);
  template <typename... Parts>
  void lose(const std::string& place, int leg, const terrain::Foothold& stated, fmt::format_string<Parts...> format,
            Parts&&... parts) {
    lost_.push_back(
        {place, leg, &stated, fmt::format("foot {} ", leg + 1) + fmt::format(format, std::forward<Parts>(parts)...)});
  }
  struct Found {
    int chain;
    double s;  ///< [m]
  };
  /// Where on the ground the stated position lies, on the stated chain if it can be; nothing if it lies elsewhere.
  std::optional<Found> ground_at(const terrain::Foothold& stated) const;
  static std::string cause_of(const terrain::Foothold& stated, const Found& found);  ///< why it is found there
  /// Where the place is `unstable`, it goes without saying that it has not the factor stated.
  void check_factor(Rule rule, const std::string& place, double stated, double found, bool unstable);
  void sample_line(const std::string& place, const Posture& feet, const Point& from, const Point& to,
                   double least_factor, bool certified);
  /// For disturbances of `scale` times the scene's.
  stability::RobustOracle oracle_of_feet(const Posture& feet, double scale) const;
  /// Transfers, and what safety factors mean; stances are asked by criterion.
  bool robust() const { return scene_.criterion != Criterion::equilibrium; }
  void check_frictional(const std::string& place, const stability::RobustOracle& oracle, const Point& com);
  bool stable(const stability::RobustOracle& oracle, const Point& com) const;
  double factor(const stability::RobustOracle& oracle, const Point& com) const;

  const Scene& scene_;
  Strips strips_;
  const double slack_;
  double least_factor_ = std::numeric_limits<double>::infinity();
  std::vector<Fault> faults_;
  std::vector<LostFoot> lost_;
  std::vector<StandingFoot> standing_;
};

std::string show(const Point& p);  ///< "(1.5, 0.25)", for messages

/// Whether two safety factors are the same to safety_factor_tolerance.
bool same_factor(double stated, double found);

}  // namespace surefoot::gaits::bare
