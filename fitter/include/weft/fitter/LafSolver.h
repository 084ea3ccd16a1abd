#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace weft {

/// What all fits of a solver have in common.
struct LafProblem {
  std::vector<glm::vec3> views;   ///< unit, tangent frame
  std::vector<glm::vec3> lights;  ///< likewise
  bool cosineInModel = false;     ///< else the model's values are seen multiplied by n.l
  float largestExponent = 80.0f;
};

/// amplitude * max(0, axes . P)^exponent with P = (lx vx, ly vy, lz vz).
///
/// The largest of |axes.x|, |axes.y| and axes.z is 1. Since |P.x| + |P.y| + P.z <= 1 above the
/// horizon, the base never exceeds 1 there, and the value never the amplitude.
struct LafLobe {
  float amplitude = 0.0f;
  glm::vec3 axes{0.0f, 0.0f, 1.0f};
  float exponent = 1.0f;
};

/// The model diffuse + lobes, and its cost: the sum of the job's squared residuals.
struct LafFit {
  float diffuse = 0.0f;
  std::vector<LafLobe> lobes;
  double cost = 0.0;
};

/// One fit: the sum over all pairs, `[view][light]`, of (target - scale * model)^2 is to become
/// small.
struct LafJob {
  std::span<const float> targets;
  std::span<const float> scales;
};

struct LafTables;

/// Fits Lafortune lobes to all views and lights of a texel at once ([Meseth 2004] [14], [Bosserhoff
/// 2003] 3.2): Levenberg-Marquardt on all samples side by side in SIMD lanes.
///
/// A lobe sees of light and view nothing but P. So samples with the same P become one, which leaves
/// an eighth of UBO2003's: exchanging light and view, and mirroring both at x or y, change nothing.
/// Immutable, thread safe.
class LafSolver {
 public:
  explicit LafSolver(LafProblem problem);
  ~LafSolver();

  /// Starts from a diffuse surface and adds, one after another, the lobe of a dictionary
  /// (mirroring, retro-reflecting, off-specular, diffuse ones of several widths) that explains most
  /// of what is left, improving all of them each time; then replaces lobes for which the dictionary
  /// has a better one by now. The result has as many lobes as asked for, some perhaps of amplitude
  /// 0, and is finite.
  LafFit fit(const LafJob& job, int lobes) const;

  /// Follows a fit to its minimum by so many steps at most.
  void improve(const LafJob& job, int iterations, LafFit& fit) const;

  /// Changes a fit, as little as the job allows, until no measured view shows more than its ceiling
  /// for any light of the hemisphere, between and below the measured ones too: the white pixels of
  /// [Meseth 2004] 5.3. Light between the lights that are looked at, 8 degrees apart, may exceed
  /// the ceiling by a few percent.
  void limit(const LafJob& job, std::span<const float> ceilings, LafFit& fit) const;

  /// The model for every pair, `[view][light]`.
  std::vector<float> values(const LafFit& fit) const;
  /// What each view shows at most, n.l included.
  std::vector<float> peaks(const LafFit& fit) const;

  /// The pairs that no lobe tells apart have one number, `[view][light]`, below groupCount().
  std::span<const std::uint32_t> groups() const;
  std::size_t groupCount() const;

 private:
  std::unique_ptr<const LafTables> tables_;
};

}  // namespace weft
