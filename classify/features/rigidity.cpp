// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/rigidity.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

double ChiSquare::ratio() const { return defined() ? value / degrees : 0; }

double ChiSquare::p_value() const {
  using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  if (!defined()) return 1;
  if (!(value < 1e12)) return 0;
  return boost::math::gamma_q(degrees / 2.0, value / 2, InDouble());
}

namespace {

using Index = Eigen::Index;
using DenseMatrix = Eigen::MatrixXd;
using DenseVector = Eigen::VectorXd;

// Measurements.

// One track in one look.
struct Seen {
  std::size_t look = 0, track = 0;
  LookCentre measured;
};

std::vector<Seen> entries_of(const TrackSet& set) {
  std::vector<Seen> entries;
  for (std::size_t j = 0; j < set.tracks.size(); ++j) {
    const std::vector<TrackPoint>& points = set.tracks[j].points;
    SEAGLINT_CHECK(points.size() == set.time_s.size(),
                   fmt::format("{} points, {} looks", points.size(), set.time_s.size()));
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!points[k].seen()) continue;
      const LookCentre& centre = points[k].measured;
      if (!std::isfinite(centre.range_m) || !std::isfinite(centre.velocity_mps))
        throw InputError(
            fmt::format("track {} at {} m, {} m/s: must be finite", j, centre.range_m, centre.velocity_mps));
      if (!(centre.range_error_m > 0) || !(centre.velocity_error_mps > 0))
        throw InputError(fmt::format("track {}: errors {} m, {} m/s: must be positive", j, centre.range_error_m,
                                     centre.velocity_error_mps));
      entries.push_back({k, j, centre});
    }
  }
  return entries;
}

// Entries that a model does not fit exactly, looks and tracks numbered anew from 0.
struct Core {
  std::vector<Seen> entries;
  std::vector<std::size_t> looks, tracks;  // numbers in the set
  std::vector<double> time_s;              // of the looks
};

// Numbers in use, and each entry's place among them.
std::vector<std::size_t> renumber(std::vector<Seen>& entries, std::size_t Seen::*number) {
  std::vector<std::size_t> used;
  for (const Seen& entry : entries) used.push_back(entry.*number);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (Seen& entry : entries)
    entry.*number = static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), entry.*number) - used.begin());
  return used;
}

Core core_of(const TrackSet& set, std::size_t least_per_look, std::size_t least_per_track) {
  Core core{entries_of(set), {}, {}, {}};
  for (std::size_t before = core.entries.size() + 1; core.entries.size() < before;) {
    before = core.entries.size();
    std::vector<std::size_t> of_look(set.time_s.size()), of_track(set.tracks.size());
    for (const Seen& entry : core.entries) ++of_look[entry.look], ++of_track[entry.track];
    std::erase_if(core.entries, [&](const Seen& entry) {
      return of_look[entry.look] < least_per_look || of_track[entry.track] < least_per_track;
    });
  }
  core.looks = renumber(core.entries, &Seen::look);
  core.tracks = renumber(core.entries, &Seen::track);
  for (const std::size_t look : core.looks) core.time_s.push_back(set.time_s[look]);
  return core;
}

// Ranges and range rates [look][track] without gaps, from which a fit starts.
struct Histories {
  DenseMatrix range_m, velocity_mps;
};

// Cubic through the ranges and rates on both sides (Hermite); constant velocity before the first and after the last.
std::array<double, 2> interpolated(const Seen& before, const Seen& after, std::span<const double> time_s, double t) {
  const LookCentre &one = before.measured, &other = after.measured;
  const double t_0 = time_s[before.look], h = time_s[after.look] - t_0, x = h > 0 ? (t - t_0) / h : 0;
  if (h <= 0) return {one.range_m + (t - t_0) * one.velocity_mps, one.velocity_mps};
  const double step = other.range_m - one.range_m;
  const double a = h * one.velocity_mps - step, b = step - h * other.velocity_mps;
  return {one.range_m + x * step + x * (1 - x) * ((1 - x) * a + x * b),
          (step + (1 - 2 * x) * ((1 - x) * a + x * b) + x * (1 - x) * (b - a)) / h};
}

Histories histories_of(const Core& core) {
  const auto looks = static_cast<Index>(core.looks.size()), tracks = static_cast<Index>(core.tracks.size());
  Histories histories{DenseMatrix(looks, tracks), DenseMatrix(looks, tracks)};
  std::size_t i = 0;  // entries are by track, then by look
  for (Index j = 0; j < tracks; ++j) {
    std::size_t end = i;
    while (end < core.entries.size() && core.entries[end].track == static_cast<std::size_t>(j)) ++end;
    for (std::size_t k = 0; k < core.looks.size(); ++k) {
      while (i + 1 < end && core.entries[i + 1].look <= k) ++i;
      const bool between = core.entries[i].look < k && i + 1 < end;
      const auto [r, v] = interpolated(core.entries[i], core.entries[between ? i + 1 : i], core.time_s, core.time_s[k]);
      histories.range_m(static_cast<Index>(k), j) = r;
      histories.velocity_mps(static_cast<Index>(k), j) = v;
    }
    i = end;
  }
  return histories;
}

// Least squares.

// A residual over its error, with its derivatives by the parameters that it depends on.
struct Residual {
  static constexpr std::size_t kMost = 9;
  double value = 0;
  std::size_t count = 0;
  std::array<Index, kMost> parameter{};
  std::array<double, kMost> derivative{};

  void depends(Index on, double by) {
    parameter[count] = on;
    derivative[count++] = by;
  }
};

template <class Model>
double chi_square(const Model& model) {
  double sum = 0;
  model.each_residual([&](const Residual& residual) { sum += residual.value * residual.value; });
  return sum;
}

// J^T J (lower triangle) and J^T e.
struct NormalEquations {
  DenseMatrix matrix;
  DenseVector gradient;
};

template <class Model>
NormalEquations normal_equations(const Model& model) {
  NormalEquations equations{DenseMatrix::Zero(model.parameters(), model.parameters()),
                            DenseVector::Zero(model.parameters())};
  model.each_residual([&](const Residual& residual) {
    for (std::size_t p = 0; p < residual.count; ++p) {
      equations.gradient(residual.parameter[p]) += residual.derivative[p] * residual.value;
      for (std::size_t q = 0; q < residual.count; ++q)
        if (residual.parameter[p] >= residual.parameter[q])
          equations.matrix(residual.parameter[p], residual.parameter[q]) +=
              residual.derivative[p] * residual.derivative[q];
    }
  });
  return equations;
}

// Marquardt (1963): (J^T J + damping diag(J^T J)) step = -J^T e. The damping also fixes the free axes and origin.
// Returns the sum of squares.
template <class Model>
double minimise(Model& model) {
  constexpr int kIterations = 100;
  constexpr double kConverged = 1e-9, kExact = 1e-20;  // relative decrease; squares of rounding errors
  double sum = chi_square(model), damping = 1e-3;
  NormalEquations equations = normal_equations(model);
  for (int i = 0; i < kIterations && sum > kExact && damping < 1e12; ++i) {
    const DenseVector diagonal = equations.matrix.diagonal();
    DenseMatrix damped = equations.matrix;
    damped.diagonal() += damping * diagonal.cwiseMax(1e-12 * diagonal.maxCoeff());
    Model trial = model;
    trial.move(damped.template selfadjointView<Eigen::Lower>().ldlt().solve(-equations.gradient));
    const double trial_sum = chi_square(trial);
    if (!(trial_sum < sum)) {
      damping *= 10;
      continue;
    }
    const bool converged = damping < 0.1 && sum - trial_sum <= kConverged * trial_sum;
    model = std::move(trial);
    sum = trial_sum;
    damping = std::max(damping / 10, 1e-12);
    if (converged) break;
    equations = normal_equations(model);
  }
  return sum;
}

// Factors of given rank.

struct Observed {
  std::size_t row = 0, track = 0;
  double value = 0, error = 1;
};

// value = mean of the row + coefficients of the row . factors of the track.
struct FactorModel {
  std::span<const Observed> observed;
  DenseMatrix row;    // [row][1 + rank]: mean, coefficients
  DenseMatrix track;  // [track][rank]

  Index rank() const { return track.cols(); }
  Index parameters() const { return row.size() + track.size(); }

  double residual(const Observed& entry) const {
    const auto k = static_cast<Index>(entry.row), j = static_cast<Index>(entry.track);
    return row(k, 0) + row.row(k).tail(rank()).dot(track.row(j)) - entry.value;
  }

  template <class Visit>
  void each_residual(Visit visit) const {
    for (const Observed& entry : observed) {
      const auto k = static_cast<Index>(entry.row), j = static_cast<Index>(entry.track);
      const Index of_row = k * row.cols(), of_track = row.size() + j * rank();
      Residual e{residual(entry) / entry.error};
      e.depends(of_row, 1 / entry.error);
      for (Index p = 0; p < rank(); ++p) {
        e.depends(of_row + 1 + p, track(j, p) / entry.error);
        e.depends(of_track + p, row(k, 1 + p) / entry.error);
      }
      visit(e);
    }
  }

  void move(const DenseVector& step) {
    for (Index k = 0; k < row.rows(); ++k) row.row(k) += step.segment(k * row.cols(), row.cols()).transpose();
    for (Index j = 0; j < track.rows(); ++j) track.row(j) += step.segment(row.size() + j * rank(), rank()).transpose();
  }
};

// Mean error of each row.
DenseVector row_errors(std::span<const Observed> observed, Index rows) {
  DenseVector sums = DenseVector::Zero(rows), counts = DenseVector::Zero(rows);
  for (const Observed& entry : observed) {
    sums(static_cast<Index>(entry.row)) += entry.error;
    counts(static_cast<Index>(entry.row)) += 1;
  }
  return sums.cwiseQuotient(counts);
}

// One more factor: the first singular vectors of the residuals over their errors, 0 where an entry is missing.
FactorModel with_next_factor(const FactorModel& model) {
  const Index rows = model.row.rows(), tracks = model.track.rows(), rank = model.rank();
  DenseMatrix residuals = DenseMatrix::Zero(rows, tracks);
  for (const Observed& entry : model.observed)
    residuals(static_cast<Index>(entry.row), static_cast<Index>(entry.track)) = -model.residual(entry) / entry.error;
  const Eigen::JacobiSVD<DenseMatrix> svd(residuals, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const double root = std::sqrt(svd.singularValues()(0));
  FactorModel next{model.observed, DenseMatrix(rows, rank + 2), DenseMatrix(tracks, rank + 1)};
  next.row << model.row, row_errors(model.observed, rows).cwiseProduct(svd.matrixU().col(0)) * root;
  next.track << model.track, svd.matrixV().col(0) * root;
  return next;
}

// Mean rows and singular vectors of values without gaps [row][track], in units of the rows' errors.
FactorModel factors_of(std::span<const Observed> observed, const DenseMatrix& values, const DenseVector& errors,
                       Index rank) {
  FactorModel model{observed, DenseMatrix::Zero(values.rows(), 1 + rank), DenseMatrix::Zero(values.cols(), rank)};
  model.row.col(0) = values.rowwise().mean();
  const DenseMatrix scaled = errors.cwiseInverse().asDiagonal() * (values.colwise() - model.row.col(0));
  const Eigen::JacobiSVD<DenseMatrix> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Index used = std::min(rank, svd.singularValues().size());
  const DenseVector root = svd.singularValues().head(used).cwiseSqrt();
  model.row.middleCols(1, used) = errors.asDiagonal() * svd.matrixU().leftCols(used) * root.asDiagonal();
  model.track.leftCols(used) = svd.matrixV().leftCols(used) * root.asDiagonal();
  return model;
}

// Least squares from the singular vectors of `values`, which are the observed ones with gaps filled. Gaps make local
// minima: with them a second fit goes factor by factor, each from the one before, and the smaller sum counts.
FactorModel fit_factors(std::span<const Observed> observed, const DenseMatrix& values, int rank) {
  const Index rows = values.rows(), tracks = values.cols();
  FactorModel model = factors_of(observed, values, row_errors(observed, rows), rank);
  const double sum = minimise(model);
  if (static_cast<Index>(observed.size()) == rows * tracks) return model;
  FactorModel stepwise{observed, DenseMatrix::Zero(rows, 1), DenseMatrix::Zero(tracks, 0)};
  double stepwise_sum = minimise(stepwise);
  for (int q = 0; q < rank; ++q) {
    stepwise = with_next_factor(stepwise);
    stepwise_sum = minimise(stepwise);
  }
  return stepwise_sum < sum ? stepwise : model;
}

std::vector<Observed> velocities_of(const Core& core) {
  std::vector<Observed> observed;
  for (const Seen& entry : core.entries)
    observed.push_back({entry.look, entry.track, entry.measured.velocity_mps, entry.measured.velocity_error_mps});
  return observed;
}

Index size_of(const std::vector<std::size_t>& numbers) { return static_cast<Index>(numbers.size()); }

Core core_of_rank(const TrackSet& set, int rank) {
  SEAGLINT_CHECK(rank >= 0 && rank <= 3, fmt::format("rank = {}", rank));
  const auto q = static_cast<std::size_t>(rank);
  return core_of(set, q + 2, q + 1);
}

}  // namespace

ChiSquare rank_test(const TrackSet& set, int rank) {
  const Core core = core_of_rank(set, rank);
  const int degrees = static_cast<int>(core.entries.size()) - static_cast<int>(core.looks.size()) * (1 + rank) -
                      static_cast<int>(core.tracks.size()) * rank + rank * rank + rank;
  if (core.entries.empty() || degrees <= 0) return {};
  const std::vector<Observed> observed = velocities_of(core);
  return {chi_square(fit_factors(observed, histories_of(core).velocity_mps, rank)), degrees};
}

std::vector<VelocityResidual> rank_residuals(const TrackSet& set, int rank, FitWeights weights) {
  constexpr double kHuber = 2;  // errors
  const int repeats = weights == FitWeights::kHuber ? 10 : 0;
  const Core core = core_of_rank(set, rank);
  std::vector<Observed> observed = velocities_of(core);
  if (observed.empty()) return {};
  FactorModel model = fit_factors(observed, histories_of(core).velocity_mps, rank);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (std::size_t i = 0; i < observed.size(); ++i) {
      const double error = core.entries[i].measured.velocity_error_mps;
      observed[i].error = error * std::sqrt(std::max(1.0, std::abs(model.residual(observed[i])) / (kHuber * error)));
    }
    minimise(model);
  }
  std::vector<VelocityResidual> residuals;
  for (std::size_t i = 0; i < observed.size(); ++i)
    residuals.push_back({core.looks[observed[i].row], core.tracks[observed[i].track], -model.residual(observed[i])});
  return residuals;
}

// The rigid body.

namespace {

struct RigidLook {
  double rho = 0, nu = 0;  // range and range rate of the origin of body axes
  Vec3 b{1, 0, 0}, a{0, 0, 0};

  // Two unit vectors across b and each other.
  std::array<Vec3, 2> across() const {
    const Vec3 first = b.cross(std::abs(b.x()) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
    return {first, b.cross(first)};
  }
};

struct RigidModel {
  std::span<const Seen> entries;
  std::vector<RigidLook> looks;
  std::vector<Vec3> points;

  static constexpr Index kOfLook = 6, kOfPoint = 3;  // rho, nu, two of b, two of a; s
  Index parameters() const {
    return kOfLook * static_cast<Index>(looks.size()) + kOfPoint * static_cast<Index>(points.size());
  }

  template <class Visit>
  void each_residual(Visit visit) const {
    for (const Seen& entry : entries) {
      const RigidLook& look = looks[entry.look];
      const Vec3& s = points[entry.track];
      const std::array<Vec3, 2> t = look.across();
      const Index of_look = kOfLook * static_cast<Index>(entry.look);
      const Index of_point = kOfLook * static_cast<Index>(looks.size()) + kOfPoint * static_cast<Index>(entry.track);

      const double of_range = 1 / entry.measured.range_error_m;
      Residual r{of_range * (look.rho - s.dot(look.b) - entry.measured.range_m)};
      r.depends(of_look, of_range);
      const double of_rate = 1 / entry.measured.velocity_error_mps;
      Residual v{of_rate * (look.nu - s.dot(look.a) - entry.measured.velocity_mps)};
      v.depends(of_look + 1, of_rate);
      for (Index i = 0; i < 2; ++i) {
        const Vec3& t_i = t[static_cast<std::size_t>(i)];
        r.depends(of_look + 2 + i, -of_range * s.dot(t_i));
        v.depends(of_look + 2 + i, of_rate * s.dot(look.b) * look.a.dot(t_i));  // a stays across b
        v.depends(of_look + 4 + i, -of_rate * s.dot(t_i));
      }
      for (Index i = 0; i < kOfPoint; ++i) {
        r.depends(of_point + i, -of_range * look.b[static_cast<std::size_t>(i)]);
        v.depends(of_point + i, -of_rate * look.a[static_cast<std::size_t>(i)]);
      }
      visit(r);
      visit(v);
    }
  }

  void move(const DenseVector& step) {
    const double* next = step.data();
    for (RigidLook& look : looks) {
      const std::array<Vec3, 2> t = look.across();
      look.rho += next[0];
      look.nu += next[1];
      look.b = (look.b + t[0] * next[2] + t[1] * next[3]).normalized();
      look.a += t[0] * next[4] + t[1] * next[5];
      look.a -= look.b * look.b.dot(look.a);
      next += kOfLook;
    }
    for (Vec3& s : points) {
      s += Vec3(next[0], next[1], next[2]);
      next += kOfPoint;
    }
  }
};

// Ranges and rates in factors of rank 3: columns x along the mean line of sight, y and z across it in an unknown
// metric. Coefficients b, a of looks [look][3], means rho, nu.
struct JointFactors {
  DenseMatrix points;  // [track][3], mean 0
  DenseMatrix b, a;    // [look][3]
  DenseVector rho, nu;
  double of_range = 1, of_rate = 1;  // mean errors
};

JointFactors joint_factors(const Core& core) {
  std::vector<Observed> observed;  // rows 2k ranges, 2k + 1 rates
  const Histories histories = histories_of(core);
  DenseMatrix values(2 * size_of(core.looks), size_of(core.tracks));
  for (Index k = 0; k < size_of(core.looks); ++k)
    values.middleRows(2 * k, 2) << histories.range_m.row(k), histories.velocity_mps.row(k);
  JointFactors factors;
  const double share = 1 / static_cast<double>(core.entries.size());
  factors.of_range = factors.of_rate = 0;
  for (const Seen& entry : core.entries) {
    const LookCentre& centre = entry.measured;
    observed.push_back({2 * entry.look, entry.track, centre.range_m, centre.range_error_m});
    observed.push_back({2 * entry.look + 1, entry.track, centre.velocity_mps, centre.velocity_error_mps});
    factors.of_range += share * centre.range_error_m;
    factors.of_rate += share * centre.velocity_error_mps;
  }
  const FactorModel model = fit_factors(observed, values, 3);

  // x = s . mean b. The remainder of s, without x, has rank 2.
  const Index looks = size_of(core.looks);
  const Eigen::RowVectorXd centroid = model.track.colwise().mean();
  const DenseMatrix s = model.track.rowwise() - centroid;
  DenseMatrix b(looks, 3), a(looks, 3);
  factors.rho.resize(looks), factors.nu.resize(looks);
  for (Index k = 0; k < looks; ++k) {
    b.row(k) = -model.row.row(2 * k).tail(3);
    a.row(k) = -model.row.row(2 * k + 1).tail(3);
    factors.rho(k) = model.row(2 * k, 0) - centroid.dot(b.row(k));
    factors.nu(k) = model.row(2 * k + 1, 0) - centroid.dot(a.row(k));
  }
  const DenseVector x = s * b.colwise().mean().transpose();
  const double xx = x.squaredNorm();
  const DenseMatrix rest = xx > 0 ? DenseMatrix(s - x * (x.transpose() * s) / xx) : s;
  const Eigen::JacobiSVD<DenseMatrix> svd(rest, Eigen::ComputeThinU);
  factors.points.resize(s.rows(), 3);
  factors.points << x, svd.matrixU().leftCols(2) * svd.singularValues().head(2).asDiagonal();

  const Eigen::CompleteOrthogonalDecomposition<DenseMatrix> axes(factors.points);
  factors.b = axes.solve(s * b.transpose()).transpose();
  factors.a = axes.solve(s * a.transpose()).transpose();
  return factors;
}

using Metric = Eigen::Matrix3d;  // b^T Q b' is the scalar product of two coefficients

// The metric Q that makes b unit and a perpendicular to it: b^T Q b = 1, b^T Q a = 0, in units of the errors (Tomasi
// and Kanade 1992, section 3.3, for one direction a look).
Metric metric_of(const JointFactors& factors) {
  constexpr std::array<std::array<Index, 2>, 6> kEntries{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  const Index looks = factors.b.rows();
  DenseMatrix left(2 * looks, 6);
  DenseVector right = DenseVector::Zero(2 * looks);
  for (Index k = 0; k < looks; ++k) {
    const Eigen::RowVector3d b = factors.b.row(k), a = factors.a.row(k);
    for (Index i = 0; i < 6; ++i) {
      const auto [p, q] = kEntries[static_cast<std::size_t>(i)];
      left(2 * k, i) = (p == q ? 1 : 2) * b(p) * b(q) / (2 * factors.of_range);
      left(2 * k + 1, i) = (p == q ? b(p) * a(p) : b(p) * a(q) + b(q) * a(p)) / factors.of_rate;
    }
    right(2 * k) = 1 / (2 * factors.of_range);
  }
  const DenseVector q = left.colPivHouseholderQr().solve(right);
  Metric metric;
  metric << q(0), q(3), q(4), q(3), q(1), q(5), q(4), q(5), q(2);
  return metric;
}

// Metrics to start from: that of the factors if it is one, and those that make the body this many times as broad as its
// extent along the line of sight.
std::vector<Metric> start_metrics(const JointFactors& factors) {
  std::vector<Metric> metrics;
  const Metric measured = metric_of(factors);
  if (measured.allFinite() && Eigen::SelfAdjointEigenSolver<Metric>(measured).eigenvalues().minCoeff() > 0)
    metrics.push_back(measured);
  const double along = factors.points.col(0).norm(), across = factors.points.col(1).norm();
  for (const double breadth : {1.0, 0.3, 3.0}) {
    const double scale = along > 0 && across > 0 ? across / (breadth * along) : 1;
    metrics.push_back(Eigen::Vector3d(1, scale * scale, scale * scale).asDiagonal());
  }
  return metrics;
}

RigidModel rigid_start(const Core& core, const JointFactors& factors, const Metric& metric) {
  const Eigen::SelfAdjointEigenSolver<Metric> solver(metric);
  const DenseMatrix b = factors.b * solver.operatorSqrt(), a = factors.a * solver.operatorSqrt();
  const DenseMatrix s = factors.points * solver.operatorInverseSqrt();
  RigidModel model{core.entries, {}, {}};
  for (Index k = 0; k < b.rows(); ++k) {
    RigidLook look{factors.rho(k), factors.nu(k), Vec3(b(k, 0), b(k, 1), b(k, 2)).normalized(),
                   Vec3(a(k, 0), a(k, 1), a(k, 2))};
    look.a -= look.b * look.b.dot(look.a);
    model.looks.push_back(look);
  }
  for (Index j = 0; j < s.rows(); ++j) model.points.emplace_back(s(j, 0), s(j, 1), s(j, 2));
  return model;
}

}  // namespace

RigidBody fit_rigid_body(const TrackSet& set) {
  constexpr double kGoodFit = 0.1;  // p-value from which other starts are not tried
  RigidBody body{{}, std::vector<Vec3>(set.tracks.size(), Vec3(kNan, kNan, kNan))};
  const Core core = core_of(set, 4, 2);
  const int degrees = 2 * static_cast<int>(core.entries.size()) - 6 * static_cast<int>(core.looks.size()) -
                      3 * static_cast<int>(core.tracks.size()) + 6;
  if (core.looks.size() < 3 || degrees <= 0) return body;
  body.test = {std::numeric_limits<double>::infinity(), degrees};
  const JointFactors factors = joint_factors(core);
  for (const Metric& metric : start_metrics(factors)) {
    RigidModel model = rigid_start(core, factors, metric);
    const double sum = minimise(model);
    if (!(sum < body.test.value)) continue;
    body.test.value = sum;
    Vec3 centroid{0, 0, 0};
    for (const Vec3& s : model.points) centroid += s / static_cast<double>(model.points.size());
    for (std::size_t j = 0; j < core.tracks.size(); ++j) body.points_m[core.tracks[j]] = model.points[j] - centroid;
    if (body.test.p_value() > kGoodFit) break;
  }
  return body;
}

}  // namespace seaglint
