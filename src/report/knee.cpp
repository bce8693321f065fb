#include "report/knee.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace formotion {
namespace {

constexpr double kLeastDistance = 1e-9;
constexpr double kSingular = 1e-9;

// One row a design, one column an objective that varies over the front, scaled to 0 (best) .. 1 (worst).
Eigen::MatrixXd scaled(const std::vector<std::vector<double>>& losses) {
  const auto rows = static_cast<Eigen::Index>(losses.size());
  Eigen::MatrixXd result(rows, 0);
  for (std::size_t k = 0; k < losses.front().size(); ++k) {
    Eigen::VectorXd column(rows);
    for (Eigen::Index i = 0; i < rows; ++i) column[i] = losses[static_cast<std::size_t>(i)][k];
    const double least = column.minCoeff(), range = column.maxCoeff() - least;
    if (!(range > 0)) continue;
    result.conservativeResize(Eigen::NoChange, result.cols() + 1);
    result.col(result.cols() - 1) = (column.array() - least) / range;
  }
  return result;
}

// The unit normal, towards the ideal, of the hyperplane through the best designs of the objectives.
Eigen::VectorXd normal_of(const Eigen::MatrixXd& designs, Eigen::VectorXd& through) {
  const Eigen::Index count = designs.cols();
  Eigen::MatrixXd edges(count - 1, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    // Of the designs that are best in objective k, the one that is best in the sum of all.
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < designs.rows(); ++i) {
      if (designs(i, k) == 0 && (best < 0 || designs.row(i).sum() < designs.row(best).sum())) best = i;
    }
    if (k == 0) {
      through = designs.row(best);
    } else {
      edges.row(k - 1) = designs.row(best) - through.transpose();
    }
  }
  Eigen::FullPivLU<Eigen::MatrixXd> lu(edges);
  lu.setThreshold(kSingular);
  Eigen::VectorXd normal = lu.kernel().col(0).normalized();
  if (normal.sum() > 0) normal = -normal;
  if (lu.dimensionOfKernel() == 1 && normal.maxCoeff() <= kSingular) return normal;
  // No hyperplane, or one that would call a loss in some objective a gain.
  through = Eigen::VectorXd::Ones(count);
  through[0] = 0;
  return Eigen::VectorXd::Constant(count, -1).normalized();
}

}  // namespace

std::optional<Knee> knee(const std::vector<std::vector<double>>& losses) {
  if (losses.size() < 3) return std::nullopt;
  const Eigen::MatrixXd designs = scaled(losses);
  if (designs.cols() < 2) return std::nullopt;
  Eigen::VectorXd through;
  const Eigen::VectorXd normal = normal_of(designs, through);
  const Eigen::VectorXd distances = (designs.rowwise() - through.transpose()) * normal;
  Eigen::Index best = 0;
  for (Eigen::Index i = 1; i < distances.size(); ++i) {
    if (distances[i] > distances[best] + kLeastDistance) best = i;
  }
  if (distances[best] <= kLeastDistance) return std::nullopt;
  return Knee{static_cast<std::size_t>(best), distances[best]};
}

}  // namespace formotion
