#include "witness/contact_lcp.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace formotion::witness {
namespace {

Eigen::Vector3d wrench_of(const Point& force, const Point& lever) {
  return {force.x(), force.y(), cross(lever, force)};
}
Point tangent(const LcpContact& c) { return {-c.normal.y(), c.normal.x()}; }
Eigen::Vector3d normal_wrench(const LcpContact& c) { return wrench_of(c.normal, c.lever); }
Eigen::Vector3d tangent_wrench(const LcpContact& c) { return wrench_of(tangent(c), c.lever); }
Eigen::Vector3d mobility(const LcpCase& lcp) { return {1, 1, 1 / (lcp.gyration_mm * lcp.gyration_mm)}; }

// w = M z + q, z = (ln, l+, l-, s) with all contacts in each block.
struct Matrices {
  Eigen::MatrixXd m;
  Eigen::VectorXd q;
  Eigen::MatrixXd force;  // wrench of the contacts = force z
};

Matrices matrices(const LcpCase& lcp) {
  const auto k = static_cast<Eigen::Index>(lcp.contacts.size());
  Eigen::MatrixXd jacobian(3 * k, 3);  // of normal, tangential and reverse tangential velocities
  Matrices result{Eigen::MatrixXd::Zero(4 * k, 4 * k), Eigen::VectorXd::Zero(4 * k), Eigen::MatrixXd::Zero(3, 4 * k)};
  for (Eigen::Index i = 0; i < k; ++i) {
    const LcpContact& contact = lcp.contacts[static_cast<std::size_t>(i)];
    jacobian.row(i) = normal_wrench(contact).transpose();
    jacobian.row(k + i) = tangent_wrench(contact).transpose();
    jacobian.row(2 * k + i) = -jacobian.row(k + i);
  }
  result.force.leftCols(3 * k) = jacobian.transpose();
  const Eigen::Vector3d d = mobility(lcp);
  result.m.topLeftCorner(3 * k, 3 * k) = jacobian * d.asDiagonal() * jacobian.transpose();
  result.q.head(3 * k) = jacobian * d.cwiseProduct(lcp.wrench);
  for (Eigen::Index i = 0; i < k; ++i) {
    result.m(k + i, 3 * k + i) = result.m(2 * k + i, 3 * k + i) = 1;
    result.m(3 * k + i, i) = lcp.friction;
    result.m(3 * k + i, k + i) = result.m(3 * k + i, 2 * k + i) = -1;
  }
  return result;
}

Twist3 twist_of(const LcpCase& lcp, const Matrices& matrices, const Eigen::VectorXd& z) {
  return mobility(lcp).cwiseProduct(lcp.wrench + matrices.force * z);
}

// Row of the lexicographically least ratio (row of the tableau) / (entry in column) over positive entries; -1: none.
Eigen::Index leaving_row(const Eigen::MatrixXd& tableau, Eigen::Index column, Eigen::Index n) {
  Eigen::Index best = -1;
  for (Eigen::Index row = 0; row < n; ++row) {
    if (tableau(row, column) <= 1e-10) continue;
    if (best < 0) {
      best = row;
      continue;
    }
    // The right hand side first, then the columns of the basis' inverse (those of w).
    double difference =
        tableau(row, 2 * n + 1) / tableau(row, column) - tableau(best, 2 * n + 1) / tableau(best, column);
    for (Eigen::Index j = 0; std::abs(difference) < 1e-12 && j < n; ++j) {
      difference = tableau(row, j) / tableau(row, column) - tableau(best, j) / tableau(best, column);
    }
    if (difference < 0) best = row;
  }
  return best;
}

}  // namespace

std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                         const Eigen::VectorXd& cover) {
  const Eigen::Index n = q.size();
  // Columns: w (0..n-1), z (n..2n-1), z0 (2n), right hand side (2n+1).
  Eigen::MatrixXd tableau = Eigen::MatrixXd::Zero(n, 2 * n + 2);
  tableau.leftCols(n).setIdentity();
  tableau.middleCols(n, n) = -m;
  tableau.col(2 * n) = -cover;
  tableau.col(2 * n + 1) = q;
  std::vector<Eigen::Index> basis(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) basis[static_cast<std::size_t>(i)] = i;
  const auto pivot = [&](Eigen::Index row, Eigen::Index column) {
    tableau.row(row) /= tableau(row, column);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i != row) tableau.row(i) -= (tableau(i, column) * tableau.row(row)).eval();
    }
    const Eigen::Index left = basis[static_cast<std::size_t>(row)];
    basis[static_cast<std::size_t>(row)] = column;
    return left;
  };
  if (q.minCoeff() < 0) {
    // z0 enters where q / cover is least.
    Eigen::Index row = 0;
    for (Eigen::Index i = 1; i < n; ++i) {
      if (q(i) / cover(i) < q(row) / cover(row)) row = i;
    }
    Eigen::Index left = pivot(row, 2 * n);
    for (int steps = 0; left != 2 * n; ++steps) {
      const Eigen::Index enters = left < n ? left + n : left - n;
      row = leaving_row(tableau, enters, n);
      if (row < 0 || steps > 1000) return std::nullopt;
      // z0 leaves as soon as it can.
      const auto z0 = std::find(basis.begin(), basis.end(), 2 * n);
      const Eigen::Index z0_row = z0 - basis.begin();
      if (z0 != basis.end() && tableau(z0_row, enters) > 1e-10) {
        const double least = tableau(row, 2 * n + 1) / tableau(row, enters);
        if (tableau(z0_row, 2 * n + 1) / tableau(z0_row, enters) <= least + 1e-12) row = z0_row;
      }
      left = pivot(row, enters);
    }
  }
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index variable = basis[static_cast<std::size_t>(i)];
    if (variable >= n && variable < 2 * n) z(variable - n) = tableau(i, 2 * n + 1);
  }
  return z;
}

std::optional<Twist3> twist_by_lemke(const LcpCase& lcp, const Eigen::VectorXd& cover) {
  const Matrices lcp_of = matrices(lcp);
  const auto z = solve_lcp(lcp_of.m, lcp_of.q, cover);
  if (!z) return std::nullopt;
  return twist_of(lcp, lcp_of, *z);
}

std::vector<Twist3> twists_by_bases(const LcpCase& lcp, double tolerance) {
  const Matrices lcp_of = matrices(lcp);
  const Eigen::Index n = lcp_of.q.size();
  std::vector<Twist3> twists;
  for (std::uint32_t chosen = 0; chosen < (1u << n); ++chosen) {
    // Those of z that are not zero solve (M z + q) = 0 in their own rows; the other rows must not be negative.
    std::vector<Eigen::Index> in;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (chosen >> i & 1) in.push_back(i);
    }
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    if (!in.empty()) {
      const Eigen::FullPivLU<Eigen::MatrixXd> lu(lcp_of.m(in, in));
      if (!lu.isInvertible()) continue;
      z(in) = lu.solve(-lcp_of.q(in));
    }
    if (z.minCoeff() < -tolerance || (lcp_of.m * z + lcp_of.q).minCoeff() < -tolerance) continue;
    const Twist3 twist = twist_of(lcp, lcp_of, z);
    const bool known =
        std::any_of(twists.begin(), twists.end(), [&](const Twist3& other) { return (other - twist).norm() < 1e-7; });
    if (!known) twists.push_back(twist);
  }
  return twists;
}

double violation(const LcpCase& lcp, const Twist3& twist, double tolerance) {
  std::vector<Eigen::Vector3d> generators;
  double depth = 0;
  for (const LcpContact& contact : lcp.contacts) {
    const double apart = normal_wrench(contact).dot(twist), slides = tangent_wrench(contact).dot(twist);
    depth = std::max(depth, -apart);
    if (apart > tolerance) continue;
    if (slides > -tolerance) generators.push_back(normal_wrench(contact) - lcp.friction * tangent_wrench(contact));
    if (slides < tolerance) generators.push_back(normal_wrench(contact) + lcp.friction * tangent_wrench(contact));
  }
  const Eigen::Vector3d needed = twist.cwiseQuotient(mobility(lcp)) - lcp.wrench;
  double least = needed.norm();
  const std::size_t count = generators.size();
  for (std::size_t subset = 1; subset < (std::size_t{1} << count); ++subset) {
    std::vector<std::size_t> in;
    for (std::size_t i = 0; i < count; ++i) {
      if (subset >> i & 1) in.push_back(i);
    }
    if (in.size() > 3) continue;
    Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(in.size()));
    for (std::size_t i = 0; i < in.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = generators[in[i]];
    const Eigen::VectorXd weights = columns.colPivHouseholderQr().solve(needed);
    if (weights.minCoeff() < -tolerance) continue;
    least = std::min(least, (columns * weights - needed).norm());
  }
  return least + std::max(0.0, depth);
}

}  // namespace formotion::witness
