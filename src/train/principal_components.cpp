#include "train/principal_components.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"

namespace svnet::train {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

constexpr Index kSpare = 50;          // directions of the subspace beyond those that are wanted
constexpr int kIterations = 3;        // of the subspace
constexpr Index kChunk = 128;         // rows or columns of a product that are made f64 at once
constexpr double kLeastShare = 1e-9;  // of the largest variance: below it there is only rounding

/// The rows minus their mean, as an operator. A chunk of a product is made by one thread as a whole.
class CentredRows {
 public:
  CentredRows(const Rows& rows, Parallel& parallel) : rows_(rows), parallel_(parallel), mean_(rows.cols()) {
    for_chunks(rows_.cols(), [&](Index begin, Index size) {
      mean_.segment(begin, size) = rows_.middleCols(begin, size).cast<double>().colwise().mean();
    });
  }
  const VectorXd& mean() const { return mean_; }

  /// X d: (rows, directions).
  MatrixXd times(const MatrixXd& d) const {
    MatrixXd product(rows_.rows(), d.cols());
    for_chunks(rows_.rows(), [&](Index begin, Index size) {
      const MatrixXd part = rows_.middleRows(begin, size).cast<double>().rowwise() - mean_.transpose();
      product.middleRows(begin, size).noalias() = part * d;
    });
    return product;
  }

  /// Xᵀ y: (inputs, directions).
  MatrixXd transposed_times(const MatrixXd& y) const {
    MatrixXd product(rows_.cols(), y.cols());
    for_chunks(rows_.cols(), [&](Index begin, Index size) {
      const MatrixXd part =
          rows_.middleCols(begin, size).cast<double>().rowwise() - mean_.segment(begin, size).transpose();
      product.middleRows(begin, size).noalias() = part.transpose() * y;
    });
    return product;
  }

 private:
  template <class Body>
  void for_chunks(Index count, const Body& body) const {
    parallel_.for_chunks(count, kChunk, [&](Index begin, Index end, int) { body(begin, end - begin); });
  }

  const Rows& rows_;
  Parallel& parallel_;
  VectorXd mean_;
};

/// An orthonormal basis of the columns.
MatrixXd orthonormal(const MatrixXd& columns) {
  const Eigen::HouseholderQR<MatrixXd> qr(columns);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

MatrixXd random_directions(Index inputs, Index count, std::uint64_t seed) {
  MatrixXd directions(inputs, count);
  RandomStream random(seed, Stream::components);
  for (Index column = 0; column < count; ++column)
    for (Index row = 0; row < inputs; ++row) directions(row, column) = random.normal();
  return directions;
}

}  // namespace

PrincipalComponents principal_components(const std::vector<float>& values, Index inputs, Index most, std::uint64_t seed,
                                         Parallel& parallel) {
  check(inputs > 0 && most > 0 && !values.empty() && values.size() % static_cast<std::size_t>(inputs) == 0,
        "[components] ", values.size(), " values are no rows of ", inputs);
  const Index count = static_cast<Index>(values.size()) / inputs;
  const Rows rows(values.data(), count, inputs);
  const CentredRows centred(rows, parallel);

  MatrixXd basis = orthonormal(random_directions(inputs, std::min({most + kSpare, count, inputs}), seed));
  for (int i = 0; i < kIterations; ++i) basis = orthonormal(centred.transposed_times(centred.times(basis)));
  const MatrixXd seen = centred.times(basis);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(seen.transpose() * seen / static_cast<double>(count));
  check(solver.info() == Eigen::Success && std::isfinite(solver.eigenvalues().sum()),
        "[components] the rows have no principal components: is a value not finite?");
  const VectorXd variances = solver.eigenvalues().reverse();  // descending
  check(variances[0] > 0, "[components] the ", count, " rows are all the same");

  PrincipalComponents result{.inputs = inputs};
  result.mean.assign(centred.mean().begin(), centred.mean().end());
  for (const double variance : variances)
    if (result.components < most && variance > kLeastShare * variances[0]) {
      result.variances.push_back(variance);
      ++result.components;
    }
  MatrixXd directions = basis * solver.eigenvectors().rowwise().reverse().leftCols(result.components);
  const double length = std::sqrt(static_cast<double>(result.components) / variances.head(result.components).sum());
  result.directions.resize(static_cast<std::size_t>(inputs * result.components));
  for (Index column = 0; column < result.components; ++column) {
    Index largest = 0;
    directions.col(column).cwiseAbs().maxCoeff(&largest);
    const double scale = directions(largest, column) < 0 ? -length : length;
    for (Index row = 0; row < inputs; ++row)
      result.directions[static_cast<std::size_t>(row * result.components + column)] = scale * directions(row, column);
  }
  return result;
}

}  // namespace svnet::train
